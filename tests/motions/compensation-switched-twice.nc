; expect: rapid X0 Y0 Z0
; error: E0905 at 5
G0 X0. Y0. Z0.
G41 D1
G42 D1
M30
