"""The points of a report as files for a paper: CSV, and a LaTeX table for the package booktabs."""

import csv
import io

from .model import Estimate, Summary

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
    r"""Samplers by scenes: slope and MSE gain over random, with intervals. Needs \usepackage{booktabs}."""
    samplers = list(dict.fromkeys((s.sampler, s.label) for scene in summary.scenes for s in scene.samplers))
    lines = [r"\begin{tabular}{l" + "rr" * len(summary.scenes) + "}", r"\toprule",
             " & ".join(["", *(rf"\multicolumn{{2}}{{c}}{{{_escaped(scene.name)}}}" for scene in summary.scenes)]) + r" \\",
             " & ".join(["Sampler"] + ["slope & gain"] * len(summary.scenes)) + r" \\", r"\midrule"]
    for name, label in samplers:
        cells = [_escaped(label)]
        for scene in summary.scenes:
            result = next((s for s in scene.samplers if s.sampler == name), None)
            cells.append(_number(result.slope.estimate, 2) if result and result.slope else "--")
            cells.append(_number(result.gain.ratio, 2) if result and result.gain else ("1" if result and result.is_baseline else "--"))
        lines.append(" & ".join(cells) + r" \\")
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


def _number(estimate: Estimate, decimals: int) -> str:
    if estimate.value is None:
        return "--"
    text = f"${estimate.value:.{decimals}f}$"
    if estimate.lo is not None and estimate.hi is not None:
        text += rf" {{\scriptsize $[{estimate.lo:.{decimals}f}, {estimate.hi:.{decimals}f}]$}}"
    return text


def _escaped(text: str) -> str:
    for character in "&%$#_{}":
        text = text.replace(character, "\\" + character)
    return text
