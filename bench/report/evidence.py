"""What stands behind a scene's two figures: every metric, who is told apart from whom, and where and at which frequencies the error is."""

import io
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib import colormaps, style
from matplotlib.figure import Figure
from matplotlib.image import imsave

from .check import Node
from .figures import MOST_IN_KEY
from .model import Estimate, Picture
from .palette import Style
from .pictures import load_array
from .svg import drawing, inline_svg
from .ticks import set_log_ticks

METRICS = ("rmse", "relmse", "mae", "smape", "flip")


@dataclass(frozen=True)
class Metrics:
    """One sampler at its largest spp; `masked`: without pixels that see an emitter directly."""

    sampler: str
    label: str
    spp: int
    all: dict[str, Estimate]
    masked: dict[str, Estimate]
    equivalent: Estimate
    efficiency: Estimate
    ns_per_path: float | None
    fill: str
    heavy_tailed: bool


@dataclass(frozen=True)
class ImageError:
    """What kept replicates of one sampler say."""

    sampler: str
    label: str
    spp: int
    replicates: int
    spectrum: tuple[float, ...]
    blurred: tuple[tuple[float, Estimate], ...]
    median_gain: float | None
    z_median: float | None
    error: Picture
    bias: Picture
    mse_map: np.ndarray  # (height, width), mean over replicates
    bias_map: np.ndarray  # in standard errors


@dataclass(frozen=True)
class Pair:
    """Two samplers at their largest common spp; `better` is one of them, or None where they cannot be told apart."""

    a: str
    b: str
    better: str | None
    ratio: Estimate
    p_holm: float | None
    spp: int
    b_overtakes: Estimate | None  # ns a path below which b would be as efficient as a
    a_overtakes: Estimate | None
    ns: tuple[float | None, float | None]  # a path of a and of b, as measured


@dataclass(frozen=True)
class Evidence:
    """All of it for one scene; empty parts where the results are of an older program."""

    metrics: tuple[Metrics, ...]
    halves: dict[str, float]
    masked_pixels: int
    images: tuple[ImageError, ...]
    pairs: tuple[Pair, ...]
    map_top: float = 1.0  # RMSE at the light end of the error maps


def load_evidence(scene: Node, directory: Path) -> Evidence:
    """Reads a scene of summary.json, and the maps that it names."""
    samplers = list(scene.at("samplers").items())
    metrics = tuple(_metrics(s) for s in samplers if "heavy_tailed" in s.value and s.value["points"])
    with_images = [s for s in samplers if s.value.get("image_error")]
    maps = {s.at("sampler").text(): {kind: load_array(s.at("image_error").at("maps").at(kind), directory, 2) for kind in ("mse", "bias_z")} for s in with_images}
    # One scale for all samplers of a scene: the brightest hundredth is the end of it.
    top = max((float(np.quantile(np.sqrt(m["mse"]), 0.99)) for m in maps.values()), default=1.0) or 1.0
    images = tuple(_image_error(s, maps[s.at("sampler").text()], top) for s in with_images)
    halves = scene.at("reference").value.get("between_halves") or {}
    pairs = tuple(_pair(node) for node in (scene.at("pairs").items() if "pairs" in scene.value else ()))
    return Evidence(metrics, {k: v for k, v in halves.items() if v is not None}, scene.value.get("emitter_pixels", 0), images, pairs, top)


def _estimate(node: Node) -> Estimate:
    return Estimate(*(node.at(key).number_or_none() for key in ("value", "lo", "hi")))


def _metrics(sampler: Node) -> Metrics:
    point = max(sampler.at("points").items(), key=lambda node: node.at("spp").integer(1))
    metrics = point.at("metrics")
    equivalent = metrics.at("equivalent_random_spp")
    return Metrics(sampler.at("sampler").name(), sampler.at("label").name(), point.at("spp").integer(1),
                   *({name: _estimate(metrics.at(part).at(name)) for name in METRICS} for part in ("all", "masked")),
                   Estimate(None) if equivalent.is_null() else _estimate(equivalent), _estimate(point.at("efficiency")),
                   point.at("ns_per_path").number_or_none(0), point.at("fill").text(), sampler.at("heavy_tailed").flag())


