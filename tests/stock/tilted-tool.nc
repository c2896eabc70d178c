; post: haas-trunnion
; stock: box 60x40x20
; tool: 1=D10
; error: E0962 at 10
G21 G90 G94 G17
T1 M6
S3000 M3
G0 X30. Y20. A0. C0.
G43 Z20. H1
G0 A30.
M30
