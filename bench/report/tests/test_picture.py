"""The pictures of the samplers' pages: well-formed, the same each time, and one for every page."""

import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from report.picture import PAIRS, picture

DOCS = Path(__file__).parents[3] / "docs" / "samplers"


def card() -> dict:
    """A card of four points and a flat spectrum."""
    projections = [{"a": a, "b": b, "x": [0.1, 0.35, 0.6, 0.85], "y": [0.6, 0.1, 0.85, 0.35]} for a, b in PAIRS]
    return {"name": "a<b", "pictures": {"n": 4, "projections": projections},
            "spectrum": {"largest": 2, "power": [1.0] * 25, "replicates": 16}}


class Pictures(unittest.TestCase):
    def test_a_panel_a_pair_and_one_for_the_spectrum(self):
        text = picture(card())
        root = ElementTree.fromstring(text)
        self.assertEqual(len(root.findall(".//{*}g")), 5)
        self.assertEqual(text.count("h0"), 4 * len(PAIRS))
        self.assertEqual(text, picture(card()))

    def test_every_page_has_its_picture(self):
        pages = sorted(page.stem for page in DOCS.glob("*.md") if page.stem != "README")
        self.assertEqual(pages, sorted(figure.stem for figure in (DOCS / "figures").glob("*.svg")))
        for page in pages:
            self.assertIn(f"(figures/{page}.svg)", (DOCS / f"{page}.md").read_text(encoding="utf-8"), page)
            ElementTree.parse(DOCS / "figures" / f"{page}.svg")
        self.assertLess(sum(figure.stat().st_size for figure in (DOCS / "figures").iterdir()), 1_500_000)


if __name__ == "__main__":
    unittest.main()
