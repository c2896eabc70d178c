; post: fanuc-lathe
; note: In, along, out, back; the next block says only the new diameter. R is the radius at the start less that at the end.
; expect: rapid X22 Y? Z4
; expect: rapid X19 Y? Z4 cycle
; expect: thread X19 Y? Z-30 F2/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: rapid X18.5 Y? Z4 cycle
; expect: thread X18.5 Y? Z-30 F2/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: rapid X17.5 Y? Z4 cycle
; expect: thread X18.5 Y? Z-30 F2/rev cycle
; expect: rapid X22 Y? Z-30 cycle
; expect: rapid X22 Y? Z4 cycle
; expect: rapid X50 Y? Z4
; expect: end
G0 X44. Z4.
G92 X38. Z-30. F2.
X37.
G92 X37. Z-30. R-1. F2.
G0 X100.
M30
