; expect: rapid X? Y0 Z0
; error: E0909 at 4
G0 Y0. Z0.
G3 X0. Y10. I-10. J0. F100.
M30
