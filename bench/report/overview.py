"""The first figure of a report: all scenes and samplers at a glance."""

import math

from markupsafe import Markup
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from . import formats
from .model import Estimate, Summary
from .palette import Style
from .svg import drawing, inline_svg
from .ticks import set_log_ticks

_WIDTH_IN = 11.6
_ROW_IN = 0.56


def overview_figure(summary: Summary, styles: dict[str, Style], key: str) -> Markup:
    """One row a scene. Left: the MSE gain over random, on a log axis. Right: the fitted slope.

    A sampler without a gain or a slope in a scene has no mark there.
    """
    with style.context(drawing(key)):
        figure = overview_figure_of(summary, styles, _WIDTH_IN, 9.0)
        return inline_svg(figure, key, "For each scene and sampler, the MSE gain over random and the fitted "
                          "slope, with intervals; the numbers are in the table below")


def overview_figure_of(summary: Summary, styles: dict[str, Style], width_in: float, font_size: float, with_key: bool = False) -> Figure:
    """The figure itself. Draw and save inside matplotlib.style.context."""
    labels = {sampler.sampler: sampler.label for scene in summary.scenes for sampler in scene.samplers}
    across = max(1, min(len(labels), int(width_in / 1.55)))
    key_in = 0.1 + 0.2 * -(-len(labels) // across) if with_key else 0.0
    names = [scene.name for scene in summary.scenes]
    row_in = max(_ROW_IN, 0.11 * max(len(scene.samplers) for scene in summary.scenes))
    height = 0.95 + key_in + row_in * len(names)
    left = max(map(len, names)) * font_size * 0.62 / 72 / width_in + 0.015  # as wide as its names
    figure = Figure(figsize=(width_in, height))
    bottom, tall = 0.55 / height, row_in * len(names) / height
    middle = left + 0.57 * (1 - left)
    gains = figure.add_axes((left, bottom, middle - left - 0.02, tall), xscale="log")
    slopes = figure.add_axes((middle + 0.02, bottom, 1 - middle - 0.02 - 0.22 / width_in, tall), sharey=gains)
    _gains(gains, summary, styles)
    _slopes(slopes, summary, styles)
    for axes in (gains, slopes):
        axes.set_ylim(len(names) - 0.5, -0.5)
        axes.set_yticks(range(len(names)), names)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        for row in range(1, len(names)):
            axes.axhline(row - 0.5, color="#e6e6e6", linewidth=0.6, zorder=0)
    for text in gains.get_yticklabels():
        text.set_parse_math(False)
    slopes.tick_params(axis="y", labelleft=False)
    if with_key:
        handles = [Line2D([], [], color=styles[name].color, marker=styles[name].marker, markersize=5, linestyle="none", label=label) for name, label in labels.items()]
        for text in figure.legend(handles=handles, loc="upper center", ncols=across, frameon=False).get_texts():
            text.set_parse_math(False)
    return figure


def _gains(axes: Axes, summary: Summary, styles: dict[str, Style]) -> None:
    axes.set_title("MSE gain over random, at the largest spp")
    axes.set_xlabel("MSE of random / MSE of the sampler (right of 1 is better)")
    ends = [0.9, 1.2]
    for row, scene in enumerate(summary.scenes):
        for sampler, y in zip(scene.samplers, _heights(row, len(scene.samplers))):
            if sampler.gain and sampler.gain.ratio.value:
                ratio = sampler.gain.ratio
                ends += _mark(axes, ratio, y, styles[sampler.sampler], least=ratio.value / 100)
    lo, hi = min(ends) / 1.08, max(ends) * 1.12
    axes.set_xlim(lo, hi)
    set_log_ticks(axes.xaxis, lo, hi)
    axes.grid(True, axis="x", which="major")
    axes.set_axisbelow(True)
    axes.axvline(1, color="#4d4d4d", linewidth=1, zorder=1)


def _slopes(axes: Axes, summary: Summary, styles: dict[str, Style]) -> None:
    axes.set_title("Slope of RMSE against spp")
    axes.set_xlabel("fitted exponent\u2003(left is faster)")
    ends = [-1.05, -0.45]
    for row, scene in enumerate(summary.scenes):
        for sampler, y in zip(scene.samplers, _heights(row, len(scene.samplers))):
            if sampler.slope and sampler.slope.estimate.value is not None:
                ends += _mark(axes, sampler.slope.estimate, y, styles[sampler.sampler], least=-math.inf)
    axes.set_xlim(min(ends) - 0.05, max(ends) + 0.05)
    axes.xaxis.set_major_locator(MaxNLocator(8, steps=(1, 2, 5, 10)))
    axes.xaxis.set_major_formatter(lambda value, _: formats.fixed(value, 1))
    axes.grid(True, axis="x", which="major")
    axes.set_axisbelow(True)
    for guide in (-0.5, -1.0):
        axes.axvline(guide, color="#9a9a9a", linewidth=0.8, zorder=1)


def _mark(axes: Axes, estimate: Estimate, y: float, look: Style, least: float) -> tuple[float, float]:
    """Draws a value and its interval; returns the ends of what was drawn."""
    lo = estimate.value if estimate.lo is None else max(estimate.lo, least)
    hi = estimate.value if estimate.hi is None else max(estimate.hi, lo)
    axes.plot([lo, hi], [y, y], color=look.color, linewidth=1.6, solid_capstyle="butt")
    axes.plot([estimate.value], [y], linestyle="none", marker=look.marker, markersize=6.2, zorder=3,
              markerfacecolor=look.color, markeredgecolor="white", markeredgewidth=0.6)
    return min(lo, estimate.value), max(hi, estimate.value)


def _heights(row: int, count: int) -> list[float]:
    """Heights of a row's samplers, one above the other; a sampler's is the same in both panels."""
    return [row + 0.62 * ((i + 0.5) / count - 0.5) for i in range(count)]
