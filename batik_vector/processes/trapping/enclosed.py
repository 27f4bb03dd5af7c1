"""Enclosed: outlines at which one ink ends and another begins all the way round, with nothing else near.

Most marks of a design lie so, whole in a ground. There a trap is the outline's parallel, in the place of the
outline: nothing has to be cut out, nor joined. All that is near the seam, or near anything else, or meets
several inks, is left to be done by overlays.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps, together
from batik_vector.processes.trapping.parallels import parallels, twice_areas
from batik_vector.values import frozen

PIECE = 48
"""Edges of a ring that are looked for at once."""
FEW = 16
"""Edges of a ring up to which each is looked for by itself."""
MARGIN = 4.0
"""Steps by which what is not near lies farther than two traps are broad."""
MIX = (np.uint64(0x9E3779B97F4A7C15), np.uint64(0xC2B2AE3D27D4EB4F), np.uint64(0xD6E8FEB86659FD93))
"""Odd numbers that spread the bits of points over a word: those of xxHash and of Steele's SplitMix."""

Flags = NDArray[np.bool_]


@frozen(eq=False)
class Enclosed:
    """Areas of each ink with the traps that are done, which of their rings those are about, and facts.

    ``done`` has for each ink which rings need no more; ``lengths`` how long the outlines are at which an ink
    meets another, in steps, by the two numbers.
    """

    layers: list[Outlines]
    done: list[Flags]
    lengths: dict[tuple[int, int], float]


def enclosed(
    layers: Sequence[Outlines], pairs: Sequence[tuple[int, int]], cell: Cell, width: float, sag: float
) -> Enclosed:
    """Return areas with traps at the outlines that are enclosed.

    Args:
        layers: the areas of each ink, outer rings anticlockwise and holes clockwise.
        pairs: which ink spreads under which other.
        cell: of the tile.
        width: of the trap, in steps.
        sag: by how much chords may miss arcs, in steps.
    """
    sizes = [len(each.closed) for each in layers]
    done = [np.zeros(size, bool) for size in sizes]
    every = together(layers)
    layer = np.repeat(np.arange(len(layers)), sizes)
    light, dark = _twins(every, layer, pairs)
    kept = _inside(every, cell, width)[light]
    light, dark = light[kept], dark[kept]
    if not len(light):
        return Enclosed(list(layers), done, {})
    points, ends = _taken(every, light)
    made = parallels(points, ends, width, sag)
    sound = made.sound.copy()
    sound[sound] = _alone(every, light[sound], dark[sound], 2 * width + MARGIN)
    which = np.flatnonzero(sound)
    if not len(which):
        return Enclosed(list(layers), done, {})
    flags = np.zeros(sum(sizes), bool)
    flags[light[which]] = flags[dark[which]] = True
    first = np.cumsum([0, *sizes])
    grown = []
    for number, outlines in enumerate(layers):
        done[number] = flags[first[number] : first[number + 1]]
        mine = which[layer[light[which]] == number]
        grown.append(_replaced(outlines, light[mine] - first[number], made.points, made.rings, mine))
    return Enclosed(grown, done, _lengths(points, ends, which, layer[light], layer[dark]))


def _twins(every: Outlines, layer: Index, pairs: Sequence[tuple[int, int]]) -> tuple[Index, Index]:
    """Return the rings of an ink that are another's run backwards, and no third's, and which those are.

    The first of two spreads under the second.
    """
    none = np.empty(0, np.intp)
    if not len(every.closed):
        return none, none
    first = every.rings[:-1]
    word = every.points[:, 0].astype(np.uint64) * MIX[0] + every.points[:, 1].astype(np.uint64) * MIX[1]
    mixed = (word ^ (word >> np.uint64(29))) * MIX[2]
    mixed ^= mixed >> np.uint64(32)
    hashes = np.add.reduceat(mixed, first)
    order = np.argsort(hashes, kind="stable")
    fresh = np.flatnonzero(np.append(True, hashes[order][1:] != hashes[order][:-1]))
    two = fresh[np.diff(np.append(fresh, len(order))) == 2]
    one, other = order[two], order[two + 1]
    number = int(layer.max()) + 1
    under = np.zeros((number, number), bool)
    under[tuple(np.array(pairs, np.intp).reshape(-1, 2).T)] = True
    swap = under[layer[other], layer[one]]
    one, other = np.where(swap, other, one), np.where(swap, one, other)
    good = under[layer[one], layer[other]]
    one, other = one[good], other[good]
    back = _backwards(every, word, one, other)
    return one[back], other[back]


def _backwards(every: Outlines, word: NDArray[np.uint64], one: Index, other: Index) -> Flags:
    """Return which rings are others run backwards; ``word`` has a number for each point."""
    sizes, first = np.diff(every.rings), every.rings[:-1]
    found: Flags = sizes[one] == sizes[other]
    one, other = one[found], other[found]
    if not len(one):
        return found
    # From the point of the least number on, there and back.
    least = np.flatnonzero(word == np.repeat(np.minimum.reduceat(word, first), sizes))
    start = np.zeros(len(first), np.intp)
    start[np.repeat(np.arange(len(first)), sizes)[least]] = least
    count = sizes[one]
    ends = np.cumsum(count)
    step = np.arange(ends[-1]) - np.repeat(ends - count, count)
    long = np.repeat(count, count)
    forth, back = np.repeat(first[one], count), np.repeat(first[other], count)
    forth = forth + (np.repeat(start[one], count) - forth + step) % long
    back = back + (np.repeat(start[other], count) - back - step) % long
    x, y = every.points[:, 0], every.points[:, 1]
    same = (x[forth] == x[back]) & (y[forth] == y[back])
    found[found] = np.logical_and.reduceat(same, ends - count)
    return found


