; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; set: rotary.secondary_kind=1
; set: rotary.secondary_letter=1
; set: rotary.secondary_axis=1
; set: rotary.tip_control=1
; expect: rapid X1 Y2 Z3 p20 s10
; expect: modes T0 H1 tip-control
; expect: rapid tip X1 Y2 Z4 p20 s10
; expect: feed tip X2 Y2 Z4 p20 s30 F100
; expect: feed tip X3 Y2 Z4 p20 s30 F100
; expect: end
G0 A10. C20. X1. Y2. Z3.
G43.5 H1
X1. Y2. Z4. I0.0593912 J-0.1631759 K0.9848078
G1 X2. I0.17101 J-0.469846 K0.866025 F100.
X3.
G49
M30
