; post: haas-mill
; stock: box 60x40x20
; grid: 0.5
; tool: 1=D10
; note: two pockets with a wall of 10 mm between; the way over goes at rapid 3 mm below the top
; finding: error E0971 at 19: tool 1, 3 mm deep at X26.75 Y15.25 Z-3, 18.25 mm long
; removed: 1=1653
%
O00001
G21 G90 G94 G17 G40 G80
T1 M6
S3000 M3
G0 X15. Y20.
G43 Z20. H1
Z1.
G1 Z-5. F200.
X25.
G0 Z-3.
X45.
G1 Z-5. F200.
G0 Z20.
M30
%
