"""The built-in scenes: each is in the experiment full, and each of full has a reference that ships and is accepted. Renders nothing but what prices a run."""

import json
import os
import shutil
import unittest

from exr import Exr
from harness import ProgramTest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FULL = os.path.join(ROOT, "bench", "experiments", "full.json")
REFERENCES = os.path.join(ROOT, "bench", "references")


def scenes_of(experiment):
    with open(experiment) as file:
        return json.load(file)["scenes"]


class BuiltIn(ProgramTest):
    def test_full_has_every_built_in_scene_once_and_says_what_to_expect_of_it(self):
        folder = os.path.join(ROOT, "scenes")
        built_in = sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.endswith(".xml"))
        self.assertGreaterEqual(len(built_in), 15)
        scenes = scenes_of(FULL)
        self.assertEqual(sorted(os.path.normpath(os.path.join(os.path.dirname(FULL), s["file"])) for s in scenes), built_in)
        self.assertEqual([s["file"] for s in scenes if not s.get("predictions")], [])

    def test_full_has_every_sampler(self):
        registered = {s["name"] for s in self.succeeds("samplers", "--json").json()}
        with open(FULL) as file:
            asked = [spec.split(":")[0] for spec in json.load(file)["samplers"]]
        self.assertEqual(sorted(asked), sorted(registered))

    def test_every_scene_of_full_has_a_reference_that_ships(self):
        """The user's cache of these tests is empty, so a reference can only be one that ships; the key in its name is that of the scene as it is."""
        lines = self.succeeds("bench", "full", "--dry-run", "--sampler", "random").out.splitlines()
        files = {line.split()[0]: line.split()[-1] for line in lines if " of CPU time" not in line and not line.startswith("scene ")}
        self.assertEqual(sorted(files), sorted(os.path.basename(s["file"])[:-4] for s in scenes_of(FULL)), lines)
        for name, file in files.items():
            self.assertTrue(file.endswith(".exr") and os.path.samefile(os.path.dirname(file), REFERENCES), f"no reference of {name} ships: {lines}")
        self.assertEqual(sorted(os.path.basename(f) for f in files.values()), sorted(f for f in os.listdir(REFERENCES) if f.endswith(".exr")), "one is of no scene")
        for name, file in files.items():
            self.assertLess(os.path.getsize(file), 250e3, name)
            self.assertEqual([Exr(file).attributes[f"koksma:{half}.{key}"] for half in "ab" for key in ("sampler", "replicates", "spp")],
                             ["sobol:randomize=owen", "8", "2048", "halton:randomize=owen", "8", "2048"], name)

    def test_they_are_accepted(self):
        """Keys, estimator version and halves. (A third render, reference --check, takes minutes.)"""
        shutil.copytree(REFERENCES, self.path("copy"))
        out = self.succeeds("reference", "full", "--out", "copy", "--spp", "1").out  # one sample a pixel, should one be missing
        self.assertEqual(out.count(" is there: "), len(scenes_of(FULL)), out)

    def test_that_of_the_furnace_is_the_closed_form(self):
        """Every pixel is 1 / (1 - albedo) = 2; the halves' means by their own standard errors."""
        (name,) = [f for f in os.listdir(REFERENCES) if f.startswith("furnace-")]
        image = Exr(os.path.join(REFERENCES, name))
        for half in "ab":
            for c in "RGB":
                mean, variance = (sum(map(sum, image.channels[f"{half}.{what}.{c}"])) for what in ("mean", "variance"))
                pixels = image.width * image.height
                self.assertLess(abs(mean / pixels - 2), 5 * variance ** 0.5 / pixels, f"{half}.{c}")


if __name__ == "__main__":
    unittest.main()
