"""What the tables say: verdicts from given intervals, and cells in the order in which they are shown.

Nothing is estimated here; an interval that includes 1 was computed by the program.
"""

from dataclasses import dataclass

from .evidence import Pair
from .model import CountGain, Estimate, Gain, SamplerResult, Scene, Summary, TimeTo


@dataclass(frozen=True)
class OverviewCell:
    """One sampler in one scene.

    verdict  baseline, better, worse, unclear (the interval includes 1), no interval, no gain
    mark     best: the largest of the better ones, clear of the others; joint best: where others overlap it
    """

    result: SamplerResult
    verdict: str
    mark: str = ""


@dataclass(frozen=True)
class Winner:
    """Who has the least MSE of a scene: those whom nobody is told to beat, at the largest common spp.

    runner_up  the nearest of the others, None where nobody is beaten by the winner alone; margin: its MSE over the winner's
    """

    leaders: tuple[SamplerResult, ...]
    runner_up: SamplerResult | None
    margin: Estimate | None
    spp: int


@dataclass(frozen=True)
class Overtaking:
    """What a path of a sampler might cost for it to be as efficient as the winner: below `ns`; it takes `measured`."""

    result: SamplerResult
    ns: Estimate
    measured: float


def verdict(result: SamplerResult) -> str:
    """How a sampler's MSE compares with random's, as far as its interval can tell."""
    if result.is_baseline:
        return "baseline"
    if result.gain is None or result.gain.ratio.value is None:
        return "no gain"
    lo, hi = result.gain.ratio.lo, result.gain.ratio.hi
    if lo is None and hi is None:
        return "no interval"
    if lo is not None and lo > 1:
        return "better"
    return "worse" if hi is not None and hi < 1 else "unclear"


def overview_row(scene: Scene) -> dict[str, OverviewCell]:
    """The cells of a scene by sampler name, the best distinguishable one and those level with it marked."""
    verdicts = {result.sampler: verdict(result) for result in scene.samplers}
    better = [result for result in scene.samplers if verdicts[result.sampler] == "better"]
    best = max(better, key=lambda result: result.gain.ratio.value, default=None)
    # Overlap is a cautious test: samplers whose intervals overlap a little may differ all the same.
    level = [r for r in better if r.gain.ratio.hi is None or r.gain.ratio.hi >= best.gain.ratio.lo]
    mark = "best" if len(level) == 1 else "joint best"
    return {result.sampler: OverviewCell(result, verdicts[result.sampler], mark if result in level else "")
            for result in scene.samplers}


def _better_first(pair: Pair, name: str) -> Estimate:
    """MSE of the other of a pair over that of `name`."""
    ratio = pair.ratio
    if pair.a == name or not ratio.value:
        return ratio
    return Estimate(1 / ratio.value, 1 / ratio.hi if ratio.hi else None, 1 / ratio.lo if ratio.lo else None)


def winner(scene: Scene) -> Winner | None:
    """None where the scene has no pairs: a single sampler, or none with replicates."""
    pairs = [pair for pair in (scene.evidence.pairs if scene.evidence else ()) if pair.ratio.value]
    if not pairs:
        return None
    results = {result.sampler: result for result in scene.samplers}
    named = [name for name in results if any(name in (pair.a, pair.b) for pair in pairs)]
    beaten = {pair.b if pair.better == pair.a else pair.a for pair in pairs if pair.better}
    leaders = tuple(results[name] for name in named if name not in beaten)
    if len(leaders) != 1:
        return Winner(leaders, None, None, max(pair.spp for pair in pairs))
    name = leaders[0].sampler
    nearest = min((pair for pair in pairs if name in (pair.a, pair.b)), key=lambda pair: _better_first(pair, name).value)
    return Winner(leaders, results[nearest.b if nearest.a == name else nearest.a], _better_first(nearest, name), nearest.spp)


def pair_matrix(scene: Scene) -> list[tuple[SamplerResult, list[tuple[str, Estimate | None]]]]:
    """Samplers by samplers, those that beat most first: "+" where the row has less MSE than the column, "\u2212" where more, "=" where
    they are not told apart, "" without a comparison; each with the MSE of the column over that of the row."""
    pairs = {frozenset((pair.a, pair.b)): pair for pair in scene.evidence.pairs}
    beats = {result.sampler: sum(pair.better == result.sampler for pair in pairs.values()) for result in scene.samplers}
    order = sorted((result for result in scene.samplers if any(result.sampler in pair for pair in pairs)), key=lambda result: -beats[result.sampler])

    def cell(row: SamplerResult, column: SamplerResult) -> tuple[str, Estimate | None]:
        pair = pairs.get(frozenset((row.sampler, column.sampler))) if row is not column else None
        if pair is None:
            return "", None
        return "=" if pair.better is None else "+" if pair.better == row.sampler else "\u2212", _better_first(pair, row.sampler)

    return [(row, [cell(row, column) for column in order]) for row in order]