def _pair(node: Node) -> Pair:
    overtakes = [node.at(f"{who}_overtakes_below_ns_per_path") for who in "ba"]
    ns = (None, None) if overtakes[0].is_null() else tuple(overtakes[0].at(key).number_or_none(0) for key in ("ns_a", "ns_b"))
    return Pair(node.at("a").name(), node.at("b").name(), node.at("better").text_or_none(), _estimate(node.at("mse_ratio")), node.at("p_holm").number_or_none(0),
                node.at("spp").integer(1), *(None if o.is_null() else _estimate(o) for o in overtakes), ns)


def _image_error(sampler: Node, maps: dict[str, np.ndarray], top: float) -> ImageError:
    node = sampler.at("image_error")
    return ImageError(sampler.at("sampler").name(), sampler.at("label").name(), node.at("spp").integer(1), node.at("replicates").integer(2),
                      tuple(item.number(0) for item in node.at("spectrum").items()),
                      tuple((item.at("sigma").number(0), _estimate(item.at("rmse"))) for item in node.at("blurred").items()),
                      node.at("median_pixel_gain").number_or_none(0), node.at("bias_z_median").number_or_none(0),
                      # Perceptually uniform: equal steps look equal. The square root is an RMSE per pixel.
                      _png(colormaps["magma"](np.clip(np.sqrt(maps["mse"]) / top, 0, 1))),
                      _png(colormaps["RdBu_r"](np.clip(np.nan_to_num(maps["bias_z"]) / 8 + 0.5, 0, 1))), maps["mse"], maps["bias_z"])


def _png(rgba: np.ndarray) -> Picture:
    buffer = io.BytesIO()
    imsave(buffer, (rgba[..., :3] * 255 + 0.5).astype(np.uint8), format="png")
    return Picture(buffer.getvalue(), rgba.shape[1], rgba.shape[0])


def spectrum_figure(evidence: Evidence, styles: dict[str, Style], key: str) -> Markup:
    """Power of the error by frequency; white noise is flat, blue noise rises from the left."""
    with style.context(drawing(key)):
        figure = Figure(figsize=(5.75, 3.2))
        axes = figure.add_axes((0.115, 0.15, 0.865, 0.74), yscale="log")
        axes.set_title(f"Error spectrum at {evidence.images[0].spp} spp", x=-0.11)
        axes.set_xlabel("frequency, cycles a pixel")
        axes.set_ylabel("power")
        axes.grid(True, which="major")
        ends = []
        for image in evidence.images:
            look, power = styles[image.sampler], image.spectrum[1:]
            steps = 2 * (len(image.spectrum) - 1) or 1
            axes.plot([(i + 1) / steps for i in range(len(power))], power, color=look.color, dashes=look.dashes or (None, None), linewidth=1.3, label=image.label)
            ends += [value for value in power if value > 0]
        axes.set_xlim(0, 0.5)
        if ends:
            lo, hi = min(ends) / 1.3, max(ends) * 1.3
            axes.set_ylim(lo, hi)
            set_log_ticks(axes.yaxis, lo, hi)
        if len(evidence.images) <= MOST_IN_KEY:
            for text in axes.legend(loc="best", borderaxespad=0.2).get_texts():
                text.set_parse_math(False)
        return inline_svg(figure, key, "Power of the error by frequency for " + ", ".join(i.label for i in evidence.images))


def told_apart(evidence: Evidence) -> tuple[list[Pair], list[Pair]]:
    """Pairs that are told apart, the largest difference first, and those that are not."""
    def size(pair: Pair) -> float:
        return -abs(math.log(pair.ratio.value)) if pair.ratio.value else 0.0
    return sorted((p for p in evidence.pairs if p.better), key=size), [p for p in evidence.pairs if not p.better]
