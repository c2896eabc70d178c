; note: A label before the first mark is no block.
; expect: rapid X1 Y? Z?
; expect: end
PROGRAM OF A PART: 7
%
O7
G0 X1.
M30
%
