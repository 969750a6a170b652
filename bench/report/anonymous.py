"""A copy of results for blind review: without machine, paths and commit."""

import json
from dataclasses import replace
from pathlib import Path

from .model import Summary

WITHHELD = "withheld"
_KEYS = {"machine", "commit"}


def anonymous(summary: Summary, folder: Path) -> Summary:
    """The summary as it is shown from `folder`, which is to hold the copy."""
    experiment = replace(summary.experiment, machine=WITHHELD, commit=WITHHELD, command=_command(summary.experiment.name), note="")
    others = tuple((WITHHELD, count) for _, count in summary.other_commits)
    return replace(summary, directory=folder, experiment=experiment, other_commits=others)


def anonymous_json(text: str) -> str:
    """One JSON value with what is withheld replaced, wherever it stands."""
    value = json.loads(text)
    experiment = value.get("experiment")
    if isinstance(experiment, dict):
        experiment.update(command=_command(experiment.get("name", "default")), note="")
    return json.dumps(_cleaned(value), separators=(",", ":"))


def _command(name: str) -> str:
    return f"./koksma bench {name}"


def _cleaned(value):
    if isinstance(value, dict):
        return {key: WITHHELD if key in _KEYS else _cleaned(item) for key, item in value.items()}
    return [_cleaned(item) for item in value] if isinstance(value, list) else value
