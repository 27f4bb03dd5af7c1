"""Whether ink that ends along a seam was drawn to end there: what its corners look like.

A page that cuts a mark off leaves a straight end too. The drawing's own are known by their corners: square
ones, those where borders of several marks meet, rounded ones, and those that it has elsewhere as well.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.drawing import Drawing, Edges
from batik_vector.certificate.picture.rim import ROUNDING, Shown, Spans, off_chord, turns
from batik_vector.certificate.report import Limits
from batik_vector.certificate.seam import Seam
from batik_vector.geometry.congruence import distinct

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SQUARE = np.sin(np.radians(1.0))
"""How far a border may lean and still leave the seam squarely."""

STRAIGHT_MM = 0.2
"""How long (mm) the piece of border must be that leaves the seam squarely, or the drawing's own corner's."""

SHORT_MM = 0.05
"""How long (mm) a piece of border along the seam must be, inside the page, for its corners to count."""

BENT = 1e-3
"""How far a piece leans off its tangent at most, and is straight; more is a chord of a curve."""

SMOOTH = np.sin(np.radians(3.0))
"""How far the borders of both sides may lean apart and still go on in one another."""

FLAT = np.cos(np.radians(15.0))
"""How far a border leans that leaves along the seam, as at a rounded corner."""

CORNER = 1.0
"""Degrees by which corners may differ and be the same."""

PARALLEL = np.tan(np.radians(0.2))

DISPLACED = 0.05
"""Share of a seam within which borders that do not meet are one, out of register: no step was drawn."""


class Corners:
    """The corners of what ends along one seam."""

    def __init__(self, near: Shown, far: Shown, seam: Seam, tile: Drawing, limits: Limits) -> None:
        self.near, self.far, self.seam, self.tile = near, far, seam, tile
        self.limit = limits.position * seam.frame.per_mm
        self.reach = limits.reach * seam.frame.per_mm
        self._inner: Floats | None = None

    def drawn(self, low: float, high: float) -> bool:
        """Whether both ends of a stretch look like the drawing's own corners."""
        length = float(self.seam.length)
        if high - low >= length - ROUNDING:
            return True
        return all(self._own(place) for place in (low, high))

    def displaced(self, low: float, high: float) -> bool:
        """Whether a border of either edge ends the stretch, and they are so near that they ought to meet."""
        if high - low > min(self.reach, DISPLACED * self.seam.length):
            return False
        near, far = (
            [len(borders(side.spans, place, self.seam.length, self.limit)[0]) for place in (low, high)]
            for side in (self.near, self.far)
        )
        return near in ([1, 0], [0, 1]) and far == near[::-1]

    def _own(self, place: float) -> bool:
        """Whether a stretch ends at a place as no page would end it that cuts a mark off."""
        both = [borders(side.spans, place, self.seam.length, self.limit) for side in (self.near, self.far)]
        (here, _, one), (there, _, other) = both
        lean, tangent, run = (np.concatenate(parts) for parts in zip(*both, strict=True))
        straight = STRAIGHT_MM * self.seam.frame.per_mm
        # Where more than two borders meet, or one leaves along the edge, the corner was drawn.
        if len(lean) not in (1, 2) or np.abs(lean).max() >= FLAT:
            return True
        if len(lean) == 2 and not (len(here) and len(there)) and np.ptp(lean) > SMOOTH:
            return True
        if len(here) and len(there):
            # A curve that goes straight on, in another colour, is one mark in two halves.
            return not (abs(here[0] + there[0]) <= SMOOTH and min(one[0], other[0]) < straight)
        flat = np.abs(lean - tangent) <= BENT
        if ((run >= straight) & (np.abs(lean) <= SQUARE) & flat).any():
            return True
        own = self._elsewhere()
        # Half a round mark leaves squarely, too, and any rectangle elsewhere would speak for it.
        tangent = tangent[flat | (np.abs(tangent) > SQUARE)]
        turned_by = np.degrees(np.arccos(np.clip(np.concatenate([tangent, -tangent]), -1, 1)))
        return bool((np.abs(turned_by[:, None] - own[None, :]) <= CORNER).any())

    def _elsewhere(self) -> Floats:
        """Return by how many degrees borders turn, inside the page, at the ends of pieces along this seam."""
        if self._inner is None:
            seam = self.seam
            found = []
            for ink in self.tile:
                step = (ink.rings.end - ink.rings.begin).astype(np.float64)
                run, rise = np.abs(step[:, 1 - seam.axis]), np.abs(step[:, seam.axis])
                at = ink.rings.begin[:, seam.axis]
                mine = (rise <= PARALLEL * run) & (run >= SHORT_MM * seam.frame.per_mm)
                mine &= (at > seam.near + self.limit) & (at < seam.far - self.limit)
                found += _corners(ink.rings, np.flatnonzero(mine))
            by = np.degrees(np.abs(np.concatenate(found))) if found else np.empty(0)
            self._inner = distinct(np.round(by[by > 5], 2))
        return self._inner


def turned(apart: Floats, length: int) -> Floats:
    """Return differences of places on a circle, from minus half its length to half of it."""
    return np.asarray((apart + length / 2) % length - length / 2)


def _corners(rings: Edges, rows: Indices) -> list[Floats]:
    """Return by how many radians rings turn, to the left, at both ends of some of their edges.

    It is the turn into the tangent of a curve, and not into its first chord, which may be degrees off.
    """
    if not len(rows):
        return []
    step = (rings.end - rings.begin).astype(np.float64)
    length = np.hypot(*step.T)
    begins = np.flatnonzero(np.r_[True, rings.owner[1:] != rings.owner[:-1]])
    ends = np.append(begins[1:], len(rings)) - 1
    after, before = np.arange(len(rings)) + 1, np.arange(len(rings)) - 1
    after[ends], before[begins] = begins, ends
    found = []
    for way in (before, after):
        beside = way[rows]
        beyond = way[beside]
        off = off_chord(turns(step[beside], step[beyond]), length[beside], length[beyond])
        found.append(turns(step[rows], step[beside]) - off)
    return found


def borders(spans: Spans, place: float, length: int, reach: float) -> tuple[Floats, Floats, Floats]:
    """Return lean, tangent and run of the borders that leave an edge at a place."""
    ends = np.column_stack([spans.low, spans.high])
    on = (np.abs(turned(ends - place, length)) <= reach + ROUNDING) & (spans.run > 0)
    return spans.lean[on], spans.tangent[on], spans.run[on]
