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
        "invalid_samples": 0, "seconds_total": 1234.5,
    }


def write(directory: Path, summary: dict) -> Path:
    """Writes summary.json and returns the directory."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    return directory


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
        "picture": None, "reference_crop": None, "samplers": results,
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
            "gain_vs_random": None, "crop": None, "crop_spp": None, "error_map": None, "layouts": None, "any_count": None}


def _time_to(target: float, points: list[dict]) -> dict:
    entry = {"relmse": target, "seconds": None, "lo": None, "hi": None, "how": "not reached",
             "reached_relmse": points[-1]["relmse"]}
    for before, after in zip(points, points[1:]):
        if after["relmse"] <= target < before["relmse"]:
            part = math.log(target / before["relmse"]) / math.log(after["relmse"] / before["relmse"])
            seconds = before["cpu_seconds"] * (after["cpu_seconds"] / before["cpu_seconds"]) ** part
            return entry | {"seconds": seconds, "lo": seconds * 0.9, "hi": seconds * 1.12, "how": "interpolated"}
    return entry