def winding(outlines: Outlines) -> Flags:
    """Return which rings wind as they ought to: outer ones anticlockwise and holes clockwise."""
    if not len(outlines):
        return np.ones(0, bool)
    outer = np.zeros(len(outlines.closed), bool)
    outer[outlines.marks[:-1]] = True
    right: Flags = (twice_areas(outlines.points, outlines.rings) > 0) == outer
    return right


def _inside(every: Outlines, cell: Cell, width: float) -> Flags:
    """Return which rings keep from the edges of the tile by more than two traps."""
    if not len(every.closed):
        return np.zeros(0, bool)
    first, away = every.rings[:-1], 2 * width + MARGIN
    found = np.ones(len(first), bool)
    for axis, size in ((0, cell.columns), (1, cell.rows)):
        along = every.points[:, axis]
        found &= np.minimum.reduceat(along, first) > away
        found &= np.maximum.reduceat(along, first) < size - away
    return found


def _taken(every: Outlines, which: Index) -> tuple[Steps, Offsets]:
    """Return the points of some rings, and where each begins."""
    sizes = np.diff(every.rings)[which]
    return every.points[_ranges(every.rings[which], sizes)], np.concatenate([[0], np.cumsum(sizes)])


def _ranges(first: Index, counts: Index) -> Index:
    """Return the whole numbers from each on, so many of them, one run after another."""
    ends = np.cumsum(counts)
    return np.arange(ends[-1] if len(ends) else 0) + np.repeat(first - ends + counts, counts)


def _alone(every: Outlines, light: Index, dark: Index, distance: float) -> Flags:
    """Return which rings have nothing within a distance but their twins."""
    sizes = np.diff(every.rings)
    others = np.ones(len(sizes), bool)
    others[dark] = False
    rings = np.flatnonzero(others)
    # The edges of a frame are long: the box about all four would be near everything.
    piece = np.where(sizes[rings] > FEW, PIECE, 1)
    pieces = -(-sizes[rings] // piece)
    ring, piece = np.repeat(rings, pieces), np.repeat(piece, pieces)
    begin = piece * (np.arange(len(ring)) - np.repeat(np.cumsum(pieces) - pieces, pieces))
    edges = np.minimum(piece, sizes[ring] - begin)
    at = _ranges(begin, edges + 1)
    whole = np.repeat(sizes[ring], edges + 1)
    # The last edge ends where the first begins.
    at = np.where(at == whole, 0, at) + np.repeat(every.rings[ring], edges + 1)
    offsets = np.concatenate([[0], np.cumsum(edges + 1)])
    lines = shapely.from_ragged_array(
        shapely.GeometryType.LINESTRING, every.points[at].astype(np.float64), (offsets,)
    )
    asked = np.zeros(len(sizes), bool)
    asked[light] = True
    mine = np.flatnonzero(asked[ring])
    bounds = shapely.bounds(lines[mine]) + np.array([-distance, -distance, distance, distance])
    one, other = shapely.STRtree(lines).query(shapely.box(*bounds.T))
    one = mine[one]
    apart = ring[one] != ring[other]
    one, other = one[apart], other[apart]
    near = shapely.dwithin(lines[one], lines[other], distance)
    asked[ring[one[near]]] = False
    return asked[light]


def _replaced(outlines: Outlines, which: Index, points: Steps, rings: Offsets, others: Index) -> Outlines:
    """Return outlines with some rings in the place of some of theirs."""
    if not len(which):
        return outlines
    first, counts = outlines.rings[:-1].copy(), np.diff(outlines.rings)
    first[which] = len(outlines.points) + rings[others]
    counts[which] = np.diff(rings)[others]
    taken = np.concatenate([outlines.points, points])[_ranges(first, counts)]
    return Outlines(
        taken, np.concatenate([[0], np.cumsum(counts)]), outlines.marks, outlines.closed, outlines.names
    )


def _lengths(
    points: Steps, ends: Offsets, which: Index, light: Index, dark: Index
) -> dict[tuple[int, int], float]:
    """Return how long some rings are, for each two inks together."""
    after = np.arange(1, len(points) + 1)
    after[ends[1:] - 1] = ends[:-1]
    x, y = points[:, 0], points[:, 1]
    along, up = (x[after] - x).astype(np.float64), (y[after] - y).astype(np.float64)
    each = np.add.reduceat(np.sqrt(along * along + up * up), ends[:-1])
    found = dict[tuple[int, int], float]()
    for number in which.tolist():
        both = int(light[number]), int(dark[number])
        found[both] = found.get(both, 0.0) + float(each[number])
    return found
