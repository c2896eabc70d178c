; note: O1001 runs twice, O1002 within it.
; expect: rapid X0 Y0 Z5
; expect: feed X0 Y0 Z-1 F100
; expect: feed X1 Y0 Z-1 F100
; expect: rapid X1 Y0 Z5
; expect: feed X1 Y0 Z-1 F100
; expect: feed X2 Y0 Z-1 F100
; expect: rapid X2 Y0 Z5
; expect: rapid X2 Y0 Z50
; expect: end
%
O1
G0 X0. Y0. Z5.
M98 P1001 L2
G90 Z50.
M30
O1001
G90 G1 Z-1. F100.
M98 P1002
G90 G0 Z5.
M99
O1002
G91 X1.
M99
%
