"""What became of the rows of the catalogue in the last run of `ctest -L hard`: "held H of N, expected failures E".

    python3 summary.py ROWS.tsv RECORDS [--markdown | --fresh | --take]

A row holds if it has a test, and all of its tests that ran held, under both kernels. --markdown prints the table of docs/numerics.md; --fresh
removes the records of earlier runs; --take prints the summary that the run before this left, once.
"""
import pathlib
import sys


def read(rows_file, folder):
    rows = dict(line.rstrip("\n").split("\t") for line in open(rows_file, encoding="utf-8"))
    records = {row: [] for row in rows}
    for file in sorted(folder.glob("*.tsv")):
        row, kernel, outcome, share, error, noise, tolerance, name = file.read_text(encoding="utf-8").rstrip("\n").split("\t")
        if row not in records:
            sys.exit(f"{file}: no row {row} in {rows_file}")
        measured = tuple(map(float, (share, error, noise, tolerance))) if tolerance else None
        records[row].append((kernel, outcome, measured, name))
    return rows, records


def state(tests):
    """Of a row: not run, held, expected failure or failed."""
    outcomes = {outcome for _, outcome, _, _ in tests}
    if not outcomes:
        return "not run"
    if outcomes <= {"held"}:
        return "held"
    return "expected failure" if outcomes <= {"held", "expected-failure"} else "FAILED"


def summary(rows, records):
    states = {row: state(records[row]) for row in rows}
    count = list(states.values()).count
    lines = []
    for row, what in rows.items():
        if states[row] in ("FAILED", "expected failure"):
            bad = ", ".join(f"{name} ({kernel})" for kernel, outcome, _, name in records[row] if outcome != "held")
            lines.append(f"  {row} {states[row]}: {bad}")
    not_run = f", not run {count('not run')}" if count("not run") else ""
    lines.append(f"hard cases: held {count('held')} of {len(rows)}, expected failures {count('expected failure')}, failed {count('FAILED')}{not_run}")
    return "\n".join(lines) + "\n", count("FAILED")


def markdown(rows, records):
    print("| row | what | outcome | nearest to its limit: relative error ± 99.99 % interval | tolerance | kernels |\n|---|---|---|---|---|---|")
    for row, what in rows.items():
        tests = records[row]
        worst = max((m for _, _, m, _ in tests if m), default=None)
        measured = f"{worst[1]:+.1e} ± {worst[2]:.0e} | {worst[3]:.0e}" if worst else "exact, or bounds in the test | "
        kernels = "both" if {k for k, _, _, _ in tests} == {"batch", "reference"} else ""
        print(f"| {row} | {what} | {state(tests)} | {measured} | {kernels} |")


def main():
    rows_file, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    mode = sys.argv[3] if len(sys.argv) > 3 else ""
    left = folder / "summary.txt"
    if mode == "--fresh":
        for file in folder.glob("*"):
            file.unlink()
    elif mode == "--take":
        if left.exists():
            print("\n" + left.read_text(encoding="utf-8"))
            left.unlink()
    elif mode == "--markdown":
        markdown(*read(rows_file, folder))
    else:
        text, failed = summary(*read(rows_file, folder))
        print(text)
        left.write_text(text, encoding="utf-8")
        sys.exit(1 if failed else 0)


main()
