; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; expect: rapid X1 Y2 Z3 p90
; error: E0905 at 8:4
G0 C90. X1. Y2. Z3.
G0 G43.4 H1 Z4.
M30
