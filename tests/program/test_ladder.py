"""bench ladder: scenes with known answers, to where float ends; and the three ways that it compares."""

import json
import unittest

from harness import ProgramTest


class Ladder(ProgramTest):
    def test_quick(self):
        out = self.succeeds("bench", "ladder", "--quick", "--no-report", "-o", "out").out
        numbers = json.loads(self.read("out/ladder.json"))
        names = [ladder["name"] for ladder in numbers["ladders"]]
        self.assertEqual(names, ["light-size", "distance", "scale", "offset", "camera-distance", "roughness", "albedo", "grazing", "spp", "index"])
        for ladder in numbers["ladders"]:
            self.assertIn(ladder["name"], out)
            for step in ladder["steps"]:
                for result in step["techniques"].values():
                    self.assertEqual(result["invalid"], 0)
                if ladder["name"] != "camera-distance":  # the one that float must lose: the camera is the origin
                    self.assertTrue(step["techniques"]["mis"]["holds"], (ladder["name"], step))
        reach = {ladder["name"]: (ladder["steps"][0]["x"], ladder["steps"][-1]["x"]) for ladder in numbers["ladders"]}
        self.assertAlmostEqual(reach["light-size"][1] / 1e-12, 1)
        self.assertAlmostEqual(reach["offset"][1] / 1e7, 1)
        self.assertGreater(reach["index"][1], 2 ** 32)
        self.assertEqual(sum(e["invalid"] for e in numbers["extremes"]), 0)
        self.assertEqual(len(numbers["extremes"]), 12)

    def test_dry_run_and_refusals(self):
        self.assertIn("light-size", self.succeeds("bench", "ladder", "--dry-run").out)
        self.refuses(2, ["bench", "ladder", "--sampler", "random"], "own scenes and samplers")


class Technique(ProgramTest):
    def mean(self, *arguments):
        self.succeeds("render", "scene.xml", "-o", "a.exr", "--stats", "a.json", "--quiet", "--spp", "4096", *arguments)
        return json.loads(self.read("a.json"))

    def test_three_ways_agree(self):
        ways = [self.mean("--technique", t) for t in ["mis", "light", "bsdf"]]
        self.assertEqual([w["technique"] for w in ways], ["mis", "light", "bsdf"])
        for w in ways[1:]:
            self.assertAlmostEqual(w["mean_rgb"][1] / ways[0]["mean_rgb"][1], 1, delta=0.05)
            self.assertNotEqual(w["mean_rgb"][1], ways[0]["mean_rgb"][1])

    def test_replay_keeps_the_technique(self):
        def light_samples():
            return sum(self.succeeds("replay", "--from", "a.exr", "--pixel", "4,14", "--sample", str(i)).out.count("  light     #") for i in range(8))

        self.mean("--technique", "bsdf")
        self.assertEqual(light_samples(), 0)
        self.mean()
        self.assertGreater(light_samples(), 0)

    def test_refusal(self):
        self.refuses(2, ["render", "scene.xml", "-o", "a.exr", "--technique", "both"], "--technique")


if __name__ == "__main__":
    unittest.main()
