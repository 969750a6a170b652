"""A chart of the lecture: measured points with their intervals, closed forms as dashed lines."""

from markupsafe import Markup
from matplotlib import style
from matplotlib.figure import Figure

from .palette import BASELINE_COLOR, COLORS, MARKERS
from .svg import drawing, inline_svg
from .ticks import set_log_ticks, set_value_ticks


def chart(numbers: dict, key: str) -> Markup:
    """Series over x; a point without a value is left out, and on a logarithmic axis one that is not positive."""
    with style.context(drawing(key)):
        figure = Figure(figsize=(5.75, 4.0), layout="constrained")
        axes = figure.subplots(subplot_kw={"xscale": "log" if numbers["x_log"] else "linear", "yscale": "log" if numbers["y_log"] else "linear"})
        ends: list[float] = []
        # Where a closed form joins the points, they are not joined a second time.
        joined = not any(series["known"] for series in numbers["series"])
        for k, series in enumerate(numbers["series"]):
            points = [(x, y) for x, y in zip(series["x"], series["y"])
                      if y["value"] is not None and (not numbers["y_log"] or y["value"] > 0)]
            xs, values = [x for x, _ in points], [y["value"] for _, y in points]
            ends += values
            if series["known"]:
                axes.plot(xs, values, color=BASELINE_COLOR, dashes=(4, 2), linewidth=1.0, label=series["label"], zorder=4)
                continue
            color, marker = COLORS[k % len(COLORS)], list(MARKERS)[k % len(MARKERS)]
            axes.plot(xs, values, color=color, marker=marker, markersize=5.5, markeredgecolor="white", markeredgewidth=0.6,
                      linewidth=1.2 if joined or len(numbers["series"]) > 2 else 0.0, label=series["label"], zorder=3)
            for x, y in points:
                if y["lo"] is None or y["hi"] is None:
                    continue
                low = max(y["lo"], y["value"] / 100) if numbers["y_log"] else y["lo"]
                axes.plot([x, x], [low, y["hi"]], color=color, linewidth=1.1, solid_capstyle="butt", zorder=2)
                ends += [low, y["hi"]]
        axes.set_title(numbers["title"])
        axes.set_xlabel(numbers["x"])
        axes.set_ylabel(numbers["y"])
        axes.grid(True, which="major")
        axes.set_axisbelow(True)
        if numbers["x_log"]:
            xs = sorted({x for series in numbers["series"] for x in series["x"]})
            axes.set_xlim(xs[0] / 1.3, xs[-1] * 1.3)
            if all(float(x).is_integer() for x in xs):
                set_value_ticks(axes.xaxis, xs)
            else:
                set_log_ticks(axes.xaxis, xs[0] / 1.3, xs[-1] * 1.3)
        if numbers["y_log"] and ends:
            lo, hi = min(ends) / 1.2, max(ends) * 1.2
            axes.set_ylim(lo, hi)
            set_log_ticks(axes.yaxis, lo, hi)
        legend = axes.legend()
        for text in legend.get_texts():
            text.set_parse_math(False)
        return inline_svg(figure, key, f"{numbers['title']}; the numbers are in the tables")
