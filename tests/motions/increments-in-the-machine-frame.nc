; error: E0905 at 2
G91 G53 G0 Z0.
M30
