"""Bridges: spans with all their images under the symmetry, the pieces that each joins, and their bodies."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.sampling import Array, Geometries, Points
from batik_vector.processes.stencilling.clusters import Gain
from batik_vector.processes.stencilling.sheets import Sheet, Torus
from batik_vector.processes.stencilling.spans import Spans
from batik_vector.processes.stencilling.symmetry import Symmetry
from batik_vector.values import frozen

ANCHOR = 0.125
"""Breadths behind the ends of a bridge at which the sheet is looked for that it joins."""
ROOM = 0.25
"""Breadths of opening that are left on either side of a bridge, where they can be."""
BESIDE = np.array([0.25, 0.5, 0.75])
"""Where that is asked, in lengths of a bridge."""
TWICE = 16.0
"""Steps within which two images are one and the same bridge."""
OVER = 0.03
"""Breadths by which a bridge reaches into the sheet at either end."""


@frozen(eq=False)
class Bridge:
    """One bridge of a repeat: ``one`` and ``other`` are parts of the sheet, ``gain`` as joints have it."""

    middle: tuple[float, float]
    way: tuple[float, float]
    low: float
    high: float
    one: int
    other: int
    gain: Gain

    @property
    def length(self) -> float:
        """From sheet to sheet, in steps."""
        return self.high - self.low

    @property
    def centre(self) -> tuple[float, float]:
        """The middle of its body."""
        half = (self.low + self.high) / 2
        return self.middle[0] + self.way[0] * half, self.middle[1] + self.way[1] * half

    def ends(self) -> Points:
        """Return where it meets the sheet, shape (2, 2), in steps."""
        at = np.array([[self.low], [self.high]])
        return np.asarray(np.array(self.middle) + at * np.array(self.way))


@frozen(eq=False)
class Orbit:
    """Bridges that are images of one another, and what they cost together, in steps."""

    bridges: tuple[Bridge, ...]
    cost: float
    fine: bool = True
    """Whether enough of the openings is left beside them."""

    @property
    def joints(self) -> list[tuple[int, int, Gain]]:
        """What they join."""
        return [(each.one, each.other, each.gain) for each in self.bridges]


def orbits_of(spans: Spans, sheet: Sheet, symmetry: Symmetry, breadth: float) -> list[Orbit]:
    """Return spans as orbits of bridges; those are left out whose images do not all end in the sheet."""
    if not len(spans):
        return []
    torus, count = sheet.torus, len(spans)
    # The images are told by the middle of the body: the same bridge may be found from either end.
    half = ((spans.low + spans.high) / 2)[:, None]
    centre = spans.middle + half * spans.way
    reach = (spans.high - spans.low) / 2
    centres, ways = symmetry.images(centre), symmetry.turned(spans.way)
    home, _ = torus.home(centres.reshape(-1, 2))
    centres = home.reshape(centres.shape)
    past = (reach + ANCHOR * breadth)[:, None]
    ends = np.stack([centres - past * ways, centres + past * ways], axis=2)  # (k, n, 2, 2)
    part, gain = _parts_at(ends.reshape(-1, 2), sheet)
    part, gain = part.reshape(len(symmetry), count, 2), gain.reshape(len(symmetry), count, 2, 2)
    fine = _leave_room(spans, sheet, breadth)
    found = list[Orbit]()
    for number in range(count):
        if (part[:, number] < 0).any():
            continue
        mine = _different(centres[:, number], torus)
        bridges = tuple(
            Bridge(
                _rounded(centres[k, number], 3),
                _rounded(ways[k, number], 9),
                -round(float(reach[number]), 3),
                round(float(reach[number]), 3),
                int(part[k, number, 0]),
                int(part[k, number, 1]),
                _less(gain[k, number, 1], gain[k, number, 0]),
            )
            for k in mine
        )
        cost = round(float(spans.cost[number]), 3) * len(bridges)
        found.append(Orbit(bridges, cost, bool(fine[number])))
    return found


def _leave_room(spans: Spans, sheet: Sheet, breadth: float) -> NDArray[np.bool_]:
    """Return which spans leave an opening on either side, and no sliver of one."""
    normal = np.stack([-spans.way[:, 1], spans.way[:, 0]], axis=1)
    along = spans.low[:, None] + BESIDE * (spans.high - spans.low)[:, None]
    on = spans.middle[:, None, :] + along[:, :, None] * spans.way[:, None, :]
    sides = np.array([-1.0, 1.0])[:, None, None, None] * (0.5 + ROOM) * breadth * normal[:, None, :]
    part, _ = _parts_at((on + sides).reshape(-1, 2), sheet)
    opened = (part < 0).reshape(2, len(spans), len(BESIDE)).sum(axis=2)
    return np.asarray((opened == len(BESIDE)).all(axis=0))


def _rounded(place: Points, digits: int) -> tuple[float, float]:
    """Return a place without the last bits of its floats, which are not the same on every machine."""
    x, y = np.round(place, digits).tolist()
    return x, y


def _less(one: Steps, other: Steps) -> Gain:
    x, y = (one - other).tolist()
    return int(x), int(y)


def _different(centres: Points, torus: Torus) -> list[int]:
    """Return the images that are no other's place over again."""
    kept: list[int] = []
    for each in range(len(centres)):
        if kept:
            ways, _ = torus.nearest(centres[kept] - centres[each])
            if ((ways**2).sum(axis=1) < TWICE**2).any():
                continue
        kept.append(each)
    return kept


