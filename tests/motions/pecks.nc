; note: G83 comes out to R after each peck and goes back to .254 above the last depth; G73 only lifts by it.
; expect: rapid X0 Y0 Z5
; expect: rapid X0 Y0 Z1 cycle
; expect: feed X0 Y0 Z-1 F50 cycle
; expect: rapid X0 Y0 Z1 cycle
; expect: rapid X0 Y0 Z-0.746 cycle
; expect: feed X0 Y0 Z-2.5 F50 cycle
; expect: rapid X0 Y0 Z5 cycle
; expect: rapid X9 Y0 Z5 cycle
; expect: rapid X9 Y0 Z1 cycle
; expect: feed X9 Y0 Z-1 F50 cycle
; expect: rapid X9 Y0 Z-0.746 cycle
; expect: feed X9 Y0 Z-2.5 F50 cycle
; expect: rapid X9 Y0 Z5 cycle
; expect: end
G90 G0 X0. Y0. Z5.
G98 G83 X0. Y0. Z-2.5 R1. Q2. F50.
G73 X9. Y0. Z-2.5 R1. Q2. F50.
G80
M30
