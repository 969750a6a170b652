"""Reads summary.json and the pictures it names into the values of model.py."""

import json
from pathlib import Path

from . import model
from .check import Node, ReportError
from .evidence import load_evidence
from .pictures import file_of, load_array, load_picture

SCHEMA = 1


def load_summary(directory: Path) -> model.Summary:
    """Reads directory/summary.json, checks all of it, and loads the pictures.

    Raises ReportError, whose one line names the file, the place in it and what was expected.
    """
    path = directory / "summary.json"
    root = Node(_parse(path), str(path))
    if root.at("schema").value != SCHEMA:
        raise root.at("schema").fail(f"{SCHEMA}, the only schema that this report reads")
    scenes = tuple(_scene(node, directory) for node in root.at("scenes").items())
    if not scenes:
        raise root.at("scenes").fail("at least one scene")
    _refuse_repeats(root.at("scenes"), [scene.name for scene in scenes], "a scene name used once")
    others = tuple((node.at("commit").text(), node.at("rows").integer(1)) for node in root.at("other_commits").items())
    return model.Summary(directory, _experiment(root.at("experiment")), scenes, root.at("rows").integer(1), others,
                         root.at("invalid_samples").integer(), root.at("seconds_total").number(0))


def _parse(path: Path) -> object:
    def refuse(word: str) -> None:
        raise ValueError(f"found {word}, expected a finite number or null")

    try:
        return json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)
    except FileNotFoundError:
        raise ReportError(f"{path}: not found, expected the summary that `koksma bench` writes") from None
    except json.JSONDecodeError as error:
        raise ReportError(f"{path}:{error.lineno}:{error.colno}: {error.msg}, expected JSON") from None
    except (ValueError, RecursionError) as error:
        raise ReportError(f"{path}: {error}, expected JSON in UTF-8") from None


def _experiment(node: Node) -> model.Experiment:
    confidence = node.at("confidence").number(0)
    if not 0 < confidence < 1:
        raise node.at("confidence").fail("a number in (0, 1)")
    texts = {key: node.at(key).text()
             for key in ("title", "command", "commit", "machine", "isa", "compiler", "version", "note")}
    return model.Experiment(name=node.at("name").name(), cores=node.at("cores").integer(1),
                            threads=node.at("threads").integer(1), confidence=confidence, **texts)


def _scene(node: Node, directory: Path) -> model.Scene:
    samplers = tuple(_sampler(item, directory) for item in node.at("samplers").items())
    if not samplers:
        raise node.at("samplers").fail("at least one sampler")
    _refuse_repeats(node.at("samplers"), [s.sampler for s in samplers], "a sampler used once in a scene")
    return model.Scene(
        name=node.at("name").name(), purpose=node.at("purpose").text(), expect=node.at("expect").text(),
        film=_integers(node.at("film"), (1, 1), "[width, height]"),
        crop=_integers(node.at("crop"), (0, 0, 1, 1), "[x, y, width, height]"),
        max_depth=node.at("max_depth").integer(least=-1), rr_depth=node.at("rr_depth").integer(),
        effects=tuple(effect.name() for effect in node.at("effects").items()),
        dimensions=node.at("dimensions").integer(), kernel=node.at("kernel").text(),
        reference=_reference(node.at("reference")),
        picture=load_picture(node.at("picture"), directory),
        reference_crop=load_picture(node.at("reference_crop"), directory),
        samplers=samplers, reference_data=load_array(node.at("reference_data"), directory, 3),
        reference_exr=file_of(node.at("reference_exr"), directory),
        predictions=tuple(_prediction(item) for item in node.at("predictions").items()),
        verdict=node.at("predictions_verdict").one_of(*VERDICTS), forced=None if node.at("cost_of_effects").is_null() else _forced(node.at("cost_of_effects")),
        evidence=load_evidence(node, directory))


VERDICTS = ("held", "refuted", "undecided", "not tested")


def _prediction(node: Node) -> model.Prediction:
    found = tuple(model.Finding(item.at("what").text(), _estimate(item, "value", "lo", "hi"), item.at("verdict").one_of(*VERDICTS))
                  for item in node.at("found").items())
    return model.Prediction(node.at("says").name(), node.at("of").one_of("slope", "gain", "order"), node.at("verdict").one_of(*VERDICTS), found)


def _forced(node: Node) -> model.ForcedEffects:
    needed = {effect.name() for effect in node.at("needed").items()}
    return model.ForcedEffects(
        extra=tuple(effect.name() for effect in node.at("forced").items() if effect.name() not in needed),
        dimensions_needed=node.at("dimensions_needed").integer(), dimensions=node.at("dimensions").integer(),
        kernel_needed=node.at("kernel_needed").text(), kernel=node.at("kernel").text(),
        lines=tuple(model.EffectsCost(
            sampler=line.at("sampler").name(), spp=line.at("spp").integer(1), ns_needed=line.at("ns_per_path_needed").number(0),
            ns_forced=line.at("ns_per_path").number(0), time_ratio=_estimate(line.at("time_ratio"), "value", "lo", "hi", least=0),
            mse_ratio=_estimate(line.at("mse_ratio"), "value", "lo", "hi", least=0),
            distinguishable=line.at("distinguishable").flag()) for line in node.at("lines").items()))


def _reference(node: Node) -> model.Reference:
    return model.Reference(
        samplers=tuple(name.name() for name in node.at("samplers").items()),
        spp_total=node.at("spp_total").integer(1), replicates=node.at("replicates").integer(1),
        se_rmse=node.at("se_rmse").number_or_none(0), halves_z=node.at("halves_z").number_or_none(),
        file=node.at("file").text_or_none())


