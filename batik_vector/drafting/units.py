"""Units of repeat: which tiles, groups and origins a recipe may name to repeat what a drawing repeats."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Cell
from batik_vector.certificate.symmetry.operations import FoundGroup
from batik_vector.errors import BatikError
from batik_vector.geometry.maps.affine import Affine
from batik_vector.tiling.symmetry.groups import GROUPS, TRANSPOSED
from batik_vector.tiling.symmetry.orbits import Orbit, Shift
from batik_vector.tiling.symmetry.repeats import MAX_DENOMINATOR, TileSpec
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Floats = NDArray[np.float64]

ON_GRID = 1e-3
"""Parts of a grid step by which a side may be off a whole number of them."""
ALIKE = 1e-4
"""How far the linear part of an operation may be from that of another and still be the same."""
SLACK_MM = 0.02
"""How far the places of operations may be apart (mm), at the least: what is found is measured."""
NOISE_MM = 0.002
"""How far an origin may be measured off its place."""
PARTS = 24
"""Parts of a tile's sides in which origins mostly lie."""
REACH = range(-2, 3)
"""Lattice vectors that are tried for the place of an origin."""


@frozen(eq=False)
class Unit:
    """A repeat as a recipe names it: ``tile``, and of its placements ``symmetry`` and ``phase``."""

    tile: TileSpec
    symmetry: str = ""
    phase: Shift = (0.0, 0.0)

    @property
    def orbit(self) -> Orbit:
        """The operations that a placement is multiplied by, and the translations."""
        return self.tile.orbit(self.symmetry, self.phase)

    @property
    def periods(self) -> Floats:
        """The translations, as columns, in mm."""
        return np.array(self.tile.repeating().lattice, float).T / STEPS_PER_MM

    @property
    def copies(self) -> float:
        """How many copies of an asymmetric mark there are in a square millimetre."""
        return len(self.orbit.operations) / abs(float(np.linalg.det(self.periods)))

    @property
    def name(self) -> str:
        """Its repeat in words."""
        return f"{self.symmetry} on {self.tile.repeat}" if self.symmetry else self.tile.repeat


def units(found: FoundGroup, cell: Cell, repeat: str) -> list[Unit]:
    """Return the units that repeat what was found, those that need the fewest marks first.

    The last of them is the page itself, repeated as it was read.

    Args:
        found: the symmetry group of the page.
        cell: the page.
        repeat: how pages stand to one another.
    """
    page = Unit(TileSpec(size=(cell.width, cell.height), repeat=repeat))
    lattice = np.array(found.translations, float).T
    slack = max(SLACK_MM, found.deviation)
    known = [(np.eye(2), np.zeros(2))]
    known += [(np.array(each.linear, float), np.array(each.shift, float)) for each in found.operations]
    candidates: list[Unit] = []
    if found.continuous is None:
        for tile in _tiles(lattice, cell):
            candidates += _placed(tile, known, lattice, slack)

    def worth(unit: Unit) -> tuple[float, bool, bool]:
        """Few marks first; of these the group by its own name, and then what needs no symmetry beside it."""
        names = (unit.symmetry, unit.tile.repeat)
        return -round(unit.copies, 9), found.name not in names, bool(unit.symmetry)

    return [*sorted(candidates, key=worth), page]


def _tiles(lattice: Floats, cell: Cell) -> Iterator[TileSpec]:
    """Yield the tiles on whose lattices a pattern repeats: with a drop, or by the name of a group."""
    whole = cell.rectangle
    across = _divided(whole.columns, lattice, 0)
    up = _divided(whole.rows, lattice, 1)
    size = across / STEPS_PER_MM, up / STEPS_PER_MM
    area = size[0] * size[1] / abs(float(np.linalg.det(lattice)))
    rows = round(area)
    for words, unit in _drops(lattice, (across, up), rows):
        yield TileSpec(size=unit, repeat=words)
    for name in (*GROUPS, *TRANSPOSED):
        if name != "p1":
            try:
                yield TileSpec(size=size, repeat=name)
            except BatikError:
                continue


