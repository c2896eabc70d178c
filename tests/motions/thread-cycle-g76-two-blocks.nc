; post: fanuc-lathe
; note: Height 1 mm, first pass .5, then .5 times the roots of 2 and 3 up to .9, then one finishing pass at 1. No angle, so no infeed.
; expect: rapid X22 Y? Z4
; expect: rapid X19.5 Y? Z4 cycle
; expect: thread X19.5 Y? Z-30 F1.5/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: rapid X19.2929 Y? Z4 cycle
; expect: thread X19.2929 Y? Z-30 F1.5/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: rapid X19.134 Y? Z4 cycle
; expect: thread X19.134 Y? Z-30 F1.5/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: rapid X19.1 Y? Z4 cycle
; expect: thread X19.1 Y? Z-30 F1.5/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: rapid X19 Y? Z4 cycle
; expect: thread X19 Y? Z-30 F1.5/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: end
G0 X44. Z4.
G76 P010000 Q20 R.1
G76 X38. Z-30. R0. P1000 Q500 F1.5
M30
