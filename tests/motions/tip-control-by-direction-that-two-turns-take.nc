; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; set: rotary.secondary_kind=1
; set: rotary.secondary_letter=1
; set: rotary.secondary_axis=1
; set: rotary.tip_control=1
; expect: rapid X1 Y2 Z3 s10
; error: E0905 at 13:1
G0 A10. C0. X1. Y2. Z3.
G43.5 H1
G1 X2. I0. J0.173648 K0.984808 F100.
M30
