"""Command line: python3 -m report DIR [--figures FILE] [--anonymous]."""

import argparse
import os
import sys
from pathlib import Path


def main(arguments: list[str] | None = None) -> int:
    """Writes DIR/report.html, and DIR/figures where they are chosen; with --anonymous a copy of all in DIR/anonymous.

    Returns 0 on success and 1 on failure, with one line on stderr. Wrong usage exits with 2.
    """
    parser = argparse.ArgumentParser(
        prog="python3 -m report",
        description="Reads DIR/summary.json and the pictures it names, and writes DIR/report.html: "
        "one file that opens in a browser, offline; and points.csv and gains.tex for a paper.")
    parser.add_argument("dir", metavar="DIR", type=Path, help="results directory, made by `koksma bench`")
    parser.add_argument("--figures", metavar="FILE", type=Path, help="JSON that chooses samplers, labels, colours and column width of figures for a paper")
    parser.add_argument("--anonymous", action="store_true", help="write to DIR/anonymous, without machine, paths and commit")
    options = parser.parse_args(arguments)

    try:
        # Late, so that --help and the message below need only the standard library.
        from .anonymous import anonymous, anonymous_json
        from .check import ReportError
        from .choice import chosen, load_choice
        from .export import gains_tex, points_csv
        from .load import load_summary
        from .page import render_page
        from .paper import write_paper
    except ImportError as error:
        return _fail(f"{error}; expected the Python packages matplotlib, numpy and jinja2 "
                     "(Debian: apt install python3-matplotlib python3-numpy python3-jinja2)")
    try:
        choice = load_choice(options.figures) if options.figures else None
        summary, out = load_summary(options.dir), options.dir
        if options.anonymous:
            out = options.dir / "anonymous"
            out.mkdir(exist_ok=True)
            summary = anonymous(summary, out)
            for name in ("summary.json", "results.jsonl"):
                if (options.dir / name).is_file():
                    text = (options.dir / name).read_text(encoding="utf-8")
                    lines = text.splitlines() if name.endswith("l") else [text]
                    write_atomically(out / name, "".join(anonymous_json(line) + "\n" for line in lines))
        # Whatever is wrong with the choice of figures is told before anything is written.
        cut = chosen(summary, choice, str(options.figures)) if choice else None
        write_atomically(out / "points.csv", points_csv(summary))
        write_atomically(out / "gains.tex", gains_tex(summary))
        target = out / "report.html"
        write_atomically(target, render_page(summary))
        files = write_paper(*cut, choice, out / "figures") if cut else []
    except ReportError as error:
        return _fail(str(error))
    except OSError as error:
        return _fail(f"{error.filename or options.dir}: {error.strerror or error}")
    print(f"report: {target}")
    if files:
        print(f"figures: {out / 'figures'}, {len(files)} files")
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
