"""One small picture a sampler, for its page: four projections of its points and the spectrum of the first pair.

    PYTHONPATH=bench python3 -m report.picture build/release/bin/koksma docs/samplers/figures
"""

import argparse
import base64
import json
import struct
import subprocess
import sys
import zlib
from pathlib import Path

PANEL = 150  # units of the picture
GAP = 14
HEAD = 18
PAIRS = ((0, 1), (0, 2), (14, 15), (30, 31))
GREYS = 31  # above zero; fewer compress better


def picture(card: dict) -> str:
    """The SVG text. The same card gives the same bytes."""
    projections = {(p["a"], p["b"]): p for p in card["pictures"]["projections"]}
    width = 5 * PANEL + 4 * GAP + 2
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {PANEL + HEAD + 2}" font-family="sans-serif" font-size="10">',
             f"<title>{_escaped(card['name'])}: {card['pictures']['n']} points of one pixel, and their spectrum</title>",
             '<rect width="100%" height="100%" fill="#fff"/>']
    for column, pair in enumerate(PAIRS):
        parts.append(_panel(column, f"dimensions {pair[0]}, {pair[1]}", _points(projections[pair], card["pictures"]["n"])))
    parts.append(_panel(4, f"spectrum, mean of {card['spectrum']['replicates']}", _spectrum(card["spectrum"])))
    return "\n".join(parts) + "\n</svg>\n"


def _panel(column: int, title: str, inside: str) -> str:
    x = 1 + column * (PANEL + GAP)
    frame = f'<rect width="{PANEL}" height="{PANEL}" fill="none" stroke="#8a8a8a" stroke-width=".7"/>'
    return f'<text x="{x}" y="12" fill="#1d1d1f">{title}</text>\n<g transform="translate({x} {HEAD})">{inside}{frame}</g>'


def _points(projection: dict, n: int) -> str:
    # A round cap on a line of no length is a dot; tenths of a unit are finer than it is.
    dots = "".join(f"M{x * PANEL:.1f} {(1 - y) * PANEL:.1f}h0" for x, y in zip(projection["x"], projection["y"]))
    side = round(n ** 0.5)
    grid = "".join(f"M{k * PANEL / side:.2f} 0v{PANEL}M0 {k * PANEL / side:.2f}h{PANEL}" for k in range(1, side)) if side * side == n else ""
    return (f'<path d="{grid}" stroke="#e6e6e6" stroke-width=".4"/>'
            f'<path d="{dots}" stroke="#0072b2" stroke-width="2.6" stroke-linecap="round"/>')


def _spectrum(spectrum: dict) -> str:
    """Power from none (black) to twice that of random points (white)."""
    side = 2 * spectrum["largest"] + 1
    levels = [min(GREYS, int(power / 2 * GREYS + 0.5)) for power in spectrum["power"]]
    rows = b"".join(b"\0" + bytes(level * 255 // GREYS for level in levels[y * side:(y + 1) * side]) for y in range(side))

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0))
           + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
    data = base64.b64encode(png).decode()
    return f'<image width="{PANEL}" height="{PANEL}" style="image-rendering:pixelated" href="data:image/png;base64,{data}"/>'


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;")


def main() -> int:
    parser = argparse.ArgumentParser(prog="report.picture", description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="koksma, built")
    parser.add_argument("folder", type=Path, help="where NAME.svg are written")
    parser.add_argument("samplers", nargs="*", help="names (default: all that the program has)")
    arguments = parser.parse_args()

    def ask(*words: str):
        return json.loads(subprocess.run([arguments.program, *words, "--json"], check=True, stdout=subprocess.PIPE).stdout)

    try:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        for name in arguments.samplers or [sampler["name"] for sampler in ask("samplers")]:
            (arguments.folder / f"{name}.svg").write_text(picture(ask("card", name)), encoding="utf-8")
            print(arguments.folder / f"{name}.svg")
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"report.picture: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
