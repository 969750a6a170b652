"""The robustness ladder: python3 -m report.ladder LADDER.json PAGE.html (LADDER.json from `koksma bench ladder`)."""

import json
import sys
from pathlib import Path

_HERE = Path(__file__).parent
NAMES = {"light": "light sampling", "bsdf": "BSDF sampling", "mis": "both (MIS)"}
LOOKS = {"light": ("#e69f00", "s"), "bsdf": ("#0072b2", "^"), "mis": ("#009e73", "o")}
FLOOR = 1e-9  # errors below are drawn here: a logarithm has no zero


def main(arguments: list[str] | None = None) -> int:
    """Writes the page. Returns 0 on success and 1 on failure, with one line on stderr."""
    arguments = sys.argv[1:] if arguments is None else arguments
    if len(arguments) != 2:
        print("ladder: usage: python3 -m report.ladder LADDER.json PAGE.html", file=sys.stderr)
        return 2
    source, target = map(Path, arguments)
    try:
        from .__main__ import write_atomically
        write_atomically(target, render_ladder(json.loads(source.read_text(encoding="utf-8"))))
    except ImportError as error:
        print(f"ladder: {error}; expected the Python packages matplotlib, numpy and jinja2", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"ladder: {error.filename or target}: {error.strerror or error}", file=sys.stderr)
        return 1
    print(target)
    return 0


def render_ladder(numbers: dict) -> str:
    """The text of the page. The same numbers give the same bytes."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(loader=FileSystemLoader(_HERE), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    ladders = [{**ladder, "plot": error_plot(ladder), "lines": [verdict(technique, v, len(ladder["steps"])) for technique, v in ladder["verdicts"].items()]}
               for ladder in numbers["ladders"]]
    return environment.get_template("ladder.html.j2").render(numbers=numbers, ladders=ladders, names=NAMES, breaks=sum(
        v["breaks_at"] is not None for ladder in ladders for v in ladder["verdicts"].values()))


def verdict(technique: str, v: dict, steps: int) -> str:
    """One line: how far a technique holds."""
    text = f"{NAMES[technique]}: holds to the end" if v["breaks_at"] is None else f"{NAMES[technique]}: breaks at {v['breaks_at']:.3g}, error {v['error_there']:+.2g}"
    return text + (f"; at {v['hidden_by_noise']} of {steps} steps its noise is above ten tolerances" if v["hidden_by_noise"] else "")


def error_plot(ladder: dict) -> str:
    """Absolute relative error with its interval against what grows; the tolerance as a line, a cross where it breaks."""
    from matplotlib import style
    from matplotlib.figure import Figure

    from .svg import drawing, inline_svg

    key = f"ladder-{ladder['name']}"
    with style.context(drawing(key)):
        figure = Figure(figsize=(7.0, 2.7))
        figure.set_layout_engine("constrained")
        axes = figure.subplots()
        axes.set_xscale("log")
        axes.set_yscale("log")
        steps = ladder["steps"]
        if steps[0]["x"] > steps[-1]["x"]:
            axes.invert_xaxis()
        top = max(abs(r["error"]) + r["half_width"] for step in steps for r in step["techniques"].values())
        axes.set_ylim(FLOOR / 2, 3 * max(top, ladder["tolerance"]))
        axes.axhline(ladder["tolerance"], color="#8a8a8a", linewidth=0.9, dashes=(4, 3))
        for technique in ladder["verdicts"]:
            color, marker = LOOKS[technique]
            rows = [(step["x"], step["techniques"][technique]) for step in steps]
            x = [at for at, _ in rows]
            error = [max(abs(r["error"]), FLOOR) for _, r in rows]
            high = [max(abs(r["error"]) + r["half_width"], FLOOR) for _, r in rows]
            low = [max(abs(r["error"]) - r["half_width"], FLOOR) for _, r in rows]
            axes.errorbar(x, error, yerr=[[e - l for e, l in zip(error, low)], [h - e for e, h in zip(error, high)]], color=color, marker=marker,
                          markersize=4, linewidth=1.0, elinewidth=0.7, label=NAMES[technique])
            broken = [(at, e) for (at, r), e in zip(rows, error) if not r["holds"]]
            if broken:
                axes.plot(*zip(*broken), linestyle="", marker="x", markersize=9, color="#b00020", markeredgewidth=1.8)
        axes.set_xlabel(ladder["axis"])
        axes.set_ylabel("relative error")
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3, frameon=False, borderaxespad=0.2)
        axes.grid(True, which="major", color="#e6e6e6", linewidth=0.6)
        axes.set_axisbelow(True)
        return inline_svg(figure, key, f"{ladder['title']}: relative error")


if __name__ == "__main__":
    sys.exit(main())
