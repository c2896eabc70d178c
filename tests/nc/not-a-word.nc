(error: E0901 at 3:8)
G90
G1 X5. ?Y2.
M30
