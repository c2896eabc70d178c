; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.secondary_kind=2
; set: rotary.secondary_letter=1
; set: rotary.secondary_axis=1
; set: scale.c=-1
; note: C is the primary axis, printed turned round; A the secondary one.
; expect: rapid X0 Y0 Z0 p-30 s?
; expect: feed X0 Y0 Z0 p-45 s10 F100
; expect: feed X0 Y0 Z0 p-45 s15 F100
; expect: end
G0 X0. Y0. Z0. C30.
G1 C45. A10. F100.
G91 A5.
M30
