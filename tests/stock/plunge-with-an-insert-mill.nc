; stock: box 60x40x20
; grid: 0.5
; tool: 1=D20C8
; finding: warning W0975 at 12: tool 1, 2 mm deep at X28.75 Y16.25 Z-2, 2 mm long
; removed: 1=1032
G21 G90 G94 G17
T1 M6
S3000 M3
G0 X30. Y20.
G43 Z20. H1
Z1.
G1 Z-2. F100.
X40.
G0 Z20.
M30
