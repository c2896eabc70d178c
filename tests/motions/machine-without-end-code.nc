; set: program.end_code=none
; set: program.rewind_code=none
; expect: rapid X1 Y1 Z?
%
G0 X1. Y1.
%
