; post: fanuc-lathe
; note: F of a thread is its lead and no feed for what follows.
; expect: rapid X20 Y? Z3
; expect: thread X20 Y? Z-30 F2/rev
; error: E0908 at 8
G0 X40. Z3.
G32 Z-30. F2.
G1 X50.