def overtaking(scene: Scene) -> tuple[SamplerResult, list[Overtaking]] | None:
    """The sampler with the highest efficiency of the scene, and where each other one would be as efficient; None without pairs."""
    pairs = [pair for pair in (scene.evidence.pairs if scene.evidence else ()) if pair.a_overtakes and pair.b_overtakes and pair.ratio.value and pair.ns[0]]
    if not pairs:
        return None
    results = {result.sampler: result for result in scene.samplers}
    beats = {name: 0 for name in results}
    for pair in pairs:
        beats[pair.a if pair.b_overtakes.value < pair.ns[1] else pair.b] += 1
    first = max(beats, key=beats.get)
    rest = [Overtaking(results[pair.b], pair.b_overtakes, pair.ns[1]) if pair.a == first else Overtaking(results[pair.a], pair.a_overtakes, pair.ns[0])
            for pair in pairs if first in (pair.a, pair.b)]
    return results[first], rest


def tally(rows: list[dict[str, OverviewCell]]) -> dict[str, int]:
    """How many comparisons with random had each verdict; baselines and absent gains are not comparisons."""
    counts = {"better": 0, "unclear": 0, "worse": 0, "no interval": 0}
    for row in rows:
        for cell in row.values():
            if cell.verdict in counts:
                counts[cell.verdict] += 1
    return counts


def sampler_columns(summary: Summary) -> list[SamplerResult]:
    """The samplers of all scenes, each once, in the order of first appearance."""
    columns: dict[str, SamplerResult] = {}
    for scene in summary.scenes:
        for result in scene.samplers:
            columns.setdefault(result.sampler, result)
    return list(columns.values())


def gain_spp(scene: Scene) -> int | None:
    """The spp of a scene's gains when it is one and the same, else None."""
    spps = {result.gain.spp for result in scene.samplers if isinstance(result.gain, Gain)}
    return spps.pop() if len(spps) == 1 else None


def targets(scene: Scene) -> list[float]:
    """The relative MSEs of a scene's time-to-error table, easiest first."""
    return sorted({entry.relmse for result in scene.samplers for entry in result.time_to}, reverse=True)


def time_to(result: SamplerResult, target: float) -> TimeTo | None:
    """A sampler's entry for a target, None when it has none."""
    return next((entry for entry in result.time_to if entry.relmse == target), None)


def common_target(scene: Scene) -> float | None:
    """The hardest target that every sampler reached, or failing that the most did; the easiest where none was reached; None without targets."""
    def reached(target: float) -> int:
        entries = (time_to(result, target) for result in scene.samplers)
        return sum(entry is not None and entry.how != "not reached" for entry in entries)

    return max(targets(scene), key=lambda target: (reached(target), -target if reached(target) else target), default=None)


def fastest(scene: Scene, target: float) -> dict[str, str]:
    """Marks, by sampler name, of the shortest time to a target and of those whose interval overlaps its own.

    A time without an interval is not ranked. No marks where all overlap: there is nothing to point out.
    """
    entries = {result.sampler: time_to(result, target) for result in scene.samplers}
    ranked = {name: entry.seconds for name, entry in entries.items()
              if entry and None not in (entry.seconds.value, entry.seconds.lo, entry.seconds.hi)}
    best = min(ranked.values(), key=lambda seconds: seconds.value, default=None)
    level = [name for name, seconds in ranked.items() if seconds.lo <= best.hi]
    if len(level) == len(ranked):
        return {}
    return {name: "best" if len(level) == 1 else "joint best" for name in level}


def count_rows(scene: Scene) -> list[tuple[int, dict[str, CountGain]]]:
    """The gains at every count by sampler name, counts ascending; a sampler that was not run at a count is not in its row."""
    rows: dict[int, dict[str, CountGain]] = {}
    for result in scene.samplers:
        for gain in result.counts:
            rows.setdefault(gain.spp, {})[result.sampler] = gain
    return sorted(rows.items())


def remarks(scene: Scene) -> list[str]:
    """What a reader of a scene's figures and tables must know about points that are missing or marked."""
    lines = []
    for result in scene.samplers:
        missing = [str(point.spp) for point in result.points if not point.rmse.value]
        if missing:
            lines.append(f"{result.label}: no RMSE at {_spp(missing)}: the corrected MSE was not positive there "
                         "(below the reference's noise), so the figures leave the point out.")
        below = [str(point.spp) for point in result.points if point.below_floor and point.rmse.value]
        if below:
            lines.append(f"{result.label}: hollow markers, at {_spp(below)}: the error is below the reference's "
                         "own noise floor and is not to be relied on.")
        if not result.randomized:
            lines.append(f"{result.label}: a fixed point set, not randomised: it has no replicates, hence no "
                         "intervals and no rank.")
        if result.slope is None and result.points:
            lines.append(f"{result.label}: no slope was fitted; thin lines join its points.")
    z = scene.reference.halves_z
    if z is not None and abs(z) > 3:
        lines.append("The two halves of the reference differ by more than 3 standard errors: "
                     "treat this scene's errors with suspicion.")
    return lines


def _spp(numbers: list[str]) -> str:
    return ", ".join(numbers) + " spp"
