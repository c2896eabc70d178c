; expect: tool 3
; expect: modes T3 S1200 cw coolant M8
; expect: rapid X0 Y0 Z?
; expect: modes T3 H3 S1200 cw coolant M8
; expect: rapid X0 Y0 Z5
; expect: modes T3 H3 S1200 cw left coolant M8
; expect: feed X1 Y0 Z5 F100
; expect: modes T3 H3 S1200 cw
; expect: feed X2 Y0 Z5 F100
; expect: modes T3 S1200
; expect: rapid X2 Y0 Z9
; expect: tool 4
; expect: end
T3 M6
S1200 M3
M8
G0 X0. Y0.
G43 Z5. H3
T4
G1 G41 X1. D3 F100.
M9
G40 X2.
M5
G49 G0 Z9.
M6
M30
