; stock: box 60x40x20
; grid: 0.5
; tool: 1=D10
; note: M5 before the last cut
; finding: error E0973 at 16: tool 1, 2 mm deep at X0.25 Y25.25 Z-2, 59.5 mm long
; removed: 1=2400
G21 G90 G94 G17
T1 M6
S3000 M3
G0 X-10. Y10.
G43 Z20. H1
Z-2.
G1 X70. F300.
M5
G1 Y30.
X-10.
G0 Z20.
M30
