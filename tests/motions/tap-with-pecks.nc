; note: The tap would go down in pecks.
; expect: rapid X0 Y0 Z5
; error: E0905 at 5
G0 X0. Y0. Z5.
G84 X1. Y0. Z-5. R2. F50. Q1.
M30
