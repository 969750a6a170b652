"""Runs that are interrupted, split, repeated or out of disk: the rows are the same, and no file holds half of one."""

import json
import os
import random
import resource
import signal
import subprocess
import time
import unittest

from harness import PROGRAM
from test_bench import BenchTest

NO_REPORT = ["bench", "tiny.json", "-o", "out", "--no-report"]


def timeless(row):
    return {k: v for k, v in row.items() if "seconds" not in k and k != "sampler_share"}


class ResumeTest(BenchTest):
    def rows_of(self, folder):
        lines = [json.loads(line) for line in self.read(f"{folder}/results.jsonl").decode().splitlines()]
        return [timeless(line) for line in lines[1:]]

    def partial_rows(self):
        """Every line is whole JSON."""
        if not os.path.exists(self.path("out/results.partial.jsonl")):
            return []
        text = self.read("out/results.partial.jsonl").decode()
        self.assertTrue(text == "" or text.endswith("\n"))
        return [json.loads(line) for line in text.splitlines()]

    def kill_after(self, seconds):
        """Starts the run and kills it. @return whether it was still at work"""
        process = subprocess.Popen([PROGRAM, *NO_REPORT], cwd=self.dir, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        time.sleep(seconds)
        ended = process.poll() is not None
        process.kill()
        process.communicate()
        return not ended

    def kill_and_compare(self, kills):
        most = max(8, 6 * kills)  # long enough in all, and short enough each, to be killed on the way
        self.write_experiment(samplers=["random", "sobol", "stratified"], spp=[4, 256], replicates=[8, most], crop_spp=4,
                              scenes=[{"file": "scene.xml", "crop": [0, 0, 16, 16]}])
        self.succeeds("bench", "tiny.json", "-o", "whole", "--no-report")
        killed, generator = 0, random.Random(5)
        for _ in range(20 * kills):
            if killed == kills:
                break
            if not self.kill_after(generator.uniform(0.02, 0.15)):
                self.fail("the run ended before it was killed often enough; it must be longer")
            killed += 1
            self.partial_rows()
        self.assertEqual(killed, kills)
        before = len(self.partial_rows())
        out = self.succeeds(*NO_REPORT).out
        self.assertEqual(self.rows_of("out"), self.rows_of("whole"))
        self.assertEqual([f for f in os.listdir(self.path("out")) if "partial" in f], [])
        if before:
            self.assertIn(f"{before} of {24 + 3 * most} rows are from earlier runs", out)
        summaries = [json.loads(self.read(f"{folder}/summary.json")) for folder in ("out", "whole")]
        points = [[(p["rmse"], p["relmse_hi"], p["metrics"]) for s in summary["scenes"] for e in s["samplers"] for p in e["points"]] for summary in summaries]
        self.assertEqual(*points)


class Killed(ResumeTest):
    def test_killed_once_and_resumed(self):
        self.kill_and_compare(1)


class KilledTenTimes(ResumeTest):
    def test_killed_ten_times_and_resumed(self):
        self.kill_and_compare(10)


class Kept(ResumeTest):
    def test_a_second_run_renders_nothing(self):
        self.bench("--no-report")
        first = self.read("out/results.jsonl").splitlines()[1:]
        self.assertIn("16 of 16 rows are from earlier runs", self.bench("--no-report").out)
        self.assertEqual(self.read("out/results.jsonl").splitlines()[1:], first)
        self.assertNotIn("earlier runs", self.bench("--no-report", "--fresh").out)

    def test_a_sampler_of_another_version_is_rendered_again_and_no_other(self):
        self.bench("--no-report")
        header, *lines = self.read("out/results.jsonl").decode().splitlines()
        self.write("out/results.jsonl", "\n".join([header, *(line.replace('"sampler_version":', '"sampler_version":9') if "sobol" in line else line for line in lines)]) + "\n")
        self.assertIn("8 of 16 rows are from earlier runs", self.bench("--no-report").out)
        self.assertEqual({r["sampler_version"] < 9 for r in self.lines()[1]}, {True})

    def test_rows_against_another_reference_are_not_kept(self):
        self.bench("--no-report")
        self.succeeds("reference", "tiny.json", "--force", "-n", "4")
        self.assertNotIn("earlier runs", self.bench("--no-report").out)

    def test_a_lost_image_is_rendered_again(self):
        self.bench("--no-report")
        os.remove(self.path("out/images/scene-random-4-1.exr"))
        self.write("out/images/scene-random-4-2.exr", "not an image")
        self.assertIn("14 of 16 rows are from earlier runs", self.bench("--no-report").out)

    def test_half_a_line_is_cut_off(self):
        self.bench("--no-report")
        lines = self.read("out/results.jsonl").decode().splitlines()
        os.remove(self.path("out/results.jsonl"))
        self.write("out/results.partial.jsonl", "\n".join(lines[1:4]) + "\n" + lines[4][:77])
        self.assertIn("3 of 16 rows are from earlier runs", self.bench("--no-report").out)
        self.write("out/results.partial.jsonl", "nonsense\n")
        self.assertIn("results.partial.jsonl:1: not a row of results", self.koksma(*NO_REPORT).err)
        self.bench("--no-report", "--fresh")


class Disk(ResumeTest):
    """A limit on the size of files stands for a full disk: writes fall short or fail."""

    def limited(self, size):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        return self.koksma(*NO_REPORT, preexec_fn=limit)

    def test_a_disk_that_fills_up_keeps_earlier_rows_and_the_run_goes_on(self):
        self.bench("--no-report")
        whole = self.rows_of("out")
        os.remove(self.path("out/results.jsonl"))
        result = self.limited(8000)
        self.assertEqual((result.code, result.err.count("\n")), (1, 1), result.err)
        rows = self.partial_rows()
        self.assertGreater(len(rows), 2)
        self.assertIn("cannot write out/results.partial.jsonl", result.err)
        self.assertIn(f"{len(rows)} rows are kept in out/results.partial.jsonl", result.err)
        self.assertEqual([timeless(r) for r in rows], whole[:len(rows)])
        self.bench("--no-report")
        self.assertEqual(self.rows_of("out"), whole)

    def test_nothing_is_left_where_not_one_row_was_made(self):
        self.bench("--no-report")
        before = self.read("out/results.jsonl")
        result = self.koksma(*NO_REPORT, "--fresh", preexec_fn=lambda: (signal.signal(signal.SIGXFSZ, signal.SIG_IGN), resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))))
        self.assertEqual((result.code, result.err.count("\n")), (1, 1), result.err)
        self.assertEqual(self.read("out/results.jsonl"), before)
        self.assertFalse(os.path.exists(self.path("out/results.partial.jsonl")))

    def test_output_that_cannot_be_written(self):
        self.write("file", "")
        result = self.koksma("bench", "tiny.json", "-o", "file/out", "--no-report")
        self.assertEqual((result.code, result.err.count("\n")), (1, 1), result.err)
        self.assertIn("cannot make the folder file/out", result.err)


