#!/usr/bin/env python3
"""Writes lamps.ply: 500 loose triangles in the unit ball, each about as long as 3 % of the ball's radius, turned at random.

many-lights.xml shows it 20 times, in 20 places, sizes and colours: 10,000 lights of one triangle each.

    python3 scenes/many-lights/make_lamps.py scenes/many-lights/lamps.ply

The same file on every machine: random numbers are random.Random(1)'s, rounded to float.
"""

import math
import random
import struct
import sys

TRIANGLES = 500
RADIUS = 0.02  # from a triangle's middle to its corners


def unit(rng):
    z = 2 * rng.random() - 1
    phi = 2 * math.pi * rng.random()
    r = math.sqrt(1 - z * z)
    return (r * math.cos(phi), r * math.sin(phi), z)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def triangle(rng):
    """Three corners, equilateral, around a point of the ball."""
    radius = rng.random() ** (1 / 3)
    middle = tuple(radius * x for x in unit(rng))
    normal, other = unit(rng), unit(rng)
    s = cross(normal, other)
    length = math.sqrt(sum(x * x for x in s))
    s = tuple(x / length for x in s)
    t = cross(normal, s)
    for k in range(3):
        c, d = math.cos(2 * math.pi * k / 3), math.sin(2 * math.pi * k / 3)
        yield tuple(m + RADIUS * (c * a + d * b) for m, a, b in zip(middle, s, t))


def main():
    rng = random.Random(1)
    corners = [v for _ in range(TRIANGLES) for v in triangle(rng)]
    with open(sys.argv[1], "wb") as out:
        out.write(
            f"ply\nformat binary_little_endian 1.0\ncomment made by make_lamps.py\nelement vertex {len(corners)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {TRIANGLES}\nproperty list uchar ushort vertex_indices\nend_header\n".encode()
        )
        for v in corners:
            out.write(struct.pack("<3f", *v))
        for k in range(TRIANGLES):
            out.write(struct.pack("<B3H", 3, 3 * k, 3 * k + 1, 3 * k + 2))


if __name__ == "__main__":
    main()
