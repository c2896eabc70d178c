; error: E0904 at 2
M97 P100
M30
