"""koksma bench budget: where the error of a scene comes from."""

import json
import unittest

from harness import ProgramTest


class Budget(ProgramTest):
    def test_groups_divide_the_slots(self):
        out = self.succeeds("bench", "budget", "penumbra", "-n", "4", "-r", "3", "--no-report", "-o", "b").out
        numbers = json.loads(self.read("b/budget.json"))
        divisions = numbers["budget"]["divisions"]
        self.assertEqual([d["by"] for d in divisions], ["role", "bounce", "role and bounce"])
        for division in divisions:
            self.assertEqual(sum(g["slots"] for g in division["groups"]), sum(g["slots"] for g in divisions[0]["groups"]))
            for group in division["groups"]:
                self.assertIn("  " + group["name"], out)
                for what in ("removed", "loss"):
                    self.assertTrue(group[what]["lo"] <= group[what]["value"] <= group[what]["hi"], group)
        # The whole error of a penumbra is film and light: one of them alone does little.
        roles = {g["name"]: g for g in divisions[0]["groups"]}
        self.assertGreater(roles["light position"]["loss"]["value"], 1.2)

    def test_the_same_numbers_for_any_number_of_threads(self):
        files = []
        for threads in ("1", "2"):
            self.succeeds("bench", "budget", "smooth", "-n", "2", "-r", "2", "--no-report", "-o", "t" + threads, "-t", threads)
            files.append(json.loads(self.read(f"t{threads}/budget.json"))["budget"])
        self.assertEqual(*files)

    def test_refusals(self):
        self.refuses(2, ["bench", "budget", "bogus"], "no scene 'bogus'", "cornell")
        self.refuses(2, ["bench", "budget", "smooth", "-s", "sobol:randomize=none"], "not randomized")
        self.refuses(1, ["bench", "budget", "missing.xml"], "missing.xml")


if __name__ == "__main__":
    unittest.main()
