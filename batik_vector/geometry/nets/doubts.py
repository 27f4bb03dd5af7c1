"""Which edges may come to lie over others when crossings are rounded.

An edge on which a crossing is rounded moves by less than a step. So it can pass over what lies nearer than
two alone, and that is found here, with room to spare: most edges are beyond doubt, and need no other look.
"""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.congruence import distinct
from batik_vector.geometry.nets.cells import Mask, Places
from batik_vector.geometry.nets.meetings import Events, Meetings, Rings, dot
from batik_vector.geometry.outlines import Index

NEAR = 4.0
"""Steps: an edge on which a crossing is rounded moves by less than one, and passes over nothing that lies
farther off than two of them."""

SHARP, SHORT = 0.8, 8.0
"""Cosine of the sharpest corner, and length in steps of the shortest edge, beside
which a crossing may be rounded without another look."""


def doubtful(rings: Rings, met: Meetings, rough: Mask, nodes: Index) -> Mask | None:
    """Return which edges may lie wrong once crossings are rounded; None where too many lie near one another.

    Args:
        rings, met: outlines, and their meetings.
        rough: edges on which crossings are rounded.
        nodes: the events at which stretches begin, in order along the rings.
    """
    places, found = rings.places, np.zeros(len(rings.ring), bool)
    if not rough.any():
        return found
    within = met.cells.beside(rough).pairs_within(rough)
    if within is None:
        return None
    asked = np.flatnonzero(rough[met.e] | rough[met.f])
    e, f, crosses = met.e[asked], met.f[asked], met.crosses[asked]
    _doubt_near(places, e[~crosses], f[~crosses], found)
    _doubt_ends(places, e[crosses], f[crosses], found)
    # Neighbours in a ring share an end.
    e, f = within
    apart = np.flatnonzero((rings.after[e] != f) & (rings.after[f] != e))
    _doubt_near(places, e[apart], f[apart], found)
    _doubt_corners(rings, rough, found)
    _doubt_crowds(met.events, nodes, found)
    return found


def _doubt_near(places: Places, e: Index, f: Index, found: Mask) -> None:
    """Note which of some pairs of edges that do not cross come near one another."""
    near = np.zeros(len(e), bool)
    for one, other in ((e, f), (f, e)):
        for last in (False, True):
            near |= _near(places, one, other, last)
    found[e[near]] = found[f[near]] = True


def _doubt_ends(places: Places, e: Index, f: Index, found: Mask) -> None:
    """Note which of some pairs of edges that cross do so near an end of one."""
    gap_x, gap_y = places.x[f] - places.x[e], places.y[f] - places.y[e]
    turn = places.dx[e] * places.dy[f] - places.dy[e] * places.dx[f]
    for edge, way in ((e, 1), (f, -1)):
        dx, dy = places.dx[edge], places.dy[edge]
        begins = way * (dx * gap_y - dy * gap_x)
        near = np.minimum(np.abs(begins), np.abs(begins + way * turn)) < NEAR * np.hypot(dx, dy)
        found[e[near]] = found[f[near]] = True


def _doubt_crowds(events: Events, nodes: Index, found: Mask) -> None:
    """Note edges on which meetings lie so near one another that rounding may bring them out of order."""
    one, other = nodes[:-1], nodes[1:]
    near = events.edge[one] == events.edge[other]
    near &= (
        np.maximum(np.abs(events.x[one] - events.x[other]), np.abs(events.y[one] - events.y[other])) <= NEAR
    )
    if not near.any():
        return
    # What they meet is not known by its edge: all that passes there is looked at.
    crowd = distinct(np.concatenate([_keys(events, one[near]), _keys(events, other[near])]))
    keys = _keys(events, nodes)
    at = np.minimum(np.searchsorted(crowd, keys), len(crowd) - 1)
    found[events.edge[nodes[crowd[at] == keys]]] = True


def _keys(events: Events, which: Index) -> Index:
    """Return a number for the point of each of some events."""
    return np.asarray((events.x[which] << 32) + events.y[which])


def _doubt_corners(rings: Rings, rough: Mask, found: Mask) -> None:
    """Note edges that come near their neighbours in a ring: at sharp corners, or where they are short."""
    places = rings.places
    joined = np.flatnonzero(rough | rough[rings.after])
    ahead = rings.after[joined]
    a, b = (places.dx[joined], places.dy[joined]), (places.dx[ahead], places.dy[ahead])
    far_a, far_b = np.hypot(*a), np.hypot(*b)
    sharp = (-dot(a, b) > SHARP * far_a * far_b) | (np.minimum(far_a, far_b) < SHORT)
    found[joined[sharp]] = found[ahead[sharp]] = True


def _near(places: Places, e: Index, f: Index, last: bool) -> Mask:
    """Return which edges e begin, or end, near the edges f."""
    gap_x, gap_y = (places.x[e] - places.x[f]).astype(float), (places.y[e] - places.y[f]).astype(float)
    if last:
        gap_x += places.dx[e]
        gap_y += places.dy[e]
    way_x, way_y = places.dx[f], places.dy[f]
    length = np.hypot(way_x, way_y)
    off = np.abs(way_x * gap_y - way_y * gap_x)
    along = way_x * gap_x + way_y * gap_y
    room = NEAR * length
    return np.asarray((off < room) & (along > -room) & (along < length * length + room), bool)
