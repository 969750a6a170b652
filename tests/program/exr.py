"""Reads OpenEXR files with the standard library alone: single part, scan lines, no compression or ZIP.

Not a copy of the program's reader, on purpose: the tests compare numbers that went through the file with numbers that the
program printed.
Source: openexr.com, "OpenEXR File Layout"; the predictor and the byte order of ZIP are those of ImfZip.cpp.
"""

import struct
import zlib

PIXEL_FORMATS = {0: "I", 1: "e", 2: "f"}  # UINT, HALF, FLOAT
LINES_PER_CHUNK = {0: 1, 2: 1, 3: 16}     # NO_COMPRESSION, ZIPS, ZIP


class Exr:
    """`channels[name][y][x]`, rows and columns counted from the data window's corner; `attributes`: strings only."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self._data = file.read()
        magic, version = struct.unpack_from("<II", self._data, 0)
        assert magic == 20000630 and version & 0xFF == 2 and version >> 8 == 0, "not a plain scan-line OpenEXR file"
        raw, position = self._read_header(8)
        self.attributes = {name: value.decode() for name, (kind, value) in raw.items() if kind == "string"}
        self.data_window = struct.unpack("<4i", raw["dataWindow"][1])
        self.display_window = struct.unpack("<4i", raw["displayWindow"][1])
        self.width = self.data_window[2] - self.data_window[0] + 1
        self.height = self.data_window[3] - self.data_window[1] + 1
        self._read_pixels(position, raw["compression"][1][0], channel_list(raw["channels"][1]))

    def pixel(self, x, y):
        """RGB of a pixel of the full film."""
        return tuple(self.channels[c][y - self.data_window[1]][x - self.data_window[0]] for c in "RGB")

    def flat(self, names=("R", "G", "B")):
        """All values in the order (height, width, channel)."""
        return [self.channels[c][y][x] for y in range(self.height) for x in range(self.width) for c in names]

    def _read_header(self, position):
        raw = {}
        while self._data[position] != 0:
            name, position = text_at(self._data, position)
            kind, position = text_at(self._data, position)
            (size,) = struct.unpack_from("<i", self._data, position)
            raw[name] = (kind, self._data[position + 4:position + 4 + size])
            position += 4 + size
        return raw, position + 1

    def _read_pixels(self, position, compression, channels):
        self.channels = {name: [None] * self.height for name, _ in channels}
        lines = LINES_PER_CHUNK[compression]
        chunks = -(-self.height // lines)
        for offset in struct.unpack_from(f"<{chunks}Q", self._data, position):
            y, size = struct.unpack_from("<ii", self._data, offset)
            y -= self.data_window[1]
            rows = min(lines, self.height - y)
            expected = rows * sum(self.width * struct.calcsize(format) for _, format in channels)
            block = self._data[offset + 8:offset + 8 + size]
            if size < expected:  # a block that does not shrink is stored as it is
                block = unzipped(block)
            assert len(block) == expected, "a block of pixels has the wrong size"
            at = 0
            for row in range(y, y + rows):
                for name, format in channels:
                    self.channels[name][row] = struct.unpack_from(f"<{self.width}{format}", block, at)
                    at += self.width * struct.calcsize(format)


def text_at(data, position):
    end = data.index(0, position)
    return data[position:end].decode(), end + 1


def channel_list(data):
    channels, position = [], 0
    while data[position] != 0:
        name, position = text_at(data, position)
        channels.append((name, PIXEL_FORMATS[struct.unpack_from("<i", data, position)[0]]))
        position += 16
    return channels


def unzipped(block):
    data = bytearray(zlib.decompress(block))
    for i in range(1, len(data)):
        data[i] = (data[i - 1] + data[i] - 128) & 0xFF
    half = (len(data) + 1) // 2
    out = bytearray(len(data))
    out[0::2], out[1::2] = data[:half], data[half:]
    return bytes(out)
