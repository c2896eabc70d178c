; error: E0914 at 2
M99
M30
