"""bench on a tiny experiment: rows, statistics, report, cached references; and its numbers recomputed from the images."""

import json
import os
import re
import struct
import subprocess
import unittest

from exr import Exr
from harness import ProgramTest
from test_experiment import TINY

ROW = {"kind": str, "row_format": int, "reference_content": str, "scene": str, "scene_hash": str, "sampler": str, "sampler_version": int, "randomized": bool, "spp": int,
       "replicate": int, "layout": int, "prefix_of": int, "seed": int, "film": list, "crop": list, "max_depth": int, "rr_depth": int, "effects": list,
       "dimensions": int, "kernel": str, "mse": float, "mse_raw": float, "rmse": float, "relmse": float, "relmse_raw": float,
       "mae": float, "smape": float, "flip": float, "masked": dict,
       "mean_rgb": list, "wall_seconds": float, "cpu_seconds": float, "sampler_seconds": float, "sampler_share": float,
       "paths": int, "rays": int, "invalid_samples": int, "threads": int, "fill": str, "estimator_version": int, "reference": str,
       "commit": str, "machine": str, "isa": str}


def reports_can_be_made():
    python = os.environ.get("KOKSMA_PYTHON", "/usr/bin/python3" if os.path.exists("/usr/bin/python3") else "python3")
    return subprocess.run([python, "-c", "import numpy, matplotlib, jinja2"], stderr=subprocess.DEVNULL).returncode == 0


def to_float(x):
    """The nearest 32-bit float."""
    return struct.unpack("f", struct.pack("f", x))[0]


class BenchTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write_experiment()

    def write_experiment(self, **changes):
        self.write("tiny.json", json.dumps({**TINY, "picture_size": 8, "picture_spp": 1, "crop_spp": 4, **changes}))

    def bench(self, *arguments):
        return self.succeeds("bench", "tiny.json", "-o", "out", *arguments)

    def lines(self):
        """The header and the rows. Every line of the file must be JSON."""
        lines = [json.loads(line) for line in self.read("out/results.jsonl").decode().splitlines()]
        self.assertEqual([line["kind"] for line in lines], ["header"] + ["render"] * (len(lines) - 1))
        return lines[0], lines[1:]

    def summary(self):
        return json.loads(self.read("out/summary.json"))


