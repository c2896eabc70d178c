; expect: end
; error: E0913 at 6
%
M30
%
G0 X1.
