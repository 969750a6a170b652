"""Figures for a paper, as chosen; and the anonymous copy, read to the last byte."""

import contextlib
import io
import json
import re
import tempfile
import unittest
import zlib
from pathlib import Path

from report.__main__ import main
from report.check import ReportError
from report.choice import chosen, load_choice
from report.load import load_summary
from report.tests import synthetic

SECRETS = (b"EPYC 9R14", b"abc1234", b"fedcba9", b"alice", b"/home")


def all_bytes(folder: Path) -> bytes:
    """Every file, the compressed streams of a PDF unpacked; and the names."""
    parts = []
    for path in sorted(folder.rglob("*")):
        parts.append(str(path.relative_to(folder)).encode())
        if path.is_file():
            data = path.read_bytes()
            parts.append(data)
            if path.suffix == ".pdf":
                for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.S):
                    with contextlib.suppress(zlib.error):
                        parts.append(zlib.decompress(stream))
    return b"\n".join(parts)


class PaperTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.directory = self.root / "results"
        self.summary = synthetic.make_summary(scenes=("smooth", "cornell"))
        synthetic.add_images(self.directory, self.summary)
        self.summary["experiment"].update(command="koksma bench /home/alice/mine.json --out /home/alice/out", note="rendered by alice")
        self.summary["other_commits"] = [{"commit": "fedcba9", "rows": 3}]
        synthetic.write(self.directory, self.summary)
        rows = [{"kind": "header", "experiment": self.summary["experiment"]}, {"kind": "render", "commit": "abc1234", "machine": "AMD EPYC 9R14", "mse": 0.25}]
        (self.directory / "results.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))

    def choose(self, **choice) -> Path:
        path = self.root / "figures.json"
        path.write_text(json.dumps(choice))
        return path

    def run_main(self, *arguments) -> str:
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            status = main([str(self.directory), *map(str, arguments)])
        self.assertEqual(status, 1 if errors.getvalue() else 0)
        return errors.getvalue()


class Figures(PaperTest):
    def test_the_choice_is_what_is_drawn(self):
        choice = self.choose(samplers=["sobol:randomize=owen", "random"], scenes=["smooth"], labels={"sobol:randomize=owen": "Ours"},
                             colors={"sobol:randomize=owen": "#123456"}, column_width=60)
        self.assertEqual(self.run_main("--figures", choice), "")
        figures = self.directory / "figures"
        self.assertEqual(sorted(p.name for p in figures.iterdir()),
                         sorted([f"{name}.{ending}" for name in ("smooth-samples", "smooth-seconds", "rates", "gains") for ending in ("svg", "pdf")]
                                + ["points.csv", "gains.tex", "times.tex", "crops"]))
        svg = (figures / "smooth-samples.svg").read_text()
        self.assertIn("#123456", svg)
        self.assertAlmostEqual(float(re.search(r'width="([\d.]+)pt"', svg).group(1)), 60 / 25.4 * 72, delta=0.1)
        self.assertTrue((figures / "smooth-samples.pdf").read_bytes().startswith(b"%PDF"))
        table = (figures / "gains.tex").read_text()
        self.assertLess(table.index("Ours"), table.index("Random"))
        self.assertNotIn("Halton", table)
        self.assertEqual({line.split(",")[0] for line in (figures / "points.csv").read_text().splitlines()[1:]}, {"smooth"})
        self.assertEqual(sorted(p.name for p in (figures / "crops").iterdir()), ["0.exr", "3.exr", "reference.exr"])

    def test_two_runs_give_the_same_bytes(self):
        choice = self.choose()
        self.run_main("--figures", choice)
        before = all_bytes(self.directory / "figures")
        self.run_main("--figures", choice)
        self.assertEqual(all_bytes(self.directory / "figures"), before)

    def test_labels_and_colours_keep_the_rest_as_the_report_has_it(self):
        summary = load_summary(self.directory)
        _, styles = chosen(summary, load_choice(self.choose(samplers=["sobol:randomize=owen"])), "f.json")
        _, all_styles = chosen(summary, load_choice(self.choose()), "f.json")
        self.assertEqual(styles["sobol:randomize=owen"], all_styles["sobol:randomize=owen"])

    def test_refusals_name_the_file_and_what_was_expected(self):
        for choice, part in (({"colour": {}}, 'unknown key "colour", expected one of colors, column_width'), ({"samplers": "random"}, "found \"random\", expected an array"),
                             ({"samplers": ["sobol"]}, 'sampler "sobol" is not in the results, expected one of random, stratified'),
                             ({"scenes": ["none"]}, 'scene "none" is not in the results'), ({"labels": {"x": "y"}}, 'sampler "x"'),
                             ({"colors": {"random": "red"}}, 'a colour as "#0072b2"'), ({"column_width": 5}, "a number from 30 to 1000"),
                             ({"formats": ["png"]}, 'one of "svg", "pdf"')):
            with self.subTest(part):
                error = self.run_main("--figures", self.choose(**choice))
                self.assertIn("figures.json", error)
                self.assertIn(part, error)
                self.assertEqual(error.count("\n"), 1)
                self.assertFalse((self.directory / "report.html").exists())
        self.assertIn("none.json: No such file", self.run_main("--figures", self.root / "none.json"))
        (self.root / "figures.json").write_text("{")
        with self.assertRaises(ReportError):
            load_choice(self.root / "figures.json")


class Anonymous(PaperTest):
    def test_nothing_tells_machine_path_or_commit(self):
        self.assertEqual(self.run_main("--anonymous", "--figures", self.choose()), "")
        found = all_bytes(self.directory / "anonymous")
        for secret in (*SECRETS, str(self.root).encode()):
            self.assertNotIn(secret, found)
        self.assertIn(b"withheld", found)
        self.assertIn(b'"mse":0.25', found)  # the rows are there
        self.assertIn(b"./koksma bench default", found)
        self.assertFalse((self.directory / "report.html").exists())

    def test_the_secrets_are_in_what_is_not_anonymous(self):
        self.run_main("--figures", self.choose())
        page = (self.directory / "report.html").read_bytes()
        self.assertTrue(all(secret in page for secret in SECRETS))


if __name__ == "__main__":
    unittest.main()
