"""References: made in steps, refused when a half is wrong, checked by a third render."""

import os
import struct
import subprocess
import time
import unittest

from exr import Exr
from harness import PROGRAM
from test_bench import BenchTest


def write_exr(path, image, change):
    """Writes an Exr again, uncompressed. `change(name, value)` gives the values of its channels."""
    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data

    names = sorted(image.channels)
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in names) + b"\0"
    header = struct.pack("<II", 20000630, 2) + b"".join([
        attribute("channels", "chlist", channels), attribute("compression", "compression", b"\0"), attribute("dataWindow", "box2i", struct.pack("<4i", *image.data_window)),
        attribute("displayWindow", "box2i", struct.pack("<4i", *image.display_window)), attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)), attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)),
        *(attribute(name, "string", value.encode()) for name, value in image.attributes.items())]) + b"\0"
    line = 8 + 4 * len(names) * image.width
    start = len(header) + 8 * image.height
    with open(path, "wb") as file:
        file.write(header + b"".join(struct.pack("<Q", start + y * line) for y in range(image.height)))
        for y in range(image.height):
            file.write(struct.pack("<ii", image.data_window[1] + y, line - 8))
            for name in names:
                file.write(struct.pack(f"<{image.width}f", *(change(name, v) for v in image.channels[name][y])))


class References(BenchTest):
    def setUp(self):
        super().setUp()
        self.write_experiment(reference={"samplers": ["sobol", "halton"], "replicates": 8, "spp": 64})

    def rewrite(self, change):
        (name,) = os.listdir(self.path("references"))
        write_exr(self.path("references", name), Exr(self.path("references", name)), change)

    def test_a_wrong_half_is_refused(self):
        self.succeeds("reference", "tiny.json")
        self.rewrite(lambda name, value: value)
        self.bench("--no-report")  # the same numbers in another file
        self.rewrite(lambda name, value: value * (1.3 if name.startswith("b.mean") else 1))
        for command in (["bench", "tiny.json", "-o", "out", "--no-report"], ["reference", "tiny.json", "--check"]):
            result = self.koksma(*command)
            self.assertEqual((result.code, result.err.count("\n")), (1, 1), result.err)
            self.assertIn("the two halves of the reference of scene (sobol:randomize=owen and halton:randomize=owen) disagree: z =", result.err)

    def test_a_stale_one_is_refused(self):
        self.succeeds("reference", "tiny.json")
        (name,) = os.listdir(self.path("references"))
        content = self.read(f"references/{name}")
        start = content.index(b"estimator version ") + len(b"estimator version ")
        self.assertTrue(content[start:start + 1].isdigit())
        content = content[:start] + b"0" + content[start + 1:]
        digest = name.rsplit("-", 1)[1].split(".")[0].encode()  # as a program with another estimator has it, whose expected image may be another one
        self.assertIn(digest, content)
        with open(self.path("references", name), "wb") as file:
            file.write(content.replace(digest, digest[::-1]))
        result = self.koksma("bench", "tiny.json", "-o", "out", "--no-report")
        self.assertEqual((result.code, result.err.count("\n")), (1, 1), result.err)
        self.assertIn("estimator version 0", result.err)
        self.assertIn("remake it with 'koksma reference'", result.err)

    def test_a_third_render_sees_what_both_halves_have_wrong(self):
        out = self.succeeds("reference", "tiny.json", "--check").out
        self.assertRegex(out, r"agrees with independent random numbers, roulette from depth 1 instead of 5: largest z of an 8x8 block \d\.\d\d \(limit \d+\.\d\)")
        self.assertRegex(out, r"A bias of [\d.]+ % of the mean in a typical block, or of [\d.]+ % in the whole image, would have been seen")
        self.rewrite(lambda name, value: value * (1.5 if ".mean" in name else 1))
        result = self.koksma("reference", "tiny.json", "--check")
        self.assertEqual((result.code, result.err.count("\n")), (1, 1), result.err)
        self.assertIn("disagrees with another estimator", result.err)

    def test_a_reference_that_was_killed_goes_on_with_the_same_bits(self):
        self.write_experiment(reference={"samplers": ["sobol", "halton"], "replicates": 8, "spp": 4096})
        command = ["reference", "tiny.json"]
        self.succeeds(*command, "-o", "whole")
        (name,) = os.listdir(self.path("whole"))
        process = subprocess.Popen([PROGRAM, *command, "-o", "killed"], cwd=self.dir, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(2000):
            if process.poll() is not None or (os.path.isdir(self.path("killed")) and any(f.endswith(".steps") for f in os.listdir(self.path("killed")))):
                break
            time.sleep(0.005)
        process.kill()
        process.wait()
        self.assertEqual([f.split(".")[-1] for f in os.listdir(self.path("killed")) if "tmp" not in f], ["steps"])
        self.succeeds(*command, "-o", "killed")
        self.assertEqual(self.read(f"killed/{name}"), self.read(f"whole/{name}"))
        self.assertEqual([f for f in os.listdir(self.path("killed")) if f.endswith(".steps")], [])


if __name__ == "__main__":
    unittest.main()
