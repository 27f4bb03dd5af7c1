"""Ids for things in a file: letters and digits, each once."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from batik_vector.export.palette import ascii_name


class Ids:
    """Gives out ids of letters and digits, each once: ``wax``, ``wax2``; for marks ``petal1``, ``petal2``.

    Millions may be given out: of the numbered ones only the last of each row is remembered.
    """

    def __init__(self) -> None:
        self._singles: set[str] = set()
        self._counts: dict[str, int] = {}
        self._stems: dict[tuple[str, str], str] = {}
        self._beginnings: set[str] = set()

    def one(self, name: str, fallback: str) -> str:
        """Return an id for a thing that is there once."""
        stem = self._stem(name, fallback)
        if self._taken(stem):
            return self.next(name, fallback)
        self._singles.add(stem)
        self._beginnings.update(_beginnings(stem))
        return stem

    def next(self, name: str, fallback: str) -> str:
        """Return the next id in the row of a name."""
        stem = self._row(name, fallback)
        return f"{stem}{self._next_in(stem)}"

    def many(
        self, names: Sequence[str], fallback: str
    ) -> tuple[list[str], NDArray[np.intp], NDArray[np.int64]]:
        """Return the ids that :meth:`next` would give many names one after another.

        Returns:
            Stems, the stem of each name as a number in that list, shape (n,), and what is written behind it,
            shape (n,).
        """
        stem_of = {name: self._row(name, fallback) for name in dict.fromkeys(names)}
        place = {stem: code for code, stem in enumerate(dict.fromkeys(stem_of.values()))}
        stems, code_of = list(place), {name: place[stem] for name, stem in stem_of.items()}
        codes = np.fromiter(map(code_of.__getitem__, names), np.intp, len(names))
        counts = np.bincount(codes, minlength=len(stems))
        before = np.array([self._counts[stem] for stem in stems], np.int64) - (np.cumsum(counts) - counts)
        numbers = np.empty(len(codes), np.int64)
        numbers[np.argsort(codes, kind="stable")] = np.arange(1, len(codes) + 1) + np.repeat(before, counts)
        # Rows that may meet others, as petal and petal1 meet in petal11, go name by name.
        alike = np.array([self._may_meet(stem) for stem in stems], bool)
        for code in np.flatnonzero(~alike).tolist():
            self._counts[stems[code]] += int(counts[code])
        for at in np.flatnonzero(alike[codes]).tolist():
            numbers[at] = self._next_in(stems[codes[at]])
        return stems, codes, numbers

    def _row(self, name: str, fallback: str) -> str:
        """Return the stem of a name, whose row is open from now on."""
        stem = self._stems.get((name, fallback))
        if stem is None:
            stem = self._stems[name, fallback] = self._stem(name, fallback)
        if stem not in self._counts:
            self._counts[stem] = 0
            self._beginnings.update(_beginnings(stem))
        return stem

    def _next_in(self, stem: str) -> int:
        number = self._counts[stem] + 1
        while self._taken(f"{stem}{number}"):
            number += 1
        self._counts[stem] = number
        return number

    def _may_meet(self, stem: str) -> bool:
        """Return whether ids of a row may look like others."""
        return stem in self._beginnings or any(start in self._counts for start in _beginnings(stem))

    def _taken(self, new: str) -> bool:
        """Return whether an id was given out, singly or in a row."""
        return new in self._singles or any(
            new[len(start)] != "0" and int(new[len(start) :]) <= self._counts.get(start, 0)
            for start in _beginnings(new)
        )

    @staticmethod
    def _stem(name: str, fallback: str) -> str:
        """Join the words of a name as petalTip; an id may not begin with a digit."""
        words = re.findall(r"[A-Za-z0-9]+", ascii_name(name))
        stem = "".join(word if i == 0 else word[0].upper() + word[1:] for i, word in enumerate(words))
        return stem if stem[:1].isalpha() else f"{fallback}{stem}"


def _beginnings(text: str) -> list[str]:
    """Return all that a text may have been before figures were written behind it."""
    root = len(text.rstrip("0123456789"))
    return [text[:at] for at in range(root, len(text))]
