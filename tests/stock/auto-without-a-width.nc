; stock: auto
; tool: 1=D10
; note: all cuts are on one line
; error: E0965
G21 G90 G94 G17
T1 M6
S900 M3
G0 X0. Y10.
G43 Z20. H1
G1 Z-2. F100.
X40.
M30
