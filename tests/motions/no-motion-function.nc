; error: E0907 at 2
X1. Y1.
M30
