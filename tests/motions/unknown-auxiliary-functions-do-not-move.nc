; expect: M11
; expect: M21
; expect: M33
; expect: rapid X1 Y? Z?
; expect: end
M11
M21
G0 X1. M33
M30
