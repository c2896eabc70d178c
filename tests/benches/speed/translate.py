"""The translator of handwritten.rs as a Python script: python3 translate.py CL NC"""

import sys

LAST_NUMBER = 99_999
DECIMALS = [f"{rest:04d}".rstrip("0") for rest in range(10_000)]


def scaled(item):
    """The number as a count of the last decimal, from its digits."""
    whole, _, decimals = item.strip().partition(".")
    negative = whole.startswith("-")
    digits = decimals[:4].ljust(4, "0")
    value = int(whole.removeprefix("-") + digits)
    if decimals[4:5] >= "5":
        value += 1
    return -value if negative else value


def word(letter, value):
    """A word: up to four decimals, zeros at the end dropped."""
    sign = "-" if value < 0 else ""
    whole, rest = divmod(abs(value), 10_000)
    return f" {letter}{sign}{whole}.{DECIMALS[rest]}"


def translate(cl, nc):
    last = [None, None, None]
    feed = last_feed = last_rapid = None
    rapid = False
    number = 0
    for line in cl:
        if line.startswith("GOTO /"):
            point = [scaled(item) for item in line[6:].split(",")[:3]]
            now_rapid, rapid = rapid, False
            if point == last:
                continue
            number = number + 10 if number + 10 <= LAST_NUMBER else 10
            block = f"N{number}"
            if now_rapid != last_rapid:
                block += " G0" if now_rapid else " G1"
                last_rapid = now_rapid
            for letter, value, old in zip("XYZ", point, last):
                if value != old:
                    block += word(letter, value)
            last = point
            if not now_rapid and feed != last_feed:
                block += word("F", feed)
                last_feed = feed
            nc.write(block + "\n")
        elif line.startswith("FEDRAT /"):
            feed = scaled(line[8:].split(",")[0])
        elif line.startswith("RAPID"):
            rapid = True
        elif line.startswith("FINI"):
            number = number + 10 if number + 10 <= LAST_NUMBER else 10
            nc.write(f"N{number} M30\n")


with open(sys.argv[1], encoding="ascii", errors="replace") as cl:
    with open(sys.argv[2], "w", encoding="ascii", newline="\n") as nc:
        translate(cl, nc)
