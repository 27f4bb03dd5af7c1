"""A motif grown by an L-system: its strokes, and marks of one's own at the symbols of its word."""

from __future__ import annotations

import functools
from dataclasses import field, fields, replace
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError, blame
from batik_vector.fields import HIDDEN, Says, check
from batik_vector.geometry.curves.lsystem import LSystem, Turtle
from batik_vector.recipe.element import Element, Ring, dressed
from batik_vector.recipe.look import Dress
from batik_vector.values import frozen

MOST_MARKS = 100_000
"""Symbols at which marks are drawn."""


@frozen(kw_only=True)
class Growth(Element):
    """A mark drawn wherever a symbol stands in the word: a leaf, a flower, a dot.

    Its +x points where the turtle looks, and it shrinks with the turtle's steps.
    """

    symbol: Annotated[str, Says("the symbol of the word at which it is drawn")]
    poses: bytes = field(default=b"", metadata={HIDDEN: True})

    @property
    def ring(self) -> Ring:
        """What says where the curve is drawn."""
        return (*super().ring[:-1], self.poses)


@frozen(kw_only=True)
class Grown(Turtle, Dress):
    """What an L-system grows, with marks of one's own at its symbols: leaves at the tips, dots in the bends.

    The curve `lsystem` of a rosette's element has the same keys for its words and its turtle.
    """

    marks: Annotated[tuple[Growth, ...], Says("what is drawn at symbols of the word, bottom first")] = ()

    def __post_init__(self) -> None:
        check(self)
        self.parts()

    def parts(self) -> tuple[Element, ...]:
        """Return its strokes, and the marks upon them."""
        return self._parts

    def keys(self) -> tuple[str, ...]:
        """Return the keys of their tables."""
        return ("", *(f"marks[{number}]" for number in range(len(self.marks))))

    @functools.cached_property
    def _parts(self) -> tuple[Element, ...]:
        curve = LSystem(**{each.name: getattr(self, each.name) for each in fields(Turtle)})
        parts = [dressed(self, "", curve, 1)]
        if not self.marks:
            return tuple(parts)
        for number, mark in enumerate(self.marks):
            if len(mark.symbol) != 1:
                with blame(f"marks[{number}].symbol"):
                    raise GeometryError(f'"{mark.symbol}", expected one symbol of the word')
        walk = self.walk("".join(dict.fromkeys(mark.symbol for mark in self.marks)))
        for number, mark in enumerate(self.marks):
            at, way, size = walk.marks[mark.symbol]
            if not 0 < len(at) <= MOST_MARKS:
                told = f"it stands {len(at):,} times in the word" if len(at) else "its word has none"
                with blame(f"marks[{number}].symbol"):
                    raise GeometryError(f'"{mark.symbol}": {told}, expected 1 to {MOST_MARKS:,}')
            turn = way * size
            rows = np.column_stack([turn.real, -turn.imag, turn.imag, turn.real, at.real, at.imag])
            parts.append(replace(mark, poses=np.ascontiguousarray(rows, float).tobytes()))
        return tuple(parts)
