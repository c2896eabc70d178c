; post: fanuc-lathe
; note: K is what the lead gains in each turn; below zero it must not come to nothing.
; expect: rapid X20 Y? Z3
; expect: thread X20 Y? Z-30 F2/rev 0.1 more in each
; expect: rapid X20 Y? Z3
; expect: thread X20 Y? Z-10 F2/rev -0.1 more in each
; expect: rapid X20 Y? Z3
; error: E0902 at 14
G0 X40. Z3.
G34 Z-30. F2. K0.1
G0 Z3.
G34 Z-10. F2. K-0.1
G0 Z3.
G34 Z-30. F2. K-0.1
