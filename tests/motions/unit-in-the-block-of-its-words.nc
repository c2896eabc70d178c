; note: G20 holds for the words before it in the block too.
; expect: rapid X25.4 Y? Z?
; expect: end
G0 X1. G20
M30
