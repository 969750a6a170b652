"""The two figures of a scene: error against samples, and error against seconds."""

import math

import numpy as np
from markupsafe import Markup
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from . import formats
from .model import Estimate, Point, SamplerResult, Scene, Slope
from .palette import Style
from .svg import drawing, inline_svg
from .ticks import set_log_ticks, set_value_ticks

SIZE_IN = (5.75, 4.5)
GUIDE_COLOR = "#9a9a9a"
MOST_IN_KEY = 8  # samplers; of more the key stands on the page, once


def error_vs_spp(scene: Scene, styles: dict[str, Style], key: str) -> Markup:
    """RMSE against samples per pixel, with the fitted lines and guides of slope -1/2 and -1.

    Points without an RMSE are left out; where no line was fitted the points are joined.
    """
    with style.context(drawing(key)):
        figure, axes = _frame("Error against samples", "samples per pixel (spp)")
        for sampler in scene.samplers:
            look, points = styles[sampler.sampler], _drawable(sampler)
            _draw_points(axes, [point.spp for point in points], points, look)
            fit = _fitted_line(sampler.slope, points)
            x, y = fit or ([p.spp for p in points], [p.rmse.value for p in points])
            axes.plot(x, y, color=look.color, dashes=look.dashes or (None, None), linewidth=1.5 if fit else 0.8)
            _add_to_legend(axes, look, _legend_text(sampler))
        _set_error_axis(axes, scene)
        if any(_drawable(sampler) for sampler in scene.samplers):
            spps = [point.spp for sampler in scene.samplers for point in _drawable(sampler)]
            axes.set_xlim(min(spps) / 1.35, max(spps) * 1.35)
            set_value_ticks(axes.xaxis, spps)
            _draw_guides(axes, scene)
        else:
            _without_ticks(axes.xaxis)
        _legend(axes, scene, "fitted slope" if any(s.slope for s in scene.samplers) else None)
        return inline_svg(figure, key, f"{scene.name}: RMSE against samples per pixel, log-log, for "
                          + ", ".join(map(_legend_text, scene.samplers)))


def error_vs_seconds(scene: Scene, styles: dict[str, Style], key: str) -> Markup:
    """RMSE against CPU seconds of rendering; points that took no measurable time are left out."""
    with style.context(drawing(key)):
        figure, axes = _frame("Error against time", "CPU seconds of rendering")
        times: list[float] = []
        for sampler in scene.samplers:
            look = styles[sampler.sampler]
            points = [point for point in _drawable(sampler) if point.cpu_seconds > 0]
            seconds = [point.cpu_seconds for point in points]
            times += seconds
            _draw_points(axes, seconds, points, look)
            axes.plot(seconds, [point.rmse.value for point in points], color=look.color,
                      dashes=look.dashes or (None, None), linewidth=1.2)
            _add_to_legend(axes, look, sampler.label)
        _set_error_axis(axes, scene)
        if times:
            lo, hi = min(times) / 1.35, max(times) * 1.35
            axes.set_xlim(lo, hi)
            set_log_ticks(axes.xaxis, lo, hi)
        else:
            _without_ticks(axes.xaxis)
        _legend(axes, scene, None)
        return inline_svg(figure, key, f"{scene.name}: RMSE against CPU seconds, log-log, for "
                          + ", ".join(sampler.label for sampler in scene.samplers))


def _frame(title: str, x_label: str) -> tuple[Figure, Axes]:
    figure = Figure(figsize=SIZE_IN)
    axes = figure.add_axes((0.115, 0.115, 0.865, 0.81), xscale="log", yscale="log")
    axes.set_title(title, x=-0.11)
    axes.set_xlabel(x_label)
    axes.set_ylabel("RMSE")
    axes.grid(True, which="major")
    axes.set_axisbelow(True)
    return figure, axes


def _drawable(sampler: SamplerResult) -> list[Point]:
    # A log axis has no zero; an RMSE of exactly 0 is as little a point as none.
    return [point for point in sampler.points if point.rmse.value]


def _draw_points(axes: Axes, x: list[float], points: list[Point], look: Style) -> None:
    """Markers with bars, and the band that joins the bars."""
    bars = [_bar(point.rmse) for point in points]
    if len(points) > 1:
        axes.fill_between(x, [lo for lo, _ in bars], [hi for _, hi in bars], color=look.color, alpha=0.13, linewidth=0)
    for at, point in zip(x, points):
        lo, hi = _bar(point.rmse)
        axes.plot([at, at], [lo, hi], color=look.color, linewidth=1.1, solid_capstyle="butt")
        axes.plot([at, at], [lo, hi], color=look.color, linestyle="none", marker="_", markersize=5)
        face = "white" if point.below_floor else look.color
        edge = look.color if point.below_floor else "white"
        axes.plot([at], [point.rmse.value], linestyle="none", marker=look.marker, markersize=6.2,
                  markerfacecolor=face, markeredgecolor=edge, markeredgewidth=1.1 if point.below_floor else 0.6,
                  zorder=3)


