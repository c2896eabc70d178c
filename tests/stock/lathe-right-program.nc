; post: fanuc-lathe
; stock: cylinder 41x80
; tool: 1=Q3R0.8
; tool: 3=Q3R0.2W3
; tool: 5=D10A118
; note: finishing, a groove, a hole on the axis; nothing is wrong
; removed: 1=7379
; removed: 3=1044
; removed: 5=1413
%
O2001
N10 G99 G18 G40
N20 G21
N50 T0101
N90 G97 S900 M3
N110 G0 X32. Z2.
N120 G1 Z-10. F0.2
N130 X40. Z-12.
N140 Z-40.
N145 X43.
N150 G0 X50.
N160 Z50.
N180 M5
N220 T0303
N250 G97 S900 M3
N270 G0 X48. Z2.
N280 Z-30.
N290 G1 X34. F0.1
N300 G0 X48.
N310 Z50.
N320 T0505
N330 G97 S900 M3
N340 G0 X0. Z2.
N350 G1 Z-20. F0.1
N360 G0 Z50.
N370 M30
%
