; expect: rapid X10 Y0 Z0
; expect: arc ccw X10 Y0 Z0 I0 J0 360deg F100
; expect: arc cw X10 Y0 Z-2 I0 J0 360deg F100
; expect: arc ccw X-10 Y0 Z-3 I0 J0 180deg F100
; expect: end
G90 G17 G0 X10. Y0. Z0.
G3 I-10. J0. F100.
G2 Z-2. I-10. J0.
G3 X-10. Z-3. I-10.
M30
