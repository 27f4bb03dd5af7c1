"""Order: strokes follow one another with short ways between, what lies inside before what lies around it.

A tool that cuts a part loose can no longer cut into it, and a pen that is lifted draws nothing. So each
stroke comes after all that lie inside it, lines are drawn from whichever end is nearer, and closed strokes
begin where that saves way. What is drawn stays the same; only when, from where and, of open lines, which way.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from batik_vector.artwork import PIECE
from batik_vector.geometry.outlines import Index, Outlines, Steps, together
from batik_vector.processes.ordering.chaining import chained
from batik_vector.processes.ordering.distances import PARTS, distances
from batik_vector.processes.ordering.improving import improved
from batik_vector.processes.ordering.nesting import inside_first, parents
from batik_vector.processes.ordering.sites import Sites
from batik_vector.processes.ordering.starts import ends_of, settled
from batik_vector.units import STEPS_PER_MM

BATCH = 1 << 20
"""Vertices that are brought into order together, about; a page with more is ordered batch by batch."""
GOINGS = 2
"""How often the order is improved and the starts of closed strokes are settled by it, in turn."""
NEAREST = 7
"""Neighbours of an end that it may follow, its stroke's other end among them."""
AT_HAND = 1 << 17
"""Numbers that small orders need at a time."""
TRIED = 24
"""Vertices of a closed stroke that are tried as its start; when the order stands, all are."""


def contours(pieces: Iterable[Outlines]) -> Iterator[Outlines]:
    """Yield each ring as a mark of its own, without names: holes are strokes like any other.

    A point where the one before it is would be a move without length: it is left out, and so is a ring that
    is a single place.
    """
    for outlines in pieces:
        points, ends, closed = outlines.points, outlines.rings, outlines.closed
        # Column by column: NumPy's loop over the two numbers of each point is many times dearer.
        stays = np.empty(len(points), bool)
        stays[1:] = points[1:, 0] == points[:-1, 0]
        stays[1:] &= points[1:, 1] == points[:-1, 1]
        stays[ends[:-1]] = closed & (points[ends[:-1]] == points[ends[1:] - 1]).all(axis=1)
        if stays.any():
            points = points[~stays]
            sizes = np.diff(ends) - np.add.reduceat(stays, ends[:-1], dtype=np.int64)
            kept = sizes > 1
            points = points[np.repeat(kept, sizes)]
            ends, closed = np.concatenate([[0], np.cumsum(sizes[kept])]), closed[kept]
        if len(closed):
            yield Outlines(points, ends, np.arange(len(ends)), closed)


def ordered(pieces: Iterable[Outlines], *, join: bool = False) -> Iterator[Outlines]:
    """Yield strokes in a good order, about ``PIECE`` vertices at a time.

    Args:
        pieces: one ring or polyline to a mark, with names or without.
        join: whether strokes of which one begins where the other ends become one; names are lost then.
    """
    for batch in _batches(pieces):
        strokes = in_order(batch)
        yield from _pieces(joined(strokes) if join else strokes)


def _batches(pieces: Iterable[Outlines]) -> Iterator[Outlines]:
    """Yield pieces together, as many as have ``BATCH`` vertices."""
    held, size = list[Outlines](), 0
    for outlines in pieces:
        if held and size + len(outlines.points) > BATCH:
            yield together(held)
            held, size = [], 0
        held.append(outlines)
        size += len(outlines.points)
    if held:
        yield together(held)


