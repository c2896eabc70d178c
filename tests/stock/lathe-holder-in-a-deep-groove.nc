; post: fanuc-lathe
; stock: cylinder 60x80
; tool: 3=Q3R0.2W3L8H20x100
; note: 11 mm deep with 8 mm below the shank, which is 20 mm wide from the left side of the insert on: 17 mm of it are over the wall to Z+, in and out
; finding: error E0972 at 14-15: tool 3, 3 mm deep at X27 Y0 Z-26.98, 34 mm long
; removed: 3=5078
%
O2001
N10 G99 G18 G40
N20 G21
N50 T0303
N90 G97 S900 M3
N110 G0 X62. Z-30.
N120 G1 X38. F0.1
N130 G0 X62.
N160 Z50.
N370 M30
%
