; post: heidenhain-tnc640
; note: The length and the radius would take the place of those of the tool table.
; error: E0904 at 5
0 BEGIN PGM A MM
1 TOOL DEF 1 L+0 R+5
2 END PGM A MM