class Rows(BenchTest):
    def test_one_row_a_render_with_the_documented_keys(self):
        self.bench("--no-report")
        header, rows = self.lines()
        self.assertEqual(len(rows), 2 * (4 + 4))
        self.assertEqual(len({(r["sampler"], r["spp"], r["replicate"]) for r in rows}), len(rows))
        self.assertEqual(len({r["seed"] for r in rows}), len(rows))
        for row in rows:
            types = {key: type(value) for key, value in row.items()}
            if row["rmse"] is None:  # the reference's noise was larger
                self.assertLessEqual(row["mse"], 0)
                types["rmse"] = float
            self.assertEqual(types, ROW)
            self.assertLess(row["seed"], 2**63)
            self.assertEqual((row["paths"], row["film"], row["crop"]), (64 * row["spp"], [16, 16], [4, 4, 8, 8]))
        self.assertEqual([s["sampler"] for s in header["samplers"]], ["random", "sobol:randomize=owen"])
        for key in ["name", "title", "command", "commit", "machine", "cores", "isa", "compiler", "threads", "version"]:
            self.assertIn(key, header["experiment"])
        self.assertEqual([f for f in self.files() if "tmp" in f or "partial" in f], [])

    def test_numbers_follow_from_the_images(self):
        self.bench("--no-report")
        _, rows = self.lines()
        (name,) = os.listdir(self.path("references"))
        reference = Exr(self.path("references", name))
        halves = [{key: reference.flat([f"{half}.{key}.{c}" for c in "RGB"]) for key in ["mean", "variance"]} for half in "ab"]
        noise = [sum(half["variance"]) for half in halves]
        weight = noise[1] / (noise[0] + noise[1])
        mean = [to_float(weight * a + (1 - weight) * b) for a, b in zip(halves[0]["mean"], halves[1]["mean"])]
        variance = [to_float(weight**2 * a + (1 - weight) ** 2 * b) for a, b in zip(halves[0]["variance"], halves[1]["variance"])]
        luminance = sum(w * v for w, v in zip([0.212671, 0.715160, 0.072169] * 64, mean)) / 64
        for row in [rows[0], rows[5], rows[-1]]:
            self.succeeds("render", "scene.xml", "-q", "-o", "again.exr", "--crop", "4,4,8,8", "-s", row["sampler"],
                          "-n", str(row["spp"]), "--seed", str(row["seed"]))
            image = Exr(self.path("again.exr")).flat()
            squares = [(x - r) ** 2 for x, r in zip(image, mean)]
            weights = [1 / (r * r + 0.01 * luminance**2) for r in mean]
            expected = {"mse_raw": sum(squares) / 192, "mse": sum(s - v for s, v in zip(squares, variance)) / 192,
                        "relmse_raw": sum(s * w for s, w in zip(squares, weights)) / 192,
                        "relmse": sum((s - v) * w for s, v, w in zip(squares, variance, weights)) / 192,
                        "mae": sum(s ** 0.5 for s in squares) / 192,
                        "smape": sum(abs(x - r) / (x + r or 1) for x, r in zip(image, mean)) / 192}
            for key, value in expected.items():
                self.assertAlmostEqual(row[key], value, delta=1e-9 * abs(expected["relmse_raw"]), msg=key)
            for c, channel_mean in enumerate(row["mean_rgb"]):
                self.assertAlmostEqual(sum(image[c::3]) / 64 / channel_mean, 1, delta=1e-6)

    def test_two_runs_differ_in_time_only(self):
        runs = []
        for threads in ["1", "2"]:
            self.bench("--no-report", "-t", threads)
            runs.append([{k: v for k, v in row.items() if "seconds" not in k and k not in ("sampler_share", "threads")} for row in self.lines()[1]])
        self.assertEqual(*runs)

    def test_black_crop(self):
        self.write("scene.xml", self.read("scene.xml").decode().replace('value="12, 11, 9"', 'value="0, 0, 0"'))
        self.bench("--no-report")
        self.assertTrue(all(row["mse"] == 0 and row["relmse"] is None for row in self.lines()[1]))

    def test_scenes_and_samplers_can_be_chosen(self):
        self.write("other.xml", self.read("scene.xml").decode())
        self.write_experiment(scenes=[{"file": f, "crop": [4, 4, 8, 8]} for f in ["scene.xml", "other.xml"]])
        self.bench("--no-report", "--scene", "other", "-s", "halton", "-s", "random")
        self.assertEqual({(r["scene"], r["sampler"]) for r in self.lines()[1]}, {("other", "halton:randomize=owen"), ("other", "random")})
        self.refuses(2, ["bench", "tiny.json", "--scene", "bogus"], "no scene 'bogus'", "scene, other")
        self.refuses(2, ["bench", "tiny.json", "-s", "bogus"], "unknown sampler 'bogus'")

    def test_layouts_are_measured_one_by_one_and_the_first_is_the_plan(self):
        self.bench("--no-report")
        plain = [(r["sampler"], r["spp"], r["replicate"], r["seed"], r["mse_raw"]) for r in self.lines()[1]]
        self.write_experiment(layouts=4)
        out = self.bench("--no-report").out
        rows = self.lines()[1]
        self.assertEqual(len(rows), 2 * (4 + 4) * 4)
        self.assertEqual(len({r["seed"] for r in rows}), len(rows))
        first = [(r["sampler"], r["spp"], r["replicate"], r["seed"], r["mse_raw"]) for r in rows if r["layout"] == 0]
        self.assertEqual(first, plain)
        self.assertIn("Luck of dimensions", out)
        for sampler in self.summary()["scenes"][0]["samplers"]:
            self.assertEqual([(p["spp"], p["replicates"]) for p in sampler["points"]], [(1, 4), (4, 4)])
            for at in sampler["layouts"]:
                self.assertEqual((at["permuted"], len(at["each"])), (3, 4))
                if at["rmse"] is not None:
                    self.assertLessEqual(at["lowest"], at["rmse"])
                    self.assertLessEqual(at["spread"]["lo"], at["spread"]["hi"])

    def test_comparisons_at_counts_that_random_was_not_run_at_are_interpolated(self):
        self.write_experiment(spp=[3, 5, 11, 20], replicates=[4, 4, 4, 4], own_counts=True, samplers=["random", "sobol", "faure", "stratified"])
        out = self.bench("--no-report").out
        counts = {}
        for row in self.lines()[1]:
            counts.setdefault(row["sampler"].split(":")[0], set()).add(row["spp"])
        self.assertEqual(counts, {"random": {3, 5, 11, 20}, "sobol": {3, 4, 5, 8, 11, 16, 20}, "faure": {3, 5, 11, 20}, "stratified": {3, 4, 5, 11, 16, 20}})
        at = {c["spp"]: c for s in self.summary()["scenes"][0]["samplers"] if s["sampler"].startswith("sobol") for c in s["any_count"]}
        self.assertEqual({spp: (c["how"], c["own"]) for spp, c in at.items()},
                         {3: ("measured", False), 4: ("interpolated", True), 5: ("measured", False), 8: ("interpolated", True),
                          11: ("measured", False), 16: ("interpolated", True), 20: ("measured", False)})
        self.assertRegex(out, r"\n +8 .*\*~")

    def test_quick_is_less(self):
        self.write_experiment(spp=[1, 4, 128], replicates=[16, 2, 4])
        self.bench("--no-report", "--quick")
        header, rows = self.lines()
        counts = {spp: sum(r["spp"] == spp and r["sampler"] == "random" for r in rows) for spp in [1, 4, 128]}
        self.assertEqual(counts, {1: 8, 4: 2, 128: 0})
        self.assertIn("quick", header["experiment"]["title"])

    def test_dry_run_writes_nothing(self):
        before = self.files()
        out = self.bench("--dry-run").out
        self.assertEqual(self.files(), before)
        self.assertRegex(out, r"\nscene +16 +2560 ")
        self.assertIn("must be made", out)



