; expect: rapid X1 Y? Z?
; expect: end
M11
M21
G0 X1. M33
M30
