; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; expect: modes T0 G54
; expect: rapid X1 Y2 Z3
; expect: modes T0 H1 tip-control G54
; expect: rapid tip X1 Y2 Z4
; error: E0905 at 14:1
G54
G0 C0. X1. Y2. Z3.
G43.4 H1 Z4.
G54
G55
M30
