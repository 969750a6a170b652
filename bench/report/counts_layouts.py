"""Figures of the experiments layout and anycount: errors under permuted layouts, and gains at any number of samples."""

import math

from markupsafe import Markup
from matplotlib import style
from matplotlib.figure import Figure

from .model import Scene
from .palette import Style
from .svg import drawing, inline_svg
from .ticks import set_log_ticks, set_value_ticks

_WIDTH_IN = 11.6


def layout_spread(scene: Scene, styles: dict[str, Style], key: str) -> Markup:
    """One row a sampler, at its largest spp: RMSE of every layout over the geometric mean of the permuted ones; hollow, the planned one."""
    shown = [(sampler, sampler.layouts[-1]) for sampler in scene.samplers if sampler.layouts and sampler.layouts[-1].rmse.value]
    height = 0.95 + 0.34 * len(shown)
    with style.context(drawing(key)):
        figure = Figure(figsize=(_WIDTH_IN, height))
        axes = figure.add_axes((0.27, 0.55 / height, 0.71, 0.34 * len(shown) / height), xscale="log")
        ends = [0.95, 1.05]
        for row, (sampler, at) in enumerate(shown):
            look = styles[sampler.sampler]
            for k, estimate in enumerate(at.each):
                if not estimate.value:
                    continue
                x, lo, hi = (None if bound is None else bound / at.rmse.value for bound in (estimate.value, estimate.lo, estimate.hi))
                y = row + 0.62 * ((k + 0.5) / len(at.each) - 0.5)
                lo, hi = max(lo if lo is not None else x, x / 3), hi if hi is not None else x
                axes.plot([lo, hi], [y, y], color=look.color, linewidth=0.9, solid_capstyle="butt")
                axes.plot([x], [y], linestyle="none", marker=look.marker, markersize=5.0, zorder=3, markeredgewidth=1.1 if k == 0 else 0.5,
                          markerfacecolor="white" if k == 0 else look.color, markeredgecolor=look.color if k == 0 else "white")
                ends += [lo, hi]
        axes.set_ylim(len(shown) - 0.5, -0.5)
        axes.set_yticks(range(len(shown)), [f"{sampler.label}, {at.spp} spp" for sampler, at in shown])
        axes.tick_params(axis="y", length=0)
        for text in axes.get_yticklabels():
            text.set_parse_math(False)
        lo, hi = min(ends) / 1.03, max(ends) * 1.03
        axes.set_xlim(lo, hi)
        set_log_ticks(axes.xaxis, lo, hi)
        axes.axvline(1, color="#4d4d4d", linewidth=0.8, zorder=1)
        axes.grid(True, axis="x", which="major")
        axes.set_axisbelow(True)
        axes.set_xlabel("RMSE of a layout / geometric mean of the permuted layouts")
        return inline_svg(figure, key, f"{scene.name}: RMSE under permuted layouts of dimensions; the numbers are in the table below")


def gain_at_counts(scene: Scene, styles: dict[str, Style], key: str) -> Markup:
    """MSE gain over random against the number of samples; hollow markers where random was interpolated."""
    with style.context(drawing(key)):
        figure = Figure(figsize=(_WIDTH_IN, 4.8), layout="constrained")
        axes = figure.subplots(subplot_kw={"xscale": "log", "yscale": "log"})
        ends, spps = [0.9, 1.1], []
        for sampler in scene.samplers:
            look = styles[sampler.sampler]
            gains = [gain for gain in sampler.counts if gain.ratio.value]
            if not gains:
                continue
            axes.plot([g.spp for g in gains], [g.ratio.value for g in gains], color=look.color, dashes=look.dashes or (None, None), linewidth=1.1)
            for g in gains:
                lo, hi = (g.ratio.value if bound is None else max(bound, g.ratio.value / 10) for bound in (g.ratio.lo, g.ratio.hi))
                axes.plot([g.spp, g.spp], [lo, hi], color=look.color, linewidth=0.8, solid_capstyle="butt")
                axes.plot([g.spp], [g.ratio.value], linestyle="none", marker=look.marker, markersize=4.6, zorder=3, markeredgewidth=1.0 if g.interpolated else 0.4,
                          markerfacecolor="white" if g.interpolated else look.color, markeredgecolor=look.color if g.interpolated else "white")
                ends += [lo, hi]
                spps.append(g.spp)
            line, = axes.plot([], [], color=look.color, dashes=look.dashes or (None, None), linewidth=1.3, marker=look.marker, markersize=5)
            line.set_label(sampler.label)
        if spps:
            axes.set_xlim(min(spps) / 1.1, max(spps) * 1.1)
            set_value_ticks(axes.xaxis, [spp for spp in sorted(set(spps)) if math.log2(spp).is_integer() or spp in (5, 37, 100)])
        lo, hi = min(ends) / 1.05, max(ends) * 1.05
        axes.set_ylim(lo, hi)
        set_log_ticks(axes.yaxis, lo, hi)
        axes.axhline(1, color="#4d4d4d", linewidth=0.8, zorder=1)
        axes.grid(True, which="major")
        axes.set_axisbelow(True)
        axes.set_xlabel("samples per pixel (spp)")
        axes.set_ylabel("MSE of random / MSE of the sampler")
        axes.legend(loc="upper left", ncols=3)
        return inline_svg(figure, key, f"{scene.name}: MSE gain over random at any count; the numbers are in the table below")
