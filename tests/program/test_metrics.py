"""Metrics against numpy, which shares no code with the program. Skipped without numpy."""

import math
import re
import unittest

from exr import Exr
from harness import ProgramTest
from test_bench import BenchTest

try:
    import numpy
except ImportError:
    numpy = None

RENDER = ["render", "scene.xml", "-q"]


@unittest.skipUnless(numpy, "needs numpy")
class Numpy(ProgramTest):
    def array(self, name):
        image = Exr(self.path(name))
        return numpy.array(image.flat(), dtype=numpy.float64).reshape(image.height, image.width, 3)

    def test_metrics_of_two_renders(self):
        self.succeeds(*RENDER, "-o", "a.exr", "-n", "1")
        self.succeeds(*RENDER, "-o", "b.exr", "-n", "16", "--seed", "1")
        a, b = self.array("a.exr"), self.array("b.exr")
        floor = 0.01 * (b @ numpy.array([0.212671, 0.715160, 0.072169])).mean() ** 2
        total = numpy.abs(a) + numpy.abs(b)
        expected = {"rmse": numpy.sqrt(numpy.mean((a - b) ** 2)), "relmse": numpy.mean((a - b) ** 2 / (b**2 + floor)), "mae": numpy.abs(a - b).mean(),
                    "smape": numpy.divide(numpy.abs(a - b), total, out=numpy.zeros_like(total), where=total > 0).mean()}
        found = self.succeeds("compare", "a.exr", "b.exr", "--json").json()
        for key, value in expected.items():
            self.assertAlmostEqual(found[key] / value, 1, delta=1e-12, msg=key)
        self.assertGreater(found["flip"], 0)


class Masks(BenchTest):
    LAMP = '<lookat origin="0, 1, 4" target="0, 0.7, 0" up="0, 1, 0"/>'

    def masked(self):
        self.bench("--no-report")
        header, rows = self.lines()
        return header["scenes"][0]["emitter_pixels"], rows

    def test_nothing_is_masked_where_no_emitter_is_seen(self):
        pixels, rows = self.masked()
        self.assertEqual(pixels, 0)
        for row in rows:
            self.assertEqual(row["masked"], {"pixels": 64, **{key: row[key] for key in ("mse", "relmse", "mae", "smape", "flip")}})

    def test_a_lamp_in_sight_and_its_neighbours_are_masked(self):
        # The camera looks straight up at the lamp, of which all edges lie inside the crop.
        self.write("scene.xml", self.read("scene.xml").decode().replace(self.LAMP, '<lookat origin="0, 1.094, 0" target="0, 3, 0" up="0, 0, 1"/>'))
        self.write_experiment(scenes=[{"file": "scene.xml", "crop": [0, 0, 16, 16]}])
        pixels, rows = self.masked()
        # Its half width 0.5 at distance 1.906 under half the field of view of 25 degrees: 8 * 0.2623 / 0.4663 = 4.5 pixels, so it reaches
        # into 5 either side of the centre, and one more is masked.
        self.assertEqual(pixels, 12 * 12)
        for row in rows:
            self.assertEqual(row["masked"]["pixels"], 256 - 144)
            self.assertGreater(row["mae"], row["masked"]["mae"])

    def test_uncorrected_metrics_state_what_the_halves_of_the_reference_differ_by(self):
        self.bench("--no-report")
        header, rows = self.lines()
        halves = header["scenes"][0]["reference"]["between_halves"]
        self.assertEqual(set(halves), {"mae", "smape", "flip"})
        self.assertTrue(all(0 < value < 1 for value in halves.values()), halves)
        for row in rows:
            self.assertEqual(row["flip"] is None, row["replicate"] >= 4)
        point = self.summary()["scenes"][0]["samplers"][1]["points"][1]
        self.assertEqual(set(point["metrics"]["all"]), {"rmse", "relmse", "mae", "smape", "flip"})
        mae = [r["mae"] for r in rows if (r["sampler"], r["spp"]) == ("sobol:randomize=owen", 4)]
        self.assertAlmostEqual(point["metrics"]["all"]["mae"]["value"], sum(mae) / len(mae), delta=1e-12)

    def test_equivalent_samples_of_random(self):
        self.bench("--no-report")
        random, sobol = self.summary()["scenes"][0]["samplers"]
        for mine, other in zip(sobol["points"], random["points"]):
            equivalent = mine["metrics"]["equivalent_random_spp"]
            if equivalent:
                self.assertAlmostEqual(equivalent["value"], mine["spp"] * other["mse"] / mine["mse"], delta=1e-9 * equivalent["value"])
                self.assertTrue(equivalent["lo"] < equivalent["value"] < equivalent["hi"])


