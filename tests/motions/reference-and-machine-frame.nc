; expect: rapid X1 Y2 Z3
; expect: machine X1 Y2 Z?
; expect: rapid X1 Y2 Z10
; expect: rapid X1 Y2 Z0
; expect: machine X1 Y2 Z?
; expect: machine X1 Y2 Z?
; expect: machine X? Y? Z?
; expect: end
G0 X1. Y2. Z3.
G91 G28 Z0.
G90
G0 Z10.
G28 Z0.
G53 G0 Z-5.
G28 X1. Y2.
M30
