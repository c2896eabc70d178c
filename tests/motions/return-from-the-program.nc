; error: E0913 at 3
M99
M30
