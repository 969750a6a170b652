"""Numbers as text, for people: significant digits, a true minus sign, thin spaces between thousands."""

import math

from .model import Estimate

NONE = "\u2014"
_LEAST_POWER, _LARGEST_POWER = -4, 5  # of ten, outside which a number is written with one
_SUPERSCRIPTS = str.maketrans("-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079")


def significant(value: float | None, digits: int = 3) -> str:
    """A number to so many significant digits: decimal in [1e-4, 1e6), otherwise with a power of ten."""
    if value is None:
        return NONE
    if value == 0:
        return "0"
    mantissa, power = _split(value, digits)
    if _LEAST_POWER <= power <= _LARGEST_POWER:
        return _dressed(f"{value:,.{max(0, digits - 1 - power)}f}")
    return f"{_dressed(mantissa)}\u00d7{power_of_ten(power)}"


def power_of_ten(exponent: int) -> str:
    """10 with the exponent as superscript characters, which need no markup in SVG and in HTML."""
    return "10" + str(exponent).translate(_SUPERSCRIPTS)


def short(value: float) -> str:
    """A round number (a tick, a target) with as few characters as possible."""
    exponent = math.floor(math.log10(value) + 1e-9)
    mantissa = value / 10.0**exponent
    if -3 <= exponent < 5:
        return _dressed(f"{value:,.12f}".rstrip("0").rstrip("."))
    return power_of_ten(exponent) if abs(mantissa - 1) < 1e-9 else f"{mantissa:g}\u00d7{power_of_ten(exponent)}"


def count(value: int) -> str:
    """An integer with thin spaces between thousands."""
    return _dressed(f"{value:,d}")


def fixed(value: float | None, decimals: int = 2) -> str:
    """A number with so many decimals."""
    return NONE if value is None else _dressed(f"{value:.{decimals}f}")


def slope(value: float | None) -> str:
    """An exponent: intervals of slopes are often narrower than a hundredth."""
    return fixed(value, 3)


def percent(value: float | None, decimals: int = 1) -> str:
    """A share in [0, 1] as per cent."""
    return NONE if value is None else f"{value * 100:.{decimals}f}\u2009%"


def interval(estimate: Estimate, write=significant) -> str:
    """"[lo, hi]", or nothing when neither bound is known; a power of ten of the value goes outside."""
    if estimate.lo is None and estimate.hi is None:
        return ""
    if write is significant and estimate.value:
        power = _split(estimate.value, 3)[1]
        if not _LEAST_POWER <= power <= _LARGEST_POWER:
            lo, hi = (None if bound is None else bound / 10.0**power for bound in (estimate.lo, estimate.hi))
            return f"[{write(lo)}, {write(hi)}]\u00d7{power_of_ten(power)}"
    return f"[{write(estimate.lo)}, {write(estimate.hi)}]"


def duration(seconds: float) -> str:
    """Seconds, with minutes or hours beside them when there are many."""
    text = f"{significant(seconds)}\u00a0s"
    if seconds >= 5400:
        return f"{text} ({fixed(seconds / 3600, 1)}\u00a0h)"
    return f"{text} ({fixed(seconds / 60, 1)}\u00a0min)" if seconds >= 120 else text


def _split(value: float, digits: int) -> tuple[str, int]:
    """Mantissa and power of ten of the value as rounded: 9.996e-5 is 1.00 and -4."""
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    return mantissa, int(power)


def _dressed(text: str) -> str:
    return text.replace("-", "\u2212").replace(",", "\u202f")
