"""CSV and LaTeX of a synthetic summary; and the browser, where there is one."""

import csv
import io
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from report.export import COLUMNS, gains_tex, points_csv
from report.load import load_summary
from report.page import render_page
from report.tests import synthetic

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


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

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_the_page_runs_in_a_browser_without_an_error(self):
        page = self.directory / "report.html"
        page.write_text(render_page(self.summary), encoding="utf-8")
        result = subprocess.run([CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={self.directory}/profile", "--enable-logging=stderr", "--dump-dom",
                                 page.as_uri()], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
        self.assertIn("<dialog", result.stdout)  # the viewer's, which its script makes
        self.assertNotIn("Uncaught", result.stderr)


if __name__ == "__main__":
    unittest.main()
