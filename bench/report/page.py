"""Lays out a summary as one HTML page that needs nothing else: no network, no files beside it."""

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from . import evidence as behind
from . import formats, tables
from .counts_layouts import gain_at_counts, layout_spread
from .figures import MOST_IN_KEY, error_vs_seconds, error_vs_spp
from .progressive import progressive_figure
from .model import Picture, Scene, Summary
from .overview import overview_figure
from .palette import Style, assign_styles, swatch
from .pictures import data_uri, enlargement
from .tails import finding_tails, gain_tails, marked, tails
from .viewer import colour_maps_json, detail_style, viewer_json, window_of_difference

_HERE = Path(__file__).parent


def render_page(summary: Summary) -> str:
    """The text of report.html. The same summary gives the same bytes."""
    columns = tables.sampler_columns(summary)
    styles = assign_styles(columns)
    rows = [tables.overview_row(scene) for scene in summary.scenes]
    context = {
        "summary": summary, "experiment": summary.experiment,
        "confidence": f"{summary.experiment.confidence * 100:g}\u2009%",
        "columns": columns, "tally": tables.tally(rows), "rows": list(zip(summary.scenes, rows)),
        "overview": overview_figure(summary, styles, "overview"),
        "scenes": [_scene_context(scene, styles, f"scene{i}") for i, scene in enumerate(summary.scenes, 1)],
        "anchors": {scene.name: f"scene{i}" for i, scene in enumerate(summary.scenes, 1)}, "grid_titles": _grid_titles(summary),
        "titled": lambda rows, titles: [(scene, row) for scene, row in rows if titles[scene.name] is not None],
        "has_targets": any(tables.targets(scene) for scene in summary.scenes),
        "colour_maps": colour_maps_json(), "verdicts": _count_verdicts(summary),
        "has_predictions": any(scene.predictions for scene in summary.scenes),
        "has_equal_time": any(s.equal_time for scene in summary.scenes for s in scene.samplers),
        "heavy": marked(summary),
        "has_rows_file": (summary.directory / "results.jsonl").is_file(),
    }
    return _environment(styles).get_template("template.html.j2").render(context)


def _scene_context(scene: Scene, styles: dict[str, Style], key: str) -> dict:
    crops = [picture for picture in (scene.reference_crop, *(s.crop for s in scene.samplers)) if picture]
    widest = max((picture.width for picture in crops), default=0)
    evidence = scene.evidence or behind.Evidence((), {}, 0, (), ())
    apart, alike = behind.told_apart(evidence)
    window, winner = window_of_difference(scene), tables.winner(scene)
    return {
        "window": window, "viewer": viewer_json(scene, window, winner.leaders[0].sampler if winner else ""), "winner": winner, "many": len(scene.samplers) > MOST_IN_KEY,
        "pair_matrix": tables.pair_matrix(scene) if evidence.pairs else [], "overtaking": tables.overtaking(scene),
        "progressive_figure": progressive_figure(scene, styles, f"{key}-progressive") if any(s.progressive for s in scene.samplers) else "",
        "evidence": evidence, "apart": apart, "alike": alike, "labels": {s.sampler: s.label for s in scene.samplers},
        "spectrum_figure": behind.spectrum_figure(evidence, styles, f"{key}-spectrum") if evidence.images else "",
        "scene": scene, "key": key,
        "spp_figure": error_vs_spp(scene, styles, f"{key}-spp"),
        "seconds_figure": error_vs_seconds(scene, styles, f"{key}-seconds"),
        "targets": tables.targets(scene), "remarks": tables.remarks(scene),
        "crops": crops, "enlargement": enlargement(widest, len(crops)) if crops else 1,
        "has_points_below_floor": any(p.below_floor for s in scene.samplers for p in s.points),
        "crop_frame": _crop_frame(scene),
        "layout_figure": layout_spread(scene, styles, f"{key}-layouts") if any(s.layouts for s in scene.samplers) else "",
        "count_rows": tables.count_rows(scene),
        "count_figure": gain_at_counts(scene, styles, f"{key}-counts") if any(s.counts for s in scene.samplers) else "",
    }


def _grid_titles(summary: Summary) -> dict[str, dict[str, str | None]]:
    """What stands beside a scene's name in each table of the overview; None: the scene is not in it."""
    spps = {scene.name: tables.gain_spp(scene) for scene in summary.scenes}
    wanted = {scene.name: tables.common_target(scene) for scene in summary.scenes}
    return {"gain": {name: f"at {formats.count(spp)} spp" if spp else "" for name, spp in spps.items()}, "time": dict.fromkeys(spps, ""),
            "target": {name: f"relMSE {formats.short(target)}" if target else None for name, target in wanted.items()}}


def _count_verdicts(summary: Summary) -> dict[str, int]:
    verdicts = [prediction.verdict for scene in summary.scenes for prediction in scene.predictions]
    return {verdict: verdicts.count(verdict) for verdict in ("held", "refuted", "undecided", "not tested")}


def _crop_frame(scene: Scene) -> tuple[float, float, float, float] | None:
    """Where the crop lies in the scene's picture, as per cent of left, top, width and height.

    None when the picture cannot be of the whole film (its shape differs), or the crop is all of it.
    """
    if scene.picture is None:
        return None
    (film_w, film_h), (x, y, w, h) = scene.film, scene.crop
    same_shape = abs(scene.picture.width * film_h - scene.picture.height * film_w) <= max(film_w, film_h)
    inside = x + w <= film_w and y + h <= film_h
    if not same_shape or not inside or (w, h) == (film_w, film_h):
        return None
    return tuple(round(100 * part / whole, 3) for part, whole in ((x, film_w), (y, film_h), (w, film_w), (h, film_h)))


def _environment(styles: dict[str, Style]) -> Environment:
    environment = Environment(loader=FileSystemLoader(_HERE), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
    environment.filters.update(
        sig=formats.significant, fixed=formats.fixed, count=formats.count, percent=formats.percent,
        short=formats.short, duration=formats.duration,
        interval=formats.interval, slope=formats.slope, slope_interval=lambda estimate: formats.interval(estimate, formats.slope),
        uri=lambda picture: data_uri(picture) if isinstance(picture, Picture) else "")
    environment.globals.update(
        tails=tails, gain_tails=gain_tails, finding_tails=finding_tails, detail_style=detail_style,
        key_of=lambda sampler: swatch(styles[sampler.sampler]),
        time_to=tables.time_to, common_target=tables.common_target, fastest=tables.fastest, gain_spp=tables.gain_spp)
    return environment
