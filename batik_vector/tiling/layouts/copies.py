"""Layouts that say where copies lie: one, in a ring, in a mirror, in a rosette, in rows, or set by hand."""

from __future__ import annotations

import re
from typing import Annotated, ClassVar, TypeAlias

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, Text, check
from batik_vector.geometry.maps.affine import IDENTITY, Affine, unit_power
from batik_vector.geometry.maps.affines import Affines, turns
from batik_vector.tiling.layouts.base import Bend, Layout, Pair
from batik_vector.values import frozen


@frozen(kw_only=True)
class Single(Layout):
    """The motif once."""

    turn: Annotated[float, Between(-360, 360), Says("degrees the motif is turned")] = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """One image."""
        return Affines.of([Affine.turn(self.turn)])


@frozen(kw_only=True)
class Ring(Layout):
    """Copies on a circle, each turned with it or all upright; several motifs take their places in turn."""

    deals: ClassVar[bool] = True
    count: Annotated[int, Between(1, 1000), Says("number of copies")] = 6
    radius: Annotated[float, Between(0, 1e4), Says("distance of the copies from the centre")] = 2.0
    upright: Annotated[bool, Says("keep every copy upright instead of turning it with the ring")] = False
    turn: Annotated[float, Between(-360, 360), Says("degrees to which the first copy is turned")] = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """One image per copy."""
        out = Affine.translation((self.radius, 0))
        angles = [self.turn + 360 * k / self.count for k in range(self.count)]
        turned = turns(angles) @ out
        return turned @ turns([-a for a in angles]) if self.upright else turned


@frozen(kw_only=True)
class Mirror(Layout):
    """The motif and its mirror image."""

    axis: Annotated[float, Between(-360, 360), Says("direction of the mirror in degrees; 90 is upright")] = (
        90.0
    )
    shift: Annotated[Pair, Says("move of the motif away from the mirror")] = (1.0, 0.0)
    turn: Annotated[float, Between(-360, 360), Says("degrees the motif is turned first")] = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """Two images."""
        first = Affine.translation(self.shift) @ Affine.turn(self.turn)
        return Affines.of([first, Affine.mirror(self.axis) @ first])


_GROUP = r"^([CcDd])(\d{1,3})$"
GROUP_PATTERN = r"^\s*[CcDd]\d{1,3}\s*$"
MAX_ORDER = 500


def parse_rosette(text: str) -> str:
    """Return the name of a rosette group in its one spelling: ``"d6"`` → ``"D6"``.

    Raises:
        ValueError: with what was expected.
    """
    match = re.match(_GROUP, text.strip())
    if match is None or not 1 <= int(match[2]) <= MAX_ORDER:
        raise ValueError(f'expected "Cn" (turns) or "Dn" (turns and mirrors) with n from 1 to {MAX_ORDER}')
    return f"{match[1].upper()}{int(match[2])}"


@frozen(kw_only=True)
class RosetteLayout(Layout):
    """Copies under a rosette group: Cn turns the motif n times round the centre, Dn mirrors each as well.

    Copies that coincide, as those of a motif that stands on a mirror and is its own image, are drawn once.
    Leonardo's theorem: these are all finite groups of the plane (Weyl, Symmetry, 1952).
    """

    group: Annotated[
        str, Text(parse_rosette, '"Cn" or "Dn"', GROUP_PATTERN), Says('"C5", "D6": the group')
    ] = "D6"
    shift: Annotated[Pair, Says("move of the motif away from the centre")] = (1.0, 0.0)
    turn: Annotated[float, Between(-360, 360), Says("degrees the motif is turned first")] = 0.0
    axis: Annotated[float, Between(-360, 360), Says("direction of the first mirror in degrees")] = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """n images, or 2n with the mirrored ones after each turned one."""
        count = int(self.group[1:])
        first = Affine.translation(self.shift) @ Affine.turn(self.turn)
        turned = Affines.similarities(np.array([unit_power(k, count) for k in range(count)]))
        if self.group[0] == "D":
            turned = turned.after(Affines.of([IDENTITY, Affine.mirror(self.axis)]))
        return turned @ first


