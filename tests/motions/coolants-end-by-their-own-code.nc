; set: coolant.thru_high_code=88
; set: coolant.thru_off_code=89
; note: M9 does not end a coolant that has a code of its own, and its code ends no other.
; expect: modes T0 coolant M88
; expect: rapid X0 Y0 Z0
; expect: rapid X1 Y0 Z0
; expect: modes T0
; expect: rapid X2 Y0 Z0
; expect: modes T0 coolant M8
; expect: rapid X3 Y0 Z0
; expect: end
M88
G0 X0. Y0. Z0.
M9
X1.
M89
X2.
M8
M89
X3.
M30
