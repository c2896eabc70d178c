; error: E0906 at 2
G0 G1 X1. F100.
M30
