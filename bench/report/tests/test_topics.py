"""The pages of one topic: the budget of a scene, and the lecture."""

import contextlib
import io
import json
import struct
import tempfile
import unittest
import zlib
from pathlib import Path

from report import budget, lecture


def _png(width: int, height: int) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"\0" * (width + 1) * height)) + chunk(b"IEND", b""))


def _estimate(value, lo=None, hi=None, **more):
    return {"value": value, "lo": lo, "hi": hi, **more}


BUDGET = {
    "scene": "a <room>", "purpose": "", "sampler": "sobol", "spp": 16, "replicates": 4, "dimensions": 9, "command": "./koksma bench budget", "version": "v",
    "machine": "m",
    "budget": {"independent": _estimate(4.0, 3.0, 5.0), "sequence": _estimate(1.0, 0.5, 1.5), "gain": _estimate(4.0, 3.0, 6.0), "divisions": [{
        "by": "role", "groups": [
            {"name": "film", "slots": 1, "only": _estimate(3.0, 2.0, 4.0, heavy_tailed=True), "all_but": _estimate(2.0, 1.0, 3.0, heavy_tailed=False),
             "removed": _estimate(0.25, 0.1, 0.4), "gain": _estimate(1.3, 1.1, 1.6), "added": _estimate(0.5, 0.4, 0.6), "loss": _estimate(2.0, 1.5, 2.5)},
            {"name": "time", "slots": 2, "only": _estimate(None, heavy_tailed=False), "all_but": _estimate(None, heavy_tailed=False),
             "removed": _estimate(None), "gain": _estimate(None), "added": _estimate(None), "loss": _estimate(None)}]}]},
}
LECTURE = {
    "command": "./koksma bench lecture", "version": "v", "machine": "m", "quick": False, "seed": 0, "seconds": 12.3, "cpu_seconds": 20.0, "held": 1, "refuted": 1,
    "topics": [{
        "name": "rays", "title": "More rays & less noise", "slide": "Four times the rays.", "command": "./koksma bench lecture rays", "seconds": 1.0,
        "tables": [{"title": "T", "columns": ["n", "RMSE"], "rows": [[4, _estimate(0.5, 0.4, 0.6)], ["none", None]]}],
        "charts": [{"title": "C", "x": "n", "y": "RMSE", "x_log": True, "y_log": True, "series": [
            {"label": "random", "x": [1.0, 4.0], "y": [_estimate(1.0, 0.9, 1.1), _estimate(-0.5, -0.6, 0.1)], "known": False},
            {"label": "1 / sqrt(n)", "x": [1.0, 4.0], "y": [_estimate(1.0), _estimate(0.5)], "known": True}]}],
        "pictures": [{"file": "pictures/a.png", "caption": "room: dark", "width": 8}, {"file": "pictures/a.png", "caption": "hall: dark", "width": 8}],
        "checks": [{"what": "true", "measured": _estimate(1.0, 0.9, 1.1), "expected": 1.0, "held": True},
                   {"what": "false", "measured": _estimate(1.0, 0.9, 1.1), "expected": 2.0, "held": False}],
        "notes": ["A note."]}],
}


class TopicPages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.dir = Path(folder.name)

    def page(self, module, numbers) -> str:
        (self.dir / "n.json").write_text(json.dumps(numbers), encoding="utf-8")
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(module.main([str(self.dir / "n.json"), str(self.dir / "n.html")]), 0)
        return (self.dir / "n.html").read_text(encoding="utf-8")

    def fails(self, module, numbers, code: int, word: str):
        (self.dir / "n.json").write_text(numbers, encoding="utf-8")
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(module.main([str(self.dir / "n.json"), str(self.dir / "n.html")]), code)
        self.assertIn(word, errors.getvalue())
        self.assertEqual(errors.getvalue().count("\n"), 1)

    def test_budget(self):
        page = self.page(budget, BUDGET)
        self.assertIn("a &lt;room&gt;", page)
        self.assertIn("25.0 [10.0, 40.0]", page)
        self.assertIn("(tails)", page)
        self.assertEqual(page.count("<svg"), 1)
        self.assertNotIn("http", page.replace("http-equiv", ""))

    def test_lecture(self):
        (self.dir / "pictures").mkdir()
        (self.dir / "pictures/a.png").write_bytes(_png(8, 8))
        page = self.page(lecture, LECTURE)
        self.assertIn("More rays &amp; less noise", page)
        self.assertIn("0.500 [0.400, 0.600]", page)
        self.assertEqual(page.count("data:image/png;base64,"), 2)
        self.assertEqual(page.count('<div class="crops">'), 2, "pictures of two subjects")
        self.assertIn("<details open>", page, "what is refuted is not folded away")
        self.assertIn("refuted</b>", page)
        self.assertNotIn("http", page.replace("http-equiv", ""))
        self.assertEqual(page, self.page(lecture, LECTURE))

    def test_what_is_wrong_is_said_in_one_line(self):
        self.fails(budget, "{", 1, "budget:")
        self.fails(budget, "{}", 1, "of this version of the program")
        outside = json.loads(json.dumps(LECTURE))
        outside["topics"][0]["pictures"][0]["file"] = "../a.png"
        self.fails(lecture, json.dumps(outside), 1, "inside the results directory")
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(lecture.main([]), 2)


if __name__ == "__main__":
    unittest.main()
