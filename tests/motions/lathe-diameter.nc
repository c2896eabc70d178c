; post: fanuc-lathe
; note: X is a diameter, I a radius; U and W are increments. In G18 Z to X is counterclockwise.
; expect: tool 1
; expect: modes T1 H1 S300 cw
; expect: rapid X20 Y? Z2
; expect: feed X20 Y? Z-10 F0.25/rev
; expect: arc ccw X25 Y? Z-15 K-15 I20 90deg F0.25/rev
; expect: feed X26 Y? Z-15 F0.25/rev
; expect: feed X26 Y? Z-17 F0.25/rev
; expect: machine X? Y? Z?
; expect: end
G21 G99 G18
T0101
G97 S300 M3
G0 X40. Z2.
G1 Z-10. F0.25
G3 X50. Z-15. I0. K-5.
G1 U2.
W-2.
G28 U0. W0.
M30
