; post: fanuc-lathe
; note: Height 1 mm, passes at .8 and 1 and one more at 1; half of 90 degrees makes the infeed as long as the depth.
; expect: rapid X12 Y? Z4
; expect: rapid X12 Y? Z3.2 cycle
; expect: rapid X10.2 Y? Z3.2 cycle
; expect: thread X10.2 Y? Z-20 F2/rev cycle
; expect: rapid X12 Y? Z-20 cycle
; expect: rapid X12 Y? Z4 cycle
; expect: rapid X12 Y? Z3 cycle
; expect: rapid X10 Y? Z3 cycle
; expect: thread X10 Y? Z-20 F2/rev cycle
; expect: rapid X12 Y? Z-20 cycle
; expect: rapid X12 Y? Z4 cycle
; expect: rapid X12 Y? Z3 cycle
; expect: rapid X10 Y? Z3 cycle
; expect: thread X10 Y? Z-20 F2/rev cycle
; expect: rapid X12 Y? Z-20 cycle
; expect: rapid X12 Y? Z4 cycle
; expect: end
G0 X24. Z4.
G76 X20. Z-20. K1. D0.8 I0. A90. F2.
M30
