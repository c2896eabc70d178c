; post: haas-mill
; stock: cylinder 60x20
; part: step.stl
; grid: 0.5
; tool: 1=D10L30H40x60
; tool: 2=D6A118
; note: a ring, a hole with pecks; nothing is wrong
; removed: 1=4636
; removed: 2=219
%
O00001
G21 G90 G94 G17 G40 G80
T1 M6
S3000 M3
G0 X40. Y0.
G43 Z20. H1
Z-4.
G1 X28. F300.
G2 I-28. J0.
G1 X40.
G0 Z20.
M5
T2 M6
S2000 M3
G0 X0. Y0.
G43 Z20. H2
G98 G83 X0. Y0. Z-9. R2. Q3. F100.
G80
G0 Z20.
M30
%
