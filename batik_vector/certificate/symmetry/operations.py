"""What a search for symmetry answers: operations in mm on cloth, and the group that they make up."""

from __future__ import annotations

import enum

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.symmetry.group_names import axis_of
from batik_vector.certificate.symmetry.lattice import Matrix, Whole, determinant, order_of
from batik_vector.values import frozen

Vector = NDArray[np.float64]
Pair = tuple[float, float]


class OperationKind(enum.StrEnum):
    """What an operation is."""

    TRANSLATION = "translation"
    ROTATION = "rotation"
    MIRROR = "mirror"
    GLIDE = "glide"


@frozen
class Operation:
    """One operation x → M x + t of a pattern, in mm on cloth.

    ``linear`` is M, row by row; on a stretched lattice it is no isometry, but becomes one when the lattice
    is unstretched. ``order`` is 2, 3, 4 or 6 for a rotation, 2 for a mirror or glide, 1 for a translation.
    ``place`` is the centre of a rotation, or a point on the axis of a mirror or glide; ``axis`` its
    direction in degrees, ``glide`` the way along it in mm. Other centres and axes follow by the group.
    """

    kind: OperationKind
    order: int
    linear: tuple[Pair, Pair]
    shift: Pair
    place: Pair = (0.0, 0.0)
    axis: float | None = None
    glide: float = 0.0

    def __str__(self) -> str:
        if self.kind == OperationKind.TRANSLATION:
            return f"translation by ({self.shift[0]:.2f}, {self.shift[1]:.2f}) mm"
        where = f"({self.place[0]:.2f}, {self.place[1]:.2f}) mm"
        if self.kind == OperationKind.ROTATION:
            return f"{self.order}-fold rotation about {where}"
        along = f" by {self.glide:.2f} mm" if self.kind == OperationKind.GLIDE else ""
        return f"{self.kind}{along} along {self.axis:.0f}° through {where}"


@frozen
class Miss:
    """An operation that nearly holds: ``share`` of the outline meets its image.

    It fails most at ``place`` (mm, on the tile) in ``ink``, by ``deviation`` mm.
    """

    operation: Operation
    share: float
    deviation: float
    place: Pair
    ink: str


@frozen
class FoundGroup:
    """The wallpaper group of a pattern and how it was found.

    Attributes:
        name: one of the seventeen, p1 to p6m.
        orbifold: its orbifold symbol.
        translations: a shortest basis of all translations, in mm.
        copies: how many copies of the asymmetric unit one cell of the tile holds.
        deviation: the worst distance in mm between the pattern and its image under any operation measured.
        stretch: percent by which the lattice is stretched against one that every operation allows exactly.
        operations: one for every linear part but the identity; with the translations they make up the group.
        misses: operations that nearly hold, the nearest first.
        continuous: the direction along which the pattern may be shifted by any amount, if there is one.
        note: in words, where the pattern is blank or plain stripes.
    """

    name: str
    orbifold: str
    translations: tuple[Pair, Pair]
    copies: int
    deviation: float = 0.0
    stretch: float = 0.0
    operations: tuple[Operation, ...] = ()
    misses: tuple[Miss, ...] = ()
    continuous: Pair | None = None
    note: str = ""


def pair(vector: Vector) -> Pair:
    """Return a vector as two plain floats, without a minus before nought."""
    x, y = (vector + 0.0).tolist()
    return x, y


def described(turn: Whole, shift: Vector, basis: Matrix) -> Operation:
    """Return an operation x → A x + t given in lattice coordinates as one in mm.

    Of the parallel axes of a reflection the one with the least glide is told.
    """
    inverse = np.linalg.inv(basis)
    linear = basis @ np.array(turn, float) @ inverse
    order = order_of(turn) or 1
    rows = (pair(linear[0]), pair(linear[1]))
    if order == 1:
        return Operation(OperationKind.TRANSLATION, 1, rows, pair(basis @ (shift - np.rint(shift))))
    if determinant(turn) > 0:
        shift = shift % 1
        centre = np.linalg.solve(np.eye(2) - linear, basis @ shift)
        return Operation(OperationKind.ROTATION, order, rows, pair(basis @ shift), pair(centre))
    shift = _least_glide(turn, shift)
    # Half of A t + t leads along the axis, half of A t − t across it.
    along = basis @ (shift + np.array(turn, float) @ shift) / 2
    across = basis @ shift - along
    way = basis @ np.array(axis_of(turn), float)
    angle = float(np.degrees(np.arctan2(way[1], way[0]))) % 180
    glide = float(np.hypot(*along))
    kind = OperationKind.MIRROR if glide < 1e-6 else OperationKind.GLIDE
    return Operation(kind, 2, rows, pair(basis @ shift), pair(across / 2), angle, glide)


def _least_glide(turn: Whole, shift: Vector) -> Vector:
    """Return the translation part, moved by whole lattice vectors, that goes least along the axis."""
    steps = np.array([(i, j) for i in range(-2, 3) for j in range(-2, 3)], float)
    shifts = shift - np.rint(shift) + steps
    along = np.abs(shifts + shifts @ np.array(turn, float).T).sum(axis=1)
    nearest = np.lexsort([np.abs(shifts).sum(axis=1).round(6), along.round(6)])[0]
    return np.asarray(shifts[nearest])
