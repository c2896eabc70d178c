; error: E0911 at 2
M6
M30