def _bar(error: Estimate) -> tuple[float, float]:
    """The ends of an error bar on a log axis; a bound of zero or less ends at a hundredth of the value."""
    lo = error.value if error.lo is None else max(error.lo, error.value / 100)
    hi = error.value if error.hi is None else error.hi
    return lo, max(lo, hi)


def _fitted_line(slope: Slope | None, points: list[Point]) -> tuple[list[float], list[float]] | None:
    """The line of the given slope through the centre of the points that it was fitted to.

    The program hands over a slope and no intercept; a least-squares line passes through the centre.
    """
    if slope is None or slope.estimate.value is None:
        return None
    fitted = [point for point in points if slope.spp_from <= point.spp <= slope.spp_to]
    if not fitted:
        return None
    x, y = np.log([[point.spp, point.rmse.value] for point in fitted]).mean(axis=0)
    ends = [float(slope.spp_from), float(slope.spp_to)]
    return ends, [math.exp(y + slope.estimate.value * (math.log(end) - x)) for end in ends]


def _legend_text(sampler: SamplerResult) -> str:
    if sampler.slope is None:
        return f"{sampler.label}\u2002(no fit)"
    estimate = sampler.slope.estimate
    return f"{sampler.label}\u2002{formats.slope(estimate.value)} {formats.interval(estimate, formats.slope)}".rstrip()


def _add_to_legend(axes: Axes, look: Style, text: str) -> None:
    # An empty line: the legend shows the sampler's line and marker together, as the key in the tables does.
    line, = axes.plot([], [], color=look.color, dashes=look.dashes or (None, None), linewidth=1.5,
                      marker=look.marker, markersize=6.2, markeredgecolor="white", markeredgewidth=0.6)
    line.set_label(text if not text.startswith("_") else " " + text)


def _legend(axes: Axes, scene: Scene, title: str | None) -> None:
    if len(scene.samplers) > MOST_IN_KEY:
        return
    legend = axes.legend(loc="lower left", title=title, title_fontsize=8.5, alignment="left", borderaxespad=0.2)
    for text in legend.get_texts():
        text.set_parse_math(False)


def _set_error_axis(axes: Axes, scene: Scene) -> None:
    """The same error axis for both figures of a scene, and the reference's noise where it is in sight."""
    ends = [end for sampler in scene.samplers for point in _drawable(sampler) for end in _bar(point.rmse)]
    if not ends:
        axes.text(0.5, 0.5, "no point to draw", transform=axes.transAxes, ha="center", color=GUIDE_COLOR)
        _without_ticks(axes.yaxis)
        return
    lo, hi = min(ends), max(ends)
    room = max((hi / lo) ** 0.06, 1.15)
    lo, hi = lo / room, hi * room
    axes.set_ylim(lo, hi)
    set_log_ticks(axes.yaxis, lo, hi)
    floor = scene.reference.se_rmse
    if floor and lo < floor < hi:
        axes.axhspan(lo, floor, color="#000000", alpha=0.06, linewidth=0)


def _draw_guides(axes: Axes, scene: Scene) -> None:
    """Thin lines of slope -1/2 and -1 from the worst first point, each labelled where it leaves the axes."""
    firsts = [_drawable(sampler)[0] for sampler in scene.samplers if _drawable(sampler)]
    x0, y0 = min(point.spp for point in firsts), max(point.rmse.value for point in firsts)
    (_, x_hi), (y_lo, y_hi) = axes.get_xlim(), axes.get_ylim()
    for exponent, text in ((-0.5, "\u22121/2"), (-1.0, "\u22121")):
        end = min(x_hi, x0 * (y_lo / y0) ** (1 / exponent))
        axes.plot([x0, end], [y0, y0 * (end / x0) ** exponent], color=GUIDE_COLOR,
                  linewidth=0.7, zorder=1)
        at = min(x_hi / 1.12, x0 * (y_lo * (y_hi / y_lo) ** 0.03 / y0) ** (1 / exponent))
        axes.annotate(text, (at, y0 * (at / x0) ** exponent), xytext=(3, 3), textcoords="offset points",
                      color="#6a6a6a", fontsize=7.5)


def _without_ticks(axis: Axis) -> None:
    axis.set_major_locator(NullLocator())
    axis.set_minor_locator(NullLocator())
