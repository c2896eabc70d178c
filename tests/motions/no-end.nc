; expect: rapid X1 Y1 Z?
; error: E0912 at 4
%
G0 X1. Y1.
