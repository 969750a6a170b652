"""Ticks of logarithmic axes, labelled densely enough to read a value off a short axis."""

import math
from collections.abc import Sequence

from matplotlib.axis import Axis
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

from . import formats

_MANTISSAS = ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0),
              tuple(1 + i / 10 for i in range(90)))
_MOST_LABELS = 8


def set_log_ticks(axis: Axis, lo: float, hi: float, most: int = _MOST_LABELS) -> None:
    """Labels an axis over [lo, hi], 0 < lo < hi, at three to `most` round numbers."""
    ticks: list[float] = []
    for mantissas in _MANTISSAS:
        ticks = [m * 10.0**e for e in range(math.floor(math.log10(lo)), math.ceil(math.log10(hi)) + 1)
                 for m in mantissas if lo <= m * 10.0**e <= hi]
        if len(ticks) >= 3:
            break
    decades = [10.0**e * m for e in range(math.floor(math.log10(lo)), math.ceil(math.log10(hi)) + 1)
               for m in range(1, 10) if lo <= m * 10.0**e <= hi]
    _set(axis, thinned(ticks, most), decades if len(decades) <= 60 else [])


def set_value_ticks(axis: Axis, values: Sequence[float]) -> None:
    """Labels an axis at values that occur (numbers of samples), or at every second, third ... of them."""
    _set(axis, thinned(sorted(set(values))), [])


def thinned(ticks: list[float], most: int = _MOST_LABELS) -> list[float]:
    """At most so many of the ticks, evenly, the last one kept."""
    step = max(1, math.ceil(len(ticks) / most))
    return ticks[::-1][::step][::-1]


def _set(axis: Axis, ticks: list[float], minor: list[float]) -> None:
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_major_formatter(FixedFormatter([formats.short(tick) for tick in ticks]))
    axis.set_minor_locator(FixedLocator(minor) if minor else NullLocator())
    axis.set_minor_formatter(FixedFormatter([]))
