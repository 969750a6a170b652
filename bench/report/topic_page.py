"""A page of one topic from a file of numbers: what the budget and the lecture have in common."""

import json
import sys
from collections.abc import Callable
from pathlib import Path

_HERE = Path(__file__).parent


def render_to_file(name: str, context: Callable[[dict, Path], dict], arguments: list[str]) -> int:
    """Reads NUMBERS.json, fills name.html.j2 with it (as `numbers`) and with what `context` makes of it and
    its folder, and writes the page.

    Returns 0 on success, 1 on failure and 2 for wrong usage, with one line on stderr.
    """
    if len(arguments) != 2:
        print(f"{name}: usage: python3 -m report.{name} NUMBERS.json PAGE.html", file=sys.stderr)
        return 2
    source, target = map(Path, arguments)
    try:
        # Late, so that the message below needs only the standard library.
        from jinja2 import Environment, FileSystemLoader, StrictUndefined, UndefinedError

        from .__main__ import write_atomically
        from .check import ReportError

        numbers = json.loads(source.read_text(encoding="utf-8"))
        environment = Environment(loader=FileSystemLoader(_HERE), autoescape=True, undefined=StrictUndefined,
                                  trim_blocks=True, lstrip_blocks=True)
        environment.filters.update(percent=_percent, times=_times, sig=_significant, cell=_cell)
        write_atomically(target, environment.get_template(f"{name}.html.j2").render(numbers=numbers, **context(numbers, source.parent)))
    except ImportError as error:
        print(f"{name}: {error}; expected the Python packages matplotlib, numpy and jinja2", file=sys.stderr)
        return 1
    except (KeyError, UndefinedError) as error:
        print(f"{name}: {source}: {error}; expected the numbers of this version of the program", file=sys.stderr)
        return 1
    except (ReportError, OSError, ValueError) as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 1
    print(target)
    return 0


def _cell(value: object) -> str:
    """Text as it is, numbers to three or four digits, estimates with their intervals."""
    from . import formats
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return formats.count(value)
    if value is None or isinstance(value, float):
        return formats.significant(value, 4)
    return _significant(value)


def _with_interval(estimate: dict, form: Callable[[float], str]) -> str:
    if estimate["value"] is None:
        return "\u2013"
    if estimate.get("lo") is None or estimate.get("hi") is None:
        return form(estimate["value"])
    return f"{form(estimate['value'])} [{form(estimate['lo'])}, {form(estimate['hi'])}]"


def _percent(estimate: dict) -> str:
    from . import formats
    return _with_interval(estimate, lambda x: formats.fixed(100 * x, 1)) + "\u2009%"


def _times(estimate: dict) -> str:
    from . import formats
    return _with_interval(estimate, formats.fixed)


def _significant(estimate: dict) -> str:
    from . import formats
    return _with_interval(estimate, formats.significant)
