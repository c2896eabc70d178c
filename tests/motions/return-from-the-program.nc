; expect: end
; error: E0913 at 4
M99
M30
