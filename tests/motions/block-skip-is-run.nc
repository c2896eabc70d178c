; expect: rapid X1 Y? Z?
; expect: rapid X2 Y? Z?
; expect: end
G0 X1.
/N20 X2.
M30
