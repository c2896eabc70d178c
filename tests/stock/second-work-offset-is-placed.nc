; stock: box 60x40x20
; grid: 0.5
; tool: 1=D10
; offset: G55=0,20,0
; removed: 1=2400
G21 G90 G94 G17
T1 M6
S3000 M3
G54 G0 X-10. Y10.
G43 Z20. H1
Z-2.
G1 X70. F300.
G0 Z20.
G55 X-10. Y10. Z20.
Z-2.
G1 X70. F300.
G0 Z20.
M30
