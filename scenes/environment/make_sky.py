#!/usr/bin/env python3
"""Writes sky.hdr: a clear sky with a low sun over dark ground, 128 x 64 pixels, Radiance RGBE without compression.

    python3 scenes/environment/make_sky.py scenes/environment/sky.hdr
"""

import math
import sys

WIDTH, HEIGHT = 128, 64
SUN = (0.62, 0.44, 0.65)  # toward it; made unit below
SUN_RADIUS = math.radians(3.0)


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def radiance(d):
    """Linear RGB toward a unit direction; +y is up."""
    cosine = sum(a * b for a, b in zip(d, unit(SUN)))
    glow = math.exp(-12.0 * math.acos(max(-1.0, min(1.0, cosine))))
    if d[1] < 0.0:
        return (0.05, 0.045, 0.04)
    height = d[1] ** 0.5
    sky = tuple(a + (b - a) * height for a, b in zip((0.62, 0.58, 0.55), (0.12, 0.22, 0.5)))
    sun = 300.0 if math.acos(max(-1.0, min(1.0, cosine))) < SUN_RADIUS else 0.0
    return tuple(s + 3.0 * g * glow + sun * g for s, g in zip(sky, (1.0, 0.85, 0.6)))


def rgbe(rgb):
    largest = max(rgb)
    fraction, exponent = math.frexp(largest)
    scale = fraction * 256.0 / largest
    return bytes([int(c * scale) for c in rgb] + [exponent + 128])


def main():
    with open(sys.argv[1], "wb") as out:
        out.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode())
        for y in range(HEIGHT):
            theta = math.pi * (y + 0.5) / HEIGHT
            for x in range(WIDTH):
                # The middle column is seen along +z, a quarter of the width along +x.
                phi = 2.0 * math.pi * ((x + 0.5) / WIDTH - 0.5)
                d = (-math.sin(phi) * math.sin(theta), math.cos(theta), math.cos(phi) * math.sin(theta))
                out.write(rgbe(radiance(d)))


if __name__ == "__main__":
    main()
