"""A sheet: what one element of one placement draws over all its copies, and what it cuts. Sheets make a pile.

Here they come from millimetres to the grid, all at once, so that what is congruent is found.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Geometries, Ink
from batik_vector.geometry.congruence import distinct
from batik_vector.geometry.outlines import Index
from batik_vector.tiling.welding.congruent import Areas, Copies, Repeated, Stock, together
from batik_vector.tiling.welding.growth import grown, grown_on_grid, quad_segs
from batik_vector.values import frozen


def _none() -> Geometries:
    return np.empty(0, dtype=object)


@frozen
class Sheet:
    """The marks of one element, in mm on cloth, not yet wrapped.

    ``ink`` is None for a sheet that only cuts. ``gap`` is how many mm of ground it keeps bare round its
    shape by cutting what lies beneath; None cuts nothing. ``cutter`` is the shape that cuts, where it is
    not the areas drawn (an outlined petal hides what lies under the whole petal). ``whole`` leaves out
    marks that would be cut, as nobody waxes half a dot; ``margin`` (mm) is how far a line drawn round
    the areas by another sheet reaches beyond them, so that both are kept or left out together.
    """

    name: str
    ink: Ink | None
    areas: Areas = field(default_factory=_none)
    lines: Geometries = field(default_factory=_none)
    gap: float | None = None
    cutter: Areas = field(default_factory=_none)
    whole: bool = False
    margin: float = 0.0


class Laid(NamedTuple):
    """Copies, and for each the number of the sheet it lies in."""

    copies: Copies
    sheet: Index

    def taken(self, which: Index | NDArray[np.bool_]) -> Laid:
        """Return some of them, by number or by a mask."""
        return Laid(self.copies.taken(which), self.sheet[which])


def joined(parts: Sequence[Laid]) -> Laid:
    """Return several as one."""
    sheets = [part.sheet for part in parts]
    return Laid(
        together([p.copies for p in parts]), np.concatenate(sheets) if sheets else np.empty(0, np.intp)
    )


class Pile:
    """Sheets, bottom first, whose areas are on the grid.

    Attributes:
        sheets: as given.
        stock: of which the copies are.
        tolerance: in mm, for the round corners of what is grown.
        farthest: mm by which anything is grown at most: what is grown so far covers all.
        areas: of all sheets.
        drawn: the areas of all sheets that have an ink.
    """

    def __init__(
        self, sheets: Sequence[Sheet], stock: Stock, tolerance: float, farthest: float = math.inf
    ) -> None:
        self.sheets, self.stock, self.tolerance, self.farthest = sheets, stock, tolerance, farthest
        own = [sheet.cutter if sheet.gap is not None else _none() for sheet in sheets]
        copies, place = _taken_up(stock, [*(sheet.areas for sheet in sheets), *own])
        every = Laid(copies, place % max(len(sheets), 1))
        has_ink = np.array([sheet.ink is not None for sheet in sheets], bool)
        cuts = np.array([sheet.gap is not None for sheet in sheets], bool)
        has_own = np.array([len(each) > 0 for each in own], bool)
        second = place >= len(sheets)
        self.areas = every.taken(~second)
        self.drawn = every.taken(~second & has_ink[every.sheet])
        self._cutting = every.taken(cuts[every.sheet] & (second == has_own[every.sheet]))

    def reach(self, number: int, extra: float = 0.0) -> float:
        """Return by how much (mm) what a sheet cuts with is grown: its gap, and ``extra``."""
        return min((self.sheets[number].gap or 0.0) + extra, self.farthest)

    def cutters(self, above: int = -1, extra: float = 0.0) -> Laid:
        """Return what sheets above a number cut away: their shapes, grown by gap and ``extra`` (mm)."""
        numbers = [n for n in range(above + 1, len(self.sheets)) if self.sheets[n].gap is not None]
        reach = np.full(len(self.sheets), np.nan)
        reach[numbers] = [self.reach(number, extra) for number in numbers]
        parts = [self._grown(reach[self._cutting.sheet])]
        for number in numbers:
            sheet = self.sheets[number]
            if len(sheet.lines) and sheet.ink is not None and not len(sheet.cutter):
                radius = self.reach(number, extra + sheet.ink.width / 2)
                copies, _ = self.stock.settled(grown(sheet.lines, radius, self.tolerance))
                parts.append(Laid(copies, np.full(len(copies), number)))
        return joined(parts)

    def _grown(self, reach: NDArray[np.float64]) -> Laid:
        """Return what cuts, each grown by its reach in mm, with round corners; the least first.

        Those whose reach is not a number are left out. What is grown comes to its places all at once.
        """
        whole = self._cutting.taken(reach <= 0)
        shapes, rows, which = [_none()], [], []
        for radius in distinct(reach[reach > 0]).tolist():
            mine = np.flatnonzero(reach == radius)
            used, row = self.stock.used(self._cutting.copies.taken(mine))
            rows.append(row + sum(map(len, shapes)))
            shapes.append(grown_on_grid(used, radius, quad_segs(radius, self.tolerance)))
            which.append(mine)
        if not which:
            return whole
        laid = self._cutting.taken(np.concatenate(which))
        down = self.stock.set_down(np.concatenate(shapes), np.concatenate(rows), laid.copies.shift)
        return joined([whole, Laid(down.copies, laid.sheet[down.each])])


def _taken_up(stock: Stock, parts: Sequence[Areas]) -> tuple[Copies, Index]:
    """Bring all areas to the grid; return them in their order, and the number of the part of each."""
    number = np.repeat(np.arange(len(parts)), [len(each) for each in parts])
    repeated = np.array([isinstance(each, Repeated) for each in parts], bool)[number]
    settled, of = stock.settled(np.concatenate([_none(), *(p for p in parts if not isinstance(p, Repeated))]))
    copies = together([settled, *stock.copies([each for each in parts if isinstance(each, Repeated)])])
    place = np.concatenate([number[~repeated][of], number[repeated]])
    order = np.argsort(place, kind="stable")
    return copies.taken(order), place[order]