def _divided(side: int, lattice: Floats, axis: int) -> int:
    """Return the shortest part of a side (steps), a whole number of steps, by which a lattice repeats."""
    along = np.zeros(2)
    along[axis] = side / STEPS_PER_MM
    inside = np.rint(np.linalg.solve(lattice, along)).astype(int)
    parts = math.gcd(*inside.tolist())
    for times in range(1, parts + 1):
        if parts % times == 0 and side * times % parts == 0:
            return side * times // parts
    return side


def _drops(lattice: Floats, sides: tuple[int, int], count: int) -> Iterator[tuple[str, tuple[float, float]]]:
    """Yield the drop that a lattice is, and the size of its unit: a rectangle (steps) has several."""
    across, up = sides
    if count == 1:
        yield "grid", (across / STEPS_PER_MM, up / STEPS_PER_MM)
    if not 1 < count <= MAX_DENOMINATOR:
        return
    for axis, (side, other) in enumerate(((across, up), (up, across))):
        if side % count:
            continue
        # The translation that leads to the next column: how far does it drop?
        for part in range(1, count):
            step = np.empty(2)
            step[axis], step[1 - axis] = side / count / STEPS_PER_MM, other * part / count / STEPS_PER_MM
            place = np.linalg.solve(lattice, step)
            if np.hypot(*(lattice @ (place - np.rint(place)))) > SLACK_MM / 4 or other * part % count:
                continue
            drop = Fraction(part, count)
            half = drop == Fraction(1, 2)
            words = ("half-drop", "brick")[axis] if half else f"{('drop', 'brick')[axis]} {drop}"
            size = (side // count / STEPS_PER_MM, other / STEPS_PER_MM)
            yield words, size if axis == 0 else size[::-1]
            break


def _placed(
    tile: TileSpec, known: list[tuple[Floats, Floats]], lattice: Floats, slack: float
) -> Iterator[Unit]:
    """Yield a tile with an origin for its group at which all of its operations are known ones."""
    plain = Unit(tile)
    grouped = len(plain.orbit.operations) > 1
    names = [""] if grouped else ["", *(name for name in (*GROUPS, *TRANSPOSED) if name != "p1")]
    for name in names:
        try:
            unit = replace(plain, symmetry=name)
            operations = unit.orbit.operations
        except BatikError:
            continue
        origin = _origin(operations, known, lattice, slack, np.array(tile.size) / PARTS)
        if origin is not None:
            yield replace(unit, phase=origin)


def _origin(
    operations: tuple[Affine, ...],
    known: list[tuple[Floats, Floats]],
    lattice: Floats,
    slack: float,
    parts: Floats,
) -> Shift | None:
    """Return the least shift of a group after which its operations are known; None where there is none.

    What is all but a whole number of ``parts`` (mm, across and up) was meant to be one.
    """
    linear = [np.array([[each.a, each.b], [each.c, each.d]]) for each in operations]
    shift = [np.array([each.e, each.f]) for each in operations]
    match = [
        next((i for i, (other, _) in enumerate(known) if np.abs(other - each).max() <= ALIKE), None)
        for each in linear
    ]
    if any(each is None for each in match):
        return None
    wanted = [known[each][1] for each in match if each is not None]
    turns = [np.linalg.matrix_rank(np.eye(2) - each, tol=1e-6) for each in linear]
    # A centre of rotation fixes the origin, a mirror one coordinate of it, a translation nothing.
    first = int(np.argmax(turns))
    best: tuple[float, Shift] | None = None
    for i in REACH:
        for j in REACH:
            off = wanted[first] - shift[first] + lattice @ (i, j)
            place = np.linalg.lstsq(np.eye(2) - linear[first], off, rcond=1e-9)[0]
            near = np.rint(place / parts) * parts
            place = np.where(np.abs(near - place) <= NOISE_MM, near, place)
            gaps = [t + (np.eye(2) - m) @ place - s for m, t, s in zip(linear, shift, wanted, strict=True)]
            shares = np.linalg.solve(lattice, np.array(gaps).T)
            apart = np.hypot(*(lattice @ (shares - np.rint(shares)))).max()
            size = float(np.hypot(*place))
            if apart <= slack and (best is None or size < best[0] - 1e-6):
                best = size, _tidy(place)
    return None if best is None else best[1]


def _tidy(place: Floats) -> Shift:
    """Return a place in whole grid steps."""
    x, y = (np.rint(place * STEPS_PER_MM) / STEPS_PER_MM + 0.0).tolist()
    return x, y
