"""Files that are missing, wrong or cannot be written: exit code 1, one line, and no half-written or temporary file."""

import os
import re
import resource
import unittest

from harness import SCENE, ProgramTest

RENDER = ["render", "scene.xml", "-q"]


class Scenes(ProgramTest):
    def refuses_scene(self, content, *words):
        self.write("bad.xml", content)
        self.refuses(1, ["render", "bad.xml", "-q", "-o", "out.exr"], "bad.xml", *words)
        self.refuses(1, ["plan", "bad.xml"], "bad.xml", *words)

    def test_missing_scene(self):
        self.refuses(1, ["render", "none.xml", "-q", "-o", "out.exr"], "none.xml", "No such file")
        self.refuses(1, ["render", ".", "-q", "-o", "out.exr"], "directory")

    def test_malformed_xml_is_told_with_line_and_column(self):
        self.refuses_scene("<scene version='3.0.0'>\n  <shape", "bad.xml:2:", "not well-formed XML")
        self.refuses_scene("", "not well-formed XML")

    def test_unknown_words_are_errors(self):
        self.refuses_scene(SCENE.replace('type="cube"', 'type="cubus"'), "cubus", "cube")
        self.refuses_scene(SCENE.replace('name="fov"', 'name="fvo"'), "no parameter 'fvo'", "supported:")

    def test_missing_mesh(self):
        self.refuses_scene(SCENE.replace('<shape type="cube">', '<shape type="ply"><string name="filename" value="none.ply"/>'),
                           "none.ply", "there is no file")

    def test_empty_film(self):
        self.refuses(1, [*RENDER, "-o", "out.exr", "-D", "res=0"], "scene.xml:", "width", "0")

    @unittest.skipIf("KOKSMA_SANITIZED" in os.environ, "a sanitizer's operator new ends the program where it should throw")
    def test_enormous_film(self):
        self.refuses(1, [*RENDER, "-o", "out.exr", "-D", "res=1048576"], "out of memory", "--crop")

    def test_no_samples(self):
        self.refuses(1, [*RENDER, "-o", "out.exr", "-D", "spp=0"], "sample_count", "0")

    def test_parameter_of_wrong_type(self):
        self.refuses(1, [*RENDER, "-o", "out.exr", "-D", "res=abc"], "scene.xml:", "abc", "width")

    def test_unused_parameter(self):
        self.refuses(1, [*RENDER, "-o", "out.exr", "-D", "bogus=1"], "'bogus'", "not used", "bsdf, res, spp")

    def test_more_samples_than_a_sampler_has(self):
        self.refuses(1, [*RENDER, "-o", "out.exr", "-s", "stratified", "-n", "5000000000"], "stratified", "at most", "5000000000")


class Outputs(ProgramTest):
    def test_folder_that_does_not_exist(self):
        self.refuses(1, [*RENDER, "-o", "none/out.exr"], "none/out.exr", "No such file", "folder that exists")

    def test_output_is_a_folder(self):
        os.mkdir(self.path("out.exr"))
        self.refuses(1, [*RENDER, "-o", "out.exr"], "out.exr", "it is a folder")

    def test_folder_that_cannot_be_written(self):  # below a file: refused even to root
        self.refuses(1, [*RENDER, "-o", "scene.xml/out.exr"], "scene.xml/out.exr", "Not a directory")
        self.refuses(1, [*RENDER, "-o", "out.exr", "--stats", "scene.xml/out.json"], "scene.xml/out.json", "Not a directory")

    def test_unwritable_output_is_told_before_the_scene_is_read(self):
        self.refuses(1, ["render", "none.xml", "-o", "none/out.exr"], "none/out.exr")


class FullDisk(ProgramTest):
    """A limit on the size of files stands for the full disk: it needs no root, and write() fails in the same way."""

    def limited(self, size, *arguments):
        return self.koksma(*arguments, restore_signals=False,  # Python ignores SIGXFSZ, and so does the child: write() returns an error
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))

    def check_image(self, resolution, *sizes):
        render = [*RENDER, "-D", f"res={resolution}"]
        self.succeeds(*render, "-o", "old.exr")
        old, before = self.read("old.exr"), self.files()
        for size in sizes:
            self.assertLess(size, len(old))
            for name in ["old.exr", "new.exr"]:
                result = self.limited(size, *render, "-o", name, "--seed", "1")
                self.assertEqual(result.code, 1)
                self.assertRegex(result.err, rf"^koksma: cannot write {name}: [^\n]+\n$")
                self.assertEqual(self.files(), before)
                self.assertEqual(self.read("old.exr"), old)

    def test_image(self):
        self.check_image(64, 0, 1000, 10000)

    def test_small_image(self):
        self.check_image(4, 0, 100, 600)

    def test_statistics(self):
        result = self.limited(100, *RENDER, "-D", "res=1", "-o", "scene.exr", "--stats", "out.json")
        self.assertEqual(result.code, 1)
        self.assertEqual(result.err.count("\n"), 1)
        self.assertNotIn("out.json", self.files())

    def test_experiment_leaves_whole_rows_only(self):
        self.write("tiny.json", """{"title": "Tiny", "scenes": [{"file": "scene.xml", "crop": [4, 4, 8, 8]}], "samplers": ["random"],
            "spp": [1, 2], "replicates": [4, 4], "picture_size": 4, "picture_spp": 1, "crop_spp": 999,
            "reference": {"samplers": ["sobol", "halton"], "replicates": 2, "spp": 4}}""")
        self.succeeds("reference", "tiny.json")
        result = self.limited(2500, "bench", "tiny.json", "-o", "out")
        self.assertEqual(result.code, 1)
        self.assertRegex(result.err, r"^koksma: cannot write out/[^\n]+\n$")
        for name in self.files():
            self.assertIsNone(re.search(r"\.tmp\d*$|out/results\.jsonl|summary|report", name), name)
        self.assertTrue(self.read("out/results.partial.jsonl").endswith(b"}\n"))


class Comparing(ProgramTest):
    def test_missing_file(self):
        self.succeeds(*RENDER, "-o", "a.exr")
        self.refuses(1, ["compare", "a.exr", "none.exr"], "none.exr", "no such file")
        self.refuses(1, ["compare", "none.exr", "a.exr"], "none.exr", "no such file")

    def test_not_an_image(self):
        self.succeeds(*RENDER, "-o", "a.exr")
        self.refuses(1, ["compare", "a.exr", "scene.xml"], "scene.xml", "OpenEXR")
        self.refuses(1, ["compare", "a.exr", "."], "OpenEXR", "directory")

    def test_truncated_image(self):
        self.succeeds(*RENDER, "-o", "a.exr")
        with open(self.path("cut.exr"), "wb") as file:
            file.write(self.read("a.exr")[:300])
        self.refuses(1, ["compare", "cut.exr", "a.exr"], "cut.exr")

    def test_different_sizes(self):
        self.succeeds(*RENDER, "-o", "a.exr")
        self.succeeds(*RENDER, "-o", "b.exr", "-D", "res=8")
        self.refuses(1, ["compare", "a.exr", "b.exr"], "16x16", "8x8")


if __name__ == "__main__":
    unittest.main()
