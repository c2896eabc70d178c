; post: fanuc-lathe
; stock: tube 80x24x60
; tool: 2=Q2R0.4L2H14x60
; note: at X25 the bar reaches from 12.5 - 2 = 10.5 to -3.5: it fits. pi (12.5² - 12²) 50 = 1924, less the corner that the nose leaves
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
