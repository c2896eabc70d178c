; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; set: rotary.tip_control=1
; note: The part is taken as it lies with the table at 0, so C need not be known; the tip
; note: is known when the program names it.
; expect: rapid X1 Y2 Z3 p?
; expect: modes T0 H1 tip-control
; expect: rapid tip X? Y? Z4 p?
; expect: rapid tip X1 Y2 Z4 p?
; expect: feed tip X1 Y2 Z4 p90 F100
; expect: end
G0 X1. Y2. Z3.
G43.4 H1 Z4.
X1. Y2.
G1 C90. F100.
M30
