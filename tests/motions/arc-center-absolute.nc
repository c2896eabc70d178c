; set: circle.center=4
; expect: rapid X10 Y5 Z0
; expect: arc ccw X0 Y15 Z0 I0 J5 90deg F100
; expect: end
G0 X10. Y5. Z0.
G3 X0. Y15. I0. J5. F100.
M30
