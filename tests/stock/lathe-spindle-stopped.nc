; post: fanuc-lathe
; stock: tube 41x20x80
; tool: 1=Q2R0.4
; note: boring with the spindle stopped
; finding: error E0973 at 13: tool 1, 1 mm deep at X11 Y0 Z-9.58, 10 mm long
; removed: 1=657
%
O2001
N10 G98 G18 G40
N20 G21
N50 T0101
N110 G0 X22. Z2.
N120 G1 Z-10. F100.
N130 G0 X20.
N160 Z50.
N370 M30
%
