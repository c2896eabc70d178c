(error: E0902 at 3:4)
G90
G1 X
M30
