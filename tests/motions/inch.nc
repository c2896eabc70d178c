; expect: rapid X25.4 Y12.7 Z?
; expect: feed X25.4 Y12.7 Z-2.54 F254
; expect: feed X10 Y12.7 Z-2.54 F300
; expect: end
G20 G90 G94
G0 X1. Y.5
G1 Z-.1 F10.
G21 G1 X10. F300.
M30
