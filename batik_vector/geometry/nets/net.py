"""The union of many areas that meet, of which most may be copies of a few.

Copies that have the same neighbours at the same places are left bare along the same stretches. So the
stretches of one of each sort are worked out, set down wherever a copy of it lies, and chained to rings. All
of it is in whole numbers; what is rounded are the crossings alone, and where that may change how edges lie to
one another they are looked at again. The few areas that are entangled by it are united beforehand. Wherever
it is not sure, nothing is returned, and who asked has to unite the areas in another way."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import shapely

from batik_vector.geometry.congruence import alike, distinct, same_points
from batik_vector.geometry.nets.bare import Stretches
from batik_vector.geometry.nets.cells import Mask
from batik_vector.geometry.nets.chains import Chains, chained, entangled
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.nets.solving import Copies, Solved, labels, solved
from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps, of_polygons, runs, together
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

ROUNDS = 4
"""How often entangled areas are united beforehand; one is enough for most nets."""

MOST = 20
"""One in how many areas may be entangled, at most: of more it is dearer than to unite them all."""

Unite = Callable[[list[Geometries]], Geometries]
"""Returns the unions, on the grid, of some groups of areas."""


class Net(NamedTuple):
    """What areas cover together.

    ``areas`` are valid polygons on the grid, and ``first`` says of each which is the first of those that it
    is made of; ``alone`` are the numbers of those that have nothing in common with others but points."""

    areas: Outlines
    first: Index
    alone: Index


class _Tangle(NamedTuple):
    """Copies whose stretches lie over one another, or go on one knows not how: pairs, shape (k, 2)."""

    pairs: Index


class _Work(NamedTuple):
    """Copies, what is known of them, and for each of what sort it is, and the first of those that it was made
    of.

    Copies that have become part of others are of a sort that has no stretches, and ``origin`` -1.
    """

    copies: Copies
    known: Solved
    sort: Index
    origin: Index


def united(
    shapes: Outlines, areas: Geometries, kind: Index, shift: Steps, pairs: Index, unite: Unite
) -> Net | None:
    """Return the union of copies; None where it cannot be told for sure.

    Args:
        shapes: valid areas on the grid, outer rings anticlockwise and holes clockwise.
        areas: the same as polygons.
        kind, shift: of which shape each copy is, and how far it is moved; shapes (n,) and (n, 2).
        pairs: of copies whose bounds meet, each once, shape (k, 2).
        unite: unites what rounding entangles.
    """
    heads, number = alike(np.column_stack([kind, shift]))
    if len(heads) < len(kind):
        pairs = number[pairs]
        pairs = np.unique(np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1), axis=0)
    copies = Copies.of(shapes, areas, kind[heads], shift[heads], pairs)
    sorts, sort = copies.sorts()
    known = solved(copies, sorts)
    now = None if known is None else _Work(copies, known, sort, np.arange(len(heads)))
    for _ in range(ROUNDS):
        if now is None:
            return None
        label = labels(now.copies, now.known, now.sort)
        drawn = (np.bincount(label, minlength=len(label))[label] > 1) & (now.origin >= 0)
        drawn[len(heads) :] = True
        down = _set_down(now, np.flatnonzero(drawn))
        if not isinstance(down, _Tangle):
            break
        now = _untangled(now, down.pairs, unite)
    if now is None or down is None or isinstance(down, _Tangle):
        return None
    first = np.full(len(label), len(heads))
    there = now.origin >= 0
    np.minimum.at(first, label[there], now.origin[there])
    net = _rings(*down, label)
    if net is None:
        return None
    alone = np.flatnonzero((~drawn & there)[: len(heads)])
    return Net(net[0], heads[first[net[1]]], heads[alone])


def _untangled(now: _Work, pairs: Index, unite: Unite) -> _Work | None:
    """Unite entangled copies, and work out again what is bare about them; None where there are too many."""
    copies, count = now.copies, len(now.copies)
    # What is entangled with itself is so by what it meets.
    alone = np.isin(copies.own, pairs[pairs[:, 0] == pairs[:, 1], 0])
    pairs = np.concatenate([pairs, np.column_stack([copies.own[alone], copies.other[alone]])])
    label = components(count, pairs)
    gone = np.bincount(label, minlength=count)[label] > 1
    members = np.flatnonzero(gone)
    if not len(members) or len(members) * MOST > count:
        return None
    groups = [members[label[members] == each] for each in distinct(label[members])]
    bodies = [_placed(copies, group) for group in groups]
    whole, of = shapely.get_parts(unite(bodies), return_index=True)
    new = oriented(polygonal(whole))
    if len(new) != len(whole):
        return None
    shapes = together([copies.shapes, of_polygons(new)])
    kind = np.concatenate([copies.kind, len(copies.shapes) + np.arange(len(new))])
    shift = np.concatenate([copies.shift, np.zeros((len(new), 2), np.int64)])
    kept = (copies.own < copies.other) & ~gone[copies.own] & ~gone[copies.other]
    old = np.column_stack([copies.own[kept], copies.other[kept]])
    beside = distinct(copies.other[gone[copies.own]])
    beside = beside[~gone[beside]]
    others = np.concatenate([beside, count + np.arange(len(new))])
    bounds = np.vstack([shapely.bounds(_placed(copies, beside)).reshape(-1, 4), shapely.bounds(new)])
    boxes: Geometries = np.asarray(shapely.box(*bounds.T), dtype=object)
    one, other = shapely.STRtree(boxes).query(boxes[len(beside) :])
    one, other = one + count, others[other]
    met = (other < count) | (other < one)
    more = np.column_stack([other[met], one[met]])
    origin = np.concatenate([now.origin, [now.origin[groups[each]].min() for each in of.tolist()]])
    origin[members] = -1
    areas = np.concatenate([copies.areas, new])
    copies = Copies.of(shapes, areas, kind, shift, np.concatenate([old, more]))
    late = solved(copies, others)
    if late is None:
        return None
    sort = np.concatenate([now.sort, np.zeros(len(new), np.intp)])
    # The last sort of all has no stretches.
    first = len(now.known.ends) - 1
    sort[others], sort[members] = first + np.arange(len(others)), first + len(others)
    known = now.known.more(late)
    known = known._replace(
        ends=np.append(known.ends, known.ends[-1]), slot_ends=np.append(known.slot_ends, known.slot_ends[-1])
    )
    return _Work(copies, known, sort, origin)


def _placed(copies: Copies, which: Index) -> Geometries:
    """Return some copies as polygons."""
    areas = copies.areas[copies.kind[which]]
    xy, owner = shapely.get_coordinates(areas, return_index=True)
    return np.asarray(shapely.set_coordinates(areas.copy(), xy + copies.shift[which][owner]), dtype=object)


@frozen(eq=False)
class _Down:
    """Stretches where they lie: points, where those of each begin, its end, of which copy, and whether a
    ring."""

    points: Steps
    offsets: Offsets
    end: Steps
    owner: Index
    whole: Mask


def _set_down(now: _Work, which: Index) -> tuple[_Down, Chains] | _Tangle | None:
    """Set down the stretches of some copies and chain them; None where they do not fit together."""
    copies = now.copies
    slim = _without_repeats(now.known.stretches)
    members, ends = runs(now.known.ends, now.sort[which])
    row = now.known.members[members]
    owner = np.repeat(which, np.diff(ends))
    # What rounding drew together to a point is none.
    long = (np.diff(slim.offsets) > 1) | ~same_points(slim.points[slim.offsets[:-1]], slim.end)
    row, owner = row[long[row]], owner[long[row]]
    kept = _not_closed_up(copies, slim, row, owner)
    row, owner = row[kept], owner[kept]
    tangle = _tangle(copies, slim, row, owner)
    if tangle is None or len(tangle.pairs):
        return tangle
    shift = copies.shift[owner]
    begin, stop = slim.offsets[row], slim.offsets[row + 1] - 1
    start, last = slim.points[begin] + shift, slim.points[stop] + shift
    end = slim.end[row] + shift
    more = (stop > begin)[:, None]
    first = np.where(more, slim.points[np.minimum(begin + 1, len(slim.points) - 1)] + shift, end)
    chains = chained(start, end, first, last, slim.whole[row])
    if not isinstance(chains, Chains):
        return None if chains is None else _Tangle(owner[chains])
    row, owner, shift = row[chains.order], owner[chains.order], shift[chains.order]
    points, offsets = runs(slim.offsets, row)
    moved = slim.points[points]
    sizes = np.diff(offsets)
    for axis in (0, 1):
        moved[:, axis] += np.repeat(shift[:, axis], sizes)
    return _Down(moved, offsets, end, owner, slim.whole[row]), chains


def _without_repeats(stretches: Stretches) -> Stretches:
    """Leave out points that repeat the one before them, or the end."""
    points, first = stretches.points, stretches.offsets[:-1]
    keep = np.ones(len(points), bool)
    keep[1:] = ~same_points(points[1:], points[:-1])
    keep[first] = True
    # What is left before the end may be that.
    kept = np.flatnonzero(keep)
    offsets = np.searchsorted(kept, stretches.offsets)
    last = kept[offsets[1:] - 1]
    at_end = same_points(points[last], stretches.end) & (last > first)
    if not at_end.any() and keep.all():
        return stretches
    keep[last[at_end]] = False
    offsets = np.concatenate([[0], np.cumsum(keep)])[stretches.offsets]
    return Stretches(points[keep], offsets, stretches.end, stretches.whole, stretches.doubtful[keep])


def _not_closed_up(copies: Copies, stretches: Stretches, row: Index, owner: Index) -> Mask:
    """Return which stretches run not back along another: two such that rounding laid together enclose
    nothing."""
    kept = np.ones(len(row), bool)
    first = stretches.offsets[:-1]
    short = np.flatnonzero(((np.diff(stretches.offsets) == 1) & stretches.doubtful[first])[row])
    shift = copies.shift[owner[short]]
    rows = np.column_stack([stretches.points[first[row[short]]] + shift, stretches.end[row[short]] + shift])
    _, number = alike(np.concatenate([rows, rows[:, [2, 3, 0, 1]]]))
    there, back = number[: len(rows)], number[len(rows) :]
    kept[short[np.isin(there, back)]] = False
    return kept


def _tangle(copies: Copies, stretches: Stretches, row: Index, owner: Index) -> _Tangle | None:
    """Return which copies' edges lie over others, of those that rounding may have brought there."""
    if not stretches.doubtful.any():
        return _Tangle(np.empty((0, 2), np.intp))
    rough = np.logical_or.reduceat(stretches.doubtful, stretches.offsets[:-1])
    following = np.empty_like(stretches.points)
    following[:-1] = stretches.points[1:]
    following[stretches.offsets[1:] - 1] = stretches.end
    row, owner = row[rough[row]], owner[rough[row]]
    members, ends = runs(stretches.offsets, row)
    asked = stretches.doubtful[members]
    owner, members = np.repeat(owner, np.diff(ends))[asked], members[asked]
    shift = copies.shift[owner]
    found = entangled(stretches.points[members] + shift, following[members] + shift)
    return None if found is None else _Tangle(owner[found])


