; expect: rapid X1 Y1 Z?
; error: E0912 at 5
%
G0 X1. Y1.
%
