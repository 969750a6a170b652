#!/usr/bin/env python3
"""Writes plume.vol: the density of a plume of smoke on 16 x 24 x 16 cells, between 0 and 1, in Mitsuba's volume format, version 3.

    python3 scenes/smoke/make_smoke.py scenes/smoke/plume.vol

A column that widens and sways as it rises, made of puffs; nothing in it is random but for the hash below, so the file is the same on every
machine up to the last digits of sin and exp, which rounding to 1/1024 takes away.
"""

import math
import struct
import sys

WIDTH, HEIGHT, DEPTH = 16, 24, 16
PUFFS = 40


def hashed(i, k):
    """[0, 1): number k of puff i."""
    x = (i * 2654435761 + k * 40503 + 12345) & 0xFFFFFFFF
    for shift, factor in (16, 0x21F0AAAD), (15, 0x735A2D97), (15, 1):
        x = ((x ^ (x >> shift)) * factor) & 0xFFFFFFFF
    return x / 2**32


def puffs():
    """(x, y, z, radius, weight) in the unit cube."""
    for i in range(PUFFS):
        y = 0.06 + 0.86 * (i + hashed(i, 0)) / PUFFS
        wide = 0.03 + 0.17 * y
        angle = 2 * math.pi * hashed(i, 1)
        sway = 0.08 * math.sin(7 * y)
        yield (0.5 + sway + wide * math.cos(angle), y, 0.5 + wide * math.sin(angle), 0.05 + 0.08 * y, 1.1 - 0.7 * y)


def density(x, y, z):
    total = sum(w * math.exp(-((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2) / (r * r)) for a, b, c, r, w in PLUME)
    return min(1.0, max(0.0, total - 0.05))


PLUME = list(puffs())


def main():
    values = [
        round(1024 * density((i + 0.5) / WIDTH, (j + 0.5) / HEIGHT, (k + 0.5) / DEPTH)) / 1024 for k in range(DEPTH) for j in range(HEIGHT) for i in range(WIDTH)
    ]
    with open(sys.argv[1], "wb") as out:
        out.write(b"VOL\x03" + struct.pack("<5i6f", 1, WIDTH, HEIGHT, DEPTH, 1, 0, 0, 0, 1, 1, 1))
        out.write(struct.pack(f"<{len(values)}f", *values))


if __name__ == "__main__":
    main()
