"""The figures of a card, as inline SVG."""

import numpy as np
from markupsafe import Markup
from matplotlib import style
from matplotlib.figure import Figure

from .palette import BASELINE_COLOR, COLORS
from .svg import drawing, inline_svg


def point_plots(pictures: dict, key: str) -> Markup:
    """Projections on pairs of dimensions, with the grid that has one cell a point where there is one."""
    projections = pictures["projections"]
    side = round(pictures["n"] ** 0.5)
    with style.context(drawing(key)):
        figure = Figure(figsize=(11.6, 6.1), layout="constrained")
        for axes, projection in zip(figure.subplots(2, 4).flat, projections):
            axes.set_title(f"dimensions {projection['a']}, {projection['b']}")
            if side * side == pictures["n"]:
                for k in range(1, side):
                    axes.axhline(k / side, color="#ececec", linewidth=0.5, zorder=0)
                    axes.axvline(k / side, color="#ececec", linewidth=0.5, zorder=0)
            axes.plot(projection["x"], projection["y"], ".", color=COLORS[0], markersize=2.6)
            axes.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xticks=[], yticks=[])
            axes.spines[:].set_visible(True)
        return inline_svg(figure, key, f"{pictures['n']} points in {len(projections)} projections")


def spectrum_image(spectrum: dict, key: str) -> Markup:
    """Power over frequencies: black is none, white twice that of random points or more."""
    side = 2 * spectrum["largest"] + 1
    with style.context(drawing(key)):
        figure = Figure(figsize=(4.6, 4.5), layout="constrained")
        axes = figure.subplots()
        axes.set_title("Power spectrum, dimensions 0 and 1")
        edge = spectrum["largest"] + 0.5
        axes.imshow(np.reshape(spectrum["power"], (side, side)), cmap="gray", vmin=0, vmax=2, origin="lower",
                    extent=(-edge, edge, -edge, edge), interpolation="nearest")
        axes.set(xlabel="frequency", ylabel="frequency")
        return inline_svg(figure, key, "Power spectrum of the first pair of dimensions")


def radial_power(spectrum: dict, key: str) -> Markup:
    """The mean of the spectrum over circles; random points have 1."""
    with style.context(drawing(key)):
        figure = Figure(figsize=(6.2, 4.5), layout="constrained")
        axes = figure.subplots()
        axes.set_title("Radial mean of the power")
        axes.axhline(1, color=BASELINE_COLOR, linewidth=0.8, dashes=(3, 2))
        axes.plot(range(1, len(spectrum["radial"]) + 1), spectrum["radial"], color=COLORS[0])
        axes.set(xlabel="frequency", ylim=(0, max(1.5, 1.05 * max(spectrum["radial"]))), xlim=(0, len(spectrum["radial"])))
        axes.grid(axis="y")
        return inline_svg(figure, key, "Mean power against frequency")


def star_discrepancies(rows: list, key: str) -> Markup:
    """Star discrepancy against the number of points: exact in one and two dimensions, between two bounds in three and four."""
    return _against_n("Star discrepancy: exact, and bounds", rows, key,
                      [("dimension 0", "star1", 0, "o"), ("dimensions 0, 1", "star2", 1, "s")],
                      bands=[("dimensions 0 to 2, bounds", "star3", 2), ("dimensions 0 to 3, bounds", "star4", 3)],
                      guides=[(-0.5, "N^-1/2"), (-1, "1/N")])


def l2_discrepancies(rows: list, key: str) -> Markup:
    """L2 discrepancies against the number of points; dashed, the expectation of L2-star for random points."""
    return _against_n("L2 discrepancies, dimensions 0, 1 (and 0 to 3)", rows, key,
                      [("star", "l2star2", 0, "o"), ("star, 4 dimensions", "l2star4", 1, "s"), ("centred", "centred2", 2, "^"),
                       ("wrap-around", "wraparound2", 3, "v"), ("mixture", "mixture2", 4, "D")],
                      dashed=[("random2", 0), ("random4", 1)])


def rate_plot(rates: list, key: str) -> Markup:
    """RMSE against samples for every integrand, each divided by its value at the first count."""
    with style.context(drawing(key)):
        figure = Figure(figsize=(6.2, 5.0), layout="constrained")
        axes = figure.subplots()
        axes.set_title("Error on integrands, relative to the first count")
        for k, rate in enumerate(rates):
            n = np.array([e["n"] for e in rate["errors"]], float)
            rmse = np.array([e["rmse"] for e in rate["errors"]], float)
            if rmse[0] > 0:
                axes.loglog(n, np.where(rmse > 0, rmse, np.nan) / rmse[0], color=COLORS[k % len(COLORS)], marker="osD^vPX"[k % 7],
                            markersize=3.5, linewidth=1.1, label=rate["integrand"])
        _guides(axes, [(-0.5, "N^-1/2"), (-1, "1/N"), (-1.5, "N^-3/2")], n, 1.0)
        axes.set(xlabel="samples", ylabel="RMSE / RMSE at the first count")
        axes.legend(ncols=2, fontsize=7.5)
        return inline_svg(figure, key, "Relative RMSE against samples")


def _against_n(title: str, rows: list, key: str, series: list, dashed: list = (), guides: list = (),
               bands: list = ()) -> Markup:
    with style.context(drawing(key)):
        figure = Figure(figsize=(5.7, 4.5), layout="constrained")
        axes = figure.subplots()
        axes.set_title(title)
        n = np.array([row["n"] for row in rows], float)
        good = np.array([row["good"] for row in rows])
        for label, field, color, marker in series:
            y = np.array([row[field] for row in rows])
            axes.loglog(n, y, marker, markevery=np.flatnonzero(good).tolist(), linestyle="-", color=COLORS[color], markersize=4,
                        linewidth=1.1, label=label)
        for label, field, color in bands:
            lo, hi = (np.array([row[field][end] for row in rows]) for end in ("lo", "hi"))
            axes.fill_between(n, lo, hi, color=COLORS[color], alpha=0.3, linewidth=0.6, label=label)
        for field, color in dashed:
            axes.loglog(n, [row[field] for row in rows], color=COLORS[color], linewidth=0.8, dashes=(3, 2))
        _guides(axes, guides, n, 1.0)
        axes.set(xlabel="points (markers: good counts)")
        axes.grid()
        axes.legend()
        return inline_svg(figure, key, title)


def _guides(axes, guides: list, n: np.ndarray, start: float) -> None:
    for slope, name in guides:
        axes.loglog(n, start * (n / n[0]) ** slope, color="#b0b0b0", linewidth=0.7, dashes=(2, 2))
        axes.annotate(name, (n[-1], start * (n[-1] / n[0]) ** slope), color="#808080", fontsize=7.5)
