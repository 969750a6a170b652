"""The lecture: koksma bench lecture, estimate, adaptive, and the page that points to them."""

import json
import pathlib
import re
import unittest

from harness import ProgramTest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Lecture(ProgramTest):
    def test_a_topic_is_measured_and_its_closed_forms_hold(self):
        out = self.succeeds("bench", "lecture", "antialiasing", "bounces", "--quick", "--no-report", "-o", "l").out
        numbers = json.loads(self.read("l/lecture.json"))
        self.assertEqual([t["name"] for t in numbers["topics"]], ["bounces", "antialiasing"])
        self.assertEqual((numbers["refuted"], numbers["held"]), (0, 12))
        self.assertIn("12 closed forms held, 0 refuted", out)
        for topic in numbers["topics"]:
            for picture in topic["pictures"]:
                self.assertEqual(self.read("l/" + picture["file"])[:4], b"\x89PNG")

    def test_the_same_numbers_for_any_number_of_threads(self):
        files = []
        for threads in ("1", "2"):
            self.succeeds("bench", "lecture", "bounces", "--quick", "--no-report", "-o", "t" + threads, "-t", threads)
            topic, = json.loads(self.read(f"t{threads}/lecture.json"))["topics"]
            del topic["seconds"]
            files.append(topic)
        self.assertEqual(*files)

    def test_unknown_topics(self):
        self.refuses(2, ["bench", "lecture", "bogus"], "unknown topic 'bogus'", "branching")


class Estimate(ProgramTest):
    def test_layers_add_up_and_the_ledger_is_told(self):
        out = self.succeeds("estimate", "scene.xml", "-o", "a.exr", "--light", "light", "--end", "constant=0.5", "--rr-depth", "1", "--stats", "a.json").out
        ledger = json.loads(self.read("a.json"))["ledger"]
        self.assertEqual(ledger["samples"], 16 * 16 * 4)
        self.assertEqual(ledger["roulette"]["largest_boost"], 2)
        self.assertGreater(ledger["roulette"]["lost"], 0)
        self.assertIn("roulette  ", out)
        again = self.succeeds("estimate", "scene.xml", "-o", "b.exr", "--light", "light", "--end", "constant=0.5", "--rr-depth", "1", "-t", "1", "-q")
        self.assertEqual(again.out, "")
        self.assertEqual(self.read("a.exr"), self.read("b.exr"))
        for layer in (b"Le.R", b"Ldirect.G", b"Lindirect.B", b"scattered0.R"):
            self.assertIn(layer, self.read("a.exr"))

    def test_it_is_the_production_render_up_to_rounding(self):
        self.succeeds("estimate", "scene.xml", "-o", "a.exr", "-q")
        self.succeeds("render", "scene.xml", "-o", "b.exr", "-q")
        self.assertLess(self.succeeds("compare", "a.exr", "b.exr", "--json").json()["rmse"], 1e-5)

    def test_refusals(self):
        for arguments, *parts in ((["--light", "nee"], "technique 'nee'", "mis, light, bsdf"), (["--end", "depth"], "expected a value"),
                                  (["--directions", "x"], "bsdf, uniform"), (["--roulette-number", "x"], "own, rescaled")):
            self.refuses(2, ["estimate", "scene.xml", "-o", "a.exr", *arguments], *parts)
        self.refuses(2, ["estimate", "scene.xml", "-o", "a.exr", "--branching", "2", "-s", "stratified"], "needs a sequence")
        self.refuses(1, ["estimate", "scene.xml", "-o", "a.exr", "--end", "none", "--max-depth", "-1"], "never end")


class Adaptive(ProgramTest):
    def test_counts_are_within_the_budget(self):
        out = self.succeeds("adaptive", "scene.xml", "-o", "a.exr", "-n", "32").out
        spent = float(out.split()[0])
        self.assertLessEqual(spent, 32)
        self.assertGreater(spent, 30)
        self.assertIn(b"samples", self.read("a.exr"))
        self.succeeds("adaptive", "scene.xml", "-o", "b.exr", "-n", "32", "-t", "1", "-q")
        self.assertEqual(self.read("a.exr"), self.read("b.exr"))

    def test_refusals(self):
        self.refuses(2, ["adaptive", "scene.xml", "-o", "a.exr", "--mode", "x"], "two-stage or one-stage")
        self.refuses(1, ["adaptive", "scene.xml", "-o", "a.exr", "-n", "64", "-s", "stratified"], "needs a sequence")
        self.refuses(1, ["adaptive", "scene.xml", "-o", "a.exr", "-n", "16"], "leaves 0")


class Page(ProgramTest):
    def test_source_lines_are_where_the_page_says(self):
        page = (ROOT / "docs/lecture.md").read_text(encoding="utf-8")
        links = re.findall(r"\[`([^`]*)`\]\(\.\./([^)#]*)#L(\d+)\)", page)
        self.assertGreater(len(links), 10)
        for code, file, line in links:
            self.assertIn(code, (ROOT / file).read_text(encoding="utf-8").splitlines()[int(line) - 1], f"{file}:{line}")

    def test_every_topic_is_on_the_page(self):
        page = (ROOT / "docs/lecture.md").read_text(encoding="utf-8")
        known = self.koksma("bench", "lecture", "bogus").err.split("topics: ")[1].split(", ")
        self.assertEqual(len(known), 12)
        for topic in known:
            self.assertIn(f"`koksma bench lecture {topic.strip()}`", page)


if __name__ == "__main__":
    unittest.main()
