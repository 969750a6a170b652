"""The figure of a budget: one row a group of decisions, what the sequence does for it alone and what is lost without it."""

from markupsafe import Markup
from matplotlib import style
from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter

from .palette import BASELINE_COLOR, COLORS
from .svg import drawing, inline_svg


def shares(division: dict, key: str) -> Markup:
    """Left, the part of the error of independent numbers that goes; right, the factor by which the error of the sequence grows."""
    groups = division["groups"]
    height = 1.0 + 0.3 * len(groups)
    with style.context(drawing(key)):
        figure = Figure(figsize=(11.6, height))
        bottom, tall = 0.62 / height, 0.3 * len(groups) / height
        removed = figure.add_axes((0.23, bottom, 0.36, tall))
        loss = figure.add_axes((0.64, bottom, 0.35, tall), xscale="log")
        for row, group in enumerate(groups):
            _bar(removed, row, group["removed"], 0.0, COLORS[0], 100.0)
            _bar(loss, row, group["loss"], 1.0, COLORS[3], 1.0)
        for axes in (removed, loss):
            axes.set_ylim(len(groups) - 0.4, -0.6)
            axes.tick_params(axis="y", length=0)
            axes.grid(True, axis="x", which="major")
            axes.set_axisbelow(True)
        removed.set_yticks(range(len(groups)), [group["name"] for group in groups])
        loss.set_yticks([])
        removed.axvline(0, color=BASELINE_COLOR, linewidth=0.8)
        loss.axvline(1, color=BASELINE_COLOR, linewidth=0.8)
        removed.set_title(f"By {division['by']}: it alone by the sequence")
        removed.set_xlabel("part of the MSE of independent numbers that goes (%)")
        loss.set_title("It alone independent")
        loss.set_xlabel("MSE over that of the sequence")
        ends = [g["loss"]["hi"] or g["loss"]["value"] or 1 for g in groups] + [1.5]
        loss.set_xlim(0.85, max(ends) * 1.1)
        ticks = [t for t in (1, 1.5, 2, 3, 5, 10, 30, 100, 1000, 10000) if t <= max(ends) * 1.1]
        loss.set_xticks(ticks)
        loss.minorticks_off()
        loss.xaxis.set_major_formatter(ScalarFormatter())
        return inline_svg(figure, key, f"Error budget by {division['by']}; the numbers are in the table below")


def _bar(axes, row: int, estimate: dict, base: float, color: str, factor: float) -> None:
    if estimate["value"] is None:
        return
    value = factor * estimate["value"]
    axes.barh(row, value - base, left=base, height=0.62, color=color, alpha=0.55)
    if estimate["lo"] is not None:
        axes.plot([factor * estimate["lo"], factor * estimate["hi"]], [row, row], color="#1d1d1f", linewidth=1.2, solid_capstyle="butt")
    axes.plot([value], [row], "|", color="#1d1d1f", markersize=7)
