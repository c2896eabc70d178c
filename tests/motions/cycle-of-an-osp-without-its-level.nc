; set: cycle.return_codes=3
; note: Without G71 nobody knows where M53 returns to; without M53 and M54 it is the end of the travel.
; expect: rapid X0 Y0 Z30
; error: E0905 at 6
G0 X0. Y0. Z30.
G81 X0. Y0. Z-5. R2. F100. M53
M30
