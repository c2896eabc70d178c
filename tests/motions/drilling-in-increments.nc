; note: R counts from the level before the cycle, Z from R.
; expect: rapid X0 Y0 Z10
; expect: rapid X5 Y0 Z10 cycle
; expect: rapid X5 Y0 Z2 cycle
; expect: feed X5 Y0 Z-3 F100 cycle
; expect: rapid X5 Y0 Z2 cycle
; expect: rapid X10 Y0 Z2 cycle
; expect: feed X10 Y0 Z-3 F100 cycle
; expect: rapid X10 Y0 Z2 cycle
; expect: end
G90 G0 X0. Y0. Z10.
G91 G99 G81 X5. Z-5. R-8. F100.
X5.
G90 G80
M30
