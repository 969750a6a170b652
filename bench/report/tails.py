"""What stands beside an interval of heavy-tailed errors: how often such intervals were seen to cover, where that is less than they say."""

from markupsafe import Markup

from . import formats
from .model import Finding, Prediction, SamplerResult, Scene

LEAST_COVERAGE = 0.93  # of a nominal 95 %: docs/intervals.md


def tails(of: str, *results: SamplerResult | None) -> Markup:
    """The mark of an interval over these samplers, empty where it covers. of: "rmse" (relMSE too), "slope" or "gain"."""
    least = min((getattr(r.coverage, of) for r in results if r and r.coverage), default=1.0)
    if least >= LEAST_COVERAGE:
        return Markup("")
    covers = formats.percent(least)
    return Markup(f'<a class="tails" href="#tails" title="heavy tails: such intervals were seen to cover at least {covers}">\u2021\u2009{covers}</a>')


def gain_tails(scene: Scene, result: SamplerResult) -> Markup:
    """Beside a gain, in which the baseline's tail counts as much as the sampler's."""
    return tails("gain", result, *(s for s in scene.samplers if s.is_baseline))


def finding_tails(scene: Scene, prediction: Prediction, finding: Finding) -> Markup:
    """Beside what was found of a prediction: of one sampler, or "ours / theirs" where an order was predicted."""
    named = [s for s in scene.samplers if s.label in finding.what.split(" / ")]
    if prediction.of == "slope":
        return tails("slope", *named)
    return tails("gain", *named) if prediction.of == "order" else gain_tails(scene, *named) if named else Markup("")


def marked(summary) -> list[SamplerResult]:
    """Samplers with a mark somewhere."""
    return [s for scene in summary.scenes for s in scene.samplers
            if s.coverage and min(s.coverage.rmse, s.coverage.slope, s.coverage.gain) < LEAST_COVERAGE]
