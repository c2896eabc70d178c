; note: A negative radius goes the long way round. The center lies left of the chord of a short G3.
; expect: rapid X10 Y0 Z0
; expect: arc ccw X0 Y10 Z0 I0 J0 90deg F100
; expect: rapid X10 Y0 Z0
; expect: arc ccw X0 Y10 Z0 I10 J10 270deg F100
; expect: rapid X10 Y0 Z0
; expect: arc cw X0 Y10 Z0 I10 J10 90deg F100
; expect: arc cw X0 Y-10 Z0 I0 J0 180deg F100
; expect: end
G90 G17 G0 X10. Y0. Z0.
G3 X0. Y10. R10. F100.
G0 X10. Y0.
G3 X0. Y10. R-10.
G0 X10. Y0.
G2 X0. Y10. R10.
G2 X0. Y-10. R10.
M30
