"""What the viewer in a report shows: linear radiance of the crops, maps, and the window where the samplers differ most."""

import base64
import json
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from matplotlib import colormaps

from .model import Scene

WINDOW = 16  # pixels a side of the window that is shown enlarged
LUMINANCE = np.array((0.212671, 0.715160, 0.072169))  # of linear Rec. 709


@dataclass(frozen=True)
class Window:
    """Pixels [x, x + width) x [y, y + height) of the crop; ratio: largest over smallest MSE of the samplers in it."""

    x: int
    y: int
    width: int
    height: int
    best: str
    worst: str
    ratio: float


def window_of_difference(scene: Scene) -> Window | None:
    """The window in which the largest and the smallest relative MSE of the scene's samplers lie furthest apart; None without two maps.

    The MSE of a pixel is a mean over replicates, so that the noise of one render does not choose. It is relative to what is there, and
    pixels that the picture shows as white do not count: a difference is to be seen.
    """
    images = scene.evidence.images if scene.evidence else ()
    if len(images) < 2:
        return None
    stack = np.stack([image.mse_map for image in images])
    height, width = (min(WINDOW, size) for size in stack.shape[1:])
    boxes = _sums_over_windows(stack * _visibility(scene.reference_data) if scene.reference_data is not None else stack, width, height)
    apart = boxes.max(axis=0) - boxes.min(axis=0)
    y, x = np.unravel_index(np.argmax(apart), apart.shape)
    at = stack[:, y:y + height, x:x + width].sum(axis=(1, 2))
    least = max(float(at.min()), float(np.finfo(np.float32).tiny))
    return Window(int(x), int(y), width, height, images[int(at.argmin())].label, images[int(at.argmax())].label, float(at.max()) / least)


def _visibility(reference: np.ndarray) -> np.ndarray:
    """1 / (luminance^2 + a hundredth of its mean squared), the weight of relMSE; 0 where the picture is white."""
    luminance = reference @ LUMINANCE
    weight = 1 / (luminance**2 + 0.01 * luminance.mean() ** 2 + np.finfo(np.float32).tiny)
    return np.where(luminance * exposure_of(reference) < 1, weight, 0)


def _sums_over_windows(maps: np.ndarray, width: int, height: int) -> np.ndarray:
    """Differences of the table of sums from the corner; shape (maps, places in y, places in x)."""
    sums = np.pad(maps.cumsum(axis=1).cumsum(axis=2), ((0, 0), (1, 0), (1, 0)))
    return sums[:, height:, width:] - sums[:, :-height, width:] - sums[:, height:, :-width] + sums[:, :-height, :-width]


def exposure_of(reference: np.ndarray) -> float:
    """What brings the luminance that nine tenths of the pixels do not exceed to 0.6; as the program's pictures."""
    luminance = np.sort((reference @ LUMINANCE).ravel())
    luminance = luminance[np.isfinite(luminance) & (luminance > 0)]
    return 0.6 / float(luminance[int(0.9 * (len(luminance) - 1))]) if len(luminance) else 1.0


def viewer_json(scene: Scene, window: Window | None, right: str = "") -> Markup | None:
    """The viewer's data as JSON, safe inside a script element; None where the scene has no crops as data.

    right  the sampler that is shown on the right at first; on the left is the first of the scene
    The reference is of 32-bit floats; images are their differences from it, and maps their values, as 16-bit floats in units of `top`, which
    the small errors of good samplers need.
    """
    if scene.reference_data is None:
        return None
    samplers = [s for s in scene.samplers if s.crop_data is not None]
    maps = {image.sampler: image for image in (scene.evidence.images if scene.evidence else ())}
    top = scene.evidence.map_top if scene.evidence else 1.0
    reference = scene.reference_data
    images = [{"label": "Reference", "difference": None, "rmse": None, "bias": None}]
    for s in samplers:
        image = maps.get(s.sampler)
        images.append({"label": f"{s.label}, {s.crop_spp} spp", "difference": _half((s.crop_data - reference) / top),
                       "rmse": _half(np.sqrt(image.mse_map) / top) if image else None, "bias": _half(np.nan_to_num(image.bias_map)) if image else None})
    height, width = reference.shape[:2]
    data = {"width": width, "height": height, "exposure": exposure_of(reference), "top": top,
            "reference": base64.b64encode(np.nan_to_num(reference).astype("<f4").tobytes()).decode(),
            "right": next((i for i, s in enumerate(samplers, 1) if s.sampler == right), len(samplers)),
            "window": [window.x, window.y, window.width, window.height] if window else None, "images": images}
    return Markup(json.dumps(data, separators=(",", ":")).replace("<", "\\u003c"))


def colour_maps_json() -> Markup:
    """Both colour maps as base64 of 256 RGB triples. magma is perceptually uniform, RdBu diverges and is safe for the colour-blind."""
    def triples(name: str) -> str:
        return base64.b64encode((colormaps[name](np.linspace(0, 1, 256))[:, :3] * 255 + 0.5).astype(np.uint8).tobytes()).decode()
    return Markup(json.dumps({"error": triples("magma"), "bias": triples("RdBu_r")}))


def detail_style(window: Window, width: int, height: int, zoom: int) -> str:
    """CSS of an img that shows the window of a picture of the crop, enlarged."""
    return (f"width:{width * zoom}px;height:{height * zoom}px;margin-left:{-window.x * zoom}px;margin-top:{-window.y * zoom}px")


def _half(values: np.ndarray) -> str:
    largest = float(np.finfo(np.float16).max)
    return base64.b64encode(np.clip(np.nan_to_num(values), -largest, largest).astype("<f2").tobytes()).decode()
