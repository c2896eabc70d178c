; expect: rapid X0 Y0 Z5
; error: E0911 at 4
G0 X0. Y0. Z5.
G81 X1. R2. F50.
M30
