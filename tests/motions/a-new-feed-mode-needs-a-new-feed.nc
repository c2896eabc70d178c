; expect: rapid X0 Y0 Z0
; expect: feed X1 Y0 Z0 F100
; error: E0908 at 6
G0 X0. Y0. Z0.
G1 X1. F100.
G95 X2.
