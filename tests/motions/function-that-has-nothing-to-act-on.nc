; error: E0911 at 2
G28
M30
