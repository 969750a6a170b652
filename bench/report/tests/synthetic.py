"""Results directories that look like real ones, made of nothing: errors with known slopes and gains."""

import json
import math
import random
import struct
import zlib
from pathlib import Path

SPPS = (1, 4, 16, 64, 256)
# name, label, CPU cost relative to random, share of the time spent in the sampler
SAMPLERS = (("random", "Random", 1.0, 0.03), ("stratified", "Stratified", 1.03, 0.05),
            ("halton:randomize=owen", "Halton (Owen)", 1.16, 0.14), ("sobol:randomize=owen", "Sobol' (Owen)", 1.05, 0.06))
# name: RMSE at 1 spp, slope of each sampler, CPU seconds at 1 spp, purpose, expectation
SCENES = {
    "smooth": (0.08, (-0.5, -0.82, -0.98, -1.22), 0.012, "Diffuse walls under a large soft light, nothing hidden.",
               "Every stratification pays; Sobol' with Owen scrambling goes beyond slope \u22121."),
    "penumbra": (0.15, (-0.5, -0.64, -0.66, -0.7), 0.011, "A square light behind a slanted edge: a jump in the light's domain.",
                 "Low-discrepancy samplers reach \u22120.75 at best."),
    "cornell": (0.31, (-0.5, -0.56, -0.55, -0.57), 0.021, "The Cornell box: many diffuse bounces, so many dimensions.",
                "Gains of two to three; samplers are hard to tell apart."),
    "veach": (0.42, (-0.5, -0.63, -0.6, -0.64), 0.017, "Four plates of rising roughness under four lights, after Veach.",
              "Stratifying the choice of the light pays."),
    "bokeh": (0.6, (-0.5, -0.53, -0.58, -0.62), 0.019, "Small bright lights out of focus behind a thin lens.",
              "The lens is two of the first dimensions."),
    "caustic": (1.9, (-0.5, -0.502, -0.499, -0.505), 0.018, "Light focused by glass and found only by chance.",
                "No sampler helps: a null result is the right one."),
}


def png(width: int, height: int, pixel) -> bytes:
    """An RGB PNG file; pixel(x, y) gives three integers of 0 to 255."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y)) for y in range(height))

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def make_summary(scenes=tuple(SCENES), samplers=SAMPLERS) -> dict:
    """A summary without pictures; the same each time."""
    rng = random.Random(1)
    return {
        "schema": 1,
        "experiment": {"name": "default", "title": "Four samplers in a path tracer", "command": "./koksma bench",
                       "commit": "abc1234", "machine": "AMD EPYC 9R14", "cores": 2, "isa": "avx512",
                       "compiler": "gcc 12.2.0", "threads": 2, "version": "0.1.0", "confidence": 0.95, "note": ""},
        "scenes": [_scene(name, samplers, rng) for name in scenes],
        "rows": 80, "other_commits": [], "invalid_samples": 0, "seconds_total": 1234.5,
    }


def write(directory: Path, summary: dict) -> Path:
    """Writes summary.json and returns the directory."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    return directory


