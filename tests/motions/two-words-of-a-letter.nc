; error: E0906 at 2
G0 X1. X2.
M30
