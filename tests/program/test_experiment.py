"""Experiment files: every key is checked before anything is rendered or written."""

import copy
import json
import unittest

from harness import ProgramTest

TINY = {
    "title": "Tiny",
    "scenes": [{"file": "scene.xml", "crop": [4, 4, 8, 8]}],
    "samplers": ["random", "sobol"],
    "spp": [1, 4],
    "replicates": [4, 4],
    "reference": {"samplers": ["sobol", "halton"], "replicates": 2, "spp": 16},
}


class Experiments(ProgramTest):
    def refuses_change(self, change, *words, code=1):
        """`change` edits the experiment, which is right without it."""
        experiment = copy.deepcopy(TINY)
        change(experiment)
        self.write("tiny.json", json.dumps(experiment))
        self.refuses(code, ["bench", "tiny.json", "-o", "out", "--dry-run"], *words)
        self.refuses(code, ["bench", "tiny.json", "-o", "out"], *words)

    def test_unknown_experiment(self):
        self.refuses(1, ["bench", "bogus"], "unknown experiment 'bogus'", ".json file")
        self.refuses(1, ["bench", "none.json"], "no experiment file none.json")
        self.refuses(1, ["reference", "none.json"], "no experiment file none.json")

    def test_malformed_json(self):
        self.write("tiny.json", '{"title":\n "Tiny",,}')
        self.refuses(1, ["bench", "tiny.json"], "tiny.json", "line 2")
        self.write("tiny.json", "[1]")
        self.refuses(1, ["bench", "tiny.json"], "tiny.json", "expected an object")

    def test_unknown_keys(self):
        self.refuses_change(lambda e: e.update(sampler="sobol"), "tiny.json", '"sampler"', "known keys:", "samplers")
        self.refuses_change(lambda e: e["scenes"][0].update(name="a"), "scenes[0]", '"name"', "crop, file")
        self.refuses_change(lambda e: e["reference"].update(seed=1), "reference", '"seed"', "replicates, samplers, spp")

    def test_missing_keys(self):
        for key in ["title", "scenes", "samplers", "spp", "replicates"]:
            self.refuses_change(lambda e: e.pop(key), "tiny.json", f'"{key}"')
        self.refuses_change(lambda e: e["scenes"][0].pop("crop"), "scenes[0]", '"crop"')
        self.refuses_change(lambda e: e.pop("reference"), '"reference"')

    def test_wrong_types(self):
        for key, value in {"title": 3, "scenes": {}, "samplers": "sobol", "spp": 4, "replicates": "4", "seed": "x", "relmse_targets": 0.1,
                           "layouts": 1.5, "own_counts": 1, "crop_spp": 1.5, "picture_size": "big", "picture_spp": True}.items():
            self.refuses_change(lambda e: e.update({key: value}), "tiny.json", f'"{key}"', "expected")
        self.refuses_change(lambda e: e.update(reference=3), "reference", "expected an object")
        self.refuses_change(lambda e: e.update(scenes=[3]), "scenes[0]", "expected an object")

    def test_numbers_are_not_bent_into_shape(self):
        for spp in [[-4, 8], [1.5, 8], [True, 8], ["1", 8]]:
            self.refuses_change(lambda e: e.update(spp=spp), '"spp"', "list of integers")
        for replicates in [[1e12, 4], [10**12, 4], [4.5, 4]]:
            self.refuses_change(lambda e: e.update(replicates=replicates), '"replicates"', "list of integers")

    def test_wrong_values(self):
        self.refuses_change(lambda e: e.update(spp=[0, 4]), "1 or more")
        self.refuses_change(lambda e: e.update(spp=[4, 4]), "spp must increase")
        self.refuses_change(lambda e: e.update(replicates=[4]), "2 values of spp but 1 of replicates")
        self.refuses_change(lambda e: e.update(samplers=[]), "may not be empty")
        self.refuses_change(lambda e: e.update(picture_size=0), "picture_size")
        self.refuses_change(lambda e: e["reference"].update(replicates=1), "two replicates")
        self.refuses_change(lambda e: e["reference"].update(samplers=["sobol", "sobol"]), "two different samplers")
        self.refuses_change(lambda e: e.update(layouts=0), '"layouts" is 0')
        self.refuses_change(lambda e: e.update(layouts=2), "3 layouts or more")
        self.refuses_change(lambda e: e.update(layouts=3, replicates=[4, 1]), "2 replicates")
        self.refuses_change(lambda e: e.update(layouts=1001), '"layouts" is 1001', "1000")
        self.refuses_change(lambda e: e.update(samplers=["bogus"]), "unknown sampler 'bogus'", code=2)

    def test_sets_of_effects(self):
        self.refuses_change(lambda e: e.update(effects=["all"]), '"effects"', '"needed"')
        self.refuses_change(lambda e: e.update(effects=["needed", "lense"]), "unknown effect 'lense'", code=2)
        self.refuses_change(lambda e: e.update(effects=["needed", "lens"]), "lack what the scene calls for")
        self.write("tiny.json", json.dumps(dict(TINY, effects=["needed", "all"])))
        self.succeeds("bench", "tiny.json", "-o", "out", "--no-report")
        plain, forced = json.loads(self.read("out/summary.json"))["scenes"]
        self.assertEqual((plain["name"], forced["name"], plain["cost_of_effects"]), ("scene", "scene+all", None))
        cost = forced["cost_of_effects"]
        self.assertLess(set(cost["needed"]), set(cost["forced"]))
        self.assertLess(cost["dimensions_needed"], cost["dimensions"])
        self.assertEqual({(line["sampler"].split(":")[0], line["spp"]) for line in cost["lines"]}, {(s, n) for s in TINY["samplers"] for n in TINY["spp"]})
        for line in cost["lines"]:
            self.assertGreater(line["time_ratio"]["value"], 0)

    def test_crops(self):
        for crop in [[4, 4, 13, 8], [16, 0, 1, 1], [2147483647, 0, 2147483647, 1]]:
            self.refuses_change(lambda e: e["scenes"][0].update(crop=crop), "scene.xml", "not inside the film of 16x16")
        for crop in [[4, 4, 8], [-1, 0, 4, 4], [0, 0, 0, 4]]:
            self.refuses_change(lambda e: e["scenes"][0].update(crop=crop), "scenes[0]", "[x, y, width, height]")

    def test_nothing_is_counted_twice(self):
        self.refuses_change(lambda e: e.update(samplers=["sobol", "sobol:randomize=owen"]), "sobol:randomize=owen", "twice", code=2)
        self.refuses_change(lambda e: e.update(scenes=2 * e["scenes"]), "two scenes are named scene")

    def test_limits_are_told_before_anything_is_rendered(self):
        self.refuses_change(lambda e: e.update(samplers=["random", "stratified"], spp=[1, 10**9]), "stratified", "at most")

    def test_references_that_cannot_know_their_error(self):
        for samplers, words in [(["bogus", "sobol"], "unknown sampler 'bogus'"), (["sobol", "sobol:randomize=owen"], "both halves"),
                                (["sobol:randomize=none", "random"], "no randomisation")]:
            experiment = copy.deepcopy(TINY)
            experiment["reference"]["samplers"] = samplers
            self.write("tiny.json", json.dumps(experiment))
            result = self.koksma("bench", "tiny.json", "-o", "out")
            self.assertEqual(result.code, 1)
            self.assertIn(words, result.err.splitlines()[-1])

    def test_unwritable_folders(self):
        self.write("tiny.json", json.dumps(TINY))
        self.refuses(1, ["bench", "tiny.json", "-o", "scene.xml/out"], "scene.xml/out", "Not a directory")
        self.refuses(1, ["reference", "tiny.json", "-o", "scene.xml/out"], "scene.xml/out", "Not a directory")
        self.environment["KOKSMA_REFERENCE_DIR"] = self.path("scene.xml", "references")
        result = self.koksma("bench", "tiny.json", "-o", "out")
        self.assertEqual(result.code, 1)
        self.assertIn("scene.xml/references", result.err.splitlines()[-1])

    def test_report_of_what_is_no_result(self):
        self.refuses(1, ["report", "none"], "none/results.jsonl", "koksma bench wrote")
        self.refuses(1, ["report", "."], "results.jsonl", "koksma bench wrote")
        self.write("out/results.jsonl", "")
        self.refuses(1, ["report", "out"], "holds no results")
        self.write("out/results.jsonl", '{"kind":"header"}\n{"kind":"render",\n')
        self.refuses(1, ["report", "out"], "out/results.jsonl:2: not a row of results")
        self.write("out/results.jsonl", '{"kind":"header"}\n{"kind":"render","scene":"a"}\n')
        self.refuses(1, ["report", "out"], "out/results.jsonl:2: not a row of results", "scene_hash")


if __name__ == "__main__":
    unittest.main()
