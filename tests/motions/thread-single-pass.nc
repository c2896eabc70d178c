; post: fanuc-lathe
; expect: rapid X20 Y? Z3
; expect: thread X20 Y? Z-30 F2/rev
; expect: rapid X25 Y? Z-30
; expect: end
G0 X40. Z3.
G32 Z-30. F2.
G0 X50.
M30
