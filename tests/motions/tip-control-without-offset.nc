; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; expect: rapid X1 Y2 Z3
; error: E0911 at 8
G0 C0. X1. Y2. Z3.
G43.4 Z4.
M30
