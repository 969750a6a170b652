"""The points of a report as files for a paper: CSV, and LaTeX tables for the package booktabs."""

import csv
import io
from collections.abc import Callable

from .model import Estimate, SamplerResult, Scene, Summary, TimeTo
from .tables import targets, time_to

COLUMNS = ("scene", "sampler", "spp", "replicates", "rmse", "rmse_lo", "rmse_hi", "relmse", "relmse_lo", "relmse_hi", "cpu_seconds", "wall_seconds", "sampler_share")


def points_csv(summary: Summary) -> str:
    """One line a scene, sampler and spp, with all digits; empty where there is no number."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for scene in summary.scenes:
        for sampler in scene.samplers:
            for p in sampler.points:
                numbers = (p.rmse.value, p.rmse.lo, p.rmse.hi, p.relmse.value, p.relmse.lo, p.relmse.hi, p.cpu_seconds, p.wall_seconds, p.sampler_share)
                writer.writerow([scene.name, sampler.sampler, p.spp, p.replicates, *("" if n is None else repr(n) for n in numbers)])
    return out.getvalue()


def gains_tex(summary: Summary) -> str:
    r"""Slope and MSE gain over random with intervals, a line a scene and sampler. Needs \usepackage{booktabs}."""
    return _table(summary, "rr", ["slope", "gain"], lambda scene, result: [
        _number(result.slope.estimate, 3) if result.slope else "--",
        _number(result.gain.ratio, 2) if result.gain else ("1" if result.is_baseline else "--")])


def times_tex(summary: Summary) -> str:
    r"""CPU seconds to reach a relMSE with intervals, never extrapolated, a line a scene and sampler. Needs \usepackage{booktabs}."""
    wanted = sorted({target for scene in summary.scenes for target in targets(scene)}, reverse=True)

    def cell(entry: TimeTo | None) -> str:
        if entry is None or entry.seconds.value is None:
            return "--"
        return rf"$\leq {entry.seconds.value:.3g}$" if entry.how == "measured" else _seconds(entry.seconds)

    return _table(summary, "r" * len(wanted), [f"relMSE ${target:g}$" for target in wanted], lambda scene, result: [cell(time_to(result, target)) for target in wanted])


def _table(summary: Summary, columns: str, heads: list[str], cells: Callable[[Scene, SamplerResult], list[str]]) -> str:
    lines = [r"\begin{tabular}{ll" + columns + "}", r"\toprule", " & ".join(["Scene", "Sampler", *heads]) + r" \\"]
    for scene in summary.scenes:
        lines.append(r"\midrule")
        for i, result in enumerate(scene.samplers):
            lines.append(" & ".join([_escaped(scene.name) if i == 0 else "", _escaped(result.label), *cells(scene, result)]) + r" \\")
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


def _seconds(estimate: Estimate) -> str:
    text = f"${estimate.value:.3g}$"
    if estimate.lo is not None or estimate.hi is not None:
        ends = ", ".join("--" if bound is None else f"{bound:.3g}" for bound in (estimate.lo, estimate.hi))
        text += rf" {{\scriptsize $[{ends}]$}}"
    return text


def _number(estimate: Estimate, decimals: int) -> str:
    if estimate.value is None:
        return "--"
    text = f"${estimate.value:.{decimals}f}$"
    if estimate.lo is not None and estimate.hi is not None:
        text += rf" {{\scriptsize $[{estimate.lo:.{decimals}f}, {estimate.hi:.{decimals}f}]$}}"
    return text


def _escaped(text: str) -> str:
    return "".join({"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}.get(c, "\\" + c if c in "&%$#_{}" else c) for c in text)
