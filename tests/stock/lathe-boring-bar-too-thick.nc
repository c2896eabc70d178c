; post: fanuc-lathe
; stock: tube 80x24x60
; tool: 2=Q2R0.4L2H30x60
; note: a bar 30 mm thick reaches from 12.5 - 2 = 10.5 over the axis to 19.5 on the other side, 7 mm into the wall, and at X23 8 mm into what is cut, 8.24 where the nose leaves a corner
; finding: error E0972 at 14-16: tool 2, 8.236 mm deep at X20.5 Y0 Z-49.965, 149.94 mm long
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
