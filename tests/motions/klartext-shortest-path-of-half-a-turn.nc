; post: heidenhain-5x
; error: E0905 at 9
; expect: rapid X0 Y0 Z50 p10
; expect: rapid X0 Y0 Z50 p190
0 BEGIN PGM A MM
1 M126
2 L X+0 Y+0 Z+50 A+0 C+10 R0 FMAX
3 L C+190 FMAX
4 L X+1 C+10 F500
5 END PGM A MM
