; note: Controls differ in what G80 leaves in force.
; expect: rapid X0 Y0 Z5
; expect: rapid X0 Y0 Z2 cycle
; expect: feed X0 Y0 Z-1 F50 cycle
; expect: rapid X0 Y0 Z5 cycle
; error: E0907 at 10
G0 X0. Y0. Z5.
G81 X0. Y0. R2. Z-1. F50.
G80
X10.
