; post: fanuc-lathe
; stock: cylinder 41x80
; tool: 1=Q3R0.8
; note: the rapid goes along Z before it is clear of the shoulder at Z-10
; finding: error E0971 at 15: tool 1, 4.5 mm deep at X16 Y0 Z-14.18, 5.68 mm long
; removed: 1=7726
%
O2001
N10 G99 G18 G40
N20 G21
N50 T0101
N90 G97 S900 M3
N110 G0 X32. Z2.
N120 G1 Z-10. F0.2
N130 G0 Z-15.
N140 X50.
N160 Z50.
N370 M30
%
