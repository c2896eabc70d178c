; error: E0902 at 3
G90
G0 X
M30