class JointAndPadded(BenchTest):
    """With 8 samples the light of scene penumbra, dimensions 2 and 3, is better served by a padded pair than by the joint sequence."""

    def test_padded_beats_joint_behind_an_edge(self):
        scenes = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes")
        self.write_experiment(scenes=[{"file": os.path.join(scenes, "penumbra.xml"), "crop": [264, 336, 64, 64]}], samplers=["random", "sobol", "sobol-padded"],
                              spp=[8, 16], replicates=[8, 8], reference={"samplers": ["sobol:randomize=owen", "halton:randomize=owen"], "replicates": 8, "spp": 2048})
        self.bench("--no-report")
        rmse = {(s["sampler"].split(":")[0], p["spp"]): p for s in self.summary()["scenes"][0]["samplers"] for p in s["points"]}
        self.assertLess(1.2 * rmse["sobol-padded", 8]["rmse_hi"], rmse["sobol", 8]["rmse_lo"])
        self.assertLess(rmse["sobol", 16]["rmse_hi"], 1.05 * rmse["sobol-padded", 16]["rmse_lo"])  # a tie, where that pair is a net too


class References(BenchTest):
    def test_second_run_uses_the_cached_reference(self):
        self.assertIn("no reference for scene yet", self.bench("--no-report").err)
        (name,) = os.listdir(self.path("references"))
        self.assertRegex(name, r"^scene-[0-9a-f]{16}\.exr$")
        before = os.stat(self.path("references", name))
        self.assertEqual(self.bench("--no-report").err, "")
        self.assertEqual(os.stat(self.path("references", name)).st_mtime_ns, before.st_mtime_ns)
        self.assertIn(f"references/{name}", self.bench("--dry-run").out)

    def test_another_scene_needs_another_reference(self):
        self.bench("--no-report")
        self.write("scene.xml", self.read("scene.xml").decode().replace('value="12, 11, 9"', 'value="1, 1, 1"'))
        self.bench("--no-report")
        self.assertEqual(len(os.listdir(self.path("references"))), 2)

    def test_reference_command(self):
        self.assertIn("standard error", self.succeeds("reference", "tiny.json").out)
        (name,) = os.listdir(self.path("references"))
        first = self.read(f"references/{name}")
        self.assertIn("is there", self.succeeds("reference", "tiny.json").out)
        self.succeeds("reference", "tiny.json", "--force")
        self.assertEqual(self.read(f"references/{name}"), first)
        self.succeeds("reference", "tiny.json", "--force", "-n", "4")
        self.assertNotEqual(self.read(f"references/{name}"), first)
        self.assertEqual(self.bench("--no-report").err, "")

    def test_reference_of_another_question_is_refused(self):
        self.bench("--no-report")
        self.write("other.xml", self.read("scene.xml").decode().replace('value="12, 11, 9"', 'value="1, 1, 1"'))
        self.write_experiment(scenes=[{"file": "other.xml", "crop": [4, 4, 8, 8]}])
        self.bench("--no-report")
        scene, other = (self.path("references", n) for n in sorted(os.listdir(self.path("references")), reverse=True))
        os.replace(scene, other)
        result = self.koksma("bench", "tiny.json", "-o", "out", "--no-report")
        self.assertEqual((result.code, result.err.count("\n")), (1, 1))
        self.assertIn("remake it with 'koksma reference'", result.err)


