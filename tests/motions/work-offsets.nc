; note: Where the axes stand in another work offset is not known before they are told to go there.
; expect: modes T0 G54
; expect: rapid X1 Y2 Z3
; expect: modes T0 G55
; expect: rapid X4 Y? Z?
; expect: end
G54 G0 X1. Y2. Z3.
G55
X4.
M30
