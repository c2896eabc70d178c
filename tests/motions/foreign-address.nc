; post: grbl
; error: E0905 at 3
T1
M30
