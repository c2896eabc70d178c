; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_k=1
; expect: rapid X1 Y2 Z3
; expect: rapid X1 Y2 Z2 cycle
; expect: feed X1 Y2 Z-5 F100 cycle
; expect: rapid X1 Y2 Z3 cycle
; error: E0905 at 12:1
G0 C0. X1. Y2. Z3.
G98 G81 Z-5. R2. F100.
G43.4 H1
M30
