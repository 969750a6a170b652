#!/usr/bin/env python3
"""Writes grove.xml: 90 instances of the two trees of instancing.xml, turned, stretched and every third mirrored.

    python3 scenes/instancing/make_grove.py scenes/instancing/grove.xml

The same file on every machine: random numbers are random.Random(1)'s, printed with three digits.
"""

import random
import sys

TREES, NEAREST = 90, 0.75


def main():
    rng = random.Random(1)
    places = []
    while len(places) < TREES:
        x, z = 14 * rng.random() - 7, 16 * rng.random() - 12
        if all((x - a) ** 2 + (z - b) ** 2 > NEAREST**2 for a, b in places):
            places.append((x, z))
    with open(sys.argv[1], "w") as out:
        out.write("<!-- made by make_grove.py -->\n<scene version=\"3.0.0\">\n")
        for i, (x, z) in enumerate(places):
            wide, high = 0.8 + 0.5 * rng.random(), 0.7 + 0.8 * rng.random()
            mirror = "-" if i % 3 == 0 else ""
            out.write(
                f'    <shape type="instance"> <ref id="{"fir" if i % 2 else "oak"}"/> <transform name="to_world"> '
                f'<scale x="{mirror}{wide:.3f}" y="{high:.3f}" z="{wide:.3f}"/> <rotate y="1" angle="{360 * rng.random():.1f}"/> '
                f'<translate x="{x:.3f}" z="{z:.3f}"/> </transform> </shape>\n'
            )
        out.write("</scene>\n")


if __name__ == "__main__":
    main()
