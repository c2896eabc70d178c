; expect: end
; error: E0913 at 4
M30
G0 X1.
