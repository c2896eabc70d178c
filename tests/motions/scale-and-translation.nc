; set: scale.x=2
; set: output.translate_y=-5
; expect: rapid X10 Y15 Z3
; expect: rapid X11 Y14 Z3
; expect: end
G0 X20. Y10. Z3.
G91 X2. Y-1.
M30
