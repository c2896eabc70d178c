; post: heidenhain-tnc640
; note: The length and the radius take the place of those of the tool table.
; expect: tool measured
; expect: end
0 BEGIN PGM A MM
1 TOOL DEF 1 L+0 R+5
2 TOOL DEF 2
3 END PGM A MM
