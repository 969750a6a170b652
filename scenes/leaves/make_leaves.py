#!/usr/bin/env python3
"""Writes leaves.ply, 160 squares about a stem, turned at random, with texture coordinates; and leaf.png, the shape of a leaf, white on black.

    python3 scenes/leaves/make_leaves.py scenes/leaves

The same files on every machine: random numbers are random.Random(1)'s, rounded to float.
"""

import math
import pathlib
import random
import struct
import sys
import zlib

LEAVES = 160
SIZE = 48  # pixels


def square(rng):
    """Corners of a leaf: its stalk is at the stem's side, it hangs outward and down."""
    turn = 2 * math.pi * rng.random()
    height = 0.35 + 1.5 * rng.random()
    out = (math.cos(turn), 0.0, math.sin(turn))
    reach = 0.12 + 0.5 * rng.random() * math.sin(math.pi * (height - 0.2) / 1.8)
    length = 0.28 + 0.12 * rng.random()
    droop = math.radians(-20 + 70 * rng.random())
    along = (out[0] * math.cos(droop), -math.sin(droop), out[2] * math.cos(droop))
    roll = math.radians(60) * (rng.random() - 0.5)
    side = (-out[2] * math.cos(roll), math.sin(roll), out[0] * math.cos(roll))
    root = tuple(reach * o for o in out)
    for u, v in ((-0.5, 0), (0.5, 0), (0.5, 1), (-0.5, 1)):
        p = tuple(r + length * (0.7 * u * s + v * a) for r, s, a in zip(root, side, along))
        yield (p[0], p[1] + height, p[2], u + 0.5, v)


def write_mesh(path):
    rng = random.Random(1)
    corners = [c for _ in range(LEAVES) for c in square(rng)]
    with open(path, "wb") as out:
        out.write(
            f"ply\nformat binary_little_endian 1.0\ncomment made by make_leaves.py\nelement vertex {len(corners)}\n"
            "property float x\nproperty float y\nproperty float z\nproperty float u\nproperty float v\n"
            f"element face {2 * LEAVES}\nproperty list uchar ushort vertex_indices\nend_header\n".encode()
        )
        for c in corners:
            out.write(struct.pack("<5f", *c))
        for k in range(0, 4 * LEAVES, 4):
            out.write(struct.pack("<B3HB3H", 3, k, k + 1, k + 2, 3, k, k + 2, k + 3))


def inside(u, v):
    """Pointed at both ends, widest near the stalk, with notches along the edge."""
    width = 0.46 * math.sin(math.pi * v) ** 0.8 * (1.15 - 0.4 * v)
    return abs(u - 0.5) < width * (1.0 - 0.12 * ((v * 9) % 1.0))


def write_picture(path):
    rows = b"".join(
        b"\0" + bytes(255 if inside((x + 0.5) / SIZE, (y + 0.5) / SIZE) else 0 for x in range(SIZE)) for y in range(SIZE)
    )

    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))

    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    write_mesh(folder / "leaves.ply")
    write_picture(folder / "leaf.png")
