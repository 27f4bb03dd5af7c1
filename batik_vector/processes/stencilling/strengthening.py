"""Strengthening: large islands get more bridges than one, away from those that they have."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Points
from batik_vector.processes.stencilling.bridges import Bridge, Orbit
from batik_vector.processes.stencilling.islands import Islands
from batik_vector.processes.stencilling.planning import APART, Clash, Plan
from batik_vector.processes.stencilling.sheets import Torus
from batik_vector.units import STEPS_PER_MM, format_mm

PLENTY = 80
"""How many bridges are tried between two pieces where there may have to be several."""
AWAY = 1 / 3
"""Part of an island's breadth that its bridges are apart, where they can."""


def strengthened(plan: Plan, islands: Islands, breadth: int, large: float, count: int) -> Plan:
    """Return a plan by which at least so many bridges hold each large island from outside.

    Args:
        plan: by which the sheet is one piece.
        islands: of its sheet.
        breadth: of a bridge, in steps.
        large: from which breadth on islands are large, in steps.
        count: of bridges to a large island.

    Raises:
        GeometryError: where there is no room for so many.
    """
    sheet = plan.ground.sheet
    first = np.array([sheet.clusters.lies(part)[0] for part in range(len(sheet.parts))], np.intp)
    offers = list(plan.offers)
    clash = Clash(offers, plan.ground, breadth, APART * breadth)
    chosen = [number for number, orbit in enumerate(offers) if orbit in plan.orbits]
    more = list[int]()
    for number in np.flatnonzero(islands.across >= large).tolist():
        name, shape = int(islands.first[number]), islands.shapes[number]
        while True:
            taken = [offers[each] for each in (*chosen, *more)]
            held = _places(taken, name, shape, first, sheet.torus)
            if len(held) >= count:
                break
            best = _next(
                offers, (*chosen, *more), clash, held, AWAY * islands.across[number], name, shape, plan, first
            )
            if best is None:
                raise _no_room(len(held), count, shape)
            more.append(best)
    return replace(plan, more=tuple(offers[each] for each in more))


def _next(
    offers: list[Orbit],
    chosen: Collection[int],
    clash: Clash,
    held: Points,
    away: float,
    name: int,
    shape: shapely.Geometry,
    plan: Plan,
    first: Index,
) -> int | None:
    """Return the best bridges more for an island: away from those it has, then few, then cheap."""
    torus, best, found = plan.ground.sheet.torus, None, None
    for number, orbit in enumerate(offers):
        if number in chosen:
            continue
        places = _places([orbit], name, shape, first, torus)
        if not len(places) or clash(number, chosen):
            continue
        apart = min((_apart(places[:1], held, torus)), default=np.inf)
        rank = (max(0.0, round(1 - apart / away, 3)), len(orbit.bridges), orbit.cost, number)
        if best is None or rank < best:
            best, found = rank, number
    return found


def _apart(places: Points, others: Points, torus: Torus) -> list[float]:
    return [
        float(np.sqrt((torus.nearest(others - place)[0] ** 2).sum(axis=1)).min())
        for place in places
        if len(others)
    ]


def _places(orbits: list[Orbit], name: int, shape: shapely.Geometry, first: Index, torus: Torus) -> Points:
    """Return the middles of the bridges that hold an island from outside, shape (n, 2)."""
    mine = [
        bridge
        for orbit in orbits
        for bridge in orbit.bridges
        if name in (first[bridge.one], first[bridge.other]) and not _inside(bridge, shape, torus)
    ]
    return np.array([bridge.centre for bridge in mine], float).reshape(-1, 2)


def _inside(bridge: Bridge, shape: shapely.Geometry, torus: Torus) -> bool:
    """Return whether a bridge stands in a hole of an island."""
    parts = shapely.get_parts(shape)
    if not shapely.get_num_interior_rings(parts).any():
        return False
    filled = shapely.union_all(shapely.polygons(shapely.get_exterior_ring(parts)))
    at = np.array(bridge.centre)
    which, gains = torus.around(shapely.bounds(np.array([filled])), at, at)
    back = at - torus.at(gains)
    return bool(shapely.contains_xy(filled, back[:, 0], back[:, 1]).any()) if len(which) else False


def _no_room(held: int, count: int, shape: shapely.Geometry) -> GeometryError:
    x, y = (shapely.get_coordinates(shapely.point_on_surface(shape))[0] / STEPS_PER_MM).tolist()
    return GeometryError(
        f"large_bridges = {count}, expected at most {held}: an island at ({format_mm(x)}, {format_mm(y)}) mm "
        "has room for no more; take narrower bridges, or a larger large"
    )
