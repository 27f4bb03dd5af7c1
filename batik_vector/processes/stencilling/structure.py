"""Structure: where a finished sheet is narrowest, and what hangs on its weakest neck."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Array, Geometries
from batik_vector.processes.stencilling.contours import Field, Places, contours_of, field_of, places_on
from batik_vector.processes.stencilling.gaps import facing, near_contours, pieces_at, triangulated
from batik_vector.processes.stencilling.planning import STRAIGHT, Plan
from batik_vector.processes.stencilling.sheets import Sheet, sheet_of
from batik_vector.values import frozen

ROUND = 4.0
"""Breadths of a place that the way round it, along the contour, is long at least: else it is a point."""
STEEP = 0.5
"""Sine of the angle at which the way across stands on the contour, at least."""
MEASURED = 400
"""Places that are measured, those that look narrowest."""
NEAR = 0.4
"""Breadths of a place about its ends within which their contours are measured."""
SPACING = 0.25
"""Breadths of a bridge between places on the contour."""


@frozen
class Member:
    """A place where the sheet is narrow: its middle (steps), and how broad it is there (steps)."""

    x: float
    y: float
    breadth: float


@frozen
class Neck:
    """What hangs on one or several bridges alone: where one is (steps), how many, the area (square steps)."""

    x: float
    y: float
    bridges: int
    area: float


def finished(openings: Geometries, cell: Cell) -> Sheet:
    """Return the sheet of a stencil with its bridges."""
    return sheet_of(openings, cell)


def narrowest_member(sheet: Sheet, breadth: float) -> Member | None:
    """Return where a sheet is narrowest between two openings or two sides of one; None without openings.

    Args:
        sheet: with its bridges.
        breadth: of a bridge, in steps: what is much broader than that is not looked for.
    """
    contours = contours_of(sheet)
    if not len(contours.runs):
        return None
    cell = sheet.torus.cell
    reach = float(min(max(cell.columns, cell.rows), 8 * breadth))
    places = places_on(contours, SPACING * breadth, STRAIGHT * breadth, reach)
    edges = triangulated(places)
    piece = pieces_at(sheet.clusters, places.part, places.gain, {})
    edges = edges[piece[edges[:, 0]] == piece[edges[:, 1]]]
    edges = edges[facing(places, edges, 1)]
    edges = edges[_across(places, edges)]
    if not len(edges):
        return None
    middle = places.points[edges].mean(axis=1)
    edges = edges[(sheet.torus.home(middle)[1] == 0).all(axis=1)]
    if not len(edges):
        return None
    ways = places.points[edges[:, 1]] - places.points[edges[:, 0]]
    # Places lie beside one another on both sides: the way straight across says which are worth measuring.
    straight = np.abs(_cross(places.heading[edges[:, 0]], ways))
    order = np.argsort(np.round(straight, 3), kind="stable")[:MEASURED]
    edges, straight = edges[order], straight[order]
    lines = _shortest(places, edges, field_of(contours, reach + SPACING * breadth))
    length = shapely.length(lines)
    # Where the two ends all but meet there is nothing to measure between them.
    close = np.sqrt((ways[order] ** 2).sum(axis=1)) * NEAR < 2 * STRAIGHT * breadth
    rough = close | ~np.isfinite(length)
    length = np.where(rough, straight, length)
    least = int(np.argmin(np.round(length, 3)))
    ends = places.points[edges[least]] if rough[least] else shapely.get_coordinates(lines[least])
    x, y = ends.mean(axis=0).tolist()
    return Member(x, y, float(length[least]))


def _shortest(places: Places, edges: Index, field: Field) -> Geometries:
    """Return the shortest lines across the sheet near some edges."""
    ways = places.points[edges[:, 1]] - places.points[edges[:, 0]]
    # Near enough that the contours about the two ends stay apart.
    reach = np.sqrt((ways**2).sum(axis=1)) * NEAR
    sides = [
        near_contours(
            places.points[ends], np.zeros(len(edges), np.intp), field, np.zeros(len(field.part)), reach
        )
        for ends in edges.T
    ]
    return np.asarray(shapely.shortest_line(*sides), dtype=object)


def _across(places: Places, edges: Index) -> Array:
    """Return which edges cross the sheet where it is narrow, and do not run beside a corner."""
    p, q = edges.T
    ways = places.points[q] - places.points[p]
    length = np.sqrt((ways**2).sum(axis=1))
    steep = (np.abs(_cross(places.heading[p], ways)) >= STEEP * length) & (
        np.abs(_cross(places.heading[q], ways)) >= STEEP * length
    )
    round_ = np.full(len(edges), np.inf)
    same = (places.run[p] == places.run[q]) & (places.gain[p] == places.gain[q]).all(axis=1)
    way = np.abs(places.along[p] - places.along[q])
    whole = places.around[p]
    round_[same] = np.where(whole > 0, np.minimum(way, whole - way), way)[same]
    # Contours that an edge of the tile has cut go on in one another.
    meet = (np.abs(places.end[p] - places.end[q]) <= 2).all(axis=1)
    beyond = np.where(meet, places.to_end[p] + places.to_end[q], np.inf)
    return np.asarray(steep & (np.minimum(round_, beyond) >= ROUND * length))


def _cross(one: Array, other: Array) -> Array:
    return np.asarray(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])


def weakest_neck(plan: Plan) -> Neck | None:
    """Return the bridges on which most of the sheet hangs for their number; None where there are none.

    The pieces of the sheet are a graph whose edges are bridges. For each piece but the largest: what can be
    reached from that only through this piece hangs on the bridges that lead out of it all (R. Tarjan,
    Depth-first search and linear graph algorithms, SIAM Journal on Computing 1 (1972)).
    """
    sheet, bridges = plan.ground.sheet, plan.bridges
    if not bridges:
        return None
    first = [sheet.clusters.lies(part)[0] for part in range(len(sheet.parts))]
    area: dict[int, float] = {}
    for name, own in zip(first, shapely.area(sheet.parts).tolist(), strict=True):
        area[name] = area.get(name, 0.0) + own
    leads: dict[int, list[tuple[int, int]]] = {name: [] for name in area}
    for number, bridge in enumerate(bridges):
        one, other = first[bridge.one], first[bridge.other]
        if one != other:
            leads[one].append((other, number))
            leads[other].append((one, number))
    root = max(area, key=lambda name: (sheet.clusters.span(name).rank > 0, area[name], -name))
    best: Neck | None = None
    for inside, weight in _hanging(root, leads, area):
        on = sorted({number for each in inside for other, number in leads[each] if other not in inside})
        if on and (best is None or weight / len(on) > best.area / best.bridges + 1e-6):
            x, y = bridges[on[0]].centre
            best = Neck(x, y, len(on), weight)
    return best


def _hanging(
    root: int, leads: dict[int, list[tuple[int, int]]], area: dict[int, float]
) -> list[tuple[set[int], float]]:
    """Return for each piece but the root what hangs on the root through it alone, itself included."""
    order, above, low, seen = list[int](), {root: root}, dict[int, int](), dict[int, int]()
    stack = [(root, iter(leads[root]))]
    seen[root] = low[root] = 0
    order.append(root)
    while stack:
        node, rest = stack[-1]
        step = next(rest, None)
        if step is None:
            stack.pop()
            if stack:
                low[above[node]] = min(low[above[node]], low[node])
            continue
        other, _ = step
        if other not in seen:
            seen[other] = low[other] = len(order)
            above[other] = node
            order.append(other)
            stack.append((other, iter(leads[other])))
        elif other != above[node]:
            low[node] = min(low[node], seen[other])
    below: dict[int, set[int]] = {}
    held: dict[int, set[int]] = {}
    for node in reversed(order):
        below.setdefault(node, set()).add(node)
        held.setdefault(node, set()).add(node)
        if node != root:
            below.setdefault(above[node], set()).update(below[node])
            if low[node] >= seen[above[node]]:
                held.setdefault(above[node], set()).update(below[node])
    return [(held[node], sum(area[each] for each in held[node])) for node in order if node != root]