def _pieces(strokes: Outlines) -> Iterator[Outlines]:
    if len(strokes.points) <= PIECE:
        yield strokes
        return
    cuts = np.flatnonzero(np.diff(strokes.rings[1:] // PIECE)) + 1
    for first, stop in pairwise(sorted({0, *cuts.tolist(), len(strokes)})):
        begin, end = strokes.rings[first], strokes.rings[stop]
        yield Outlines(
            strokes.points[begin:end],
            strokes.rings[first : stop + 1] - begin,
            np.arange(stop - first + 1),
            strokes.closed[first:stop],
            strokes.names[first:stop],
        )


def in_order(strokes: Outlines) -> Outlines:
    """Return strokes in a good order; see :mod:`batik_vector.processes.order`.

    Args:
        strokes: one ring or polyline to a mark, with names or without, none of them empty.
    """
    if len(strokes) < 2:
        return strokes
    # Once the C library has taken back a piece of this size it keeps as much at hand. Without, what small
    # orders need goes back to the system and is asked for again all the time: a sixth of all they cost.
    np.empty(AT_HAND)
    parent = parents(strokes)
    start = strokes.rings[:-1].copy()
    # What lies in the same stroke, or in none, has an order of its own.
    used = np.zeros(len(parent) + 1, bool)
    used[parent + 1] = True
    groups = (np.cumsum(used) - 1)[parent + 1].astype(np.intp)
    among: Index | None = None
    for going in range(GOINGS):
        ends = ends_of(strokes, start)
        sites = Sites.of(ends, groups)
        pairs = sites.near(NEAREST)
        among = improved(chained(sites, pairs) if among is None else among, sites, pairs)
        among = _from_the_corner(among, ends, int(np.count_nonzero(groups == 0)))
        passed = _nested(among, parent)
        if not strokes.closed.any():
            break
        start = settled(strokes, passed, start, TRIED if going < GOINGS - 1 else None)
    return _drawn(strokes, passed, start)


def _from_the_corner(among: Index, ends: Steps, count: int) -> Index:
    """Return an order whose first ``count`` strokes begin at the end nearer to the page's corner."""
    head = among[: 2 * count]
    first, last = distances(ends[head[[0, -1]]], np.zeros(2, np.int64)).tolist()
    return among if first <= last else np.concatenate([head[::-1], among[2 * count :]])


def _nested(among: Index, parent: Index) -> Index:
    """Return the ends as they are passed when what lies inside comes first, of the order in each group."""
    sequence = inside_first(among[::2] >> 1, parent)
    into = np.empty_like(sequence)
    into[among[::2] >> 1] = among[::2]
    return np.stack([into[sequence], into[sequence] ^ 1], axis=1).ravel()


def _drawn(strokes: Outlines, passed: Index, start: Index) -> Outlines:
    """Return strokes as they are passed: closed ones from their starts on, open ones either way."""
    sequence, back = passed[::2] >> 1, (passed[::2] & 1).astype(bool)
    first, sizes = strokes.rings[:-1][sequence], np.diff(strokes.rings)[sequence]
    closed = strokes.closed[sequence]
    rings = np.concatenate([[0], np.cumsum(sizes)])
    step = np.arange(rings[-1]) - np.repeat(rings[:-1], sizes)
    turned = np.where(closed, start[sequence] - first, 0)
    step += np.repeat(turned, sizes)
    room = np.repeat(sizes, sizes)
    step -= (step >= room) * room
    backward = np.repeat(back & ~closed, sizes)
    step = np.where(backward, room - 1 - step, step)
    points = strokes.points.take(step + np.repeat(first, sizes), axis=0)
    names = [strokes.names[each] for each in sequence.tolist()] if len(strokes.names) else ()
    return replace(strokes, points=points, rings=rings, closed=closed, names=names, unfinished=False)


def joined(strokes: Outlines) -> Outlines:
    """Return strokes, without names, of which each begins elsewhere than the one before it ends.

    Lines that follow one another without a way between are one; what comes back to its beginning is closed.

    Args:
        strokes: one ring or polyline to a mark, in order.
    """
    points, first, last = strokes.points, strokes.rings[:-1], strokes.rings[1:] - 1
    goes_on = (points[first[1:]] == points[last[:-1]]).all(axis=1)
    goes_on &= ~strokes.closed[1:] & ~strokes.closed[:-1]
    if not goes_on.any():
        return replace(strokes, names=())
    heads = np.flatnonzero(np.append(True, ~goes_on))
    tails = np.append(heads[1:], len(strokes)) - 1
    many = tails > heads
    size = last[tails] - first[heads] + 1 - (tails - heads)
    # A line there and back encloses nothing.
    shut = many & (points[first[heads]] == points[last[tails]]).all(axis=1) & (size > 3)
    kept = np.ones(len(points), bool)
    kept[first[1:][goes_on]] = False
    kept[last[tails[shut]]] = False
    rings = np.concatenate([[0], np.cumsum(size - shut)])
    closed = strokes.closed[heads] | shut
    return Outlines(points[kept], rings, np.arange(len(rings)), closed)


def travel(strokes: Outlines) -> float:
    """Return the way between strokes in their order, in mm: what the tool goes with the pen up."""
    first, last = strokes.rings[:-1], strokes.rings[1:] - 1
    ends = strokes.points[np.where(strokes.closed, first, last)]
    return float(distances(ends[:-1], strokes.points[first[1:]]).sum()) / PARTS / STEPS_PER_MM