@frozen(kw_only=True)
class Spot:
    """One hand-made copy: mirrored, scaled, turned and moved in this order; or a matrix."""

    shift: Annotated[Pair, Says("move in motif units")] = (0.0, 0.0)
    turn: Annotated[float, Between(-360, 360), Says("degrees")] = 0.0
    scale: Annotated[float, Between(1e-3, 1e3), Says("size")] = 1.0
    mirror: Annotated[bool, Says("mirrored at the x axis first")] = False
    matrix: Annotated[
        tuple[float, float, float, float, float, float] | None,
        Says("x' = ax + by + e, y' = cx + dy + f as [a, b, c, d, e, f], instead of all the above"),
    ] = None

    def __post_init__(self) -> None:
        check(self)

    def affine(self) -> Affine:
        """Return the map.

        Raises:
            GeometryError: where the matrix flattens the plane.
        """
        if self.matrix is not None:
            a, b, c, d, e, f = self.matrix
            if abs(a * d - b * c) < 1e-9:
                raise GeometryError(f"the matrix {list(self.matrix)} flattens the motif to a line")
            return Affine(a, b, c, d, e, f)
        image = Affine.turn(self.turn) @ Affine.scale(self.scale)
        return Affine.translation(self.shift) @ image @ (Affine.mirror(0) if self.mirror else Affine())


@frozen(kw_only=True)
class Free(Layout):
    """Copies set by hand. Tian et al. 2019, Eq. 2."""

    spots: Annotated[tuple[Spot, ...], Says("one table for each copy")] = (Spot(),)

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """One image per spot."""
        if not self.spots:
            raise GeometryError("a free layout needs at least one spot")
        return Affines.of([spot.affine() for spot in self.spots])


_Number: TypeAlias = Annotated[float, Between(-1e4, 1e4)]
Spots: TypeAlias = tuple[tuple[_Number, ...], ...]
"""Places (x, y) or (x, y, turn in degrees), in motif units."""


@frozen(kw_only=True)
class Places(Layout):
    """Copies at a list of places, each [x, y] or [x, y, turn]: one motif as often as a drawing shows it."""

    at: Annotated[Spots, Says("[x, y] or [x, y, turn] of each copy, in motif units and degrees")] = ()
    mirrored: Annotated[Spots, Says("of each copy that is mirrored at the x axis first")] = ()

    def __post_init__(self) -> None:
        check(self)
        for key, spots in (("at", self.at), ("mirrored", self.mirrored)):
            for number, spot in enumerate(spots):
                if len(spot) not in (2, 3):
                    raise GeometryError(
                        f"{key}[{number}] has {len(spot)} numbers, expected [x, y] or [x, y, turn]"
                    )
        if not (self.at or self.mirrored):
            raise GeometryError("at is empty, and so is mirrored: expected at least one place")

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """One image per place, those that are mirrored last."""
        spots = np.array([(*spot, 0.0)[:3] for spot in (*self.at, *self.mirrored)], np.float64)
        turned = turns(spots[:, 2].tolist()).linear.copy()
        # The mirrored ones change the sign of y before they are turned.
        turned[len(self.at) :, 1::2] *= -1.0
        return Affines(np.hstack([turned, spots[:, :2]]))


@frozen(kw_only=True)
class Lattice(Layout):
    """Copies in even rows over the whole repeat, for grounds of dots and small flowers, and *sido* cells.

    Several motifs take the places in turn, row by row from the lower left.
    """

    spreads: ClassVar[bool] = False
    deals: ClassVar[bool] = True
    columns: Annotated[int, Between(1, 2000), Says("copies across the repeat")] = 4
    rows: Annotated[int, Between(1, 2000), Says("copies up the repeat")] = 4
    stagger: Annotated[bool, Says("shift every other row by half a step")] = False
    turn: Annotated[float, Between(-360, 360), Says("degrees each copy is turned")] = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """One image per place; the first stands half a step in from the corner."""
        if self.stagger and self.rows % 2:
            raise GeometryError(f"rows = {self.rows}: staggered rows repeat only when their number is even")
        dx, dy = cell[0] / self.columns, cell[1] / self.rows
        row, column = np.divmod(np.arange(self.rows * self.columns), self.columns)
        early = np.where(self.stagger & (row % 2 == 1), 0.5, 0.0)
        places = np.column_stack([(column + 0.5 + early) * dx - cell[0] / 2, (row + 0.5) * dy - cell[1] / 2])
        return Affines.translations(places) @ Affine.turn(self.turn)
