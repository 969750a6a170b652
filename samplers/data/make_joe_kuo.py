#!/usr/bin/env python3
"""Makes joe_kuo_new6.inc from the published table of direction numbers new-joe-kuo-6.21201.

Usage: make_joe_kuo.py new-joe-kuo-6.21201 > joe_kuo_new6.inc

Source of the numbers: S. Joe and F. Y. Kuo 2008, "Constructing Sobol' sequences with better two-dimensional projections",
SIAM J. Sci. Comput. 30, 2635-2654; table at https://web.maths.unsw.edu.au/~fkuo/sobol/. Dimensions 2..4096 are kept.
Checks the direction numbers of the first 1024 dimensions (32 columns, little-endian uint32) against a SHA-256.
"""
import hashlib
import struct
import sys

DIMENSIONS = 4096
SHA256 = "e9f8c7de7b80c13fce58dd4f8fed873a0c11205fd4d70609faf5f9468945d9ab"


def columns(s, a, m):
    v = [m[c] << (31 - c) for c in range(min(s, 32))]
    for c in range(s, 32):
        x = v[c - s] ^ (v[c - s] >> s)
        for k in range(1, s):
            if (a >> (s - 1 - k)) & 1:
                x ^= v[c - k]
        v.append(x)
    return v


def main():
    rows = [[int(w) for w in line.split()] for line in open(sys.argv[1]) if line[0].isdigit()]
    rows = rows[: DIMENSIONS - 1]
    assert [r[0] for r in rows] == list(range(2, DIMENSIONS + 1))
    table = [[0x80000000 >> c for c in range(32)]] + [columns(r[1], r[2], r[3:]) for r in rows[:1023]]
    digest = hashlib.sha256(b"".join(struct.pack("<32I", *v) for v in table)).hexdigest()
    assert digest == SHA256, digest

    print("// Made by make_joe_kuo.py from new-joe-kuo-6 (Joe and Kuo 2008, SIAM J. Sci. Comput. 30). s, a, m_1 .. m_s of each dimension.")
    line = ""
    for r in rows:
        assert len(r) == 3 + r[1]
        for word in r[1:]:
            item = f"{word},"
            if len(line) + len(item) > 130:
                print(line)
                line = ""
            line += item
    print(line)


main()
