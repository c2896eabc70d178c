; post: fanuc-lathe
; stock: cylinder 41x80
; tool: 1=D6
; note: a mill beside the axis of the spindle
; finding: warning W0978 at 13: tool 1: drill or mill away from the spindle axis
%
O2001
N10 G98 G18 G40
N20 G21
N50 T0101
N90 G97 S900 M3
N110 G0 X20. Z2.
N120 G1 Z-10. F100.
N370 M30
%
