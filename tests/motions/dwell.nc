; note: The mill dwells in milliseconds.
; expect: dwell 1.5
; expect: end
G4 P1500
M30
