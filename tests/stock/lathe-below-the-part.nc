; post: fanuc-lathe
; stock: cylinder 42x70
; part: shaft.stl
; tool: 1=Q3R0
; note: the front is 30 in diameter down to Z-20, and turned to 29
; finding: error E0974 at 19: tool 1 cuts 0.5 mm below the part at X14.5 Y0 Z-9.922, 9.94 mm long
; removed: 1=14025
%
O2001
N10 G99 G18 G40
N20 G21
N50 T0101
N90 G97 S900 M3
N110 G0 X30. Z2.
N120 G1 Z-20. F0.2
N125 X44.
N130 G0 Z2.
N140 X29.
N150 G1 Z-10. F0.2
N155 X44.
N160 G0 Z50.
N370 M30
%