def _rings(down: _Down, chains: Chains, label: Index) -> tuple[Outlines, Index] | None:
    """Return areas and the label of each, from chained stretches; None where they are none."""
    points = down.points
    offsets = down.offsets[chains.ends]
    of = label[down.owner[chains.ends[:-1]]]
    after = np.empty_like(points)
    after[:-1] = points[1:]
    after[offsets[1:] - 1] = points[offsets[:-1]]
    (x, y), (to_x, to_y) = (points - points[:1]).T, (after - points[:1]).T
    doubled = np.add.reduceat(x * to_y - y * to_x, offsets[:-1])
    way = np.add.reduceat(np.abs(to_x - x) + np.abs(to_y - y), offsets[:-1])
    # A hole thinner than a step may be turned inside out by rounding, or laid flat: it is none.
    shells = np.flatnonzero(doubled >= 0)
    shells = shells[np.lexsort([-doubled[shells], of[shells]])]
    further = shells[1:][of[shells[1:]] == of[shells[:-1]]]
    firsts = distinct(of)
    if (doubled[further] > 2 * way[further]).any() or len(shells) - len(further) != len(firsts):
        return None
    kept = np.ones(len(of), bool)
    kept[further] = False
    order = np.flatnonzero(kept)
    order = order[np.lexsort([doubled[order] < 0, of[order]])]
    members, ends = runs(offsets, order)
    marks = np.searchsorted(of[order], np.append(firsts, len(label)))
    return Outlines(points[members], ends, marks, np.ones(len(order), bool)), firsts
