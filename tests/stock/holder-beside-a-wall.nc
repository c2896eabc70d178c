; post: heidenhain-tnc640
; stock: box 60x40x40 at 0,0,-40
; grid: 0.5
; tool: 1=D10L25H40x60
; note: a slot of 30 mm along the edge of the stock with 25 mm of tool below its holder
; finding: error E0972 at 14-16: tool 1, 5 mm deep at X50.75 Y10.25 Z-5, 69.5 mm long
; removed: 1=18000
0 BEGIN PGM SLOT MM
1 TOOL CALL 1 Z S3000
2 L Z+50 FMAX M3
3 L X-10 Y+5 FMAX
4 L Z-15 FMAX
5 L X+70 F300
6 L Z-30 F300
7 L X-10
8 L Z+50 FMAX
9 END PGM SLOT MM
