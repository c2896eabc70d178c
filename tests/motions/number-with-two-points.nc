; error: E0902 at 2
G0 X1.2.3
M30
