"""Colours and names as formats take them."""

from __future__ import annotations

import re
import unicodedata
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
    return unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode("ascii")


class Ids:
    """Gives out ids of letters and digits, each once: ``wax``, ``wax2``; for marks ``petal1``, ``petal2``.

    Millions may be given out: of the numbered ones only the last of each row is remembered.
    """

    def __init__(self) -> None:
        self._singles: set[str] = set()
        self._counts: dict[str, int] = {}
        self._stems: dict[tuple[str, str], str] = {}
        self._rivals: dict[str, list[str]] = {}

    def one(self, name: str, fallback: str) -> str:
        """Return an id for a thing that is there once."""
        stem = self._stem(name, fallback)
        if self._taken(stem, self._counts):
            return self.next(name, fallback)
        self._singles.add(stem)
        self._rivals.clear()
        return stem

    def next(self, name: str, fallback: str) -> str:
        """Return the next id in the row of a name."""
        stem = self._stems.get((name, fallback))
        if stem is None:
            stem = self._stems[name, fallback] = self._stem(name, fallback)
        if stem not in self._counts:
            self._counts[stem] = 0
            self._rivals.clear()
        rivals = self._rivals.get(stem)
        if rivals is None:
            rivals = self._rivals[stem] = self._rivals_of(stem)
        number = self._counts[stem] + 1
        while rivals and self._taken(f"{stem}{number}", rivals):
            number += 1
        self._counts[stem] = number
        return f"{stem}{number}"

    def _rivals_of(self, stem: str) -> list[str]:
        """Return the stems and single ids whose ids may look like this row's."""
        known = [each for each in (*self._counts, *sorted(self._singles)) if each != stem]
        return [
            each
            for each in known
            if (each.startswith(stem) and each[len(stem) :].isdigit())
            or (stem.startswith(each) and stem[len(each) :].isdigit())
        ]

    def _taken(self, new: str, stems: Iterable[str]) -> bool:
        """Return whether an id was given out, singly or in one of these rows."""
        if new in self._singles:
            return True
        for stem in stems:
            number = new[len(stem) :] if new.startswith(stem) else ""
            if number.isdigit() and number[0] != "0" and int(number) <= self._counts.get(stem, 0):
                return True
        return False

    @staticmethod
    def _stem(name: str, fallback: str) -> str:
        """Join the words of a name as petalTip; an id may not begin with a digit."""
        words = re.findall(r"[A-Za-z0-9]+", ascii_name(name))
        stem = "".join(word if i == 0 else word[0].upper() + word[1:] for i, word in enumerate(words))
        return stem if stem[:1].isalpha() else f"{fallback}{stem}"


def dxf_names(names: Iterable[str], longest: int = 31) -> list[str]:
    """Return layer names of A-Z, 0-9, ``_`` and ``-``, unique, never those DXF keeps for itself."""
    given = {"0", "DEFPOINTS", ""}
    out = []
    for name in names:
        stem = re.sub(r"[^A-Z0-9_-]+", "_", ascii_name(name).upper()).strip("_")[:longest]
        stem = stem or "INK"
        new, number = stem, 1
        while new in given:
            number += 1
            new = f"{stem[: longest - 1 - len(str(number))]}_{number}"
        given.add(new)
        out.append(new)
    return out


_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def xml_safe(text: str) -> bool:
    """Return whether XML 1.0 can hold every character of a text."""
    return _NOT_XML.search(text) is None


def xml_label(text: str) -> str:
    """Return a text on one line, with a replacement character for each that XML cannot hold."""
    return _NOT_XML.sub("\ufffd", re.sub(r"[\t\r\n]+", " ", text))
