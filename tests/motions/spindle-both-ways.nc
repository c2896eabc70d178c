; error: E0906 at 2
S100 M3 M4
M30
