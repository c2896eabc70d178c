; note: Some controls wait 1500 seconds, others refuse it.
; error: E0902 at 3
G4 P1500.
M30
