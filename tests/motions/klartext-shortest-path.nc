; post: heidenhain-5x
; note: M126: C goes on by the shorter way, over any number of turns; M127: by its numbers.
; expect: rapid X0 Y0 Z50 p350
; expect: rapid X0 Y0 Z50 p370
; expect: rapid X0 Y0 Z50 p350
; expect: rapid X0 Y0 Z50 p10
; expect: end
0 BEGIN PGM A MM
1 M126
2 L X+0 Y+0 Z+50 A+0 C+350 R0 FMAX
3 L C+10 FMAX
4 L C+350 FMAX
5 M127
6 L C+10 FMAX
7 M30
8 END PGM A MM
