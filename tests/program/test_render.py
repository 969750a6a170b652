"""What render writes: the same bytes for any number of threads, statistics, and metadata from which a pixel can be replayed."""

import json
import re
import unittest

from exr import Exr
from harness import ProgramTest

RENDER = ["render", "scene.xml", "-q"]

# Key of the statistics -> type, as documented for --stats.
STATS = {"scene": str, "scene_hash": str, "sampler": str, "sampler_version": int, "spp": int, "seed": int, "film": list, "crop": list,
         "max_depth": int, "rr_depth": int, "technique": str, "effects": list, "dimensions": int, "kernel": str, "wall_seconds": float,
         "cpu_seconds": float, "sampler_seconds": float, "paths": int, "rays": int, "rays_closest": int, "rays_shadow": int,
         "tail_numbers": int, "invalid_samples": int, "invalid": list, "mean_rgb": list, "commit": str, "embree": str}


class Bytes(ProgramTest):
    def test_image_does_not_depend_on_the_threads_or_the_run(self):
        for sampler in ["random", "stratified", "halton", "sobol"]:
            images = []
            for threads in ["1", "1", "2", "4", "0"]:
                self.succeeds(*RENDER, "-D", "res=40", "-n", "70", "-s", sampler, "-t", threads, "-o", "out.exr")
                images.append(self.read("out.exr"))
            self.assertEqual(len(set(images)), 1, sampler)

    def test_seeds_differ(self):
        for seed in ["0", "1"]:
            self.succeeds(*RENDER, "--seed", seed, "-o", f"{seed}.exr")
        self.assertNotEqual(Exr(self.path("0.exr")).flat(), Exr(self.path("1.exr")).flat())

    def test_crop_is_a_part_of_the_full_image(self):
        for sampler in ["random", "stratified", "halton", "sobol"]:
            self.succeeds(*RENDER, "-s", sampler, "-o", "full.exr")
            self.succeeds(*RENDER, "-s", sampler, "--crop", "3,5,7,4", "-o", "crop.exr")
            full, crop = Exr(self.path("full.exr")), Exr(self.path("crop.exr"))
            self.assertEqual(crop.data_window, (3, 5, 9, 8))
            self.assertEqual(crop.display_window, (0, 0, 15, 15))
            for y in range(5, 9):
                for x in range(3, 10):
                    self.assertEqual(crop.pixel(x, y), full.pixel(x, y))

    def test_admissible_kernels_give_the_same_bytes(self):
        names = re.search(r"admissible: ([^)]+)\)", self.succeeds("plan", "scene.xml").out)[1].split()
        self.assertGreater(len(names), 1)
        images = set()
        for name in names:
            self.succeeds(*RENDER, "--kernel", name, "-o", "out.exr")
            images.add(self.read("out.exr"))
        self.assertEqual(len(images), 1)


class Stats(ProgramTest):
    def test_keys_and_types(self):
        self.succeeds(*RENDER, "-o", "out.exr", "--stats", "out.json", "-s", "halton", "-n", "9", "--seed", "7", "--crop", "1,2,10,12")
        stats = json.loads(self.read("out.json"))
        self.assertEqual({key: type(value) for key, value in stats.items()}, STATS)
        self.assertEqual(stats["sampler"], "halton:randomize=owen")
        self.assertEqual((stats["spp"], stats["seed"], stats["film"], stats["crop"]), (9, 7, [16, 16], [1, 2, 10, 12]))
        self.assertEqual(stats["paths"], 10 * 12 * 9)
        self.assertEqual(stats["rays"], stats["rays_closest"] + stats["rays_shadow"])
        self.assertGreaterEqual(stats["rays_closest"], stats["paths"])
        self.assertEqual((stats["invalid_samples"], stats["invalid"]), (0, []))
        self.assertIn("area_light", stats["effects"])
        self.assertGreater(stats["wall_seconds"], 0)
        self.assertGreater(stats["cpu_seconds"], stats["sampler_seconds"])

    def test_mean_is_that_of_the_image(self):
        self.succeeds(*RENDER, "-o", "out.exr", "--stats", "out.json")
        image = Exr(self.path("out.exr"))
        for c, mean in zip("RGB", json.loads(self.read("out.json"))["mean_rgb"]):
            values = image.flat([c])
            self.assertAlmostEqual(sum(values) / len(values) / mean, 1, delta=1e-6)  # the pixels are rounded to float

    def test_scene_is_the_default_of_sampler_and_spp(self):
        self.succeeds(*RENDER, "-o", "out.exr", "--stats", "out.json", "-D", "spp=3")
        stats = json.loads(self.read("out.json"))
        self.assertEqual((stats["sampler"], stats["spp"], stats["seed"]), ("random", 3, 0))


