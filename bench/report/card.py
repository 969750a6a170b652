"""The card of one sampler: python3 -m report.card NUMBERS.json PAGE.html (NUMBERS from `koksma card`)."""

import json
import sys
from pathlib import Path

_HERE = Path(__file__).parent


def main(arguments: list[str] | None = None) -> int:
    """Writes the page. Returns 0 on success and 1 on failure, with one line on stderr."""
    arguments = sys.argv[1:] if arguments is None else arguments
    if len(arguments) != 2:
        print("card: usage: python3 -m report.card NUMBERS.json PAGE.html", file=sys.stderr)
        return 2
    source, target = map(Path, arguments)
    try:
        from .__main__ import write_atomically
        text = render_card(json.loads(source.read_text(encoding="utf-8")))
        write_atomically(target, text)
    except ImportError as error:
        print(f"card: {error}; expected the Python packages matplotlib, numpy and jinja2", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"card: {error.filename or target}: {error.strerror or error}", file=sys.stderr)
        return 1
    print(target)
    return 0


def render_card(card: dict) -> str:
    """The text of the page. The same numbers give the same bytes."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from . import card_figures as figures

    environment = Environment(loader=FileSystemLoader(_HERE), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("card.html.j2").render(
        card=card, info=card["info"],
        points=figures.point_plots(card["pictures"], "points"),
        spectrum=figures.spectrum_image(card["spectrum"], "spectrum"),
        radial=figures.radial_power(card["spectrum"], "radial"),
        star=figures.star_discrepancies(card["discrepancies"], "star"),
        l2=figures.l2_discrepancies(card["discrepancies"], "l2"),
        quality=card["quality"] and quality_rows(card["quality"]),
        rates=card["rates"] and figures.rate_plot(card["rates"], "rates"))


def quality_rows(quality: dict) -> dict:
    """Columns of the histogram up to the worst t that occurs, and the triangle of pairs."""
    worst = max(t for row in quality["histogram"] for t, count in enumerate(row["count"]) if count)
    pairs = {(pair["a"], pair["b"]): pair["t"] for pair in quality["pairs"]}
    return {
        "columns": range(worst + 1),
        "histogram": [(row["dimensions"], row["count"][:worst + 1]) for row in quality["histogram"]],
        "pairs": [[pairs.get((a, b)) for b in range(quality["of"])] for a in range(quality["of"] - 1)],
        "of": quality["of"], "n": quality["n"],
    }


if __name__ == "__main__":
    sys.exit(main())
