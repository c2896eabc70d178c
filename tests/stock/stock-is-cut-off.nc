; stock: cut-off.stl
; error: E0964
G21 G90 G94 G17
M30