class Statistics(BenchTest):
    def test_summary_follows_from_the_rows(self):
        self.bench("--no-report")
        _, rows = self.lines()
        (scene,) = self.summary()["scenes"]
        for sampler in scene["samplers"]:
            for point in sampler["points"]:
                mses = [r["mse"] for r in rows if (r["sampler"], r["spp"]) == (sampler["sampler"], point["spp"])]
                self.assertEqual(len(mses), point["replicates"])
                self.assertAlmostEqual(point["mse"] / (sum(mses) / len(mses)), 1, delta=1e-12)
                if not point["below_floor"]:
                    self.assertAlmostEqual(point["rmse"] ** 2 / point["mse"], 1, delta=1e-12)
                    self.assertTrue(point["rmse_lo"] < point["rmse"] < point["rmse_hi"])

    def test_no_intervals_without_a_randomisation(self):
        self.write_experiment(samplers=["random", "sobol:randomize=none"], spp=[1, 4, 16], replicates=[4, 4, 4])
        out = self.bench("--no-report").out
        self.assertIn("no interval without a randomisation", out)
        rows = [r for r in self.lines()[1] if r["sampler"] == "sobol:randomize=none"]
        self.assertEqual({r["randomized"] for r in rows}, {False})
        for spp in [1, 4, 16]:
            self.assertEqual(len({r["mse"] for r in rows if r["spp"] == spp}), 1)
        none = self.summary()["scenes"][0]["samplers"][1]
        self.assertEqual((none["sampler"], none["randomized"], none["gain_vs_random"]), ("sobol:randomize=none", False, None))
        for point in none["points"]:
            self.assertEqual([point[key] for key in ["rmse_lo", "rmse_hi", "relmse_lo", "relmse_hi"]], [None] * 4)

    def test_report_remakes_the_summary(self):
        self.bench("--no-report")
        summary, rows = self.read("out/summary.json"), self.read("out/results.jsonl")
        os.remove(self.path("out/summary.json"))
        self.environment["KOKSMA_PYTHON"] = "/bin/true"
        self.succeeds("report", "out")
        self.assertEqual((self.read("out/summary.json"), self.read("out/results.jsonl")), (summary, rows))


class Reports(BenchTest):
    @unittest.skipUnless(reports_can_be_made(), "needs numpy, matplotlib and jinja2")
    def test_report_is_one_file_that_needs_no_network(self):
        self.write_experiment(spp=[1, 4, 16], replicates=[4, 4, 4])
        self.assertIn("report: out/report.html", self.bench().out)
        page = self.read("out/report.html").decode()
        for link in re.findall(r"\s(?:src|href|srcset)=\"([^\"]+)\"", page) + re.findall(r"url\(([^)]+)\)", page):
            self.assertTrue(link.startswith(("data:", "#")) or link in self.files_beside_report(), link[:80])
        self.assertNotRegex(page, r"@import|\bfetch\(|XMLHttpRequest|<iframe|<link")
        self.assertIn("Tiny", page)
        os.remove(self.path("out/report.html"))
        self.succeeds("report", "out")
        self.assertIn("out/report.html", self.files())

    @unittest.skipUnless(reports_can_be_made(), "needs numpy, matplotlib and jinja2")
    def test_an_anonymous_copy_tells_nothing(self):
        self.succeeds("bench", self.path("tiny.json"), "-o", self.path("out"), "--no-report")  # the command line has paths
        experiment = self.lines()[0]["experiment"]
        self.write("figures.json", json.dumps({"samplers": ["random"]}))
        self.succeeds("report", "out", "--figures", "figures.json", "--anonymous")
        secrets = {experiment["machine"], experiment["commit"].rstrip("+"), self.dir}
        found, copied = set(), 0
        for root, _, names in os.walk(self.path("out", "anonymous")):
            for name in names:
                with open(os.path.join(root, name), "rb") as file:
                    content = file.read()
                found |= {secret for secret in secrets if secret.encode() in content}
                copied += 1
        self.assertEqual(found, set())
        self.assertGreater(copied, 10)
        self.assertTrue(all(secret in self.read("out/results.jsonl").decode() for secret in secrets))
        self.assertIn("out/anonymous/figures/crops/scene-random.exr", self.files())
        self.assertNotIn("out/report.html", self.files())
        self.write("figures.json", json.dumps({"sampler": ["random"]}))
        result = self.koksma("report", "out", "--figures", "figures.json")
        self.assertEqual(result.code, 1)
        self.assertIn('figures.json: unknown key "sampler"', result.err)

    def files_beside_report(self):
        return os.listdir(self.path("out"))

    def test_rows_survive_without_python(self):
        self.environment["KOKSMA_PYTHON"] = "/none/python"
        result = self.koksma("bench", "tiny.json", "-o", "out")
        self.assertEqual(result.code, 1)  # what was asked for is not there
        self.assertEqual(result.err.splitlines()[-1].count("python3-jinja2"), 1)
        self.assertIn("the rows and the tables are complete", result.err.splitlines()[-1])
        self.assertEqual(len(self.lines()[1]), 16)
        self.assertNotIn("out/report.html", self.files())
        failed = self.koksma("report", "out")
        self.assertEqual((failed.code, failed.err.count("\n")), (1, 1))
        self.assertIn("/none/python cannot be started", failed.err)


if __name__ == "__main__":
    unittest.main()
