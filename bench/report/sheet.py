"""One figure for a page: error against samples, a small panel a scene.

    python3 -m report.sheet DIR -o rates.svg
"""

import argparse
import sys
from pathlib import Path

from matplotlib import style
from matplotlib.figure import Figure

from .check import ReportError
from .load import load_summary
from .model import Summary
from .palette import assign_styles
from .panels import error_panels
from .svg import drawing

WIDTH_IN = 9.3
COLUMNS = 3


def rates_sheet(summary: Summary) -> Figure:
    """RMSE against samples per pixel with intervals, in panels of COLUMNS a row; points without an RMSE are left out."""
    styles = assign_styles(sampler for scene in summary.scenes for sampler in scene.samplers)
    return error_panels(summary.scenes, styles, "samples", WIDTH_IN, COLUMNS)


def main() -> int:
    parser = argparse.ArgumentParser(prog="report.sheet", description=__doc__.splitlines()[0])
    parser.add_argument("dir", type=Path, help="folder that koksma bench wrote")
    parser.add_argument("-o", "--output", type=Path, required=True, help="figure to write (.svg, .pdf, .png)")
    arguments = parser.parse_args()
    try:
        summary = load_summary(arguments.dir)
        with style.context(drawing("sheet")):
            rates_sheet(summary).savefig(arguments.output, metadata={"Date": None} if arguments.output.suffix == ".svg" else None)
    except (ReportError, OSError) as error:
        print(f"report.sheet: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
