; note: G17 X to Y, G18 Z to X, G19 Y to Z are counterclockwise (G3).
; expect: rapid X10 Y0 Z0
; expect: arc ccw X0 Y10 Z0 I0 J0 90deg F100
; expect: arc cw X10 Y0 Z0 I0 J0 90deg F100
; expect: rapid X0 Y0 Z10
; expect: modes T0 ZX
; expect: arc ccw X10 Y0 Z0 K0 I0 90deg F100
; expect: rapid X0 Y10 Z0
; expect: modes T0 YZ
; expect: arc ccw X0 Y0 Z10 J0 K0 90deg F100
; expect: end
G90 G17 G0 X10. Y0. Z0.
G3 X0. Y10. I-10. J0. F100.
G2 X10. Y0. I0. J-10.
G0 X0. Z10.
G18 G3 X10. Z0. I0. K-10.
G0 X0. Y10.
G19 G3 Y0. Z10. J-10. K0.
M30
