; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; expect: rapid X1 Y2 Z3
; expect: modes T0 H1 tip-control
; expect: rapid tip X1 Y2 Z4
; expect: modes T0
; expect: machine X1 Y2 Z?
; expect: machine X? Y? Z?
; expect: end
G0 C0. X1. Y2. Z3.
G43.4 H1 Z4.
G49 G53 G0 Z0.
G28 X1. Y2.
M30
