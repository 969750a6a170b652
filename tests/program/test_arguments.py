"""Wrong usage: exit code 2, one line that says what to do, nothing written."""

import unittest

from harness import ProgramTest

COMMANDS = ["render", "bench", "compare", "plan", "samplers", "check", "points", "rates", "card", "reference", "report", "replay"]
SCENE = ["render", "scene.xml", "-q", "-o", "out.exr"]


class Help(ProgramTest):
    def test_help_names_all_commands_and_the_exit_codes(self):
        result = self.succeeds("--help")
        self.assertEqual(result.err, "")
        self.assertIn("Exit codes: 0 success, 1 failure, 2 wrong usage", result.out)
        for command in COMMANDS:
            self.assertIn(f"\n  {command} ", result.out)

    def test_every_command_has_help(self):
        for command in COMMANDS:
            result = self.succeeds(command, "--help")
            self.assertEqual(result.err, "")
            self.assertIn(f"Usage: koksma {command}", result.out)

    def test_version_names_program_commit_and_embree(self):
        self.assertRegex(self.succeeds("--version").out, r"^koksma \d+\.\d+\.\d+ \([^)]+\), Embree \d")

    def test_full_standard_output_is_a_failure(self):
        with open("/dev/full", "w") as full:
            result = self.koksma("samplers", stdout=full)
        self.assertEqual(result.code, 1)
        self.assertIn("cannot write to standard output", result.err)


class Usage(ProgramTest):
    def test_commands(self):
        self.refuses(2, [], "a command is required", "render, bench")
        self.refuses(2, ["frobnicate"], "unknown command 'frobnicate'", "render, bench")

    def test_options(self):
        self.refuses(2, ["render"], "scene is required", "koksma render --help")
        self.refuses(2, ["render", "scene.xml"], "--output", "koksma render --help")
        self.refuses(2, [*SCENE, "--bogus"], "--bogus", "koksma render --help")
        self.refuses(2, [*SCENE, "more"], "more", "koksma render --help")
        self.refuses(2, [*SCENE, "--threads", "5000"], "--threads", "4096")
        self.refuses(2, ["samplers", "more"], "more", "koksma samplers --help")

    def test_counts_neither_wrap_around_nor_saturate(self):
        for option in ["--spp", "--seed"]:
            for value in ["-3", "1.5", "abc", "", "99999999999999999999999"]:
                self.refuses(2, [*SCENE, option, value], option)
        self.refuses(2, ["replay", "scene.xml", "--pixel", "1,1", "--sample", "-1"], "--sample", "-1")
        self.refuses(2, ["reference", "--spp", "-1"], "--spp", "-1")

    def test_samples(self):
        self.refuses(2, [*SCENE, "--spp", "0"], "--spp", "1 or more")
        self.refuses(2, [*SCENE, "--seed", str(2**63)], "--seed", "below 2^63")
        self.succeeds(*SCENE, "--seed", str(2**63 - 1))

    def test_path_lengths(self):
        self.refuses(2, [*SCENE, "--max-depth", "-2"], "--max-depth", "-1 (no limit)")
        self.refuses(2, [*SCENE, "--rr-depth", "-1"], "--rr-depth", "0 or more")

    def test_crops(self):
        for crop in ["0,0,17,4", "0,0,4,17", "16,0,1,1", "-1,0,4,4", "0,0,0,4", "2147483647,0,2147483647,4"]:
            self.refuses(2, [*SCENE, "--crop", crop], f"--crop {crop}", "16x16")
        self.refuses(2, [*SCENE, "--crop", "0,0,4"], "--crop")

    def test_samplers_and_their_options(self):
        self.refuses(2, [*SCENE, "-s", "bogus"], "unknown sampler 'bogus'", "random", "sobol")
        self.refuses(2, [*SCENE, "-s", ""], "unknown sampler ''", "random", "sobol")
        self.refuses(2, [*SCENE, "-s", "sobol:bogus=1"], "no option 'bogus'", "randomize")
        self.refuses(2, [*SCENE, "-s", "sobol:randomize=bogus"], "randomize=bogus", "none", "owen")
        self.refuses(2, [*SCENE, "-s", "sobol:randomize"], "needs a value", "randomize=owen")
        self.refuses(2, [*SCENE, "-s", "random:seed=1"], "its options are: none")
        self.refuses(2, ["plan", "scene.xml", "-s", "bogus"], "unknown sampler 'bogus'", "random", "sobol")

    def test_kernels(self):
        self.refuses(2, [*SCENE, "--kernel", "bogus"], "unknown kernel 'bogus'", "reference/all")
        self.refuses(2, [*SCENE, "-D", "bsdf=dielectric", "--kernel", "reference/diffuse"], "reference/diffuse", "lacks effects")

    def test_scene_parameters(self):
        self.refuses(2, [*SCENE, "-D", "res"], "-D res", "name=value")
        self.refuses(2, [*SCENE, "-D", "=16"], "-D =16", "name=value")
        self.refuses(2, [*SCENE, "-D"], "-D")

    def test_names_of_output(self):
        self.refuses(2, ["render", "scene.xml", "-o", "out.png"], "out.png", ".exr")
        self.refuses(2, ["render", "scene.xml", "-o", ""], "--output", ".exr")
        self.refuses(2, [*SCENE, "--stats", "out.exr"], "--stats", "same file")


if __name__ == "__main__":
    unittest.main()
