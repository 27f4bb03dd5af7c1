"""The stretches of outlines that no other area covers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.nets.cells import Mask
from batik_vector.geometry.nets.doubts import doubtful
from batik_vector.geometry.nets.meetings import Events, Meetings, Rings
from batik_vector.geometry.outlines import Index, Offsets, Steps
from batik_vector.values import frozen


@frozen(eq=False)
class Stretches:
    """Stretches of outlines, each from a meeting to the next, or a whole ring.

    Stretch i is ``points[offsets[i]:offsets[i + 1]]`` and ``end[i]``, which of a ring repeats its first
    point. ``whole[i]`` says whether it is a ring that meets nothing; ``doubtful`` says of every point whether
    the edge that leaves it may lie wrong once it is rounded."""

    points: Steps
    offsets: Offsets
    end: Steps
    whole: Mask
    doubtful: Mask


class Bare(NamedTuple):
    """Stretches, whose each is, and the pairs of owners that have more in common than points, shape (k,
    2)."""

    stretches: Stretches
    owner: Index
    tied: Index


class _Swept(NamedTuple):
    """Events in order along the rings, those at one place as one, and how many areas cover what follows each.

    ``tied`` are rows (ring, owner) that have more in common than points.
    """

    events: Index
    along: NDArray[np.float64]
    cover: Index
    tied: Index


def bare(rings: Rings, met: Meetings, asked: Mask, held: Index) -> Bare | None:
    """Return the stretches that are not covered; None where too many lie near one another.

    Args:
        rings: the outlines.
        met: their meetings.
        asked: owners whose stretches are wanted; all that they meet are among the rings.
        held: rows (ring, owner): rings that lie in the area of an owner, and do not meet it.
    """
    events = met.events
    base = np.bincount(held[:, 0], minlength=len(rings.outlines.closed))
    swept = _swept(rings, events, base)
    owner_of_ring = np.repeat(np.arange(len(rings.outlines)), np.diff(rings.outlines.marks))
    tied = np.concatenate([swept.tied, held])
    tied = np.column_stack([owner_of_ring[tied[:, 0]], tied[:, 1]])
    following = _following(rings.ring[events.edge[swept.events]])
    kept = np.flatnonzero((swept.cover == 0) & asked[rings.places.owner[events.edge[swept.events]]])
    rough = np.zeros(len(rings.ring), bool)
    rough[events.edge[swept.events[kept]]] = rough[events.edge[swept.events[following[kept]]]] = True
    doubts = doubtful(rings, met, rough, swept.events)
    if doubts is None:
        return None
    lone = np.ones(len(base), bool)
    lone[rings.ring[events.edge]] = False
    lone = np.flatnonzero(lone & (base == 0) & asked[owner_of_ring])
    stretches = _cut(rings, events, swept, (kept, following[kept]), lone, doubts)
    return Bare(stretches, owner_of_ring[_rings_of(rings, events, swept, kept, lone)], tied)


def _swept(rings: Rings, events: Events, base: Index) -> _Swept:
    """Walk along the rings; ``base``, by how many areas each is covered where it begins, is added to."""
    along = events.edge + events.part
    order = np.argsort(along, kind="stable")
    other, covered = events.other[order], events.covered[order]
    ring, along = rings.ring[events.edge[order]], along[order]
    # By pairs of a ring and another area, and along the ring: what each meeting changes.
    by = np.argsort(ring * len(rings.outlines) + other, kind="stable")
    ring_by, other_by, along_by, now = ring[by], other[by], along[by], covered[by]
    new = np.append(True, (ring_by[1:] != ring_by[:-1]) | (other_by[1:] != other_by[:-1]))[: len(by)]
    again = np.append(False, ~new[1:] & (along_by[1:] == along_by[:-1]))[: len(by)]
    if again.any():
        # An area that touches itself goes through a point twice: what is inside of both is inside.
        at = np.flatnonzero(~again)
        now = np.logical_and.reduceat(now, at)[np.cumsum(~again) - 1]
    begins = np.flatnonzero(new)
    stops = np.append(begins[1:], len(by)) - 1
    before = np.roll(now, 1)
    before[begins] = now[stops[: len(begins)]]
    change = np.empty(len(by), np.intp)
    change[by] = now.astype(np.intp) - before
    base += np.bincount(ring_by[stops[: len(begins)]][now[stops[: len(begins)]]], minlength=len(base))
    total = np.cumsum(change)
    # What a ring changes altogether is nothing, so that the sum goes on from ring to ring.
    cover = base[ring] + total
    last = np.append(along[1:] != along[:-1], True)[: len(along)]
    together = np.logical_or.reduceat(events.tied[order][by], begins) if len(by) else np.zeros(0, bool)
    tied = np.column_stack([ring_by[begins], other_by[begins]])[together]
    return _Swept(order[last], along[last], cover[last], tied)


def _following(ring: Index) -> Index:
    """Return which item follows each in its ring, given the rings of all in order."""
    count = len(ring)
    following = np.arange(1, count + 1)
    heads = np.flatnonzero(np.append(True, ring[1:] != ring[:-1])[:count])
    following[np.append(heads[1:], count)[: len(heads)] - 1] = heads
    return following


def _rings_of(rings: Rings, events: Events, swept: _Swept, kept: Index, lone: Index) -> Index:
    return np.concatenate([rings.ring[events.edge[swept.events[kept]]], lone])


def _cut(
    rings: Rings, events: Events, swept: _Swept, ends: tuple[Index, Index], lone: Index, doubts: Mask
) -> Stretches:
    """Return the stretches between some events, and then the rings that meet nothing."""
    kept, stop = ends
    order, first_of = swept.events, rings.outlines.rings
    edge, x, y = events.edge[order], events.x[order], events.y[order]
    ring = rings.ring[edge[kept]]
    first, size = first_of[ring], np.diff(first_of)[ring]
    steps = edge[stop] - edge[kept]
    # A ring's last stretch goes on over its end, and with one meeting all round.
    steps += np.where(swept.along[stop] <= swept.along[kept], size, 0)
    inner = np.where(swept.along[stop] == edge[stop], steps - 1, steps)
    counts = np.concatenate([inner + 1, np.diff(first_of)[lone]])
    offsets = np.concatenate([[0], np.cumsum(counts)])
    start = np.concatenate([edge[kept] - first, np.zeros(len(lone), np.intp)])
    size, first = np.concatenate([size, np.diff(first_of)[lone]]), np.concatenate([first, first_of[lone]])
    place = np.arange(offsets[-1]) - np.repeat(offsets[:-1] - start, counts)
    turns = np.repeat(size, counts)
    vertex = np.where(place >= turns, place - turns, place) + np.repeat(first, counts)
    points = rings.outlines.points[vertex]
    points[offsets[: len(kept)], 0], points[offsets[: len(kept)], 1] = x[kept], y[kept]
    end = np.concatenate([np.column_stack([x[stop], y[stop]]), rings.outlines.points[first_of[lone]]])
    whole = np.arange(len(counts)) >= len(kept)
    return Stretches(points, offsets, end, whole, doubts[vertex])
