; note: Controls read X83 as 83 mm or as 83 smallest steps.
; error: E0902 at 3
G0 X83 Y0.
M30
