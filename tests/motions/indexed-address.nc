; error: E0905 at 2
R1=15.5
M30
