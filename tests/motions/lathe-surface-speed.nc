; post: fanuc-lathe
; note: The limit stays in force; it holds under surface speed.
; expect: tool 2
; expect: modes T2 H2 surface S180 up to S2000 cw
; expect: rapid X10 Y? Z0
; expect: modes T2 H2 S800 up to S2000 cw
; expect: rapid X11 Y? Z0
; expect: end
T0202
G50 S2000
G96 S180 M3
G0 X20. Z0.
G97 S800
X22.
M30