def add_images(directory: Path, summary: dict, side: int = 32) -> None:
    """Gives the first scene crops as data and maps: a grey ramp with noise that falls from sampler to sampler, most of it in one corner."""
    import numpy as np
    rng = np.random.default_rng(1)
    (directory / "crops").mkdir(parents=True, exist_ok=True)
    scene = summary["scenes"][0]
    reference = np.repeat(np.linspace(0.2, 0.8, side * side, dtype=np.float32).reshape(side, side, 1), 3, axis=2)
    corner = np.ones((side, side))
    corner[side // 2:, :side // 2] = 4
    png_bytes = png(side, side, lambda x, y: (x, y, 128))

    def keep(name: str, values) -> str:
        np.save(directory / "crops" / name, values.astype(np.float32))
        return f"crops/{name}"

    def picture(name: str) -> str:
        (directory / "crops" / name).write_bytes(png_bytes)
        return f"crops/{name}"

    scene.update(reference_crop=picture("reference.png"), reference_data=keep("reference.npy", reference), reference_exr=picture("reference.exr"))
    for i, sampler in enumerate(scene["samplers"]):
        error = rng.normal(size=(side, side)) * corner * 0.05 / 2**i
        sampler.update(crop=picture(f"{i}.png"), crop_spp=16, crop_exr=picture(f"{i}.exr"), crop_data=keep(f"{i}.npy", reference + error[..., None]), heavy_tailed=False)
        sampler["image_error"] = {"spp": 16, "replicates": 4, "spectrum": [1.0] * (side // 2 + 1), "blurred": [{"sigma": 1.0, "rmse": {"value": 0.1, "lo": 0.09, "hi": 0.11}}],
                                  "median_pixel_gain": None, "bias_z_median": 0.7,
                                  "maps": {"mse": keep(f"{i}-mse.npy", (corner * 0.05 / 2**i) ** 2), "bias_z": keep(f"{i}-z.npy", rng.normal(size=(side, side)))}}
        for point in sampler["points"]:
            estimate = {"value": point["rmse"], "lo": point["rmse_lo"], "hi": point["rmse_hi"]}
            point.update(metrics={part: dict.fromkeys(("rmse", "relmse", "mae", "smape", "flip"), estimate) for part in ("all", "masked")}
                         | {"equivalent_random_spp": None}, efficiency=estimate, ns_per_path=100.0, fill="vector")


def _scene(name: str, samplers, rng: random.Random) -> dict:
    error, slopes, seconds, purpose, expect = SCENES[name]
    results = [_sampler(spec, error, slopes[i % len(slopes)], seconds, rng) for i, spec in enumerate(samplers)]
    baseline = results[0]["points"][-1]["rmse"]
    for result in results[1:]:
        ratio = (baseline / result["points"][-1]["rmse"]) ** 2
        result["gain_vs_random"] = {"spp": SPPS[-1], "mse_ratio": ratio, "lo": ratio * 0.86, "hi": ratio * 1.17}
    return {
        "name": name, "purpose": purpose, "expect": expect, "film": [512, 512], "crop": [200, 260, 64, 64],
        "max_depth": 8, "rr_depth": 5, "effects": ["area_light", "diffuse"], "dimensions": 27,
        "kernel": "reference/diffuse", "cost_of_effects": None,
        "reference": {"samplers": ["sobol:randomize=owen", "random"], "spp_total": 32768, "replicates": 16,
                      "se_rmse": error / 150 / math.sqrt(2), "halves_z": 0.4, "file": "references/" + name + ".exr"},
        "picture": None, "reference_crop": None, "reference_data": None, "reference_exr": None, "samplers": results,
        "predictions": [], "predictions_verdict": "not tested",
    }


def _sampler(spec, error: float, slope: float, seconds: float, rng: random.Random) -> dict:
    name, label, cost, share = spec
    points = []
    for spp in SPPS:
        rmse = error * spp**slope * math.exp(rng.gauss(0, 0.03))
        cpu = seconds * cost * spp * math.exp(rng.gauss(0, 0.01))
        relmse = rmse**2 / (4 * error**2)
        points.append({"spp": spp, "replicates": 16, "rmse": rmse, "rmse_lo": rmse * 0.94, "rmse_hi": rmse * 1.06,
                       "relmse": relmse, "relmse_lo": relmse * 0.88, "relmse_hi": relmse * 1.13, "cpu_seconds": cpu,
                       "wall_seconds": cpu / 1.9, "sampler_share": share, "below_floor": False})
    return {"sampler": name, "label": label, "randomized": True, "points": points,
            "slope": {"value": slope, "lo": slope - 0.03, "hi": slope + 0.03, "spp_from": 4, "spp_to": 256},
            "time_to": [_time_to(target, points) for target in (1e-1, 1e-2, 1e-3)],
            "gain_vs_random": None, "crop": None, "crop_spp": None, "crop_data": None, "crop_exr": None, "equal_time_vs_random": None, "progressive": None,
            "interval_coverage": None, "layouts": None, "any_count": None}


def _time_to(target: float, points: list[dict]) -> dict:
    entry = {"relmse": target, "seconds": None, "lo": None, "hi": None, "how": "not reached",
             "reached_relmse": points[-1]["relmse"]}
    for before, after in zip(points, points[1:]):
        if after["relmse"] <= target < before["relmse"]:
            part = math.log(target / before["relmse"]) / math.log(after["relmse"] / before["relmse"])
            seconds = before["cpu_seconds"] * (after["cpu_seconds"] / before["cpu_seconds"]) ** part
            return entry | {"seconds": seconds, "lo": seconds * 0.9, "hi": seconds * 1.12, "how": "interpolated"}
    return entry
