"""A matplotlib figure as an SVG element inside a page: the same bytes each time, and ids of its own."""

import html
import io
import re

from markupsafe import Markup
from matplotlib.figure import Figure

# Text stays text (selectable, small, in the page's font). It is laid out in DejaVu Sans, which comes with
# matplotlib and is wider than the usual system fonts: what fits there fits in a browser.
SETTINGS = {
    "svg.fonttype": "none", "font.family": "DejaVu Sans", "font.size": 9.0, "mathtext.default": "regular",
    "axes.titlesize": 9.5, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.titlepad": 9.0,
    "axes.edgecolor": "#8a8a8a", "axes.linewidth": 0.7, "axes.labelcolor": "#1d1d1f",
    "axes.spines.top": False, "axes.spines.right": False, "axes.unicode_minus": True,
    "xtick.color": "#8a8a8a", "ytick.color": "#8a8a8a", "xtick.labelcolor": "#1d1d1f", "ytick.labelcolor": "#1d1d1f",
    "xtick.minor.size": 1.5, "ytick.minor.size": 1.5, "xtick.minor.width": 0.5, "ytick.minor.width": 0.5,
    "grid.color": "#e6e6e6", "grid.linewidth": 0.6, "legend.fontsize": 8.5, "legend.frameon": True,
    "legend.framealpha": 0.85, "legend.edgecolor": "none", "legend.handlelength": 2.8, "legend.borderpad": 0.3,
    "figure.facecolor": "none", "axes.facecolor": "none", "path.simplify": False,
}


def inline_svg(figure: Figure, key: str, label: str) -> Markup:
    """The figure as one <svg> element.

    key    unique in the page: prefixes every id and salts the hashes that matplotlib makes ids of
    label  what a reader who cannot see the figure is told
    Draw and call inside `drawing(key)`.
    """
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r"<style.*?</style>", "", text, flags=re.S)  # `*{...}`, which would reach the whole page
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    # The page's font, and no name of one that the reader may lack.
    text = re.sub(r"font: (\w+ )?([\d.]+px) [^;\"]*", _font, text)
    text = text.replace("xlink:href", "href")
    text = _with_prefixed_ids(text, key)
    box = re.search(r'viewBox="([^"]*)"', text)
    start = f'<svg class="plot" role="img" aria-label="{html.escape(label)}" viewBox="{box.group(1)}">'
    text = start + text[text.index(">") + 1:]
    return Markup(re.sub(r"\s*\n\s*", "\n", text))


def drawing(key: str) -> list:
    """The styles for matplotlib.style.context: its defaults, whatever the user's matplotlibrc says, and ours."""
    return ["default", {**SETTINGS, "svg.hashsalt": key}]


def _font(match: re.Match) -> str:
    weight = (match.group(1) or "").strip()
    return f"font-size: {match.group(2)}" + (f"; font-weight: {weight}" if weight else "")


def _with_prefixed_ids(text: str, key: str) -> str:
    used = set(re.findall(r'url\(#([^)]*)\)', text)) | set(re.findall(r'href="#([^"]*)"', text))
    text = re.sub(r' id="([^"]*)"', lambda m: f' id="{key}-{m.group(1)}"' if m.group(1) in used else "", text)
    text = re.sub(r"url\(#", f"url(#{key}-", text)
    return re.sub(r'href="#', f'href="#{key}-', text)
