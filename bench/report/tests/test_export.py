"""CSV and LaTeX of a synthetic summary."""

import csv
import io
import tempfile
import unittest
from pathlib import Path

from report.export import COLUMNS, gains_tex, points_csv
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

    def test_latex_table_has_a_line_a_sampler(self):
        lines = gains_tex(self.summary).splitlines()
        self.assertEqual((lines[0], lines[1], lines[-2], lines[-1]), (r"\begin{tabular}{lrrrr}", r"\toprule", r"\bottomrule", r"\end{tabular}"))
        body = lines[lines.index(r"\midrule") + 1:-2]
        self.assertEqual(len(body), 4)
        self.assertTrue(all(line.count("&") == 4 and line.endswith(r"\\") for line in body), body)


if __name__ == "__main__":
    unittest.main()
