"""Patterns that may be shifted along one direction by any amount: plain stripes.

Such a pattern has no finest lattice. It is as good as one on a right-angled lattice, whose first vector is
the length after which a stripe closes on the tile's torus, and so it is drawn anew on that.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.symmetry.lattice import Matrix, reduced
from batik_vector.certificate.symmetry.operations import Pair, pair
from batik_vector.certificate.symmetry.outline import Edges, Indices, Outline, Points, together
from batik_vector.geometry.congruence import distinct
from batik_vector.values import frozen

FARTHEST = 24
"""How many cells, across and up, a stripe may climb before it comes back to itself."""

Numbers = NDArray[np.float64]


@frozen(eq=False)
class Stripes:
    """Stripes along the unit vector ``way``, drawn on the right-angled lattice ``basis`` (columns, mm)."""

    way: Pair
    basis: Matrix
    drawn: Outline


def stripes(drawn: Outline, basis: Matrix, slack: float) -> Stripes | None:
    """Return the pattern as stripes, or None where anything stands across them or a stripe is broken.

    Args:
        drawn: the outline, in mm.
        basis: the lattice of the tile, as columns in mm.
        slack: how far (mm) an edge may lean, and how long a gap may be.
    """
    edges = drawn.edges
    steps = edges.end - edges.begin
    way = _closing(steps[np.hypot(*steps.T).argmax()], basis, slack)
    if way is None:
        return None
    length = float(np.hypot(*way))
    across = np.array([-way[1], way[0]]) / length
    upright = across * (abs(float(np.linalg.det(basis))) / length)
    if np.abs(steps @ across).max() > slack / 4:
        return None
    frame = np.column_stack([way, upright])
    parts = [_kind(edges, kind, frame, slack) for kind in distinct(edges.kind)]
    if any(part is None for part in parts):
        return None
    found = [part for part in parts if part is not None]
    anew = Outline(together([p[0] for p in found]), together([p[1] for p in found]), drawn.inks)
    return Stripes(pair(way / length), reduced(frame), anew)


def _closing(step: Points, basis: Matrix, slack: float) -> Points | None:
    """Return the shortest lattice vector along an edge; None where there is none of sensible length."""
    count = np.arange(-FARTHEST, FARTHEST + 1)
    whole = np.stack(np.meshgrid(count, count), axis=-1).reshape(-1, 2)
    ways = whole[(np.gcd(*whole.T) == 1) & (whole @ (FARTHEST + 1, 1) > 0)] @ basis.T
    length = np.hypot(*ways.T)
    lean = np.abs(ways[:, 0] * step[1] - ways[:, 1] * step[0]) / length
    likely = np.flatnonzero(lean <= slack / 4)
    return ways[likely[length[likely].argmin()]] if len(likely) else None


def _kind(edges: Edges, kind: int, frame: Matrix, slack: float) -> tuple[Edges, Edges] | None:
    """Return the edges and rings of one kind drawn in full length; None where one is broken."""
    mine = edges.kind == kind
    steps = edges.end[mine] - edges.begin[mine]
    forward = np.sign(steps @ frame[:, 0]) if kind % 2 == 0 else np.ones(len(steps))
    place = ((edges.begin[mine] + steps / 2) @ np.linalg.inv(frame).T)[:, 1]
    pitch, length = float(np.hypot(*frame[:, 1])), float(np.hypot(*frame[:, 0]))
    at, sides = [], []
    for side in (-1.0, 1.0):
        here = forward == side
        if not here.any():
            continue
        heights, drawn = _gathered(place[here], np.hypot(*steps[here].T), slack / pitch)
        rounds = drawn / length
        if (np.abs(rounds - np.rint(rounds)) * length > slack).any() or (rounds < 0.5).any():
            return None
        at.append(heights)
        sides.append(np.full(len(heights), side))
    return _drawn(np.concatenate(at), np.concatenate(sides), frame, kind)


def _gathered(place: Numbers, length: Numbers, slack: float) -> tuple[Numbers, Numbers]:
    """Return the distinct places on a circle of length 1, and the total length drawn at each."""
    place = place % 1
    order = np.argsort(place, kind="stable")
    gaps = np.diff(np.r_[place[order], place[order[0]] + 1])
    # Counted from the widest gap, no group is cut in two.
    begin = place[order[(int(gaps.argmax()) + 1) % len(order)]]
    place = (place - begin) % 1
    order = np.argsort(place, kind="stable")
    group = np.cumsum(np.r_[False, np.diff(place[order]) > slack])
    total = np.bincount(group, length[order])
    middle = np.bincount(group, place[order] * length[order]) / total
    return np.asarray((middle + begin) % 1), np.asarray(total)


def _drawn(at: Numbers, sides: Numbers, frame: Matrix, kind: int) -> tuple[Edges, Edges] | None:
    order = np.argsort(at, kind="stable")
    at, sides = at[order], sides[order]
    begin = np.column_stack([np.where(sides > 0, 0, 1), at])
    end = np.column_stack([np.where(sides > 0, 1, 0), at])
    lines = _edges(begin, end, frame, kind)
    if kind % 2:
        return lines, together([])
    # What is covered lies on the left: between an edge that runs forward and the next, which runs back.
    if len(at) % 2 or (sides[1:] == sides[:-1]).any():
        return None
    first = np.flatnonzero(sides > 0)
    low, high = at[first], np.roll(at, -1)[first]
    high = np.where(high < low, high + 1, high)
    zero, one = np.zeros(len(low)), np.ones(len(low))
    corners = [np.column_stack(c) for c in ((zero, low), (one, low), (one, high), (zero, high))]
    turned = corners[1:] + corners[:1]
    return lines, _edges(np.concatenate(corners), np.concatenate(turned), frame, kind)


def _edges(begin: Points, end: Points, frame: Matrix, kind: int) -> Edges:
    kinds: Indices = np.full(len(begin), kind, np.intp)
    return Edges(begin @ frame.T, end @ frame.T, kinds)
