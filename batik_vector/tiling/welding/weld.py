"""Welding: areas of one ink that meet or overlap become one, component by component.

Uniting everything at once costs far more than uniting each connected group by itself, an area that meets no
other needs nothing done, and groups that are copies of one another are united once. Large groups are nets,
united by ``geometry.nets`` at the edges that meet others. Coordinates are whole grid steps.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry import work
from batik_vector.geometry.congruence import alike
from batik_vector.geometry.nets import united as united_net
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.outlines import Index, Offsets, Steps, of_polygons, runs, to_polygons
from batik_vector.geometry.regions import oriented
from batik_vector.geometry.sampling import Indices
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.torus.remembered import Asked, as_array, identities
from batik_vector.tiling.welding.congruent import Copies, Stock, together

ROUNDS = 6
"""How often areas that joining brought together are joined again; two are seldom needed, and dense scribbles
that never come apart on the grid are left as they are."""

NET = 20_000
"""Vertices of a group from which on it is united as a net; GEOS is as soon done with fewer."""


def welded(areas: Geometries) -> tuple[Geometries, Indices]:
    """Join the areas that meet; return them with the index of the first area that each is made of.

    Areas that touch in points only stay apart.
    """
    if not len(areas):
        return areas, np.empty(0, np.intp)
    stock = Stock()
    joined, origin = weld(stock, stock.taken_up(areas))
    return stock.geometries(joined), origin


def united(areas: Geometries, pairs: Indices) -> tuple[Geometries, Indices]:
    """Unite every group of areas that pairs connect; return them with the first area that each is made of."""
    stock = Stock()
    joined, first, _ = _united(stock, stock.taken_up(areas), pairs)
    return stock.geometries(joined), first


def weld(stock: Stock, copies: Copies, group: Index | None = None) -> tuple[Copies, Index]:
    """Join the copies that meet; return them with the index of the first that each is made of, ascending.

    Args:
        stock: of which shapes they are.
        copies: shape (n,).
        group: shape (n,); only those of one group are joined. None joins all.
    """
    group = np.zeros(len(copies), np.intp) if group is None else group
    near = _near(stock, copies, group, 0)
    nets, first, left = _nets(stock, copies, near)
    origin = np.flatnonzero(left)
    copies, group, place = copies.taken(origin), group[origin], np.cumsum(left) - 1
    pairs = _met(stock, copies, place[near[left[near[:, 0]]]])
    # Joining moves crossings onto the grid, and may push an edge over a neighbour that it only came
    # near to; then these two are joined as well.
    copies, origin = _joined(stock, copies, origin, group, pairs)
    return _in_order(together([nets, copies]), np.concatenate([first, origin]))


def weld_changed(stock: Stock, copies: Copies, group: Index, changed: Index) -> tuple[Copies, Index]:
    """Join copies that were welded and have been changed since with those that they have come to overlap.

    Args:
        stock, copies, group: as for :func:`weld`, which also says what is returned.
        changed: which copies are not what they were.
    """
    if not len(changed):
        return copies, np.arange(len(copies))
    origin = np.concatenate([np.delete(np.arange(len(copies)), changed), changed])
    copies, group, known = copies.taken(origin), group[origin], len(origin) - len(changed)
    return _joined(stock, copies, origin, group, _overlapping(stock, copies, group, known))


def _joined(
    stock: Stock, copies: Copies, origin: Index, group: Index, pairs: Indices
) -> tuple[Copies, Index]:
    """Join pairs of copies, and what overlaps for it; return them with their origins, ascending."""
    for _ in range(ROUNDS):
        if not len(pairs):
            break
        copies, first, single = _united(stock, copies, pairs)
        origin, group = origin[first], group[first]
        pairs = _overlapping(stock, copies, group, single)
    return _in_order(copies, origin)


def _in_order(copies: Copies, origin: Index) -> tuple[Copies, Index]:
    """Return copies and their origins, these ascending."""
    order = np.argsort(origin, kind="stable")
    return copies.taken(order), origin[order]


def _overlapping(stock: Stock, copies: Copies, group: Index, known: int) -> Indices:
    """Return the pairs that share more than borders, but for those among the first ``known``."""
    pairs = _met(stock, copies, _near(stock, copies, group, known))
    return pairs[stock.holds(overlap, copies.taken(pairs[:, 0]), copies.taken(pairs[:, 1]))]


def overlap(a: Geometries, b: Geometries) -> NDArray[np.bool_]:
    """Return which areas of two arrays share more than their borders."""
    return np.asarray(shapely.relate_pattern(a, b, "T********"))


def _near(stock: Stock, copies: Copies, group: Index, known: int) -> Indices:
    """Return the pairs of a group whose bounds meet, shape (k, 2), but for those of the first ``known``."""
    late = np.arange(known, len(copies))
    a, b = stock.near(copies.taken(late), copies)
    a = late[a]
    asked = ((b < known) | (a < b)) & (group[a] == group[b])
    return np.column_stack([a[asked], b[asked]])


def _met(stock: Stock, copies: Copies, near: Indices) -> Indices:
    """Return those of some pairs that have a point in common."""
    a, b = near.T
    return near[stock.holds(shapely.intersects, copies.taken(a), copies.taken(b))]


def _nets(stock: Stock, copies: Copies, near: Indices) -> tuple[Copies, Index, NDArray[np.bool_]]:
    """Unite the large groups of copies whose bounds meet, where that can be told for sure.

    Return what they are, the first of the copies that each is made of, and which copies are left.
    """
    found, firsts, left = [together([])], [np.empty(0, np.intp)], np.ones(len(copies), bool)
    shapes, row = stock.used(copies)
    vertices = shapely.get_num_coordinates(shapes)[row]
    if vertices.sum() >= NET:
        label = components(len(copies), near)
        for each in np.flatnonzero(np.bincount(label, weights=vertices) >= NET).tolist():
            members = np.flatnonzero(label == each)
            pairs = np.searchsorted(members, near[label[near[:, 0]] == each])
            net = _net(stock, copies.taken(members), pairs) if len(pairs) else None
            if net is not None:
                found.append(net[0])
                firsts.append(members[net[1]])
                left[members] = False
    return together(found), np.concatenate(firsts), left


def _net(stock: Stock, copies: Copies, pairs: Indices) -> tuple[Copies, Index] | None:
    """Return the union of copies, given which of their bounds meet, and the first that each part is made
    of."""
    shapes, row = stock.used(copies)
    vertices = float(shapely.get_num_coordinates(shapes)[row].sum())
    work.spend(vertices)

    def make(_: list[int]) -> list[tuple[list[shapely.Geometry], list[int], list[int]] | tuple[()]]:
        areas = oriented(shapes)
        net = united_net(of_polygons(areas), areas, row, copies.shift, pairs, overlay.united)
        if net is None:
            return [()]
        return [(to_polygons(net.areas).tolist(), net.first.tolist(), net.alone.tolist())]

    if stock.remembers:
        rows = np.column_stack([identities(stock.shapes[copies.kind]), copies.shift])
        known = Asked[tuple[list[shapely.Geometry], list[int], list[int]] | tuple[()]].together(
            "net", rows, (shapes,)
        )
        (made,) = known.answers(make)
    else:
        (made,) = make([0])
    if not made:
        return None
    areas, first, alone = made
    new = stock.add(as_array(areas))
    return together([new, copies.taken(np.array(alone, np.intp))]), np.array([*first, *alone], np.intp)


def _united(stock: Stock, copies: Copies, pairs: Indices) -> tuple[Copies, Index, int]:
    """Unite every connected group; return also the first member of each, and how many had no neighbour."""
    if not len(pairs):
        return copies, np.arange(len(copies)), len(copies)
    label = components(len(copies), pairs)
    sizes = np.bincount(label, minlength=len(copies))[label]
    alone, many = np.flatnonzero(sizes == 1), np.flatnonzero(sizes > 1)
    # Members of groups that are copies of one another come in one order.
    order = many[np.lexsort([*copies.shift[many].T[::-1], copies.kind[many], label[many]])]
    starts = np.flatnonzero(np.r_[True, label[order][1:] != label[order][:-1]])
    ends = np.append(starts, len(order))
    corner = np.minimum.reduceat(copies.shift[order], starts, axis=0)
    rows = np.column_stack(
        [copies.kind[order], copies.shift[order] - np.repeat(corner, np.diff(ends), axis=0)]
    )
    heads, number = alike(rows, ends)
    whole = unions(stock, rows, ends, heads)
    down = stock.set_down(whole, number, corner)
    first = np.minimum.reduceat(order, starts)[down.each]
    # Areas that only touch fall apart again, each under its own name.
    several = np.flatnonzero(np.bincount(down.each, minlength=len(starts))[down.each] > 1)
    if len(several):
        first[several] = _held(stock, copies, order, ends, down.copies, down.each, several)
    return together([copies.taken(alone), down.copies]), np.concatenate([alone, first]), len(alone)


def _held(
    stock: Stock,
    copies: Copies,
    order: Index,
    ends: Offsets,
    pieces: Copies,
    each: Index,
    several: Index,
) -> Index:
    """Return for some pieces a member of their group that each holds."""
    at = shapely.point_on_surface(stock.geometries(pieces.taken(several)))
    owner = each[several]
    groups = np.unique(owner, return_index=True)[0]
    members, starts = runs(ends, groups)
    of = np.repeat(groups, np.diff(starts))
    tree = shapely.STRtree(stock.geometries(copies.taken(order[members])))
    point, member = tree.query(at, predicate="intersects")
    mine = of[member] == owner[point]
    point, member = point[mine], member[mine]
    found = order[ends[owner]]
    by = np.lexsort([member, point])
    who, first = np.unique(point[by], return_index=True)
    found[who] = order[members[member[by][first]]]
    return np.asarray(found)


def unions(stock: Stock, rows: Steps, offsets: Offsets, which: Index) -> Geometries:
    """Return the unions of some runs of rows (kind, x, y).

    Raises:
        TooLargeError: where they are too large, before they are in memory, or cross too often.
    """
    members, ends = runs(offsets, which)
    joining = rows[members[np.repeat(np.diff(ends) > 1, np.diff(ends))], 0]
    work.foretell(float(shapely.get_num_coordinates(stock.shapes)[joining].sum()), 0.0)
    several = np.flatnonzero(np.diff(ends) > 1)
    known = _asked(stock, rows[members], ends, several) if stock.remembers and len(several) else None
    if known is not None:
        given = int(shapely.get_num_coordinates(stock.shapes[joining]).sum())
        before = overlay.united_before(known, given)
        if before is not None:
            first = rows[members[ends[:-1]]]
            result = stock.geometries(Copies(first[:, 0], first[:, 1:]))
            result[several] = before
            return result
    areas = stock.geometries(Copies(rows[members, 0], rows[members, 1:]))
    result = areas[ends[:-1]]
    if len(several):
        groups = [areas[ends[row] : ends[row + 1]] for row in several]
        result[several] = overlay.united(groups, known)
    return result


def _asked(stock: Stock, rows: Steps, ends: Offsets, several: Index) -> Asked[overlay.Made]:
    """Return what is known of the unions of some runs of rows."""
    members, within = runs(ends, several)
    shapes = stock.shapes[rows[members, 0]]
    table = np.column_stack([identities(shapes), rows[members, 1:]])
    return Asked("united", table, (shapes,), within)


def meeting(areas: Geometries) -> Indices:
    """Return the pairs of areas that have a point in common, shape (n, 2)."""
    if len(areas) < 2:
        return np.empty((0, 2), np.intp)
    a, b = shapely.STRtree(areas).query(areas)
    a, b = a[a < b], b[a < b]
    # Each pair is asked once, and of its larger area, which is made ready for many questions.
    vertices = shapely.get_num_coordinates(areas)
    large = np.where(vertices[a] < vertices[b], b, a)
    shapely.prepare(areas[np.unique(large)])
    met = shapely.intersects(areas[large], areas[np.where(large == a, b, a)])
    return np.asarray(np.column_stack([a, b])[met])
