; stock: box 60x40x20
; tool: 1=D10
; finding: warning W0977 at 7: the motion is not simulated
G21 G90 G94 G17
T1 M6
S3000 M3
G43 Z-2. H1 G1 X10. Y10. F200.
M30