class Shards(ResumeTest):
    def shards(self, *parts):
        for part in parts:
            self.succeeds(*NO_REPORT, "--shard", part)
        return ["out/shard-" + part.replace("/", "-of-") for part in parts]

    def test_merged_parts_have_the_rows_of_one_run(self):
        self.write_experiment(layouts=3, progressive=2, samplers=["random", "sobol", "halton"])
        self.succeeds("bench", "tiny.json", "-o", "whole", "--no-report")
        folders = self.shards("2/3", "1/3", "3/3")
        self.assertTrue(all(len(self.rows_of(f)) > 10 for f in folders))
        out = self.succeeds("merge", *folders, "-o", "merged", "--no-report").out
        self.assertEqual(self.rows_of("merged"), self.rows_of("whole"))
        self.assertIn("Luck of dimensions", out)
        for name in ("images", "pictures"):
            self.assertEqual(sorted(os.listdir(self.path("merged", name))), sorted(os.listdir(self.path("whole", name))))
            for file in os.listdir(self.path("whole", name)):
                self.assertEqual(self.read(f"merged/{name}/{file}"), self.read(f"whole/{name}/{file}"))

    def test_refusals(self):
        for bad in ("0/3", "4/3", "1", "a/b", "1/3x", "/3", "1/"):
            self.refuses(2, [*NO_REPORT, "--shard", bad], "--shard", "1 <= k <= n")
        first, second = self.shards("1/2", "2/2")
        self.refuses(1, ["merge", first, "-o", "merged"], "parts are missing: 2/2")
        self.refuses(1, ["merge", first, first, "-o", "merged"], "part 1 is given twice")
        self.refuses(2, ["merge", first, second, "-o", first], "is one of the parts")
        self.bench("--no-report")
        self.refuses(1, ["merge", first, "out", "-o", "merged"], "not a part")
        self.write_experiment(title="Other")
        (other,) = self.shards("2/2")
        self.refuses(1, ["merge", first, other, "-o", "merged"], "not parts of one run", "title")


class Prices(ResumeTest):
    def test_a_dry_run_prices_what_a_run_renders(self):
        out = self.succeeds("bench", "tiny.json", "--dry-run").out
        self.assertRegex(out, r"\nscene +16 +2560 ")
        self.assertRegex(out, r"about .* of CPU time")
        shard = self.succeeds("bench", "tiny.json", "--dry-run", "--shard", "1/2").out
        self.assertRegex(shard, r"\nscene +\d+ +1280 ")
        self.bench("--no-report")
        self.assertIn("16 rows of earlier runs", self.bench("--dry-run").out)


if __name__ == "__main__":
    unittest.main()
