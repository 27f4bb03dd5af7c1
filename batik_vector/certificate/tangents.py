"""Tangents at the seam: whether a border or a line goes straight on where it crosses.

On a torus the seam is no place of its own: a border may turn there as it may anywhere. What tells a kink
of the seam from the drawing's own turns is this.

* A polyline turns at every vertex, and at one that happens to lie on the seam hardly more than at those
  beside it, nor more than its sampling explains: edges of lengths L and M that keep a tolerance t turn by
  up to 4 t (1 / L + 1 / M). ``SUDDEN`` times the lesser of that and the larger turn of the two vertices
  nearest to the crossing is allowed; where a line ends at one of these, that alone.
* Vertices are rounded, which turns an edge of length L by up to ``NOISE_MM`` / L: that is allowed.
* A turn that the seam mirrors, as the seams of pm, pmm or p4m do to every border, is the drawing's.
* So is one sharper than ``CORNER``: tips of leaves and stars may lie on the seam, and edges that meet in
  place are seldom twisted by so much. These are counted and not accused.

So a kink is found where edges are long and straight or finely sampled; one that is no sharper than the
turns of a coarsely sampled curve cannot be told from them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.drawing import InkDrawing
from batik_vector.certificate.report import Kind, Limits, SeamFault
from batik_vector.certificate.seam import Germs, Seam, germs
from batik_vector.values import frozen

NOISE_MM = 0.002
"""How far rounding to the 1 µm grid, and cutting on it, may move one end of an edge against the other."""

ROUNDED = 0.16
"""Share of how far crossings may stand apart by which the file's own rounding may move one end of an edge."""

SUDDEN = 1.5
"""How many times the turns beside it a turn of a sampled curve may be: samplers place vertices unevenly."""

CORNER = 10.0
"""A turn on the seam sharper than this (degrees) is a corner of the drawing."""

Floats = NDArray[np.float64]


@frozen(eq=False)
class Turns:
    """The turns of one ink at one seam, one item per crossing.

    ``along`` is its place in steps on the near edge, ``turn`` and ``excess`` are degrees: how far it
    turns, and how far beyond what sampling, rounding and mirrors explain.
    """

    along: NDArray[np.int64]
    turn: Floats
    excess: Floats

    def kinks(self) -> Floats:
        """Return the excess of each crossing that is no corner of the drawing, 0 for others."""
        return np.where(self.turn > CORNER, 0.0, self.excess)

    def corners(self, limit: float) -> int:
        """Count the crossings taken for corners of the drawing."""
        return int(((self.turn > CORNER) & (self.excess > limit)).sum())


def border_turns(
    ink: InkDrawing, seam: Seam, paired: NDArray[np.int64], tolerance: float, limits: Limits
) -> Turns:
    """Return the turns of the borders of areas at the places where both edges have one.

    Args:
        ink: whose areas.
        seam: where they cross.
        paired: those places, in steps on the near edge.
        tolerance: how far (mm) edges may stand from the true curve.
        limits: how far crossings may stand apart.
    """
    near, far = germs(ink.rings, seam, False), germs(ink.rings, seam, True)
    near = near.only(np.isin(near.along, paired))
    return _turns(near, far, seam, (tolerance, limits.position), directed=True)


def line_turns(ink: InkDrawing, seam: Seam, tolerance: float, limits: Limits) -> Turns:
    """Return the turns of lines where they leave by both edges, the page's corners apart."""
    near, far = germs(ink.strokes, seam, False), germs(ink.strokes, seam, True)
    corners = (0, -seam.slip % seam.length)
    return _turns(
        near.only(~np.isin(near.along, corners)), far, seam, (tolerance, limits.position), directed=False
    )


def _turns(near: Germs, far: Germs, seam: Seam, within: tuple[float, float], directed: bool) -> Turns:
    """Pair what leaves the seam to both sides; of several ways to go on at a place the straightest counts.

    ``directed`` edges of areas go on in edges of the same direction only.
    """
    tolerance, reach = within[0] * seam.frame.per_mm, int(within[1] * seam.frame.per_mm)
    low = np.searchsorted(far.along, near.along - reach)
    counts = np.searchsorted(far.along, near.along + reach, "right") - low
    row = np.repeat(np.arange(len(counts)), counts)
    column = np.arange(len(row)) + np.repeat(low - np.cumsum(counts) + counts, counts)
    if directed:
        on = near.leaves[row] != far.leaves[column]
        row, column = row[on], column[on]
    one, other = near.only(row), far.only(column)
    turn = _angle(-other.away, one.away)
    bend = 1 / one.length + 1 / other.length
    noise = max(NOISE_MM, ROUNDED * within[1]) * seam.frame.per_mm * bend
    sampled = SUDDEN * np.minimum(4 * tolerance * bend, np.maximum(one.next_turn, other.next_turn))
    mirrored = other.away * (np.array([-1, 1]) if seam.axis == 0 else np.array([1, -1]))
    excess = np.minimum(turn - noise - sampled, _angle(mirrored, one.away) - noise)
    order = np.lexsort([excess, one.along])
    along, first = np.unique(one.along[order], return_index=True)
    best = order[first]
    return Turns(along, np.degrees(turn[best]), np.degrees(np.maximum(excess[best], 0.0)))


def _angle(a: Floats, b: Floats) -> Floats:
    """Return the angles between unit vectors, in radians from 0 to π."""
    cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return np.asarray(np.abs(np.arctan2(cross, (a * b).sum(axis=1))))


def turn_faults(turns: Turns, ink: str, seam: Seam, limits: Limits) -> list[SeamFault]:
    """Return a fault for each crossing that turns too far."""
    kinks = turns.kinks()
    return [
        SeamFault(
            Kind.TANGENT,
            ink,
            seam.place(along, False),
            f"the drawing turns by {turn:.2f}° where it crosses {seam.at(along, False)} to "
            f"{seam.at(along, True)}; {excess:.2f}° of it only at the seam",
            excess,
        )
        for along, turn, excess in zip(turns.along.tolist(), turns.turn.tolist(), kinks.tolist(), strict=True)
        if excess > limits.tangent
    ]
