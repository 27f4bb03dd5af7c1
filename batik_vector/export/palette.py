"""Colours and names as formats take them."""

from __future__ import annotations

import re
from collections.abc import Iterable

from batik_vector.errors import ExportError

_HEX = re.compile(r"#(?:[0-9a-fA-F]{3}){1,2}\Z")

ACI = {
    1: (255, 0, 0),
    2: (255, 255, 0),
    3: (0, 255, 0),
    4: (0, 255, 255),
    5: (0, 0, 255),
    6: (255, 0, 255),
    7: (255, 255, 255),
}
"""The AutoCAD colour numbers that every reader knows."""


def rgb(colour: str) -> tuple[int, int, int]:
    """Return red, green and blue (0 to 255) of ``#rrggbb`` or ``#rgb``.

    Raises:
        ExportError: where the text is no such colour.
    """
    if not _HEX.match(colour):
        raise ExportError(f'"{colour}" is no colour: expected #rrggbb')
    figures = colour[1:] if len(colour) == 7 else "".join(c * 2 for c in colour[1:])
    return int(figures[:2], 16), int(figures[2:4], 16), int(figures[4:], 16)


def hex_colour(colour: str) -> str:
    """Return a colour as ``#rrggbb`` in small letters."""
    return "#{:02x}{:02x}{:02x}".format(*rgb(colour))


def distinct_aci(colours: Iterable[str]) -> list[int]:
    """Return for each colour the nearest number of ``ACI`` not given before, while there are any left."""
    taken: list[int] = []
    for colour in colours:
        if len(taken) % len(ACI) == 0:
            free = set(ACI)
        red, green, blue = rgb(colour)
        near = min(
            sorted(free),
            key=lambda n: sum((a - b) ** 2 for a, b in zip(ACI[n], (red, green, blue), strict=True)),
        )
        free.remove(near)
        taken.append(near)
    return taken


def ascii_name(name: str) -> str:
    """Return a name without accents and without anything that is not ASCII."""
    if name.isascii():
        return name
    # Its tables take longer to load than all inks to write.
    import unicodedata

    return unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode("ascii")


_NOT_DXF = re.compile(r'[^ -~]+|[<>/\\":;?*|,=`]+')
_NOT_R12 = re.compile(r"[^A-Z0-9_-]+")


def dxf_names(names: Iterable[str], longest: int = 255) -> list[str]:
    """Return layer names for R2000, as like the names given as DXF allows.

    Case and blanks stay. What AutoCAD refuses in names becomes ``_``, and accents are dropped: readers do not
    agree on how letters beyond ASCII are written.
    """
    stems = (_NOT_DXF.sub("_", ascii_name(name)).strip(" _") for name in names)
    return _unique((stem or "ink" for stem in stems), longest)


def r12_names(names: Iterable[str], longest: int = 31) -> list[str]:
    """Return layer names for R12, which has none but A-Z, 0-9, ``_`` and ``-``."""
    stems = (_NOT_R12.sub("_", ascii_name(name).upper()).strip("_") for name in names)
    return _unique((stem or "INK" for stem in stems), longest)


def _unique(stems: Iterable[str], longest: int) -> list[str]:
    """Return names that DXF does not reserve, and that differ in more than case: it passes over that."""
    given = {"0", "defpoints"}
    out = []
    for whole in stems:
        stem = whole[:longest].rstrip(" ")
        new, number = stem, 1
        while new.lower() in given:
            number += 1
            new = f"{stem[: longest - 1 - len(str(number))]}_{number}"
        given.add(new.lower())
        out.append(new)
    return out


_NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
"""What XML's Char leaves out. To compile Char itself, as the standard has it, takes ten times as long."""


def xml_safe(text: str) -> bool:
    """Return whether XML 1.0 can hold every character of a text."""
    return _NOT_XML.search(text) is None


def xml_label(text: str) -> str:
    """Return a text on one line, with a replacement character for each that XML cannot hold."""
    return _NOT_XML.sub("\ufffd", re.sub(r"[\t\r\n]+", " ", text))
