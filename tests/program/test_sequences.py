"""check, points, rates and card: looking at a sequence without a scene."""

import ast
import struct
import unittest

from harness import ProgramTest


class Samplers(ProgramTest):
    def test_eighteen_and_what_each_says_of_itself(self):
        all_of_them = self.succeeds("samplers", "--json").json()
        self.assertGreaterEqual(len(all_of_them), 18)
        for sampler in all_of_them:
            self.assertLessEqual({"name", "options", "kind", "scope", "joint_group", "good_counts", "max_dimensions", "max_samples", "remark"}, set(sampler))
        remarks = [s["remark"] for s in all_of_them if s["remark"]]
        text = self.succeeds("samplers").out
        self.assertIn("finite tables", remarks)
        for remark in remarks:
            self.assertIn("    " + remark + "\n", text)


class Check(ProgramTest):
    def test_a_line_a_check(self):
        lines = self.succeeds("check", "random").out.splitlines()
        self.assertEqual(lines[0], "random")
        self.assertTrue(all(line.split()[0] in ("held", "-") for line in lines[1:-1]), lines)
        self.assertIn("0 failed", lines[-1])

    def test_options_that_are_not_given_are_all_tried(self):
        both = self.succeeds("check", "lhs", "--json", "--seed", "3").json()
        self.assertEqual([s["sampler"] for s in both["samplers"]], ["lhs", "lhs:pixels=shared"])
        self.assertEqual((both["seed"], both["failed"]), (3, 0))
        one = self.succeeds("check", "lhs:pixels=shared", "--json").json()
        self.assertEqual([s["sampler"] for s in one["samplers"]], ["lhs:pixels=shared"])

    def test_unknown_names(self):
        self.refuses(2, ["check", "bogus"], "unknown sampler 'bogus'", "random")


class Points(ProgramTest):
    SOBOL = [[0, 0, 0], [0.5, 0.5, 0.5], [0.25, 0.75, 0.75], [0.75, 0.25, 0.25]]

    def test_text_and_csv(self):
        out = self.succeeds("points", "sobol:randomize=none", "-n", "4", "--dims", "3").out
        self.assertEqual([[float(x) for x in line.split()] for line in out.splitlines()], self.SOBOL)
        self.succeeds("points", "sobol:randomize=none", "-n", "4", "-d", "3", "--csv", "p.csv")
        self.assertEqual(self.read("p.csv").decode().replace(",", " "), out)

    def test_npy(self):
        self.succeeds("points", "sobol:randomize=none", "-n", "4", "-d", "3", "--npy", "p.npy")
        data = self.read("p.npy")
        self.assertEqual(data[:8], b"\x93NUMPY\x01\x00")
        size, = struct.unpack("<H", data[8:10])
        self.assertEqual((10 + size) % 64, 0)
        self.assertEqual(ast.literal_eval(data[10:10 + size].decode()), {"descr": "<f4", "fortran_order": False, "shape": (4, 3)})
        self.assertEqual(list(struct.unpack("<12f", data[10 + size:])), [x for row in self.SOBOL for x in row])

    def test_seed_and_pixel_choose_the_randomization(self):
        points = {self.succeeds("points", "sobol", "-n", "2", *more).out for more in ([], ["--seed", "1"], ["--pixel", "1,0"])}
        self.assertEqual(len(points), 3)

    def test_limits_are_refused_with_the_number(self):
        self.refuses(2, ["points", "halton", "-d", "1025"], "1024 dimensions", "1025")
        self.refuses(1, ["points", "stratified", "-n", "16777217"], "16777216", "16777217")
        self.refuses(2, ["points", "random", "-n", "0"], "--n")
        self.refuses(2, ["points", "random", "--csv", "a", "--npy", "b"], "--csv", "--npy")


class Rates(ProgramTest):
    def test_joint_and_padded_side_by_side(self):
        arguments = ["rates", "-s", "sobol", "-s", "sobol-padded", "-i", "prodlin6", "-r", "64"]
        slopes = {s["sampler"].split(":")[0]: s["rates"][0] for s in self.succeeds(*arguments, "--json").json()}
        self.assertLess(slopes["sobol"]["hi"], -1.1)
        self.assertGreater(slopes["sobol-padded"]["lo"], -0.7)
        self.assertEqual([e["n"] for e in slopes["sobol"]["errors"]], [64, 128, 256, 512, 1024, 2048, 4096])
        self.assertIn("prodlin6", self.succeeds(*arguments).out)

    def test_named_set(self):
        names = [s["sampler"].split(":")[0] for s in self.succeeds("rates", "--set", "joint-padded", "-r", "8", "-n", "256", "--json").json()]
        self.assertEqual(names, ["sobol", "sobol-4d", "sobol-padded", "pmj02", "lhs", "random"])
        self.refuses(2, ["rates", "--set", "bogus"], "unknown set 'bogus'", "joint-padded")

    def test_refusals(self):
        self.refuses(2, ["rates", "-i", "bogus"], "unknown integrand 'bogus'", "gauss2")
        self.refuses(2, ["rates", "-s", "sobol:randomize=none"], "not randomized")
        self.refuses(2, ["rates", "-s", "sobol", "-n", "64"], "two good counts")


class Card(ProgramTest):
    def test_numbers(self):
        card = self.succeeds("card", "sobol", "--json").json()
        self.assertEqual(card["info"]["name"], "sobol")
        pairs = {(p["a"], p["b"]): p["t"] for p in card["quality"]["pairs"]}
        self.assertEqual((pairs[0, 1], pairs[0, 7], pairs[1, 7]), (0, 3, 2))
        self.assertEqual(sum(card["quality"]["histogram"][3]["count"]), 70)
        for row in card["discrepancies"]:
            self.assertLessEqual(row["star1"], row["star2"] + 1e-12)
            for smaller, bounds in ((row["star2"], row["star3"]), (row["star3"]["lo"], row["star4"])):  # a projection is no worse
                self.assertLessEqual(bounds["lo"], bounds["hi"])
                self.assertLessEqual(smaller, bounds["hi"] + 1e-12)
        for row in card["discrepancies"]:
            if row["good"] and row["n"] >= 64:
                self.assertLess(row["l2star2"], row["random2"])

    def test_page_is_one_file_without_links(self):
        result = self.koksma("card", "stratified", "-o", "card.html")
        if result.code != 0 and "python3-matplotlib" in result.err:
            self.skipTest("matplotlib is not installed")
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(self.files(), ["card.html", "scene.xml"])
        page = self.read("card.html").decode()
        self.assertGreaterEqual(page.count("<svg"), 6)
        self.assertNotIn("http://www.", page.replace("http://www.w3.org", ""))
        self.assertNotIn("<script", page)

    def test_refusals(self):
        self.refuses(2, ["card", "bogus"], "unknown sampler 'bogus'")


if __name__ == "__main__":
    unittest.main()
