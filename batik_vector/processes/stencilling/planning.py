"""Planning: from the openings of one stencil to its bridges, and to what is to be told of them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import field

import numpy as np

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Array, Geometries
from batik_vector.processes.stencilling.bridges import Bridge, Orbit, bodies_of, distances, orbits_of
from batik_vector.processes.stencilling.choosing import fewest
from batik_vector.processes.stencilling.clusters import Clusters
from batik_vector.processes.stencilling.contours import Contours, Field, contours_of, field_of, places_on
from batik_vector.processes.stencilling.gaps import (
    PLAIN,
    Gaps,
    gaps_between,
    pieces_at,
    settled,
    shortened,
    together,
)
from batik_vector.processes.stencilling.sheets import Sheet, hanging, sheet_of
from batik_vector.processes.stencilling.spans import spanned
from batik_vector.processes.stencilling.symmetry import NO_OTHER, Symmetry, symmetry_of
from batik_vector.values import frozen

FINE = 0.5
"""Breadths of a bridge between places along contours that are compared."""
STRAIGHT = 0.02
"""Breadths by which contours may be straightened before."""
FIRST = 12.0
"""Breadths of a bridge that gaps are long at most, at first; only where that is not enough longer ones are
looked for."""
APART = 1.0
"""Breadths that two bridges keep apart, where they can."""


@frozen(eq=False)
class Ground:
    """A stencil before it has bridges: its sheet, and how the openings and the contours lie."""

    sheet: Sheet
    opened: Sheet
    contours: Contours
    symmetry: Symmetry = NO_OTHER

    @property
    def whole(self) -> bool:
        """Whether the sheet is one piece already."""
        return self.sheet.clusters.whole


@frozen(eq=False)
class Plan:
    """The bridges of a stencil, and the clusters that the parts of its sheet then make."""

    ground: Ground
    orbits: tuple[Orbit, ...] = ()
    more: tuple[Orbit, ...] = ()
    """Bridges beyond those that are needed."""
    made: Clusters = field(default_factory=lambda: Clusters(0))
    offers: tuple[Orbit, ...] = ()
    """Those among which they were chosen."""

    @property
    def bridges(self) -> list[Bridge]:
        """All bridges of a repeat."""
        return [bridge for orbit in (*self.orbits, *self.more) for bridge in orbit.bridges]


def ground_of(openings: Geometries, cell: Cell, tolerance: float, symmetric: bool) -> Ground:
    """Return a stencil before it has bridges.

    Args:
        openings: within the tile, in steps.
        cell: the tile.
        tolerance: how far drawn edges may stand from the true curves, in steps.
        symmetric: whether to look for the symmetry of the openings.
    """
    sheet, opened = sheet_of(openings, cell), hanging(openings, cell)
    contours = contours_of(sheet)
    ground = Ground(sheet, opened, contours)
    if not symmetric or ground.whole or not len(contours.runs):
        return ground
    near = field_of(contours, 2 * tolerance + 100)
    return Ground(sheet, opened, contours, symmetry_of(sheet, opened, contours, near, tolerance))


def offered(ground: Ground, breadth: int, most: int) -> Iterator[list[Orbit]]:
    """Yield the bridges that might stand, first the shorter ones alone, then all.

    Args:
        ground: the stencil.
        breadth: of a bridge, in steps.
        most: how many are tried between two pieces.
    """
    cell = ground.sheet.torus.cell
    whole = float(max(cell.columns, cell.rows))
    for longest in sorted({min(FIRST * breadth, whole), whole}):
        # The middle of a gap lies in the tile, and its ends at most half of it away.
        reach = longest / 2
        gaps, near, chains = gaps_of(ground, breadth, reach, most)
        orbits = orbits_of(spanned(gaps, near, chains, breadth), ground.sheet, ground.symmetry, breadth)
        yield [each for each in orbits if _clear(each, ground, breadth)]


def gaps_of(ground: Ground, breadth: float, reach: float, most: int) -> tuple[Gaps, Field, Index]:
    """Return the gaps up to some length, settled on the symmetry, with the contours to measure them by."""
    sheet, symmetry = ground.sheet, ground.symmetry
    spacing = FINE * breadth
    places = places_on(ground.contours, spacing, STRAIGHT * breadth, reach)
    names: dict[tuple[int, int, int], int] = {}
    piece = pieces_at(sheet.clusters, places.part, places.gain, names)
    gaps = gaps_between(places, piece, sheet.torus, symmetry, 2 * breadth, most)
    near = field_of(ground.contours, 3 * reach + 6 * breadth)
    chains = pieces_at(sheet.clusters, near.part, near.gain, names)
    # As they are, too: where a gap on a mirror is shortest near by may be off the mirror.
    tries = [gaps, shortened(gaps, near, chains, 2 * spacing)]
    settled_ = [settled(each, sheet.torus, symmetry, 2 * breadth) for each in tries]
    return together(settled_), near, chains


def _clear(orbit: Orbit, ground: Ground, breadth: int) -> bool:
    """Return whether the bridges of an orbit keep clear of one another."""
    bridges = list(orbit.bridges)
    if len(bridges) == 1:
        return True
    rest = distances(bridges[:1], bridges[1:], ground.sheet.torus, breadth)
    return bool(rest[0] >= APART * breadth)


def planned(ground: Ground, breadth: int, most: int = PLAIN, *, thorough: bool = True) -> Plan:
    """Return the fewest bridges that make a sheet one piece, or those that come nearest to it.

    Args:
        ground: the stencil.
        breadth: of a bridge, in steps.
        most: how many bridges are tried between two pieces.
        thorough: whether to look for the fewest, and not only for some.
    """
    start = ground.sheet.clusters
    plan = Plan(ground, made=start)
    if start.whole:
        return plan
    known = list[list[Orbit]]()
    for fine, apart in ((True, APART * breadth), (True, 1.0), (False, 1.0)):
        for orbits in _again(known, offered(ground, breadth, most)):
            tried = [each for each in orbits if each.fine or not fine]
            chosen, made = fewest(start, tried, Clash(tried, ground, breadth, apart), thorough=thorough)
            plan = Plan(ground, tuple(tried[each] for each in chosen), made=made, offers=tuple(tried))
            if made.whole:
                return plan
    return plan


def _again(known: list[list[Orbit]], more: Iterator[list[Orbit]]) -> Iterator[list[Orbit]]:
    """Yield what is known, and then what comes, which is known from then on."""
    if known:
        yield from list(known)
        return
    for each in more:
        known.append(each)
        yield each


class Clash:
    """Whether an orbit comes too near to others: bodies are looked at once."""

    def __init__(self, orbits: list[Orbit], ground: Ground, breadth: int, apart: float) -> None:
        self.torus, self.apart = ground.sheet.torus, apart
        self.centres = [np.array([bridge.centre for bridge in orbit.bridges]) for orbit in orbits]
        self.reach = [max(bridge.length for bridge in orbit.bridges) / 2 + breadth for orbit in orbits]
        self.orbits, self.breadth = orbits, breadth
        self.known: dict[tuple[int, int], bool] = {}

    def __call__(self, number: int, chosen: Collection[int]) -> bool:
        """Return whether an orbit comes too near to any that is chosen."""
        return any(self._near(*sorted((number, other))) for other in chosen)

    def _near(self, one: int, other: int) -> bool:
        if (one, other) not in self.known:
            self.known[one, other] = self._close(one, other)
        return self.known[one, other]

    def _close(self, one: int, other: int) -> bool:
        # The first stands for all: both orbits have the same symmetry.
        ways, _ = self.torus.nearest(self.centres[other] - self.centres[one][0])
        far = self.reach[one] + self.reach[other] + self.apart
        near = np.flatnonzero((ways**2).sum(axis=1) < far**2)
        if not len(near):
            return False
        some = [self.orbits[other].bridges[each] for each in near.tolist()]
        apart = distances([self.orbits[one].bridges[0]], some, self.torus, self.breadth)
        return bool(apart[0] < self.apart)


def bodies(plan: Plan, breadth: int) -> Geometries:
    """Return the bodies of a plan's bridges, in steps."""
    return bodies_of(plan.bridges, breadth)


def lengths(plan: Plan) -> Array:
    """Return how long a plan's bridges are, in steps."""
    return np.array([each.length for each in plan.bridges])
