; note: G82 waits, G84 turns the spindle round and feeds out, G85 feeds out, G86 stops the spindle. P is in milliseconds.
; expect: modes T0 S500 cw
; expect: rapid X0 Y0 Z5
; expect: rapid X0 Y0 Z1 cycle
; expect: feed X0 Y0 Z-2 F50 cycle
; expect: dwell 0.5
; expect: rapid X0 Y0 Z1 cycle
; expect: rapid X1 Y0 Z1 cycle
; expect: feed X1 Y0 Z-2 F50 cycle
; expect: modes T0 S500 ccw
; expect: feed X1 Y0 Z1 F50 cycle
; expect: modes T0 S500 cw
; expect: rapid X2 Y0 Z1 cycle
; expect: feed X2 Y0 Z-2 F50 cycle
; expect: feed X2 Y0 Z1 F50 cycle
; expect: rapid X3 Y0 Z1 cycle
; expect: feed X3 Y0 Z-2 F50 cycle
; expect: modes T0 S500
; expect: rapid X3 Y0 Z1 cycle
; expect: modes T0 S500 cw
; expect: rapid X3 Y0 Z5
; expect: end
S500 M3
G90 G0 X0. Y0. Z5.
G99 G82 X0. Y0. Z-2. R1. P500 F50.
G80
G99 G84 X1. Y0. Z-2. R1. F50.
G80
G85 X2. Y0. Z-2. R1. F50.
G80
G86 X3. Y0. Z-2. R1. F50.
G80
G0 Z5.
M30
