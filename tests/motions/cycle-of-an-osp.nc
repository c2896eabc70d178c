; set: cycle.return_codes=3
; note: G71 is the level of M53, M54 returns to R, and nothing moves in the block of G71.
; expect: rapid X0 Y0 Z30
; expect: rapid X0 Y0 Z2 cycle
; expect: feed X0 Y0 Z-5 F100 cycle
; expect: rapid X0 Y0 Z20 cycle
; expect: rapid X10 Y0 Z20 cycle
; expect: rapid X10 Y0 Z2 cycle
; expect: feed X10 Y0 Z-5 F100 cycle
; expect: rapid X10 Y0 Z20 cycle
; expect: rapid X20 Y0 Z20 cycle
; expect: rapid X20 Y0 Z2 cycle
; expect: feed X20 Y0 Z-5 F100 cycle
; expect: rapid X20 Y0 Z2 cycle
; expect: end
G0 X0. Y0. Z30.
G71 Z20.
G81 X0. Y0. Z-5. R2. F100. M53
X10.
G81 X20. Y0. Z-5. R2. F100. M54
G80
M30
