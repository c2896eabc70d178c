; error: E0914 at 2
M98 P1001
M30
