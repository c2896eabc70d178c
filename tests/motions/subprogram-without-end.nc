; expect: end
; error: E0912 at 5
M30
O1001
G0 X1.
