"""Command line: python3 -m report DIR."""

import argparse
import os
import sys
from pathlib import Path


def main(arguments: list[str] | None = None) -> int:
    """Writes DIR/report.html.

    Returns 0 on success and 1 on failure, with one line on stderr. Wrong usage exits with 2.
    """
    parser = argparse.ArgumentParser(
        prog="python3 -m report",
        description="Reads DIR/summary.json and the pictures it names, and writes DIR/report.html: "
        "one file that opens in a browser, offline; and points.csv and gains.tex for a paper.")
    parser.add_argument("dir", metavar="DIR", type=Path, help="results directory, made by `koksma bench`")
    options = parser.parse_args(arguments)

    try:
        # Late, so that --help and the message below need only the standard library.
        from .check import ReportError
        from .export import gains_tex, points_csv
        from .load import load_summary
        from .page import render_page
    except ImportError as error:
        return _fail(f"{error}; expected the Python packages matplotlib, numpy and jinja2 "
                     "(Debian: apt install python3-matplotlib python3-numpy python3-jinja2)")
    try:
        target = options.dir / "report.html"
        summary = load_summary(options.dir)
        write_atomically(options.dir / "points.csv", points_csv(summary))
        write_atomically(options.dir / "gains.tex", gains_tex(summary))
        write_atomically(target, render_page(summary))
    except ReportError as error:
        return _fail(str(error))
    except OSError as error:
        return _fail(f"{error.filename or options.dir}: {error.strerror or error}")
    print(target)
    return 0


def write_atomically(path: Path, text: str) -> None:
    """Writes text to path by way of a temporary file beside it: the old file or the whole new one.

    Raises OSError, and then leaves path as it was and no temporary file.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        # Not tempfile: its files are private to the user, a report is to be read by others.
        temporary.write_text(text, encoding="utf-8", newline="\n")
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def _fail(message: str) -> int:
    print("report: " + " ".join(message.split()), file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
