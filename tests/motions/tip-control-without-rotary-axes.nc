; note: The plain mill has three axes.
; expect: rapid X1 Y1 Z1
; error: E0904 at 5:1
G0 X1. Y1. Z1.
G43.4 H1
M30
