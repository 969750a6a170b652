"""Predictions of an experiment, held or refuted by its intervals; and progressive renders, a curve of their own."""

import math
import unittest

from test_bench import BenchTest

SOBOL = "sobol:randomize=owen"


class Predictions(BenchTest):
    def predict(self, *predictions, **changes):
        self.write_experiment(scenes=[{"file": "scene.xml", "crop": [4, 4, 8, 8], "predictions": list(predictions)}],
                              **{"spp": [1, 4, 16, 64], "replicates": [8, 8, 8, 8], "samplers": ["random", "sobol"], **changes})

    def verdicts(self):
        (scene,) = self.summary()["scenes"]
        return [p["verdict"] for p in scene["predictions"]], scene["predictions_verdict"]

    def test_what_is_right_holds_and_what_is_wrong_is_refuted(self):
        self.predict({"slope": [-1, 0], "samplers": ["random"]}, {"order": ["sobol", "random"], "spp": 64}, {"gain": [1, None], "spp": 64},
                     {"slope": [0, 1], "samplers": ["random"]}, {"order": ["random", "sobol"], "spp": 64}, {"gain": [None, 0.5], "spp": 64, "samplers": ["sobol"]},
                     {"slope": [-0.5, None], "samplers": ["random"]}, {"gain": [1, None], "spp": 256}, {"slope": [None, 0], "samplers": ["halton"]})
        out = self.bench("--no-report").out
        each, whole = self.verdicts()
        self.assertEqual(each, ["held"] * 3 + ["refuted"] * 3 + ["undecided"] + ["not tested"] * 2)
        self.assertEqual(whole, "refuted")
        for text in ("Predictions of the experiment", "held       slope of Random", "refuted    MSE at 64 spp: Random", "not tested "):
            self.assertIn(text, out)
        (scene,) = self.summary()["scenes"]
        slope = scene["samplers"][0]["slope"]
        (found,) = scene["predictions"][0]["found"]
        self.assertEqual([found[k] for k in ("value", "lo", "hi")], [slope[k] for k in ("value", "lo", "hi")])
        (found,) = scene["predictions"][1]["found"]
        gain = scene["samplers"][1]["gain_vs_random"]
        self.assertEqual([found[k] for k in ("value", "lo", "hi")], [gain[k] for k in ("mse_ratio", "lo", "hi")])

    def test_verdicts_follow_from_the_intervals(self):
        self.predict({"slope": [-0.6, -0.4]}, replicates=[4, 4, 4, 4])
        self.bench("--no-report")
        for found in self.summary()["scenes"][0]["predictions"][0]["found"]:
            inside = found["lo"] >= -0.6 and found["hi"] <= -0.4
            outside = found["hi"] < -0.6 or found["lo"] > -0.4
            self.assertEqual(found["verdict"], "held" if inside else "refuted" if outside else "undecided")

    def test_the_report_shows_them_and_a_summary_made_again_is_the_same(self):
        self.predict({"slope": [-0.6, -0.4], "samplers": ["random"]})
        self.bench("--no-report")
        before = self.summary()
        self.bench("--no-report")  # all rows are kept
        self.assertEqual(self.summary()["scenes"][0]["predictions"], before["scenes"][0]["predictions"])

    def test_refusals(self):
        for prediction, *words in (({"slope": [-1, 0], "gain": [1, 2]}, "one of the keys"), ({}, "one of the keys"), ({"slope": [0, -1]}, "least below most"),
                                   ({"slope": [None, None]}, "a bound"), ({"slope": -1}, "[least, most]"), ({"slope": [0, "x"]}, "a number or null"),
                                   ({"gain": [1, None]}, '"spp"'), ({"slope": [-1, 0], "spp": 4}, '"spp"'), ({"order": ["random"], "spp": 4}, "two samplers"),
                                   ({"order": ["random", "sobol"], "spp": 4, "samplers": ["random"]}, "two samplers"), ({"slop": [-1, 0]}, "unknown key", '"slop"')):
            self.predict(prediction)
            self.refuses(1, ["bench", "tiny.json", "-o", "out"], "tiny.json", "predictions[0]", *words)
        self.predict({"slope": [-1, 0], "samplers": ["bogus"]})
        self.refuses(2, ["bench", "tiny.json", "-o", "out"], "unknown sampler 'bogus'")


class Progressive(BenchTest):
    def test_prefixes_are_rows_and_a_curve_of_their_own(self):
        self.write_experiment(spp=[1, 4, 16], replicates=[4, 4, 4], samplers=["random", "stratified", "sobol:randomize=none"], progressive=3)
        out = self.bench("--no-report").out
        rows = self.lines()[1]
        prefixes = [r for r in rows if r["prefix_of"]]
        self.assertEqual(len(prefixes), 3 * 3 * 2)  # none of what has no randomisation
        self.assertEqual({r["prefix_of"] for r in prefixes}, {16})
        seeds = {}
        for r in prefixes:
            seeds.setdefault((r["sampler"], r["replicate"]), set()).add(r["seed"])
        self.assertTrue(all(len(s) == 1 for s in seeds.values()))  # one render, read three times
        self.assertEqual(len(set.union(*seeds.values())), 6)
        self.assertFalse(set.union(*seeds.values()) & {r["seed"] for r in rows if not r["prefix_of"]})
        random, stratified, fixed = self.summary()["scenes"][0]["samplers"]
        self.assertIsNone(fixed["progressive"])
        for entry in (random, stratified):
            self.assertEqual([p["replicates"] for p in entry["points"]], [4, 4, 4])  # prefixes are no replicates of native renders
            mse = {spp: [r["mse"] for r in prefixes if r["sampler"] == entry["sampler"] and r["spp"] == spp] for spp in (4, 16)}
            expected = 0.5 * (math.log(sum(mse[16])) - math.log(sum(mse[4]))) / math.log(4)
            self.assertAlmostEqual(entry["progressive"]["slope"]["value"], expected, delta=1e-9)
            self.assertEqual((entry["progressive"]["renders"], entry["progressive"]["planned_spp"]), (3, 16))
            self.assertLess(entry["progressive"]["slope"]["lo"], expected)
        self.assertIn("3 renders to 16 spp", out)
        # The first samples of a stratified render lie in the first of its strata: far worse than four strata.
        at_4 = [p["rmse"] for p in stratified["progressive"]["points"] if p["spp"] == 4][0]
        self.assertGreater(at_4, stratified["points"][1]["rmse"])

    def test_two_renders_or_none(self):
        for wrong in (1, -1):
            self.write_experiment(progressive=wrong)
            self.refuses(1, ["bench", "tiny.json", "-o", "out"], '"progressive"', "2 replicates or more")


if __name__ == "__main__":
    unittest.main()
