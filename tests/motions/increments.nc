; note: G91 adds, G90 sets; an axis that was never set stays unknown.
; expect: rapid X10 Y0 Z?
; expect: feed X12.5 Y-1 Z? F60
; expect: feed X12.5 Y-1 Z? F60
; expect: feed X15 Y-1 Z? F60
; expect: rapid X0 Y-1 Z2
; expect: end
G90 G0 X10. Y0.
G91 G1 X2.5 Y-1. F60.
Z1.
X2.5
G90 G0 X0. Z2.
M30
