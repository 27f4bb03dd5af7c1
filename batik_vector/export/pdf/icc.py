"""ICC profiles of presses (ICC.1:2022), read as far as a PDF needs to tell what it was made for."""

from __future__ import annotations

from batik_vector.errors import ExportError
from batik_vector.values import frozen

HEADER = 128
"""Bytes before the table of tags, which begins with their number in 4."""
ENTRY = 12
"""Bytes of an entry of that table: signature, offset, size."""
MOST_TAGS = 1000
COMPONENTS = {"GRAY": 1, "RGB": 3, "CMYK": 4}
CLASSES = {
    "prtr": "an output device",
    "mntr": "a display",
    "scnr": "an input device",
    "link": "a link of two devices",
    "spac": "a colour space",
    "abst": "an effect",
    "nmcl": "named colours",
}


@frozen
class IccProfile:
    """What a press makes of colours: the file, its colour space (``CMYK``, ``RGB``, ``GRAY``), its name."""

    data: bytes
    space: str
    name: str

    @property
    def components(self) -> int:
        """Numbers that make a colour."""
        return COMPONENTS[self.space]


def icc_profile(data: bytes) -> IccProfile:
    """Return the profile that a file holds.

    Raises:
        ExportError: where it is none, or none of an output device, with what was found.
    """
    if len(data) < HEADER + 4 or data[36:40] != b"acsp":
        raise ExportError("is no ICC profile: expected an .icc or .icm file of the press and its paper")
    size = _number(data, 0)
    if size != len(data):
        raise ExportError(
            f"is an ICC profile of {size:,} bytes, and the file has {len(data):,}: it is damaged"
        )
    kind, space = _letters(data, 12), _letters(data, 16)
    if kind != "prtr":
        found = CLASSES.get(kind, "an unknown device")
        raise ExportError(f"is an ICC profile of {found}, expected one of an output device, such as a press")
    if space not in COMPONENTS:
        raise ExportError(f'is an ICC profile of "{space}" colours, expected CMYK, RGB or GRAY')
    return IccProfile(data, space, _description(_tag(data, b"desc")))


def _number(data: bytes, at: int, size: int = 4) -> int:
    return int.from_bytes(data[at : at + size], "big")


def _letters(data: bytes, at: int) -> str:
    return data[at : at + 4].decode("latin-1").rstrip("\0 ")


def _tag(data: bytes, wanted: bytes) -> bytes:
    """Return a tag, empty where there is none such; all must lie within the file."""
    count = _number(data, HEADER)
    if count > MOST_TAGS or HEADER + 4 + count * ENTRY > len(data):
        raise ExportError(f"is an ICC profile with a table of {count:,} tags: it is damaged")
    found = b""
    for number in range(count):
        at = HEADER + 4 + number * ENTRY
        start, size = _number(data, at + 4), _number(data, at + 8)
        if start + size > len(data):
            raise ExportError("is an ICC profile with a tag beyond its end: it is damaged")
        if data[at : at + 4] == wanted:
            found = data[start : start + size]
    return found


def _description(tag: bytes) -> str:
    """Return a name on one line: ASCII in version 2, the first language that is there in version 4."""
    if tag[:4] == b"desc":
        words = tag[12 : 12 + _number(tag, 8)].decode("ascii", "replace")
    elif tag[:4] == b"mluc" and _number(tag, 8):
        length, start = _number(tag, 20), _number(tag, 24)
        words = tag[start : start + length].decode("utf-16-be", "replace")
    else:
        words = ""
    return " ".join("".join(each if each.isprintable() else " " for each in words).split())[:200]
