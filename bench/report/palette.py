"""How each sampler looks: colour, marker and line, the same in every figure and table of a report."""

from collections.abc import Iterable
from dataclasses import dataclass

from markupsafe import Markup

from .model import SamplerResult

BASELINE_COLOR = "#4d4d4d"
# Okabe & Ito 2008, "Color Universal Design", without black (kept for text) and yellow (too light for
# lines on white). In the order of contrast between neighbours, not the authors'.
COLORS = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9")
# matplotlib's marker, and its outline in a box of [-5, 5]^2 with y downwards for the key in the text.
MARKERS = {
    "o": "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z",
    "s": "M-3.6-3.6h7.2v7.2h-7.2z",
    "D": "M0-5L5 0L0 5L-5 0z",
    "^": "M0-4.4L4.6 4h-9.2z",
    "v": "M0 4.4L4.6-4h-9.2z",
    "P": "M-1.6-4.6h3.2v3h3v3.2h-3v3h-3.2v-3h-3v-3.2h3z",
    "X": "M-4.4-2.4l2-2L0-2l2.4-2.4l2 2L2 0l2.4 2.4l-2 2L0 2l-2.4 2.4l-2-2L-2 0z",
}
# On, off lengths in line widths. Seven lines, seven markers, six colours: 42 samplers before one repeats.
DASHES = ((), (5, 1.5), (1.2, 1.2), (6, 1.5, 1.2, 1.5), (3, 1), (8, 2), (4, 1, 1, 1, 1, 1))


@dataclass(frozen=True)
class Style:
    """The look of one sampler; marker is a key of MARKERS, dashes an element of DASHES."""

    color: str
    marker: str
    dashes: tuple[float, ...]


def assign_styles(samplers: Iterable[SamplerResult]) -> dict[str, Style]:
    """A style for each sampler by name, in the order of first appearance; random is grey and round."""
    styles: dict[str, Style] = {}
    markers = tuple(MARKERS)
    taken = 0
    for sampler in samplers:
        if sampler.sampler in styles:
            continue
        if sampler.is_baseline:
            styles[sampler.sampler] = Style(BASELINE_COLOR, markers[0], DASHES[2])
            continue
        # Sobol' last in a file is common; solid lines go to whoever comes, round markers to random alone.
        styles[sampler.sampler] = Style(COLORS[taken % len(COLORS)], markers[1 + taken % (len(markers) - 1)],
                                        DASHES[(0, 1, 3, 4, 5, 6, 2)[taken % 7]])
        taken += 1
    return styles


def swatch(style: Style) -> Markup:
    """A sampler's line and marker as a small inline SVG, for keys in text and tables."""
    dashes = " ".join(f"{1.8 * length:g}" for length in style.dashes)
    dash = f' stroke-dasharray="{dashes}"' if dashes else ""
    return Markup(
        '<svg class="swatch" viewBox="-15 -6 30 12" aria-hidden="true">'
        f'<path d="M-15 0H15" stroke="{style.color}" stroke-width="1.8"{dash}/>'
        f'<path d="{MARKERS[style.marker]}" fill="{style.color}" stroke="#fff" stroke-width=".8"/></svg>')