class Metadata(ProgramTest):
    def test_image_says_how_it_was_made(self):
        self.succeeds(*RENDER, "-o", "out.exr", "-s", "sobol:randomize=xor", "-n", "2", "--seed", "5", "-D", "res=8", "--max-depth", "3")
        attributes = Exr(self.path("out.exr")).attributes
        for key, value in {"scene": "scene.xml", "defines": "res=8", "sampler": "sobol:randomize=xor", "spp": "2", "seed": "5",
                           "max_depth": "3", "invalid_samples": "0"}.items():
            self.assertEqual(attributes["koksma:" + key], value)
        self.assertRegex(attributes["koksma:scene_hash"], r"^[0-9a-f]{16}$")

    def replayed(self, *arguments):
        out = self.succeeds("replay", *arguments).out
        return tuple(float(v) for v in re.search(r"^radiance\s+\(([^)]+)\)", out, re.M)[1].split(","))

    def test_replay_of_a_pixel_at_one_sample_is_the_pixel(self):
        self.succeeds(*RENDER, "-o", "out.exr", "-s", "sobol", "-n", "1", "--seed", "3", "-D", "res=12", "--crop", "2,2,8,8")
        image = Exr(self.path("out.exr"))
        lit = 0
        for x, y in [(2, 2), (6, 8), (9, 9), (5, 7)]:
            # Nine digits, as replay prints, determine a float.
            replayed = self.replayed("--from", "out.exr", "--pixel", f"{x},{y}", "--sample", "0")
            self.assertEqual(tuple(f"{v:.9g}" for v in image.pixel(x, y)), tuple(f"{v:.9g}" for v in replayed))
            lit += any(replayed)
        self.assertGreater(lit, 0)

    def test_samples_of_a_replay_add_up_to_the_pixel(self):
        self.succeeds(*RENDER, "-o", "out.exr", "-s", "stratified", "-n", "4")
        samples = [self.replayed("--from", "out.exr", "--pixel", "8,12", "--sample", str(i)) for i in range(4)]
        for pixel, values in zip(Exr(self.path("out.exr")).pixel(8, 12), zip(*samples)):
            self.assertAlmostEqual(pixel, sum(values) / 4, delta=1e-6 * pixel)

    def test_replay_without_an_image(self):
        self.succeeds(*RENDER, "-o", "out.exr", "-s", "halton", "-n", "1", "--seed", "9")
        self.assertEqual(self.replayed("--from", "out.exr", "--pixel", "8,12", "--sample", "0"),
                         self.replayed("scene.xml", "-s", "halton", "-n", "1", "--seed", "9", "--pixel", "8,12", "--sample", "0"))

    def test_forged_settings_are_refused(self):
        self.succeeds(*RENDER, "-o", "out.exr", "-n", "44")
        image = self.read("out.exr")
        at = image.index(b"koksma:spp\0string\0") + len(b"koksma:spp\0string\0") + 4
        self.assertEqual(image[at:at + 2], b"44")
        for forged in (b"4x", b"-4", b"  "):
            with open(self.path("forged.exr"), "wb") as file:
                file.write(image[:at] + forged + image[at + 2:])
            self.refuses(1, ["replay", "--from", "forged.exr", "--pixel", "1,1", "--sample", "0"], "forged.exr", f"koksma:spp is '{forged.decode()}'", "an integer")

    def test_replay_refuses(self):
        self.succeeds(*RENDER, "-o", "out.exr")
        at = ["--pixel", "1,1", "--sample", "0"]
        self.refuses(2, ["replay", *at], "needs a scene", "--from")
        self.refuses(2, ["replay", "scene.xml", "--sample", "0"], "--pixel")
        self.refuses(2, ["replay", "--from", "out.exr", "--pixel", "16,0", "--sample", "0"], "--pixel 16,0", "16x16")
        self.refuses(2, ["replay", "--from", "out.exr", "--pixel", "-1,0", "--sample", "0"], "--pixel -1,0", "16x16")
        self.refuses(2, ["replay", "--from", "out.exr", "-s", "stratified", "--pixel", "1,1", "--sample", "4"], "--sample 4", "0 to 3")
        self.refuses(1, ["replay", "--from", "none.exr", *at], "none.exr", "no such file")
        self.refuses(1, ["replay", "--from", "scene.xml", *at], "scene.xml", "OpenEXR")
        self.write("scene.xml", self.read("scene.xml").decode().replace('value="12, 11, 9"', 'value="1, 1, 1"'))
        self.refuses(1, ["replay", "--from", "out.exr", *at], "another scene")


class Comparing(ProgramTest):
    def test_numbers_of_compare(self):
        self.succeeds(*RENDER, "-o", "a.exr", "-n", "1")
        self.succeeds(*RENDER, "-o", "b.exr", "-n", "16", "--seed", "1")
        a, b = (Exr(self.path(name)).flat() for name in ["a.exr", "b.exr"])
        luminance = sum(w * v for w, v in zip([0.212671, 0.715160, 0.072169] * 256, b)) / 256
        squares = [(x - y) ** 2 for x, y in zip(a, b)]
        expected = {"mse": sum(squares) / 768, "rmse": (sum(squares) / 768) ** 0.5, "max_abs": max(squares) ** 0.5,
                    "relmse": sum(s / (y * y + 0.01 * luminance**2) for s, y in zip(squares, b)) / 768}
        found = self.succeeds("compare", "a.exr", "b.exr", "--json").json()
        for key, value in expected.items():
            self.assertAlmostEqual(found[key] / value, 1, delta=1e-12, msg=key)
        self.assertIn(f"RMSE      {found['rmse']:.6e}", self.succeeds("compare", "a.exr", "b.exr").out)

    def test_an_image_equals_itself(self):
        self.succeeds(*RENDER, "-o", "a.exr")
        found = self.succeeds("compare", "a.exr", "a.exr", "--json").json()
        self.assertEqual((found["mse"], found["relmse"], found["max_abs"], found["non_finite_a"]), (0, 0, 0, 0))


if __name__ == "__main__":
    unittest.main()
