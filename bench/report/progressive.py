"""The figure of progressive renders: what stopping one early costs beside renders that were planned for the number."""

from markupsafe import Markup
from matplotlib import style
from matplotlib.figure import Figure

from .figures import MOST_IN_KEY
from .model import Scene
from .palette import Style
from .svg import drawing, inline_svg
from .ticks import set_log_ticks, set_value_ticks


def progressive_figure(scene: Scene, styles: dict[str, Style], key: str) -> Markup:
    """RMSE of prefixes over that of native renders, against spp; above 1 a prefix is worse. Bars are of the prefixes' RMSE alone."""
    with style.context(drawing(key)):
        figure = Figure(figsize=(5.75, 3.2))
        axes = figure.add_axes((0.115, 0.15, 0.865, 0.74), xscale="log", yscale="log")
        axes.set_title("A longer render, stopped early", x=-0.11)
        axes.set_xlabel("stopped at, samples per pixel (spp)")
        axes.set_ylabel("RMSE / native RMSE")
        axes.grid(True, which="major")
        axes.axhline(1, color="#4d4d4d", linewidth=0.8, zorder=1)
        ends, spps = [0.95, 1.05], []
        for sampler in scene.samplers:
            if sampler.progressive is None:
                continue
            look, native = styles[sampler.sampler], {point.spp: point.rmse.value for point in sampler.points}
            points = [(spp, *(None if v is None else v / native[spp] for v in (rmse.value, rmse.lo, rmse.hi)))
                      for spp, rmse in sampler.progressive.points if rmse.value and native.get(spp)]
            axes.plot([p[0] for p in points], [p[1] for p in points], color=look.color, dashes=look.dashes or (None, None), linewidth=1.3,
                      marker=look.marker, markersize=5.5, markeredgecolor="white", markeredgewidth=0.6, label=sampler.label)
            for spp, value, lo, hi in points:
                lo, hi = lo or value, hi or value
                axes.plot([spp, spp], [lo, hi], color=look.color, linewidth=1.0, solid_capstyle="butt")
                ends += [lo, hi]
                spps.append(spp)
        if spps:
            axes.set_xlim(min(spps) / 1.2, max(spps) * 1.2)
            set_value_ticks(axes.xaxis, spps)
        lo, hi = min(ends) / 1.03, max(ends) * 1.03
        axes.set_ylim(lo, hi)
        set_log_ticks(axes.yaxis, lo, hi)
        if len(scene.samplers) <= MOST_IN_KEY:
            for text in axes.legend(loc="best", borderaxespad=0.2).get_texts():
                text.set_parse_math(False)
        return inline_svg(figure, key, f"{scene.name}: RMSE of progressive renders over that of native ones; the numbers are in the table below")
