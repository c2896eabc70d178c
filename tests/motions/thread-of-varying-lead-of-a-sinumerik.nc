; post: sinumerik-lathe
; note: F is what the lead gains by G34, or loses by G35, in each turn, and no feed.
; expect: rapid X20 Y? Z3
; expect: thread X20 Y? Z-30 F2/rev 0.1 more in each
; expect: rapid X20 Y? Z3
; expect: thread X20 Y? Z-10 F2/rev -0.1 more in each
; expect: rapid X20 Y? Z3
; error: E0902 at 14
DIAMON G18 G0 X40 Z3
G34 Z-30 K2 F0.1
G0 Z3
G35 Z-10 K2 F0.1
G0 Z3
G35 Z-30 K2 F0.1
