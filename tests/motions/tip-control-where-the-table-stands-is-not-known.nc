; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; expect: rapid X1 Y2 Z3 p?
; error: E0911 at 8:1
G0 X1. Y2. Z3.
G43.4 H1 Z4.
M30