def _sampler(node: Node, directory: Path) -> model.SamplerResult:
    points = sorted((_point(item) for item in node.at("points").items()), key=lambda point: point.spp)
    _refuse_repeats(node.at("points"), [point.spp for point in points], "an spp used once")
    slope, gain = node.at("slope"), node.at("gain_vs_random")
    return model.SamplerResult(
        sampler=node.at("sampler").name(), label=node.at("label").name(),
        randomized=node.at("randomized").flag(), points=tuple(points),
        slope=None if slope.is_null() else _slope(slope),
        time_to=tuple(_time_to(item) for item in node.at("time_to").items()),
        gain=None if gain.is_null() else model.Gain(_estimate(gain, "mse_ratio", "lo", "hi", least=0),
                                                    gain.at("spp").integer(1)),
        crop=load_picture(node.at("crop"), directory),
        crop_spp=None if node.at("crop_spp").is_null() else node.at("crop_spp").integer(1),
        crop_data=load_array(node.at("crop_data"), directory, 3), crop_exr=file_of(node.at("crop_exr"), directory),
        equal_time=_or_none(node.at("equal_time_vs_random"), _equal_time),
        progressive=_or_none(node.at("progressive"), _progressive), coverage=_or_none(node.at("interval_coverage"), _coverage),
        layouts=tuple(_layouts(item) for item in _items_or_none(node.at("layouts"))),
        counts=tuple(_count(item) for item in _items_or_none(node.at("any_count"))))


def _point(node: Node) -> model.Point:
    return model.Point(
        spp=node.at("spp").integer(1), replicates=node.at("replicates").integer(1),
        rmse=_estimate(node, "rmse", "rmse_lo", "rmse_hi", least=0),
        relmse=_estimate(node, "relmse", "relmse_lo", "relmse_hi", least=0),
        cpu_seconds=node.at("cpu_seconds").number(0), wall_seconds=node.at("wall_seconds").number(0),
        sampler_share=node.at("sampler_share").number_or_none(0), below_floor=node.at("below_floor").flag())


def _or_none(node: Node, read):
    return None if node.is_null() else read(node)


def _equal_time(node: Node) -> model.EqualTime:
    return model.EqualTime(node.at("seconds").number(0), _estimate(node, "mse_ratio", "lo", "hi", least=0))


def _progressive(node: Node) -> model.Progressive:
    points = tuple((item.at("spp").integer(1), _estimate(item, "rmse", "lo", "hi", least=0)) for item in node.at("points").items())
    return model.Progressive(node.at("planned_spp").integer(1), node.at("renders").integer(1), points,
                             _or_none(node.at("slope"), lambda slope: _estimate(slope, "value", "lo", "hi")))


def _coverage(node: Node) -> model.Coverage:
    return model.Coverage(node.at("replicates").integer(1), *(node.at(key).number(0) for key in ("rmse", "slope", "gain")))


def _items_or_none(node: Node) -> list[Node]:
    return [] if node.is_null() else list(node.items())


def _layouts(node: Node) -> model.LayoutSpread:
    return model.LayoutSpread(
        spp=node.at("spp").integer(1), permuted=node.at("permuted").integer(2),
        rmse=model.Estimate(node.at("rmse").number_or_none(0)),
        lowest=node.at("lowest").number_or_none(0), highest=node.at("highest").number_or_none(0),
        spread=_estimate(node.at("spread"), "value", "lo", "hi", least=0),
        planned=_estimate(node.at("plan_over_permuted"), "value", "lo", "hi", least=0),
        each=tuple(_estimate(item, "rmse", "lo", "hi", least=0) for item in node.at("each").items()))


def _count(node: Node) -> model.CountGain:
    return model.CountGain(node.at("spp").integer(1), _estimate(node, "mse_ratio", "lo", "hi", least=0), node.at("own").flag(),
                           node.at("how").one_of("measured", "interpolated") == "interpolated")


def _slope(node: Node) -> model.Slope:
    return model.Slope(_estimate(node, "value", "lo", "hi"), node.at("spp_from").integer(1),
                       node.at("spp_to").integer(1))


def _time_to(node: Node) -> model.TimeTo:
    how = node.at("how").one_of("measured", "interpolated", "not reached")
    seconds = _estimate(node, "seconds", "lo", "hi", least=0)
    if (seconds.value is None) != (how == "not reached"):
        raise node.at("seconds").fail(f'seconds exactly when "how" is not "not reached" (it is "{how}")')
    relmse = node.at("relmse").number(0)
    if relmse == 0:
        raise node.at("relmse").fail("a number above 0")
    return model.TimeTo(relmse, seconds, how, node.at("reached_relmse").number_or_none(0))


def _estimate(node: Node, value: str, lo: str, hi: str, least: float = -float("inf")) -> model.Estimate:
    # An interval need not contain its value (the two may be means of different kinds), but has an order.
    # A lower bound may lie below `least`: a t interval of a squared error can reach under zero.
    low, high = node.at(lo).number_or_none(), node.at(hi).number_or_none()
    if low is not None and high is not None and low > high:
        raise node.at(lo).fail(f"{lo} not above {hi} ({high:g})")
    return model.Estimate(node.at(value).number_or_none(least), low, high)


def _integers(node: Node, least: tuple[int, ...], shape: str) -> tuple[int, ...]:
    items = list(node.items())
    if len(items) != len(least):
        raise node.fail(f"{len(least)} integers, {shape}")
    return tuple(item.integer(minimum) for item, minimum in zip(items, least))


def _refuse_repeats(node: Node, values: list, expected: str) -> None:
    for value in values:
        if values.count(value) > 1:
            raise ReportError(f"{node.file}: {node.place}: found {value} twice, expected {expected}")
