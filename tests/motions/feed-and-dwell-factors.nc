; set: feed.upm_factor=0.001
; set: dwell.upm_factor=1
; expect: rapid X0 Y0 Z0
; expect: feed X1 Y0 Z0 F250
; expect: dwell 2
; expect: end
G0 X0. Y0. Z0.
G1 X1. F.25
G4 P2
M30
