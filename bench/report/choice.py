"""What the figures of a paper show: a small JSON file, checked, and a summary cut to it."""

import json
import re
from dataclasses import dataclass, replace
from pathlib import Path

from .check import Node, ReportError
from .model import Summary
from .palette import Style, assign_styles
from .tables import sampler_columns

FORMATS = ("svg", "pdf")
KEYS = {"samplers", "scenes", "labels", "colors", "column_width", "font_size", "formats"}


@dataclass(frozen=True)
class Choice:
    """Empty samplers or scenes: all. Widths in millimetres, the font's size in points; colours as "#rrggbb"."""

    samplers: tuple[str, ...] = ()
    scenes: tuple[str, ...] = ()
    labels: tuple[tuple[str, str], ...] = ()
    colors: tuple[tuple[str, str], ...] = ()
    column_width: float = 84.0
    font_size: float = 8.0
    formats: tuple[str, ...] = FORMATS


def load_choice(path: Path) -> Choice:
    """Raises ReportError, which names the file, the key and what was expected; unknown keys are errors."""
    try:
        root = Node(json.loads(path.read_text(encoding="utf-8")), str(path))
    except OSError as error:
        raise ReportError(f"{path}: {error.strerror}, expected the JSON file that chooses the figures") from None
    except ValueError as error:
        raise ReportError(f"{path}: {error}, expected JSON") from None
    if not isinstance(root.value, dict):
        raise root.fail("an object")
    for key in root.value:
        if key not in KEYS:
            raise ReportError(f"{path}: unknown key \"{key}\", expected one of {', '.join(sorted(KEYS))}")

    def texts(key: str) -> tuple[str, ...]:
        return tuple(item.name() for item in root.at(key).items()) if key in root.value else ()

    def pairs(key: str) -> tuple[tuple[str, str], ...]:
        if key not in root.value:
            return ()
        node = root.at(key)
        if not isinstance(node.value, dict):
            raise node.fail("an object of sampler: text")
        return tuple((name, node.at(name).name()) for name in node.value)

    def size(key: str, least: float, most: float, default: float) -> float:
        if key not in root.value:
            return default
        if not least <= (value := root.at(key).number(0)) <= most:
            raise root.at(key).fail(f"a number from {least:g} to {most:g}")
        return value

    for name, color in pairs("colors"):
        if not re.fullmatch("#[0-9a-fA-F]{6}", color):
            raise root.at("colors").at(name).fail('a colour as "#0072b2"')
    for node in root.at("formats").items() if "formats" in root.value else ():
        node.one_of(*FORMATS)
    return Choice(texts("samplers"), texts("scenes"), pairs("labels"), pairs("colors"), size("column_width", 30, 1000, Choice.column_width),
                  size("font_size", 4, 24, Choice.font_size), texts("formats") or FORMATS)


def chosen(summary: Summary, choice: Choice, file: str) -> tuple[Summary, dict[str, Style]]:
    """The summary with the chosen scenes and samplers, in the chosen order and under the chosen labels; and how each sampler looks.

    Colours that are not given are those of the report, so that figure and page agree. Raises ReportError for a name that was not run.
    """
    known = {column.sampler: column for column in sampler_columns(summary)}
    for name in (*choice.samplers, *(name for name, _ in (*choice.labels, *choice.colors))):
        if name not in known:
            raise ReportError(f"{file}: sampler \"{name}\" is not in the results, expected one of {', '.join(known)}")
    scenes = {scene.name: scene for scene in summary.scenes}
    for name in choice.scenes:
        if name not in scenes:
            raise ReportError(f"{file}: scene \"{name}\" is not in the results, expected one of {', '.join(scenes)}")
    styles = assign_styles(known.values())
    styles.update({name: replace(styles[name], color=color) for name, color in choice.colors})
    labels, order = dict(choice.labels), choice.samplers or tuple(known)

    def cut(scene):
        results = {result.sampler: result for result in scene.samplers}
        return replace(scene, samplers=tuple(replace(results[name], label=labels.get(name, results[name].label)) for name in order if name in results))

    return replace(summary, scenes=tuple(cut(scenes[name]) for name in (choice.scenes or scenes))), styles
