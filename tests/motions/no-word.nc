; error: E0901 at 3
G90
G0 X5. ?Y2.
M30
