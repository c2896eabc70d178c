; expect: rapid X10 Y0 Z0
; error: E0909 at 4
G0 X10. Y0. Z0.
G3 X0. Y11. F100.
M30
