; error: E0905 at 2
G0 X1. Y1. P5
M30
