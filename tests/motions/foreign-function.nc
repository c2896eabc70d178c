; error: E0904 at 2
G68.2 X0. Y0. Z0. I90. J0. K0.
M30
