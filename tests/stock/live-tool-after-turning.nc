; post: fanuc-mill-turn
; stock: cylinder 41x80
; tool: 1=Q3R0.8
; tool: 2=D6
; note: the turning is cut, although C is not known yet; the live tool is named. pi (20.5² - 19²) 10 = 1861, less the fillet of the nose
; finding: warning W0978 at 27: tool 2: drill or mill away from the spindle axis
; finding: warning W0978 at 28: tool 2: live tool: Y or C moves
; removed: 1=1845
%
O2001
N10 G99 G18 G40
N20 G21
N50 T0101
N90 G97 S900 M3
N110 G0 X38. Z2.
N120 G1 Z-10. F0.2
N130 X44.
N140 G0 Z50.
N145 M5
N148 M51
N150 T0202
N155 G97 S2000 M13
N160 G0 X50. C0.
N165 G12.1
N170 G1 G98 X50. C0. F3000.
N172 Z-5.
N174 X30. C0. F100.
N176 X0. C15.
N178 G13.1
N190 G0 Z50.
N370 M30
%
