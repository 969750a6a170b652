"""The error budget of a scene: python3 -m report.budget NUMBERS.json PAGE.html (NUMBERS from `koksma bench budget`)."""

import sys
from pathlib import Path

from .topic_page import render_to_file


def main(arguments: list[str] | None = None) -> int:
    """Writes the page. Returns 0 on success, 1 on failure and 2 for wrong usage, with one line on stderr."""
    return render_to_file("budget", _context, sys.argv[1:] if arguments is None else arguments)


def _context(numbers: dict, _folder: Path) -> dict:
    from . import budget_figures as figures

    return {"figures": [figures.shares(division, f"shares{k}") for k, division in enumerate(numbers["budget"]["divisions"])]}


if __name__ == "__main__":
    sys.exit(main())
