; expect: rapid X0 Y0 Z0
; expect: feed X1 Y0 Z0 F0.2/rev
; expect: feed X2 Y0 Z0 F100
; expect: feed X3 Y0 Z0 F4/inverse
; error: E0908 at 10
G0 X0. Y0. Z0.
G95 G1 X1. F.2
G94 X2. F100.
G93 X3. F4.
X4.