def _parts_at(points: Points, sheet: Sheet) -> tuple[Index, Steps]:
    """Return the part of the sheet at each place, -1 where there is none, and its repeat."""
    inside, gain = sheet.torus.home(points)
    tree = shapely.STRtree(sheet.parts)
    row, part = tree.query(shapely.points(inside))
    shapely.prepare(sheet.parts)
    held = shapely.intersects_xy(sheet.parts[part], inside[row, 0], inside[row, 1])
    row, part = row[held], part[held]
    found = np.full(len(points), -1, np.intp)
    found[row[::-1]] = part[::-1]
    return found, gain


def bodies_of(bridges: list[Bridge], breadth: int) -> Geometries:
    """Return the bodies of bridges as oblongs on whole steps, not narrower than asked."""
    if not bridges:
        return np.empty(0, dtype=object)
    half, over = math.ceil(breadth / 2) + 1, max(3.0, OVER * breadth)
    corners = np.array([[_corner(each, *at) for at in _around(each, half, over)] for each in bridges])
    # Halves go up, so that what is moved by a repeat is rounded alike.
    return np.asarray(shapely.polygons(np.floor(corners + 0.5)), dtype=object)


def _around(bridge: Bridge, half: float, over: float) -> list[tuple[float, float]]:
    low, high = bridge.low - over, bridge.high + over
    return [(low, -half), (high, -half), (high, half), (low, half)]


def _corner(bridge: Bridge, along: float, across: float) -> tuple[float, float]:
    (x, y), (dx, dy) = bridge.middle, bridge.way
    return x + along * dx - across * dy, y + along * dy + across * dx


def distances(one: list[Bridge], other: list[Bridge], torus: Torus, breadth: int) -> Array:
    """Return how far the bodies of bridges are from the nearest of others on the torus, shape (n,)."""
    bodies, others = bodies_of(one, breadth), bodies_of(other, breadth)
    if not len(bodies) or not len(others):
        return np.full(len(one), np.inf)
    bounds = shapely.bounds(bodies)
    low, high = bounds[:, :2].min(axis=0) - 4 * breadth, bounds[:, 2:].max(axis=0) + 4 * breadth
    which, gains = torus.around(shapely.bounds(others), low, high)
    if not len(which):
        return np.full(len(one), np.inf)
    copies = moved(others[which], torus.at(gains))
    row, _, apart = _nearest(bodies, copies)
    found = np.full(len(one), np.inf)
    found[row] = apart
    return found


def _nearest(bodies: Geometries, copies: Geometries) -> tuple[Index, Index, Array]:
    (row, other), apart = shapely.STRtree(copies).query_nearest(
        bodies, return_distance=True, all_matches=False
    )
    return row, other, apart


def moved(marks: Geometries, shift: Steps) -> Geometries:
    """Return marks moved by so many steps each."""
    coords, owner = shapely.get_coordinates(marks, return_index=True)
    return np.asarray(
        shapely.set_coordinates(np.array(marks, dtype=object), coords + shift[owner]), dtype=object
    )
