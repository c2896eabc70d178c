; stock: box 60x40x20
; grid: 0.5
; tool: 1=D10
; level: E0971=warn
; finding: warning E0971 at 12: tool 1, 1 mm deep at X28.75 Y15.25 Z-1, 1 mm long
; removed: 1=79
G21 G90 G94 G17
T1 M6
S3000 M3
G0 X30. Y20.
G43 Z20. H1
Z-1.
Z20.
M30
