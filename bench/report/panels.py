"""Error against samples or seconds, a small panel a scene: for a page's sheet and for a paper's column."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .model import Point, Scene
from .palette import Style
from .ticks import set_log_ticks, set_value_ticks

AXES = {"samples": "samples per pixel", "seconds": "CPU seconds"}


def error_panels(scenes: Sequence[Scene], styles: dict[str, Style], against: str, width_in: float, columns: int) -> Figure:
    """RMSE with intervals, panels of `columns` a row; points without an RMSE or, against seconds, without a time are left out.

    against  a key of AXES
    Draw and save inside matplotlib.style.context.
    """
    rows = -(-len(scenes) // columns)
    labels = {sampler.sampler: sampler.label for scene in scenes for sampler in scene.samplers}
    across = max(1, min(len(labels), int(width_in / 1.55)))  # of the key
    key_in = 0.15 + 0.2 * -(-len(labels) // across)
    height = 0.8 * width_in / columns * rows + key_in
    figure = Figure(figsize=(width_in, height))
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 1 - key_in / height))
    grid = figure.subplots(rows, columns, squeeze=False)
    for axes, scene in zip(grid.flat, scenes):
        _panel(axes, scene, styles, against)
    for axes in list(grid.flat)[len(scenes):]:
        axes.set_axis_off()
    for axes in grid[-1]:
        axes.set_xlabel(AXES[against])
    for axes in grid[:, 0]:
        axes.set_ylabel("RMSE")
    handles = [Line2D([], [], color=styles[name].color, marker=styles[name].marker, markersize=4.5, dashes=styles[name].dashes or (None, None), label=label)
               for name, label in labels.items()]
    legend = figure.legend(handles=handles, loc="upper center", ncols=across, frameon=False)
    for text in legend.get_texts():
        text.set_parse_math(False)
    return figure


def _panel(axes: Axes, scene: Scene, styles: dict[str, Style], against: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(scene.name, fontsize="medium", fontweight="bold").set_parse_math(False)
    xs: list[float] = []
    ends: list[float] = []
    for sampler in scene.samplers:
        look = styles[sampler.sampler]
        points = [point for point in sampler.points if point.rmse.value and _x(point, against) > 0]
        value = [point.rmse.value for point in points]
        low = [point.rmse.value - (point.rmse.lo or point.rmse.value) for point in points]
        high = [(point.rmse.hi or point.rmse.value) - point.rmse.value for point in points]
        axes.errorbar([_x(point, against) for point in points], value, yerr=[low, high], color=look.color, marker=look.marker, markersize=4,
                      linewidth=1.2, dashes=look.dashes or (None, None))
        xs += [_x(point, against) for point in points]
        ends += value
    if against == "samples":
        set_value_ticks(axes.xaxis, xs)
    elif xs:
        lo, hi = min(xs) / 1.3, max(xs) * 1.3
        axes.set_xlim(lo, hi)
        set_log_ticks(axes.xaxis, lo, hi, most=5)
    if ends:
        lo, hi = min(ends) / 1.3, max(ends) * 1.3
        axes.set_ylim(lo, hi)
        set_log_ticks(axes.yaxis, lo, hi)
    axes.grid(True, which="major", color="#e6e6e6", linewidth=0.6)
    axes.set_axisbelow(True)


def _x(point: Point, against: str) -> float:
    return point.spp if against == "samples" else point.cpu_seconds
