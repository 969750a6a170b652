"""plan and samplers: what a scene calls for and what there is, as text and as JSON."""

import json
import os
import unittest

from harness import ProgramTest

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes")


class Plan(ProgramTest):
    def test_text(self):
        out = self.succeeds("plan", "scene.xml", "--max-depth", "4").out
        for words in ["effects        ", "area_light", "kernel         batch/diffuse (admissible:", "reference/all", "dimensions a path",
                      "film [0-1]", "light position [", "direction [", "tail           not reached"]:
            self.assertIn(words, out)

    def test_json_lists_every_slot_once(self):
        plan = self.succeeds("plan", "scene.xml", "--max-depth", "4", "--json").json()
        self.assertEqual(set(plan), {"scene", "effects", "called_for", "kernel", "sampler", "dimensions", "tail_dimension", "tail_bounce", "slots"})
        dimension = 0
        for slot in plan["slots"]:
            self.assertEqual(set(slot), {"role", "bounce", "dimension", "arity"})
            self.assertEqual(slot["dimension"], dimension)
            dimension += slot["arity"]
        self.assertEqual((plan["dimensions"], plan["tail_dimension"]), (dimension, dimension))
        self.assertEqual(plan["slots"][0], {"role": "film", "bounce": -1, "dimension": 0, "arity": 2})

    def test_effects_follow_the_scene(self):
        plain, glass = (self.succeeds("plan", "scene.xml", "-D", f"bsdf={bsdf}", "--json").json() for bsdf in ["diffuse", "dielectric"])
        self.assertLess(set(plain["effects"]), set(glass["effects"]))
        self.assertLess(plain["dimensions"], glass["dimensions"])

    def test_text_and_json_agree(self):
        plan = self.succeeds("plan", "scene.xml", "--json").json()
        out = self.succeeds("plan", "scene.xml").out
        self.assertIn(f"slots          {plan['dimensions']} dimensions", out)
        self.assertIn(f"effects        {', '.join(plan['effects'])}\n", out)
        self.assertIn(f"kernel         {plan['kernel']} ", out)

    def test_cornell_has_no_dimension_that_it_does_not_call_for(self):
        plan = self.succeeds("plan", os.path.join(SCENES, "cornell.xml"), "--json").json()
        roles = {slot["role"] for slot in plan["slots"]}
        self.assertEqual(roles, {"film", "light position", "direction", "roulette"})
        for effect in ["lens", "motion", "instancing", "light_choice", "lobe", "texture"]:
            self.assertNotIn(effect, plan["effects"])

    def test_effects_can_be_more_than_needed(self):
        few, more, most = (self.succeeds("plan", "scene.xml", "--json", "--effects", e).json() for e in ["needed", "needed,lens,motion", "all"])
        self.assertEqual(few, self.succeeds("plan", "scene.xml", "--json").json())
        self.assertEqual(set(more["effects"]), set(few["effects"]) | {"lens", "motion"})
        self.assertEqual(more["dimensions"], few["dimensions"] + 3)
        self.assertEqual([s["role"] for s in more["slots"][:3]], ["film", "lens", "time"])
        self.assertLess(set(more["effects"]), set(most["effects"]))
        self.assertEqual(most["kernel"], "batch/all")

    def test_effects_cannot_be_fewer_than_needed(self):
        self.refuses(2, ["plan", "scene.xml", "--effects", "lens"], "lack what the scene calls for", "area_light")
        self.refuses(2, ["plan", "scene.xml", "--effects", "needed,lense"], "unknown effect 'lense'", "lens, ")

    def test_a_forced_set_renders_the_same_picture_up_to_noise(self):
        means = []
        for effects in ["needed", "all"]:
            self.succeeds("render", "scene.xml", "-q", "-o", "out.exr", "-n", "256", "--effects", effects, "--stats", "stats.json")
            means.append(json.loads(self.read("stats.json"))["mean_rgb"][1])
        self.assertAlmostEqual(means[0], means[1], delta=0.02 * means[0])

    def test_endless_paths_end_in_the_tail(self):
        self.assertIn("draw from it", self.succeeds("plan", "scene.xml", "--max-depth", "-1").out)


class Samplers(ProgramTest):
    def test_json_has_what_the_text_has(self):
        samplers = self.succeeds("samplers", "--json").json()
        out = self.succeeds("samplers").out
        self.assertLessEqual({"random", "stratified", "halton", "sobol"}, {s["name"] for s in samplers})
        for sampler in samplers:
            self.assertLessEqual({"name", "title", "paper", "version", "kind", "scope", "joint_group", "good_counts", "options",
                                  "max_dimensions", "max_samples"}, set(sampler))
            self.assertIn(sampler["kind"], ["sequence", "set"])
            self.assertIn(f"{sampler['name']}  ({sampler['title']})", out)
            self.assertIn(sampler["paper"], out)
            for option in sampler["options"]:
                self.assertIn(f"{option['name']}={'|'.join(option['values'])} (default {option['default']})", out)

    def test_every_sampler_and_every_value_of_its_options_renders(self):
        for sampler in self.succeeds("samplers", "--json").json():
            specs = [sampler["name"]] + [f"{sampler['name']}:{o['name']}={v}" for o in sampler["options"] for v in o["values"]]
            for spec in specs:
                self.succeeds("render", "scene.xml", "-q", "-o", "out.exr", "-s", spec, "-n", "4", "-D", "res=4")


if __name__ == "__main__":
    unittest.main()
