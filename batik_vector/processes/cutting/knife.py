"""A drag knife: the way of its holder, behind which the blade's tip trails along the design.

The tip stands a little off the axis about which the holder lets it swing, and follows like a castor. On a
straight run the axis goes ahead of the tip by that offset; at a corner it goes on an arc about the corner,
round which the blade swivels on the spot, until it points along the next side.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines
from batik_vector.processes.cutting.arclength import Ways, along, around
from batik_vector.processes.cutting.bends import Bends, bends_of, halved
from batik_vector.values import frozen

CHORD = 0.5
"""Steps by which a swivel's chords may lie within its arc: the tip is moved by no more."""
BROAD = 2.0
"""Offsets: the radius of a curve on which the holder need not swivel from side to side."""
SWAY = 1.0
"""Steps that the holder may be out of line at a bend that gets one point and no swivel."""


@frozen
class Knife:
    """A blade in its holder.

    ``offset`` is how far its tip trails, in steps; at a ``corner`` of so many radians or more it is
    swivelled; ``heading`` is the direction in which it points before the first stroke, in radians. Where
    strokes stand for curves from which they stray by no more than ``sag`` steps, it follows the curves.
    """

    offset: int
    corner: float
    heading: float = 0.0
    sag: float = 0.0


def shut(strokes: Outlines, overcut: Ways) -> Outlines:
    """Return strokes as open ones: closed ones come back to their start, and go on past it by the overcut.

    Args:
        strokes: one ring or polyline to a mark.
        overcut: shape (n,); of each at most as much as it is long is cut twice.
    """
    whole = around(strokes)
    begin = np.zeros(len(strokes), np.int64)
    over = np.where(strokes.closed, np.minimum(overcut, whole), 0)
    opened = along(strokes, np.arange(len(strokes)), begin, whole + over)
    return replace(opened, names=strokes.names)


def holder(strokes: Outlines, knife: Knife) -> Outlines:
    """Return the way of the holder for strokes of the tip, in their order and direction.

    Each stroke begins with the blade as the one before left it: the tip is set down on the stroke's first
    point, and swivels there.

    Args:
        strokes: open polylines, without points that repeat the one before.
        knife: the blade.
    """
    if not len(strokes) or not knife.offset:
        return strokes
    curved = bends_of(strokes, knife.heading).curved(knife.corner, knife.sag, BROAD * knife.offset)
    strokes, curved = halved(strokes, curved)
    bends = bends_of(strokes, knife.heading)
    counts = _counts(bends, curved, knife)
    owner = np.repeat(np.arange(len(counts)), counts)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    ahead = _ahead(bends, counts, owner, number)
    points = strokes.points[owner] + np.rint(knife.offset * ahead).astype(np.int64)
    rings = np.concatenate([np.zeros(1, np.int64), np.cumsum(counts)])[strokes.rings]
    return replace(strokes, points=points, rings=rings)


def _counts(bends: Bends, curved: NDArray[np.bool_], knife: Knife) -> Index:
    """Return how many places the holder passes at each point.

    On a curve it is one, and at a corner two or more, on the arc of a swivel.
    """
    bent = np.abs(bends.angles)
    widest = 2 * math.acos(max(1 - CHORD / knife.offset, 0.0))
    counts = np.ceil(np.round(bent / widest, 6)).astype(np.intp) + 1
    straight = knife.offset * np.sin(np.minimum(bent, math.pi / 2) / 2) <= SWAY
    counts[straight | curved] = 1
    return np.asarray(counts, np.intp)


def _ahead(bends: Bends, counts: Index, owner: Index, number: Index) -> NDArray[np.float64]:
    """Return the direction from the tip to the holder at each place that it passes, of length 1."""
    before, behind = _units(bends.into), _units(bends.out)
    ahead = before[owner]
    many = counts[owner]
    ends = (number == many - 1) & (many > 1)
    ahead[ends] = behind[owner[ends]]
    one = many == 1
    ahead[one] = _units(before[owner[one]] + behind[owner[one]])
    between = np.flatnonzero((number > 0) & ~ends)
    angle = bends.angles[owner[between]] * number[between] / (many[between] - 1)
    x, y = before[owner[between]].T
    ahead[between] = np.stack(
        [x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)], axis=1
    )
    return ahead


def _units(ways: NDArray[np.int64] | NDArray[np.float64]) -> NDArray[np.float64]:
    size = np.sqrt(np.asarray(ways[:, 0] * ways[:, 0] + ways[:, 1] * ways[:, 1], float))
    return np.asarray(ways / np.maximum(size, 1e-12)[:, None])
