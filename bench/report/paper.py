"""For a paper: figures as SVG and PDF, numbers as CSV, tables as LaTeX, crops as OpenEXR."""

import shutil
from pathlib import Path

from matplotlib import style

from .choice import Choice
from .export import gains_tex, points_csv, times_tex
from .model import Summary
from .overview import overview_figure_of
from .palette import Style
from .panels import AXES, error_panels
from .svg import drawing

_MM = 1 / 25.4
# No date, no name of a program: the same figures give the same bytes, and nothing tells who drew them.
_METADATA = {"svg": {"Date": None, "Creator": None}, "pdf": {"CreationDate": None, "Creator": None, "Producer": None}}


def write_paper(summary: Summary, styles: dict[str, Style], choice: Choice, folder: Path) -> list[Path]:
    """Writes everything into the folder, which is made, and returns the files.

    SCENE-samples, SCENE-seconds  one column wide
    rates, gains                  all scenes, two columns wide
    points.csv, gains.tex, times.tex; crops/*.exr
    Raises OSError.
    """
    folder.mkdir(parents=True, exist_ok=True)
    written: list[Path] = []
    width = choice.column_width * _MM

    def save(name: str, draw) -> None:
        small = {"font.size": choice.font_size, "legend.fontsize": choice.font_size, "axes.titlesize": choice.font_size + 0.5,
                 "svg.fonttype": "path", "pdf.fonttype": 42}
        with style.context([*drawing(name), small]):
            figure = draw()
            for ending in choice.formats:
                written.append(folder / f"{name}.{ending}")
                figure.savefig(written[-1], metadata=_METADATA[ending])

    for scene in summary.scenes:
        for against in AXES:
            save(f"{scene.name}-{against}", lambda: error_panels([scene], styles, against, width, 1))
    save("rates", lambda: error_panels(summary.scenes, styles, "samples", 2 * width, min(3, len(summary.scenes))))
    save("gains", lambda: overview_figure_of(summary, styles, 2 * width, choice.font_size, with_key=True))
    for name, text in (("points.csv", points_csv(summary)), ("gains.tex", gains_tex(summary)), ("times.tex", times_tex(summary))):
        written.append(folder / name)
        written[-1].write_text(text, encoding="utf-8", newline="\n")
    crops = [path for scene in summary.scenes for path in (scene.reference_exr, *(s.crop_exr for s in scene.samplers)) if path]
    (folder / "crops").mkdir(exist_ok=True)
    for crop in crops:
        written.append(folder / "crops" / crop.name)
        shutil.copyfile(crop, written[-1])
    return written
