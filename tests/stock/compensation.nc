; stock: box 60x40x20
; grid: 0.5
; tool: 1=D10
; finding: warning W0976 at 12-13: the path is taken as that of the tool center
; removed: 1=1200
G21 G90 G94 G17
T1 M6
S3000 M3
G0 X-20. Y10.
G43 Z20. H1
Z-2.
G1 G41 X-10. Y10. D1 F300.
X70.
G40 X80.
G0 Z20.
M30
