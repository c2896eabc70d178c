; post: fanuc-lathe
; stock: tube 80x24x60
; tool: 2=Q2R0.4L2H14x30H40x30
; note: the block behind the bar, 30 mm from its tip, is 40 thick about its middle: from 12.5 - 9 + 20 = 23.5 on, 11 into the wall, down to Z-20, in, across and out
; finding: error E0972 at 14-16: tool 2, 11 mm deep at X23.5 Y0 Z-19.965, 59.94 mm long
; removed: 2=1922
%
O2001
N10 G99 G18 G40
N20 G21
N50 T0202
N90 G97 S900 M3
N110 G0 X25. Z2.
N120 G1 Z-50. F0.1
N130 G0 X23.
N160 Z50.
N370 M30
%
