"""CSV and LaTeX of a synthetic summary."""

import csv
import io
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

from report.export import COLUMNS, gains_tex, points_csv, times_tex
from report.load import load_summary
from report.tests import synthetic


class Export(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = synthetic.write(Path(folder.name) / "results", synthetic.make_summary(scenes=("smooth", "cornell")))
        self.summary = load_summary(self.directory)

    def test_csv_has_every_point_with_all_digits(self):
        rows = list(csv.DictReader(io.StringIO(points_csv(self.summary))))
        self.assertEqual(tuple(rows[0]), COLUMNS)
        self.assertEqual(len(rows), 2 * 4 * 5)
        point = self.summary.scenes[1].samplers[2].points[3]
        row = rows[20 + 10 + 3]
        self.assertEqual((row["scene"], row["sampler"], int(row["spp"]), float(row["rmse"])), ("cornell", "halton:randomize=owen", 64, point.rmse.value))

    def test_latex_tables_have_a_line_a_scene_and_sampler(self):
        for text, columns in ((gains_tex(self.summary), 4), (times_tex(self.summary), 5)):
            lines = text.splitlines()
            self.assertEqual((lines[0], lines[1], lines[-2], lines[-1]), (r"\begin{tabular}{ll" + "r" * (columns - 2) + "}", r"\toprule", r"\bottomrule", r"\end{tabular}"))
            body = [line for line in lines[3:-2] if line != r"\midrule"]
            self.assertEqual(len(body), 2 * 4)
            self.assertTrue(all(line.count("&") == columns - 1 and line.endswith(r"\\") for line in body), body)
        self.assertIn("--", times_tex(self.summary))  # what was not reached has no number

    def test_latex_has_no_character_that_means_something(self):
        odd = replace(self.summary.scenes[0].samplers[0], label=r"a\b_50%~$x$^2")
        text = gains_tex(replace(self.summary, scenes=(replace(self.summary.scenes[0], samplers=(odd,)),)))
        self.assertIn(r"a\textbackslash{}b\_50\%\textasciitilde{}\$x\$\textasciicircum{}2", text)


if __name__ == "__main__":
    unittest.main()
