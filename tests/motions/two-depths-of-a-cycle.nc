; post: sinumerik-840d
; note: The control drills to the relative depth, -5.
; expect: rapid X0 Y0 Z5
; error: E0906 at 7
G710 G90 G94 G17
G0 X0 Y0 Z5 F100
CYCLE81(5,0,3,-12,5)
M30
