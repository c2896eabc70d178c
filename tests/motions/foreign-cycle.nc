; post: grbl
; expect: rapid X0 Y0 Z5
; error: E0904 at 5
G0 X0. Y0. Z5.
G81 X1. Y0. Z-1. R1. F100.
M30
