"""Parallels of closed outlines, all at once: what a buffer would find, where nothing has to be cut away.

An edge is moved by the breadth; at a corner that turns away from it the two meet in a mitre, and at one that
turns towards it they are cut back to where they cross, or joined by an arc. That is the whole boundary of all
within the breadth as long as no edge is cut back by more than its length and the parallel crosses itself
nowhere: the boundary is made of parts of the parallel, and no part of a simple closed curve but all of it is
closed. Where that does not hold the outline is left to others. Square roots and divisions alone are used,
which are the same on every machine.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Steps
from batik_vector.values import frozen

Floats = NDArray[np.float64]
NEEDLE = -0.9995
"""Cosine of the angle between edges from which a corner is a needle's point, and its bisector unsure."""
HALVINGS = 7
"""How often an arc is halved at most: half a turn in 128 chords."""


@frozen(eq=False)
class Parallels:
    """Parallels of some rings, those that are none in ``sound``: points in steps, shape (n, 2), and where
    each ring begins.
    """

    points: Steps
    rings: Offsets
    sound: NDArray[np.bool_]


def parallels(points: Steps, rings: Offsets, width: float, sag: float) -> Parallels:
    """Return the parallels of closed rings at their right-hand side.

    Args:
        points: in steps, shape (n, 2); no ring repeats its first point.
        rings: where each begins.
        width: how far off, in steps.
        sag: how far, in steps, corners may stand out, and chords lie within, of an arc.
    """
    sizes = np.diff(rings)
    of = np.repeat(np.arange(len(sizes)), sizes)
    after, before = _beside(rings)
    x, y = points[:, 0].astype(np.float64), points[:, 1].astype(np.float64)
    along, up = x[after] - x, y[after] - y
    length = np.sqrt(along * along + up * up)
    still = length == 0
    length[still] = 1.0
    east, north = up / length, -along / length
    west, south = east[before], north[before]
    turn, cos = west * north - south * east, west * east + south * north
    joint = width / np.maximum(1 + cos, 1e-9)
    # By how much an edge is longer at a corner than it was, or shorter.
    reach = joint * turn
    half = 1 / (1 + sag / width)
    arcs = (turn > 0) & (cos < 2 * half * half - 1)
    reach[arcs] = 0.0
    torn = (length + reach + reach[after] < 0) | (-reach > length) | (-reach > length[before])
    torn |= (cos < NEEDLE) | still
    sound = np.bincount(of[torn], minlength=len(sizes)) == 0
    right, top = x + joint * (west + east), y + joint * (south + north)
    arcs &= sound[of]
    made_x, made_y, counts = _rounded(
        right, top, np.flatnonzero(arcs), (x, y), (west, south, east, north), width, sag
    )
    ends = np.concatenate([[0], np.cumsum(counts)])[rings]
    steps = np.floor(np.column_stack([made_x, made_y]) + 0.5)
    return _checked(steps, ends, sound, twice_areas(points, rings))


def _beside(rings: Offsets) -> tuple[Index, Index]:
    """Return for each point of closed rings which comes after it, and which before."""
    count = int(rings[-1])
    after, before = np.arange(1, count + 1), np.arange(-1, count - 1)
    after[rings[1:] - 1] = rings[:-1]
    before[rings[:-1]] = rings[1:] - 1
    return after, before


def _rounded(
    x: Floats,
    y: Floats,
    arcs: Index,
    centres: tuple[Floats, Floats],
    normals: tuple[Floats, Floats, Floats, Floats],
    width: float,
    sag: float,
) -> tuple[Floats, Floats, Index]:
    """Return points with arcs in the place of some, and how many each has become."""
    counts = np.ones(len(x), np.intp)
    if not len(arcs):
        return x, y, counts
    west, south, east, north = (each[arcs] for each in normals)
    halvings, cos = np.ones(len(arcs), np.intp), west * east + south * north
    half = np.sqrt((1 + cos) / 2)
    for _ in range(HALVINGS - 1):
        half = np.sqrt((1 + half) / 2)
        halvings += width * (1 - half) > sag
    counts[arcs] = 2**halvings + 1
    first = np.cumsum(counts) - counts
    made_x, made_y = np.repeat(x, counts), np.repeat(y, counts)
    for level in np.unique(halvings).tolist():
        mine = np.flatnonzero(halvings == level)
        fan = _fan(west[mine], south[mine], east[mine], north[mine], level)
        into = first[arcs[mine]][:, None] + np.arange(2**level + 1)
        made_x[into] = centres[0][arcs[mine]][:, None] + width * fan[0]
        made_y[into] = centres[1][arcs[mine]][:, None] + width * fan[1]
    return made_x, made_y, counts


def _fan(west: Floats, south: Floats, east: Floats, north: Floats, level: int) -> tuple[Floats, Floats]:
    """Return the unit vectors that divide the angles between pairs of them in 2 ** level, shape (k, m)."""
    x, y = np.column_stack([west, east]), np.column_stack([south, north])
    for turn in range(level):
        between_x, between_y = x[:, :-1] + x[:, 1:], y[:, :-1] + y[:, 1:]
        if not turn:
            # The sum of nearly opposite ones says little of the direction, and what they turn from all.
            wide = (west * east + south * north < 0)[:, None]
            between_x = np.where(wide, (north - south)[:, None], between_x)
            between_y = np.where(wide, (west - east)[:, None], between_y)
        size = np.sqrt(between_x * between_x + between_y * between_y)
        x, y = (
            np.insert(each, np.arange(1, each.shape[1]), middle, axis=1)
            for each, middle in ((x, between_x / size), (y, between_y / size))
        )
    return x, y


def twice_areas(points: Steps | Floats, rings: Offsets) -> Floats:
    """Return twice the area of each ring, positive where it runs anticlockwise."""
    after, _ = _beside(rings)
    # About one of its own points, so that far from the origin nothing is lost.
    of, first = np.diff(rings), rings[:-1]
    x, y = (points[:, axis] - np.repeat(points[first, axis], of) for axis in (0, 1))
    return np.add.reduceat(x * y[after] - x[after] * y, rings[:-1]).astype(np.float64)


def _checked(points: Floats, rings: Offsets, sound: NDArray[np.bool_], areas: Floats) -> Parallels:
    """Return parallels without points that became one, and which of them are simple and wind as before."""
    after, _ = _beside(rings)
    x, y = points[:, 0], points[:, 1]
    fresh = (x != x[after]) | (y != y[after])
    sizes = np.add.reduceat(fresh, rings[:-1], dtype=np.intp)
    sound &= sizes >= 3
    fresh &= np.repeat(sound, np.diff(rings))
    kept = np.flatnonzero(sound)
    ends = np.concatenate([[0], np.cumsum(np.where(sound, sizes, 0))])
    points = points[fresh]
    own = np.concatenate([[0], np.cumsum(sizes[kept])])
    closed = np.insert(points, own[1:], points[own[:-1]], axis=0) if len(kept) else points
    shapes = shapely.from_ragged_array(
        shapely.GeometryType.POLYGON, closed, (own + np.arange(len(own)), np.arange(len(own)))
    )
    good = np.asarray(shapely.is_valid(shapes), bool)
    if len(kept):
        good &= twice_areas(points, own) * areas[kept] > 0
    sound[kept] = good
    return Parallels(points.astype(np.int64), ends, sound)
