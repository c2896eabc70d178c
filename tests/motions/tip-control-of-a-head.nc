; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_i=0
; set: rotary.primary_j=0
; set: rotary.primary_k=1
; set: rotary.secondary_kind=2
; set: rotary.secondary_letter=2
; set: rotary.secondary_axis=2
; set: rotary.secondary_i=0
; set: rotary.secondary_j=1
; set: rotary.secondary_k=0
; set: rotary.pivot_distance=150
; note: The length of the tool is the control's: with the head turned, the tip is where
; note: the program says it next.
; expect: rapid X? Y? Z? s?
; expect: rapid X1 Y2 Z3 s?
; expect: rapid X1 Y2 Z3 s20
; expect: modes T0 H2 tip-control
; expect: rapid tip X? Y? Z9 s20
; expect: rapid tip X4 Y? Z9 s20
; expect: rapid tip X4 Y5 Z9
; expect: modes T0
; expect: rapid X4 Y5 Z10
; expect: end
G0 C0.
X1. Y2. Z3.
B20.
G43.4 H2 Z9.
X4.
Y5. B0.
G49
Z10.
M30
