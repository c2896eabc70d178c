; expect: rapid X0 Y0 Z0
; error: E0908 at 4
G0 X0. Y0. Z0.
G1 X1.
