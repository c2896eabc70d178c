def loop():
    xx = nn = 0.0
    for ii in range(1, 10000001):
        xx = xx + ii * 2
        if xx > 1000000:
            xx = xx - 1000000
            nn = nn + 1
    return xx, nn


print("start", flush=True)
print(*loop())
