; post: sinumerik-840d
; stock: box 60x40x20
; part: step.stl
; grid: 0.5
; tool: 1=D16R2
; note: the floor of the step is at Z-10, the program goes to Z-10.4
; finding: error E0974 at 16: tool 1 cuts 0.4 mm below the part at X0.25 Y14.25 Z-10.4, 19.75 mm long
; removed: 1=4329
G17 G71 G90 G94
T1
M6
D1
G0 X-10 Y20 Z20
S2000 M3
G0 Z-10.4
G1 X20 F400
G0 Z20
M30
