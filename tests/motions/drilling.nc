; note: G99 stays at R, G98 returns to the level before the cycle.
; expect: rapid X0 Y0 Z50
; expect: rapid X10 Y0 Z50 cycle
; expect: rapid X10 Y0 Z2 cycle
; expect: feed X10 Y0 Z-5 F100 cycle
; expect: rapid X10 Y0 Z2 cycle
; expect: rapid X20 Y0 Z2 cycle
; expect: feed X20 Y0 Z-5 F100 cycle
; expect: rapid X20 Y0 Z2 cycle
; expect: rapid X20 Y10 Z2 cycle
; expect: feed X20 Y10 Z-7 F100 cycle
; expect: rapid X20 Y10 Z50 cycle
; expect: rapid X0 Y10 Z50
; expect: end
G90 G0 X0. Y0.  Z50.
G99 G81 X10. Y0. Z-5. R2. F100.
X20.
G98 Y10. Z-7.
G80
G0 X0.
M30
