; post: heidenhain-tnc640
; error: E0906 at 4
0 BEGIN PGM A MM
1 END PGM A INCH
