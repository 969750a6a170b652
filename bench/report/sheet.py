"""One figure for a page: error against samples, a small panel a scene.

    python3 -m report.sheet DIR -o rates.svg
"""

import argparse
import sys
from pathlib import Path

from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .check import ReportError
from .load import load_summary
from .model import Scene, Summary
from .palette import Style, assign_styles
from .svg import drawing
from .ticks import set_value_ticks

PANEL_IN = (3.1, 2.5)
COLUMNS = 3
LEGEND_IN = 0.4


def rates_sheet(summary: Summary) -> Figure:
    """RMSE against samples per pixel with intervals, in panels of COLUMNS a row; points without an RMSE are left out."""
    scenes = summary.scenes
    styles = assign_styles(sampler for scene in scenes for sampler in scene.samplers)
    rows = -(-len(scenes) // COLUMNS)
    height = PANEL_IN[1] * rows + LEGEND_IN
    figure = Figure(figsize=(PANEL_IN[0] * COLUMNS, height))
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 1 - LEGEND_IN / height))
    grid = figure.subplots(rows, COLUMNS, squeeze=False)
    for axes, scene in zip(grid.flat, scenes):
        _panel(axes, scene, styles)
    for axes in list(grid.flat)[len(scenes):]:
        axes.set_axis_off()
    for axes in grid[-1]:
        axes.set_xlabel("samples per pixel")
    for axes in grid[:, 0]:
        axes.set_ylabel("RMSE")
    labels = {sampler.sampler: sampler.label for scene in scenes for sampler in scene.samplers}
    handles = [Line2D([], [], color=look.color, marker=look.marker, dashes=look.dashes or (None, None), label=labels[name])
               for name, look in styles.items()]
    figure.legend(handles=handles, loc="upper center", ncols=len(handles), frameon=False)
    return figure


def _panel(axes: Axes, scene: Scene, styles: dict[str, Style]) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(scene.name, fontsize="medium", fontweight="bold")
    for sampler in scene.samplers:
        look = styles[sampler.sampler]
        points = [point for point in sampler.points if point.rmse.value]
        value = [point.rmse.value for point in points]
        low = [point.rmse.value - (point.rmse.lo if point.rmse.lo else point.rmse.value) for point in points]
        high = [(point.rmse.hi if point.rmse.hi else point.rmse.value) - point.rmse.value for point in points]
        axes.errorbar([point.spp for point in points], value, yerr=[low, high], color=look.color, marker=look.marker, markersize=4,
                      linewidth=1.2, dashes=look.dashes or (None, None))
    set_value_ticks(axes.xaxis, [point.spp for sampler in scene.samplers for point in sampler.points])
    axes.grid(True, which="major", color="#e6e6e6", linewidth=0.6)
    axes.set_axisbelow(True)


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
