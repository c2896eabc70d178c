; stock: box 60x40
; error: E0965
G21 G90 G94 G17
M30
