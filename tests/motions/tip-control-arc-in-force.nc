; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; expect: rapid X1 Y2 Z3
; expect: arc cw X5 Y2 Z3 I3 J2 180deg F100
; error: E0905 at 11
G0 C0. X1. Y2. Z3.
G2 X5. I2. J0. F100.
G43.4 H1
X9. I2. J0.
M30
