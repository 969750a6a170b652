"""What a reader of report.html, and a caller of `python3 -m report`, can rely on."""

import contextlib
import copy
import io
import os
import re
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

from report.__main__ import main
from report.tests import synthetic

BENCH = Path(__file__).resolve().parents[2]
VOID = {"meta", "img", "br", "input"}


class Page(HTMLParser):
    """Ids, links, sources and text of a page; `unbalanced` names the first tag that does not match."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.sources: list[str] = []
        self.text = ""
        self.unbalanced: str | None = None
        self._open: list[str] = []
        self.feed(text)
        self.unbalanced = self.unbalanced or (self._open[-1] if self._open else None)

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self._open.append(tag)
        for name, value in attributes:
            {"id": self.ids, "href": self.links, "src": self.sources}.get(name, []).append(value)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.handle_endtag(tag)

    def handle_endtag(self, tag):
        if tag not in VOID and (not self._open or self._open.pop() != tag):
            self.unbalanced = self.unbalanced or tag

    def handle_data(self, data):
        if not self._open or self._open[-1] not in ("style", "script"):
            self.text += data


class ReportTest(unittest.TestCase):
    def setUp(self) -> None:
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = Path(scratch.name) / "results"
        self.summary = synthetic.make_summary(("smooth", "cornell"))
        self.scene = self.summary["scenes"][0]

    def run_main(self) -> tuple[int, str]:
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            status = main([str(self.directory)])
        return status, errors.getvalue()

    def page(self) -> str:
        """The report of self.summary."""
        synthetic.write(self.directory, self.summary)
        self.assertEqual(self.run_main(), (0, ""))
        return (self.directory / "report.html").read_text(encoding="utf-8")

    def assert_refused(self, *parts: str) -> None:
        """The report fails with one line that holds the parts, and leaves nothing behind."""
        status, errors = self.run_main()
        self.assertEqual(status, 1)
        self.assertEqual(errors.count("\n"), 1, errors)
        for part in parts:
            self.assertIn(part, errors)
        left = [p.name for p in self.directory.iterdir() if "report" in p.name] if self.directory.is_dir() else []
        self.assertEqual(left, [])

    def refuse_summary(self, *parts: str) -> None:
        synthetic.write(self.directory, self.summary)
        self.assert_refused("summary.json", *parts)


class WhatThePageShows(ReportTest):
    def test_all_scenes_and_samplers_appear(self):
        page = Page(self.page())
        for scene in self.summary["scenes"]:
            for text in (scene["name"], scene["purpose"], scene["expect"]):
                self.assertIn(text, page.text)
            for sampler in scene["samplers"]:
                self.assertIn(sampler["label"], page.text)
                self.assertIn(sampler["sampler"], page.text)
        self.assertIn("./koksma bench", page.text)
        self.assertIn("abc1234", page.text)

    def test_layouts_and_counts_are_shown_where_an_experiment_has_them(self):
        plain = self.page()
        for words in ("Luck of dimensions", "Any number of samples"):
            self.assertNotIn(words, plain)
        for k, sampler in enumerate(self.scene["samplers"]):
            spread = {"value": 0.1 * k, "lo": 0.05 * k, "hi": 0.2 * k + 0.01}
            sampler["layouts"] = [{"spp": 16, "permuted": 3, "rmse": 0.02, "lowest": 0.018, "highest": 0.023, "spread": spread, "p_equal": 0.5,
                                   "plan_over_permuted": {"value": 0.876, "lo": 0.8, "hi": 0.95},
                                   "each": [{"rmse": 0.02 + 0.001 * i, "lo": 0.019, "hi": 0.025} for i in range(4)]}]
            if k > 0:
                sampler["any_count"] = [{"spp": spp, "own": spp == 8, "mse_ratio": 2.0 + spp, "lo": 1.5, "hi": 3.0 + spp,
                                         "how": "interpolated" if spp == 8 else "measured"} for spp in (5, 8, 11)]
        page = Page(self.page())
        self.assertIsNone(page.unbalanced)
        self.assertEqual(len(page.ids), len(set(page.ids)), "an id occurs twice")
        text = " ".join(page.text.split())
        for words in ("Luck of dimensions", "0.876", "not distinguishable", "Any number of samples", "own interpolated"):
            self.assertIn(words, text)
        self.scene["samplers"][1]["any_count"][0]["how"] = "guessed"
        (self.directory / "report.html").unlink()
        self.refuse_summary('"guessed"', '"interpolated"')

    def test_the_cost_of_effects_is_shown_where_an_experiment_has_it(self):
        self.assertNotIn("Effects that nothing calls for", self.page())
        line = {"sampler": "random", "spp": 16, "ns_per_path_needed": 812.0, "ns_per_path": 977.0, "time_ratio": {"value": 1.203, "lo": 1.18, "hi": 1.22},
                "mse_ratio": {"value": 1.017, "lo": 0.97, "hi": 1.06}, "distinguishable": False}
        self.scene["cost_of_effects"] = {"needed": ["diffuse"], "forced": ["diffuse", "lens"], "dimensions_needed": 27, "dimensions": 29,
                                         "kernel_needed": "batch/diffuse", "kernel": "batch/all", "lines": [line]}
        page = Page(self.page())
        self.assertIsNone(page.unbalanced)
        text = " ".join(page.text.split())
        for words in ("Effects that nothing calls for", "27 dimensions a path with batch/diffuse; 29 with batch/all", "besides: lens", "1.203", "1.017", "not distinguishable"):
            self.assertIn(words, text)

    def test_the_page_stands_alone_and_is_well_formed(self):
        self.add_pictures()
        text = self.page()
        page = Page(text)
        self.assertIsNone(page.unbalanced)
        self.assertEqual(len(page.ids), len(set(page.ids)), "an id occurs twice")
        self.assertEqual([s[:40] for s in page.sources if not s.startswith("data:image/png;base64,")], [])
        for link in page.links:
            self.assertTrue(link[0] == "#" and link[1:] in page.ids, link)
        for outside in ("http:", "https:", "//cdn", "@import", "url(h"):
            self.assertNotIn(outside, text)

    def test_pictures_are_embedded_enlarged_and_captioned(self):
        self.add_pictures()
        text = self.page()
        self.assertEqual(text.count("data:image/png;base64,"), 2 + 4)
        self.assertIn('width="192" height="144" alt="smooth, Reference"', text)  # 64 x 48, times 3
        self.assertIn("Random, 16 spp", text)
        self.assertIn("<i style=\"left:", text)

    def test_two_runs_give_the_same_bytes(self):
        synthetic.write(self.directory, self.summary)
        pages = []
        for seed in ("1", "2"):
            result = self.run_module(str(self.directory), PYTHONHASHSEED=seed)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            pages.append((self.directory / "report.html").read_bytes())
        self.assertEqual(pages[0], pages[1])

    def test_a_gain_whose_interval_includes_1_is_not_distinguishable(self):
        self.summary = synthetic.make_summary(("caustic",))
        for sampler in self.summary["scenes"][0]["samplers"][1:]:
            sampler["gain_vs_random"] = {"spp": 256, "mse_ratio": 1.02, "lo": 0.9, "hi": 1.15}
        page = Page(self.page())
        self.assertEqual(page.text.count("not distinguishable"), 3 + 1)
        self.assertIn("3 not distinguishable", page.text)

    def test_the_best_sampler_is_marked_and_overlapping_ones_share_the_mark(self):
        gains = [sampler["gain_vs_random"] for sampler in self.scene["samplers"][1:]]
        self.summary["scenes"] = [self.scene]
        for sampler in self.scene["samplers"]:
            sampler["time_to"] = []
        for gain, lo in zip(gains, (2.0, 4.0, 8.0)):
            gain.update(mse_ratio=lo * 1.1, lo=lo, hi=lo * 1.2)
        self.assertEqual(self.page().count('<span class="tag">best</span>'), 1 + 1)  # and once in the caption
        gains[1]["hi"] = 8.1
        text = self.page()
        self.assertEqual(text.count('<span class="tag joint">joint best</span>'), 2 + 1)
        self.assertEqual(text.count('<span class="tag">best</span>'), 1)

    def test_a_sampler_worse_than_random_is_called_so(self):
        self.scene["samplers"][1]["gain_vs_random"].update(mse_ratio=0.8, lo=0.7, hi=0.9)
        self.assertIn("worse than random", self.page())

    def test_points_without_an_rmse_are_left_out_and_named(self):
        self.scene["samplers"][3]["points"][-1].update(
            dict.fromkeys(("rmse", "rmse_lo", "rmse_hi", "relmse", "relmse_lo", "relmse_hi")))
        page = Page(self.page())
        self.assertIn("Sobol' (Owen): no RMSE at 256 spp", page.text)
        self.assertIn("below the reference\u2019s noise", page.text)

    def test_points_below_the_floor_are_marked(self):
        self.scene["samplers"][2]["points"][-1]["below_floor"] = True
        page = Page(self.page())
        self.assertIn("Halton (Owen): hollow markers, at 256 spp", page.text)
        self.assertIn("\u2020", page.text)

    def test_a_sampler_without_randomisation_has_no_bars_and_the_page_says_why(self):
        fixed = copy.deepcopy(self.scene["samplers"][3])
        fixed.update(sampler="sobol:randomize=none", label="Sobol' (none)", randomized=False, slope=None)
        for point in fixed["points"]:
            point.update({"replicates": 1, "rmse_lo": None, "rmse_hi": None, "relmse_lo": None, "relmse_hi": None,
                          "sampler_share": None})
        for holder in (fixed["gain_vs_random"], *fixed["time_to"]):
            holder.update(lo=None, hi=None)
        self.scene["samplers"].append(fixed)
        page = Page(self.page())
        self.assertIn("Sobol' (none): a fixed point set, not randomised", page.text)
        self.assertIn("no interval, not ranked", page.text)
        self.assertIn("not run", page.text)  # the other scene

    def test_a_scene_of_nulls_still_makes_a_page(self):
        for sampler in self.scene["samplers"]:
            sampler.update(slope=None, gain_vs_random=None, time_to=[])
            for point in sampler["points"]:
                point.update(dict.fromkeys(("rmse", "rmse_lo", "rmse_hi", "relmse", "relmse_lo", "relmse_hi")))
        self.scene["samplers"][1]["points"] = []
        self.scene["reference"].update(se_rmse=None, halves_z=None, file=None)
        page = Page(self.page())
        self.assertIsNone(page.unbalanced)
        self.assertIn("no point to draw", page.text)

    def test_extreme_values_still_make_a_page(self):
        points = self.scene["samplers"][0]["points"]
        points[0].update(rmse=1e12, rmse_lo=-3.0, rmse_hi=1e15, cpu_seconds=0)
        points[1].update(rmse=1e-30, rmse_lo=0, rmse_hi=None)
        points[2].update(rmse=0)
        self.scene["samplers"][1]["gain_vs_random"].update(mse_ratio=1e9, lo=None, hi=None)
        self.assertIsNone(Page(self.page()).unbalanced)

    def test_many_samplers_all_look_different(self):
        from report.palette import assign_styles
        from report.load import load_summary
        specs = [(f"s{i}", f"S{i}", 1.0, 0.1) for i in range(42)]
        synthetic.write(self.directory, synthetic.make_summary(("smooth",), specs))
        styles = assign_styles(load_summary(self.directory).scenes[0].samplers)
        self.assertEqual(len(set(styles.values())), 42)

    def test_text_from_the_summary_cannot_become_markup(self):
        self.summary["experiment"]["note"] = "<script>alert(1)</script>"
        self.scene["samplers"][1]["label"] = "a <b> & $x$ \"c\""
        text = self.page()
        self.assertNotIn("<script>alert", text)
        self.assertIsNone(Page(text).unbalanced)
        self.assertIn("a <b> & $x$ \"c\"", Page(text).text)

    def test_invalid_samples_are_reported(self):
        self.summary["invalid_samples"] = 3
        self.assertIn("3 invalid samples", Page(self.page()).text)

    def test_predictions_are_shown_with_verdict_and_figure(self):
        self.assertNotIn("Predicted beforehand", self.page())
        found = [{"what": "Random", "value": -0.499, "lo": -0.51, "hi": -0.49, "verdict": "held"}]
        self.scene.update(predictions=[{"says": "slope of Random between -0.55 and -0.45", "of": "slope", "verdict": "held", "found": found},
                                       {"says": "MSE gain over random of Stratified at 256 spp at least 9", "of": "gain", "verdict": "refuted",
                                        "found": [{"what": "Stratified", "value": 4.0, "lo": 3.5, "hi": 4.5, "verdict": "refuted"}]},
                                       {"says": "MSE at 1024 spp: Halton below Random", "of": "order", "verdict": "not tested",
                                        "found": [{"what": "Random / Halton", "value": None, "lo": None, "hi": None, "verdict": "not tested"}]}],
                          predictions_verdict="refuted")
        page = Page(self.page())
        text = " ".join(page.text.split())
        self.assertIn("Of the 3 claims that the experiment made beforehand 1 held, 1 was refuted, 1 not tested.", text)
        for words in ("slope of Random between \u22120.55", "\u22120.499 [\u22120.510, \u22120.490]", "\u00d74.00 [3.50, 4.50]", "not rendered", "1 of 3 claims held"):
            self.assertIn(words, text)
        self.scene["predictions"][0]["verdict"] = "guessed"
        (self.directory / "report.html").unlink()
        self.refuse_summary('"guessed"', '"held", "refuted", "undecided", "not tested"')

    def test_winner_margin_and_overtaking_follow_from_the_pairs(self):
        def pair(a, b, ratio, better):
            ns = {"ns_a": 100.0, "ns_b": 120.0}
            return {"a": a, "b": b, "spp": 256, "mse_ratio": {"value": ratio, "lo": ratio * 0.9, "hi": ratio * 1.1}, "p": 0.001, "p_holm": 0.002, "better": better,
                    "b_overtakes_below_ns_per_path": {"value": 100 / ratio, "lo": 90 / ratio, "hi": 110 / ratio, **ns},
                    "a_overtakes_below_ns_per_path": {"value": 120 * ratio, "lo": 100 * ratio, "hi": 130 * ratio, **ns}}
        names = [sampler["sampler"] for sampler in self.scene["samplers"]]
        self.scene["pairs"] = [pair(names[0], names[1], 0.25, names[1]), pair(names[0], names[2], 0.125, names[2]), pair(names[1], names[2], 0.5, names[2])]
        text = " ".join(Page(self.page()).text.split())
        self.assertIn("Halton (Owen) \u00d72.00 [1.82, 2.22] Stratified", text)  # the inverse of [0.45, 0.55]
        self.assertIn("is ahead", text)
        self.scene["pairs"][2]["better"] = None
        text = " ".join(Page(self.page()).text.split())
        self.assertRegex(text, r"Stratified,\s*Halton \(Owen\)\s*not distinguishable from each other")

    def test_equal_time_progressive_renders_and_earlier_commits_are_shown(self):
        plain = self.page()
        for words in ("At equal time", "Progressive renders", "Earlier rows"):
            self.assertNotIn(words, plain)
        for sampler in self.scene["samplers"]:
            slope = {"value": -0.7, "lo": -0.75, "hi": -0.65, "spp_from": 4, "spp_to": 256}
            sampler["progressive"] = {"planned_spp": 256, "renders": 4, "slope": slope, "points": [{"spp": p["spp"], "rmse": p["rmse"] * 1.1, "lo": p["rmse"], "hi": None} for p in sampler["points"]]}
        self.scene["samplers"][1]["equal_time_vs_random"] = {"seconds": 1.5, "mse_ratio": 3.21, "lo": 3.0, "hi": 3.4, "how": "interpolated"}
        self.summary["other_commits"] = [{"commit": "0ld", "rows": 12}]
        text = " ".join(Page(self.page()).text.split())
        for words in ("At equal time", "\u00d73.21 [3.00, 3.40]", "no time in common", "4 to 256 spp", "\u22120.700 [\u22120.750, \u22120.650]", "12 of 80 rows were rendered by commit 0ld"):
            self.assertIn(words, text)

    def test_intervals_of_heavy_tailed_errors_say_what_they_cover(self):
        self.assertNotIn('class="tails"', self.page())
        sampler = self.scene["samplers"][2]
        sampler["interval_coverage"] = {"replicates": 4, "rmse": 0.937, "slope": 0.914, "gain": 0.87}
        self.scene["predictions"] = [{"says": "slope", "of": "slope", "verdict": "held", "found": [
            {"what": sampler["label"], "value": -0.5, "lo": -0.6, "hi": -0.4, "verdict": "held"}]}]
        self.scene["predictions_verdict"] = "held"
        text = " ".join(Page(self.page()).text.split())
        for of, beside in (("slope", "\u2021 91.4 %"), ("gain", "\u2021 87.0 %")):
            self.assertIn(beside, text, of)
        self.assertIn("\u22120.500 [\u22120.600, \u22120.400]\u2021 91.4 %", text)  # of a prediction
        self.assertNotIn("\u2021 93.7 %", text)  # that of an RMSE covers
        self.assertIn("with 4 replicates at least 93.7 % (RMSE, relMSE), 91.4 % (slope), 87.0 % (gain)", text)

    def test_a_gain_over_a_heavy_tailed_baseline_says_what_it_covers_at_every_sampler(self):
        self.scene["samplers"][0]["interval_coverage"] = {"replicates": 16, "rmse": 0.95, "slope": 0.942, "gain": 0.926}
        text = " ".join(Page(self.page()).text.split())
        self.assertGreaterEqual(text.count("\u2021 92.6 %"), len(self.scene["samplers"]) - 1)
        self.assertNotIn("\u2021 94.2 %", text)

    def test_many_samplers_stand_one_below_the_other(self):
        specs = [(f"s{i}", f"Sampler {i}", 1.0, 0.1) for i in range(12)]
        self.summary = synthetic.make_summary(("smooth", "cornell"), specs)
        page = Page(self.page())
        self.assertIsNone(page.unbalanced)
        self.assertIn("<th scope=\"row\">", self.page())
        self.assertEqual(len(page.ids), len(set(page.ids)))

    def test_of_many_samplers_a_table_has_four_scenes_at_most_and_all_are_shown(self):
        names = tuple(synthetic.SCENES)
        self.summary = synthetic.make_summary(names, [(f"s{i}", f"Sampler {i}", 1.0, 0.1) for i in range(12)])
        page = self.page()
        heads = re.findall(r'<thead><tr><th scope="col">Sampler</th>\s*((?:<th scope="col"><a href="#scene\d+">.*?</th>\s*)+)</tr></thead>', page)
        shown = [re.findall(r'#scene(\d+)"', head) for head in heads]
        self.assertEqual(len(names), 6)
        self.assertIn([["1", "2", "3", "4"], ["5", "6"]], [shown[i:i + 2] for i in range(len(shown))])
        self.assertIsNone(Page(page).unbalanced)

    def test_raw_rows_are_linked_when_they_are_there(self):
        self.assertNotIn('href="results.jsonl"', self.page())
        (self.directory / "results.jsonl").write_text("{}\n")
        self.assertIn('href="results.jsonl"', self.page())

    def add_pictures(self) -> None:
        (self.directory / "pictures").mkdir(parents=True)
        for name, size in (("scene", (256, 256)), ("crop", (64, 48))):
            data = synthetic.png(*size, lambda x, y: (x % 256, y % 256, 128))
            (self.directory / "pictures" / f"{name}.png").write_bytes(data)
        self.scene.update(picture="pictures/scene.png", reference_crop="pictures/crop.png")
        for sampler in self.scene["samplers"]:
            sampler.update(crop="pictures/crop.png", crop_spp=16)

    def run_module(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, "-m", "report", *arguments], cwd=BENCH, text=True, capture_output=True,
                              env={**os.environ, **environment}, check=False)


class WhatIsRefused(ReportTest):
    run_module = WhatThePageShows.run_module

    def test_a_missing_directory(self):
        self.assert_refused("summary.json: not found", "koksma bench")

    def test_a_missing_summary(self):
        self.directory.mkdir()
        self.assert_refused("summary.json: not found")

    def test_text_that_is_not_json(self):
        for text, part in (('{"schema": 1,\n oops', ":2:2: "), ("", ":1:1: "), ('{"schema": NaN}', "found NaN"),
                           ("[]", "found an array of 0, expected an object"), ("\xff", "expected JSON")):
            with self.subTest(text):
                self.directory.mkdir(exist_ok=True)
                (self.directory / "summary.json").write_text(text, encoding="latin-1")
                self.assert_refused("summary.json", part)

    def test_another_schema(self):
        self.summary["schema"] = 2
        self.refuse_summary("schema: found 2, expected 1")

    def test_a_missing_key_is_named_with_its_place(self):
        del self.scene["samplers"][1]["points"][2]["relmse_hi"]
        self.refuse_summary("scenes[0].samplers[1].points[2].relmse_hi: missing")

    def test_values_of_the_wrong_kind(self):
        point = self.scene["samplers"][0]["points"][0]
        for holder, key, value, part in (
                (point, "spp", "4", 'points[0].spp: found "4", expected an integer, 1 or more'),
                (point, "spp", True, "found true"),
                (point, "rmse", -1, "found -1, expected a number, 0 or more"),
                (point, "cpu_seconds", None, "found null"),
                (point, "cpu_seconds", 10**400, "expected a number, 0 or more"),
                (point, "below_floor", 0, "found 0, expected true or false"),
                (self.scene, "film", [512], "film: found an array of 1, expected 2 integers, [width, height]"),
                (self.scene, "name", "", "expected a non-empty string"),
                (self.scene, "samplers", [], "expected at least one sampler"),
                (self.scene["samplers"][0]["time_to"][0], "how", "guessed", '"measured", "interpolated", "not reached"'),
                (self.summary["experiment"], "confidence", 95, "expected a number in (0, 1)"),
                (self.summary, "scenes", {}, "scenes: found an object, expected an array"),
                (self.summary, "scenes", [], "expected at least one scene")):
            with self.subTest(part):
                before = holder[key]
                holder[key] = value
                self.refuse_summary(part)
                holder[key] = before

    def test_intervals_the_wrong_way_round(self):
        self.scene["samplers"][1]["slope"].update(lo=-0.5, hi=-0.9)
        self.refuse_summary("slope.lo: found -0.5, expected lo not above hi (-0.9)")

    def test_repeated_names_and_spp(self):
        self.summary["scenes"][1]["name"] = "smooth"
        self.refuse_summary("found smooth twice")
        self.summary["scenes"][1]["name"] = "cornell"
        self.scene["samplers"][0]["points"][1]["spp"] = 1
        self.refuse_summary("scenes[0].samplers[0].points: found 1 twice")

    def test_pictures_that_are_missing_not_png_or_elsewhere(self):
        self.scene["picture"] = "pictures/none.png"
        self.refuse_summary("none.png: No such file", "scenes[0].picture")
        self.directory.joinpath("text.png").write_text("not a picture at all, only text")
        self.scene["picture"] = "text.png"
        self.refuse_summary("text.png: found no PNG header")
        self.scene["picture"] = "../outside.png"
        self.refuse_summary("a path inside the results directory")

    def test_a_failure_keeps_the_old_report(self):
        before = self.page()
        (self.directory / "summary.json").write_text("{")
        self.assertEqual(self.run_main()[0], 1)
        self.assertEqual((self.directory / "report.html").read_text(encoding="utf-8"), before)

    def test_wrong_usage_exits_with_2_and_help_with_0(self):
        for arguments, status in (((), 2), (("a", "b"), 2), (("--nonsense",), 2), (("--help",), 0)):
            with self.subTest(arguments):
                self.assertEqual(self.run_module(*arguments).returncode, status)

    def test_missing_packages_are_named_in_one_line(self):
        self.directory.mkdir()
        (self.directory / "matplotlib.py").write_text("raise ImportError('No module named matplotlib')")
        result = self.run_module(str(self.directory), PYTHONPATH=str(self.directory))
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
        self.assertIn("apt install python3-matplotlib", result.stderr)


if __name__ == "__main__":
    unittest.main()
