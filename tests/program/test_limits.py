"""limits: rendering against Embree alone; its counts are held here, its times are for people."""

import json
import os
import subprocess
import sys
import unittest

from harness import PROGRAM, ProgramTest

SMALL = ["-D", "res=24", "--spp", "4", "--rounds", "2"]


class Distance(ProgramTest):
    def figures(self, *arguments):
        self.succeeds("limits", *arguments, "--json", "limits.json")
        return json.loads(self.read("limits.json"))

    def test_table(self):
        out = self.succeeds("limits", "scene.xml", *SMALL).out
        for words in ["Embree", "T/E1", "T/Eown", "E1: rays one by one", "Eown: its own packets", "batch/diffuse", "reference/diffuse", "rays per path: "]:
            self.assertIn(words, out)
        self.assertNotIn("NOT", out)

    def test_json(self):
        all_figures = self.figures("scene.xml", *SMALL)
        self.assertEqual(all_figures["measures"], "distance")
        self.assertTrue(all_figures["robust"])
        (scene,) = all_figures["scenes"]
        self.assertTrue(scene["same_rays"] and scene["same_answers"])
        self.assertEqual([k["kernel"] for k in scene["kernels"]], ["batch/diffuse", "reference/diffuse"])
        for kernel in scene["kernels"]:
            ratio = kernel["t_over_e1"]
            self.assertTrue(0 < ratio["min"] <= ratio["median"] <= ratio["max"])
            self.assertGreater(kernel["closest_rays_per_path"], 1)
            self.assertTrue(0 < kernel["sampler_share"] < 1)
        batch, reference = scene["kernels"]
        for rays in ["closest_rays_per_path", "shadow_rays_per_path"]:
            self.assertAlmostEqual(batch[rays], reference[rays], delta=1e-4 * reference[rays])
        self.assertIn("t_over_eown", batch)
        self.assertNotIn("t_over_eown", reference)

    def test_several_scenes_and_a_chosen_kernel(self):
        self.write("glass.xml", self.read("scene.xml").decode().replace('name="bsdf" value="diffuse"', 'name="bsdf" value="dielectric"'))
        scenes = self.figures("scene.xml", "glass.xml", *SMALL, "--kernel", "reference/all", "--not-robust")["scenes"]
        self.assertEqual([s["scene"] for s in scenes], ["scene.xml", "glass.xml"])
        self.assertEqual([k["kernel"] for k in scenes[0]["kernels"]], ["reference/all", "reference/diffuse"])
        self.assertNotIn("eown_ns_per_path", scenes[0])  # it traces single rays

    def test_scaling(self):
        (scene,) = self.figures("scene.xml", *SMALL, "--scaling")["scenes"]
        self.assertEqual(scene["threads"], 2)
        for what in ["render", "arithmetic", "ratio"]:
            self.assertGreater(scene[what]["median"], 0)

    def test_refusals(self):
        self.refuses(2, ["limits"], "scenes", "koksma limits --help")
        self.refuses(2, ["limits", "scene.xml", "--kernel", "bogus"], "unknown kernel 'bogus'", "batch/all")
        self.refuses(2, ["limits", "scene.xml", "--rounds", "0"], "--rounds")
        self.refuses(2, ["limits", "scene.xml", "--scaling", "--growth"], "--scaling", "--growth")
        self.refuses(1, ["limits", "none.xml"], "none.xml")
        self.refuses(1, ["limits", "scene.xml", "--json", "nowhere/limits.json"], "nowhere")


class LargeScenes(ProgramTest):
    """bench/scenes/make_scenes.py, small."""

    def test_they_load_and_have_what_their_names_say(self):
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../bench/scenes/make_scenes.py")
        subprocess.run([sys.executable, "-B", script, self.path("large"), "--triangles", "5000"], check=True)
        self.assertLessEqual({"large/terrain.xml", "large/terrain.ply", "large/glass.xml", "large/glass.ply", "large/sky.hdr"}, set(self.files()))
        out = self.succeeds("plan", "large/terrain.xml").out
        self.assertIn("geometry       5002 triangles", out)
        effects = self.succeeds("plan", "large/glass.xml", "--json").json()["effects"]
        self.assertLessEqual({"dielectric", "environment"}, set(effects))
        out = self.succeeds("limits", "large/terrain.xml", "large/glass.xml", "-D", "res=16", "--spp", "4", "--rounds", "1").out
        self.assertNotIn("NOT", out)


class Growth(ProgramTest):
    """What a render costs by counted quantities; `koksma limits --growth` shows the times."""

    def render(self, spp, res=16):
        command = [PROGRAM, "render", "scene.xml", "-o", "out.exr", "--stats", "stats.json", "--threads", "1", "-q", "-D", f"res={res}", "--spp", str(spp),
                   "--sampler", "sobol:randomize=owen"]
        process = subprocess.Popen(command, cwd=self.dir)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return json.loads(self.read("stats.json")), usage

    def test_memory_does_not_grow_with_samples_and_rays_grow_in_proportion(self):
        few, few_usage = self.render(64)
        many, many_usage = self.render(16384)
        self.assertEqual(many["paths"], 256 * few["paths"])
        self.assertAlmostEqual(many["rays"] / many["paths"], few["rays"] / few["paths"], delta=0.02 * few["rays"] / few["paths"])
        self.assertEqual(many["tail_numbers"], 0)
        # One more float a sample would be 16 MB; pages come and go by less than four.
        self.assertLess(many_usage.ru_maxrss - few_usage.ru_maxrss, 4096)

    @unittest.skipIf("KOKSMA_SANITIZED" in os.environ, "a sanitizer keeps memory of its own for every byte")
    def test_memory_grows_with_pixels_by_the_film_alone(self):
        small, small_usage = self.render(1, res=64)
        large, large_usage = self.render(1, res=512)
        self.assertEqual(large["paths"], 64 * small["paths"])
        # Sums of 48 bytes and counts of 8, means as floats for the image and the file.
        bytes_per_pixel = 1024 * (large_usage.ru_maxrss - small_usage.ru_maxrss) / (512 * 512 - 64 * 64)
        self.assertLess(bytes_per_pixel, 200)


if __name__ == "__main__":
    unittest.main()