class Ranks(BenchTest):
    def test_pairs_of_a_scene_are_corrected_as_holm_says(self):
        self.write_experiment(samplers=["random", "sobol", "stratified", "halton"], spp=[1, 4], replicates=[4, 8])
        out = self.bench("--no-report").out
        pairs = self.summary()["scenes"][0]["pairs"]
        self.assertEqual(len(pairs), 6)
        least = 0
        for rank, pair in enumerate(sorted(pairs, key=lambda pair: pair["p"])):
            least = max(least, min(1, pair["p"] * (6 - rank)))
            self.assertAlmostEqual(pair["p_holm"], least, delta=1e-12)
            self.assertEqual(pair["verdict"], "distinguishable" if least < 0.05 else "not distinguishable")
            self.assertEqual(pair["better"], None if least >= 0.05 else pair["a" if pair["mse_ratio"]["value"] > 1 else "b"])
        self.assertIn("not distinguishable:", out)

    def test_of_many_pairs_the_table_says_how_many_and_who_leads(self):
        samplers = ["random", "sobol", "stratified", "halton", "lhs", "pmj02", "sobol-padded"]
        self.write_experiment(samplers=samplers, spp=[1, 16], replicates=[4, 4])
        out = self.bench("--no-report").out
        pairs = self.summary()["scenes"][0]["pairs"]
        apart = [pair for pair in pairs if pair["better"]]
        self.assertEqual(len(pairs), 21)
        beaten = {pair[side] for pair in apart for side in "ab" if pair[side] != pair["better"]}
        found = re.search(r"scene +(\d+) of 21 pairs told apart; nobody is told to beat (.*)\n", out)
        self.assertEqual(int(found[1]), len(apart))
        self.assertEqual(set(found[2].split(", ")), {name for pair in pairs for name in (pair["a"], pair["b"])} - beaten)
        self.assertGreater(len(apart), 0)
        self.assertNotIn("not distinguishable:", out)

    def test_across_scenes_mean_and_range(self):
        self.write("other.xml", self.read("scene.xml").decode().replace('value="12, 11, 9"', 'value="1, 1, 1"'))
        self.write_experiment(scenes=[{"file": f, "crop": [4, 4, 8, 8]} for f in ["scene.xml", "other.xml"]])
        out = self.bench("--no-report").out
        summary = self.summary()
        (sobol,) = summary["across_scenes"]
        gains = [s["samplers"][1]["gain_vs_random"]["mse_ratio"] for s in summary["scenes"]]
        self.assertAlmostEqual(sobol["geometric_mean"], (gains[0] * gains[1]) ** 0.5, delta=1e-9)
        self.assertEqual((sobol["lowest"], sobol["highest"], sobol["scenes"], sobol["left_out"]), (min(gains), max(gains), 2, 0))
        self.assertIn("of other scenes this says nothing", out)


class Times(BenchTest):
    def test_efficiency_equal_time_and_overtaking(self):
        self.write_experiment(spp=[1, 4, 16], replicates=[4, 4, 4])
        self.bench("--no-report")
        (scene,) = self.summary()["scenes"]
        random, sobol = scene["samplers"]
        for point in random["points"]:
            self.assertAlmostEqual(point["efficiency"]["value"] * point["mse"] * point["cpu_seconds"], 1, delta=1e-9)
            self.assertAlmostEqual(point["ns_per_path"] * point["spp"] * 64 / 1e9 / point["cpu_seconds"], 1, delta=1e-9)
        (pair,) = scene["pairs"]
        overtake = pair["b_overtakes_below_ns_per_path"]
        a, b = random["points"][-1], sobol["points"][-1]
        self.assertAlmostEqual(overtake["value"] / (a["ns_per_path"] * a["mse"] / b["mse"]), 1, delta=1e-9)
        equal = sobol["equal_time_vs_random"]
        if equal:
            self.assertEqual(equal["seconds"], min(a["cpu_seconds"], b["cpu_seconds"]))
            self.assertGreater(equal["mse_ratio"], 0)
            self.assertTrue(equal["lo"] <= equal["mse_ratio"] <= equal["hi"])
            # By hand: the one that ends first is measured at that time, the other lies between two of its points.
            ends, other = (b, random) if b["cpu_seconds"] <= a["cpu_seconds"] else (a, sobol)
            below, above = next((p, q) for p, q in zip(other["points"], other["points"][1:]) if p["cpu_seconds"] <= equal["seconds"] <= q["cpu_seconds"])
            part = math.log(equal["seconds"] / below["cpu_seconds"]) / math.log(above["cpu_seconds"] / below["cpu_seconds"])
            mse = below["mse"] * (above["mse"] / below["mse"]) ** part
            self.assertAlmostEqual(equal["mse_ratio"] / (mse / ends["mse"] if ends is b else ends["mse"] / mse), 1, delta=1e-9)
        self.assertEqual({p["fill"] for s in scene["samplers"] for p in s["points"]} - {"scalar", "vector", "unstated"}, set())


class Maps(BenchTest):
    def test_image_errors_at_the_kept_count(self):
        self.bench("--no-report")
        random, sobol = self.summary()["scenes"][0]["samplers"]
        self.assertIsNone(random["image_error"]["median_pixel_gain"])
        error = sobol["image_error"]
        self.assertGreater(error["median_pixel_gain"], 0)
        self.assertEqual((error["spp"], error["replicates"], len(error["spectrum"]), [b["sigma"] for b in error["blurred"]]), (4, 4, 5, [1, 2]))
        self.assertLess(error["blurred"][1]["rmse"]["value"], error["blurred"][0]["rmse"]["value"])
        self.assertEqual(set(error["maps"]), {"mse", "variance", "bias_z"})
        for name in error["maps"].values():
            data = self.read(f"out/{name}")
            self.assertEqual((data[:8], len(data)), (b"\x93NUMPY\x01\x00", 128 + 4 * 64))


if __name__ == "__main__":
    unittest.main()
