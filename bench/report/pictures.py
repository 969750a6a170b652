"""Pictures and arrays that a summary names; PNG files into data URIs: a report carries its pictures with it."""

import base64
import struct
from pathlib import Path

import numpy as np

from .check import Node, ReportError
from .model import Picture

_SIGNATURE = b"\x89PNG\r\n\x1a\n"  # PNG specification, section 5.2
_WIDEST_ROW = 1184  # CSS pixels: the page's column, style.css
_GAP = 16


def file_of(node: Node, directory: Path) -> Path | None:
    """The file that a node names, relative to the results directory; None for null.

    Raises ReportError when it is outside: a report is passed on to others, and must not carry files from elsewhere on the disk.
    """
    name = node.text_or_none()
    if name is None:
        return None
    path = directory / name
    if not path.resolve().is_relative_to(directory.resolve()):
        raise node.fail("a path inside the results directory")
    return path


def load_array(node: Node, directory: Path, dimensions: int) -> np.ndarray | None:
    """The NumPy file that a node names; None for null. Raises ReportError when it is missing or of another number of dimensions."""
    path = file_of(node, directory)
    if path is None:
        return None
    try:
        values = np.load(path, allow_pickle=False)
    except (OSError, ValueError) as error:
        raise ReportError(f"{path}: {error}, expected the NumPy file of {node.place}") from None
    if values.ndim != dimensions or 0 in values.shape:
        raise ReportError(f"{path}: found shape {values.shape}, expected {dimensions} dimensions")
    return values.astype(np.float64)


def load_picture(node: Node, directory: Path) -> Picture | None:
    """Loads the PNG file that a node names, relative to the results directory; None for null.

    Raises ReportError when the file is missing, not a PNG, or outside the directory.
    """
    path = file_of(node, directory)
    if path is None:
        return None
    try:
        data = path.read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ReportError(f"{path}: {reason}, expected the PNG file of {node.place} in {node.file}") from None
    if len(data) < 24 or data[:8] != _SIGNATURE or data[12:16] != b"IHDR":
        raise ReportError(f"{path}: found no PNG header, expected the PNG file of {node.place} in {node.file}")
    width, height = struct.unpack(">II", data[16:24])
    if width == 0 or height == 0:
        raise ReportError(f"{path}: found {width} x {height} pixels, expected a picture with some")
    return Picture(data, width, height)


def data_uri(picture: Picture) -> str:
    """The picture as the text of an src attribute."""
    return "data:image/png;base64," + base64.b64encode(picture.data).decode("ascii")


def enlargement(width_px: int, count: int) -> int:
    """Whole factor at which to show `count` small pictures so that pixels stay square and visible.

    4 or 3 where they fit in one row; else 3 where at least two do; else as much as fits, at least 1.
    """
    for factor, across in ((4, count), (3, count), (3, 2), (2, 2), (2, 1)):
        if across * width_px * factor + (across - 1) * _GAP <= _WIDEST_ROW:
            return factor
    return 1
