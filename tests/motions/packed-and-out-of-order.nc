; expect: rapid X0.695 Y? Z?
; expect: feed X-2 Y10 Z? F130
; expect: end
X.695G0
N0020F130.Y10.G1X-2.
M2
