"""What a report shows, as plain immutable values. Errors are of linear radiance, times in seconds."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Estimate:
    """A value with its interval. None: not known (a value), not to be had (a bound)."""

    value: float | None
    lo: float | None = None
    hi: float | None = None


@dataclass(frozen=True)
class Picture:
    """A PNG file, whole, and its size in pixels."""

    data: bytes
    width: int
    height: int


@dataclass(frozen=True)
class Point:
    """One sampler in one scene at one number of samples per pixel; seconds are of rendering alone."""

    spp: int
    replicates: int
    rmse: Estimate
    relmse: Estimate
    cpu_seconds: float
    wall_seconds: float
    sampler_share: float | None
    below_floor: bool


@dataclass(frozen=True)
class Slope:
    """Exponent p of RMSE ~ spp^p, fitted over [spp_from, spp_to]."""

    estimate: Estimate
    spp_from: int
    spp_to: int


@dataclass(frozen=True)
class TimeTo:
    """Seconds until the relative MSE fell to `relmse`; no seconds when it was not reached."""

    relmse: float
    seconds: Estimate
    how: str
    reached_relmse: float | None


@dataclass(frozen=True)
class Gain:
    """MSE of random over MSE of this sampler, at the same spp."""

    ratio: Estimate
    spp: int


@dataclass(frozen=True)
class EqualTime:
    """MSE of random over MSE of this sampler after equally many CPU seconds, the most that both were measured for."""

    seconds: float
    ratio: Estimate


@dataclass(frozen=True)
class Progressive:
    """Renders to `planned_spp`, read at every spp: points as (spp, RMSE), and a slope whose interval leaves out whole renders."""

    planned_spp: int
    renders: int
    points: tuple[tuple[int, Estimate], ...]
    slope: Estimate | None


@dataclass(frozen=True)
class Coverage:
    """What nominal intervals of heavy-tailed errors were seen to cover, as fractions, with so many replicates."""

    replicates: int
    rmse: float
    slope: float
    gain: float


@dataclass(frozen=True)
class Finding:
    """One figure that a prediction rests on."""

    what: str
    figure: Estimate
    verdict: str


@dataclass(frozen=True)
class Prediction:
    """What the experiment said beforehand; verdict: held, refuted, undecided (an interval reaches over a bound) or not tested."""

    says: str
    of: str
    verdict: str
    found: tuple[Finding, ...]


@dataclass(frozen=True)
class LayoutSpread:
    """One sampler at one spp under permuted layouts of its dimensions; `each` begins with the layout as planned."""

    spp: int
    permuted: int
    rmse: Estimate
    lowest: float | None
    highest: float | None
    spread: Estimate
    planned: Estimate
    each: tuple[Estimate, ...]


@dataclass(frozen=True)
class CountGain:
    """Gain over random at one spp; interpolated where random was not run at it. `own`: a good count of the sampler's base."""

    spp: int
    ratio: Estimate
    own: bool
    interpolated: bool


@dataclass(frozen=True)
class SamplerResult:
    """Everything about one sampler in one scene; points ascend in spp."""

    sampler: str
    label: str
    randomized: bool
    points: tuple[Point, ...]
    slope: Slope | None
    time_to: tuple[TimeTo, ...]
    gain: Gain | None
    crop: Picture | None
    crop_spp: int | None
    crop_data: object  # of viewer.py: linear radiance, shape (height, width, 3); None where no image was kept
    crop_exr: Path | None
    equal_time: EqualTime | None
    progressive: Progressive | None
    coverage: Coverage | None  # not None: the errors look heavy-tailed
    layouts: tuple[LayoutSpread, ...]
    counts: tuple[CountGain, ...]

    @property
    def is_baseline(self) -> bool:
        """Whether this is the sampler that the gains are measured against."""
        return self.sampler.split(":")[0] == "random"


@dataclass(frozen=True)
class Reference:
    """The image that errors are measured against, and what is known of its own error."""

    samplers: tuple[str, ...]
    spp_total: int
    replicates: int
    se_rmse: float | None
    halves_z: float | None
    file: str | None


@dataclass(frozen=True)
class EffectsCost:
    """A sampler at one spp with the needed effects and with more; time_ratio and mse_ratio are more over needed."""

    sampler: str
    spp: int
    ns_needed: float
    ns_forced: float
    time_ratio: Estimate
    mse_ratio: Estimate
    distinguishable: bool


@dataclass(frozen=True)
class ForcedEffects:
    """What a scene costs when it is rendered with effects that it does not call for."""

    extra: tuple[str, ...]
    dimensions_needed: int
    dimensions: int
    kernel_needed: str
    kernel: str
    lines: tuple[EffectsCost, ...]


@dataclass(frozen=True)
class Scene:
    """One scene; film is (width, height) and crop (x, y, width, height), in pixels."""

    name: str
    purpose: str
    expect: str
    film: tuple[int, int]
    crop: tuple[int, int, int, int]
    max_depth: int
    rr_depth: int
    effects: tuple[str, ...]
    dimensions: int
    kernel: str
    reference: Reference
    picture: Picture | None
    reference_crop: Picture | None
    samplers: tuple[SamplerResult, ...]
    reference_data: object
    reference_exr: Path | None
    predictions: tuple[Prediction, ...]
    verdict: str
    forced: ForcedEffects | None = None
    evidence: object = None  # of evidence.py, which is made of these values


@dataclass(frozen=True)
class Experiment:
    """What was run, on what, and the command that repeats it."""

    name: str
    title: str
    command: str
    commit: str
    machine: str
    cores: int
    isa: str
    compiler: str
    threads: int
    version: str
    confidence: float
    note: str


@dataclass(frozen=True)
class Summary:
    """A whole results directory."""

    directory: Path
    experiment: Experiment
    scenes: tuple[Scene, ...]
    rows: int
    other_commits: tuple[tuple[str, int], ...]  # of rows that an earlier program rendered
    invalid_samples: int
    seconds_total: float
