; post: linuxcnc-mill
; note: P of a dwell is in seconds there; P of a call is a number.
; expect: dwell 1.5
; expect: rapid X2 Y? Z?
; expect: end
G4 P1.5
M98 P1001
M30
O1001
G0 X2.
M99
