; set: rotary.primary_kind=1
; set: rotary.primary_letter=3
; set: rotary.primary_axis=3
; set: rotary.primary_i=0
; set: rotary.primary_j=0
; set: rotary.primary_k=1
; set: rotary.secondary_kind=1
; set: rotary.secondary_letter=1
; set: rotary.secondary_axis=1
; set: rotary.secondary_i=1
; set: rotary.secondary_j=0
; set: rotary.secondary_k=0
; note: X, Y, Z are the tip in the part while the tables turn. After G49 with tables
; note: turned the axes stand elsewhere; with the tables at 0 they keep their values.
; expect: rapid X? Y? Z? s?
; expect: rapid X? Y? Z?
; expect: rapid X10 Y20 Z?
; expect: modes T0 H5 tip-control
; expect: rapid tip X10 Y20 Z50
; expect: feed tip X10 Y20 Z50 p30 s-15 F200
; expect: feed tip X12 Y20 Z48 p30 s-15 F200
; expect: feed tip X12 Y19 Z48 p30 s-10 F200
; expect: modes T0
; expect: rapid X? Y? Z100 p30 s-10
; expect: rapid X? Y? Z100
; expect: rapid X12 Y0 Z100
; expect: modes T0 H5 tip-control
; expect: rapid tip X12 Y0 Z5
; expect: modes T0
; expect: rapid X13 Y0 Z5
; expect: end
G0 C0.
A0.
X10. Y20.
G43.4 H5 Z50.
G1 C30. A-15. F200.
X12. Z48.
G91 Y-1. A5.
G90
G49
G0 Z100.
C0. A0.
X12. Y0.
G43.4 Z5. H5
G49
X13.
M30
