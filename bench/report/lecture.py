"""The lecture's page: python3 -m report.lecture NUMBERS.json PAGE.html (NUMBERS from `koksma bench lecture`)."""

import sys
from itertools import groupby
from pathlib import Path

from .topic_page import render_to_file

_WIDEST_ROW = 1184  # CSS pixels: the page's column, style.css
_GAP = 16


def main(arguments: list[str] | None = None) -> int:
    """Writes the page. Returns 0 on success, 1 on failure and 2 for wrong usage, with one line on stderr."""
    return render_to_file("lecture", _context, sys.argv[1:] if arguments is None else arguments)


def _context(numbers: dict, folder: Path) -> dict:
    from . import lecture_figures as figures

    topics = numbers["topics"]
    return {"charts": {topic["name"]: [figures.chart(chart, f"{topic['name']}-{k}") for k, chart in enumerate(topic["charts"])] for topic in topics},
            "pictures": {topic["name"]: _rows(topic["pictures"], folder) for topic in topics}}


def _rows(pictures: list, folder: Path) -> list:
    """Pictures of one subject (what stands before the colon of the caption) stand together."""
    return [[_picture(picture, folder) for picture in row]
            for _, row in groupby(pictures, key=lambda picture: picture["caption"].rpartition(": ")[0])]


def _picture(entry: dict, folder: Path) -> dict:
    """The picture as a data URI, with the width at which its pixels are square and visible and four fit in a row."""
    from .check import Node
    from .pictures import data_uri, load_picture

    picture = load_picture(Node(entry["file"], "lecture.json", "file"), folder)
    factor = max(1, (_WIDEST_ROW - 4 * _GAP) // 5 // picture.width)
    return {"uri": data_uri(picture), "caption": entry["caption"], "width": factor * picture.width}


if __name__ == "__main__":
    sys.exit(main())
