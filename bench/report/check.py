"""Typed access to parsed JSON, with errors that say where, what was found and what was expected."""

import math
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

_LARGEST = sys.float_info.max


class ReportError(Exception):
    """A report cannot be made. The message is one line that names the file and what was expected."""


@dataclass(frozen=True)
class Node:
    """A JSON value, the file it came from and its place there.

    Every access either returns a value of the type in its name or raises ReportError. The `_or_none`
    accesses also take null. Keys that nobody asks for are ignored, so a newer program may add some;
    no key is optional, so a misspelt one is found.
    """

    value: Any
    file: str
    place: str = ""

    def fail(self, expected: str) -> ReportError:
        """Returns (does not raise) the error that this value is not what was expected."""
        at = f" {self.place}:" if self.place else ""
        return ReportError(f"{self.file}:{at} found {_shown(self.value)}, expected {expected}")

    def at(self, key: str) -> "Node":
        """The member of an object."""
        if not isinstance(self.value, dict):
            raise self.fail("an object")
        place = f"{self.place}.{key}" if self.place else key
        if key not in self.value:
            raise ReportError(f"{self.file}: {place}: missing, expected the key \"{key}\"")
        return Node(self.value[key], self.file, place)

    def items(self) -> Iterator["Node"]:
        """The elements of an array."""
        if not isinstance(self.value, list):
            raise self.fail("an array")
        for i, value in enumerate(self.value):
            yield Node(value, self.file, f"{self.place}[{i}]")

    def is_null(self) -> bool:
        """Whether the value is null."""
        return self.value is None

    def text(self) -> str:
        """A string, possibly empty."""
        if not isinstance(self.value, str):
            raise self.fail("a string")
        return self.value

    def text_or_none(self) -> str | None:
        """A string or null."""
        return None if self.is_null() else self.text()

    def name(self) -> str:
        """A string with something in it."""
        if not isinstance(self.value, str) or not self.value.strip():
            raise self.fail("a non-empty string")
        return self.value

    def one_of(self, *names: str) -> str:
        """One of the given strings."""
        if self.value not in names:
            raise self.fail("one of " + ", ".join(f'"{name}"' for name in names))
        return self.value

    def flag(self) -> bool:
        """true or false."""
        if not isinstance(self.value, bool):
            raise self.fail("true or false")
        return self.value

    def integer(self, least: int = 0) -> int:
        """An integer, `least` or more."""
        if not isinstance(self.value, int) or isinstance(self.value, bool) or self.value < least:
            raise self.fail(f"an integer, {least} or more")
        return self.value

    def number(self, least: float = -math.inf) -> float:
        """A finite number, `least` or more."""
        good = isinstance(self.value, (int, float)) and not isinstance(self.value, bool)
        # Compared, not math.isfinite: that one overflows on an integer of 400 digits.
        if not good or not -_LARGEST <= self.value <= _LARGEST or self.value < least:
            raise self.fail("a number" if least == -math.inf else f"a number, {least:g} or more")
        return float(self.value)

    def number_or_none(self, least: float = -math.inf) -> float | None:
        """A finite number, `least` or more, or null."""
        return None if self.is_null() else self.number(least)


def _shown(value: Any) -> str:
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return f"an array of {len(value)}"
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= 60 else text[:57] + "..."
