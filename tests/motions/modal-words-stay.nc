; expect: rapid X1 Y2 Z?
; expect: rapid X1 Y2 Z5
; expect: feed X1 Y2 Z-1 F100
; expect: feed X3 Y2 Z-1 F100
; expect: feed X3 Y4 Z-1 F250
; expect: rapid X3 Y4 Z5
; expect: end
%
O100 (part)
N1 G21 G90 G94 G17
N2 G0 X1. Y2.
N3 Z5.
N4 G1 Z-1. F100.
N5 X3.
N6 Y4. F250.
N7 G0 Z5.
N8 M30
%
