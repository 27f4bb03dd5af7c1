"""Plane lattices: reduced bases, refinements, and the rotations and reflections that a lattice allows.

Conway & Sloane, "Sphere Packings, Lattices and Groups" (1999), §1; International Tables for
Crystallography, volume A (2016), §1.3.2.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from itertools import product
from math import lcm

import numpy as np
from numpy.typing import NDArray

from batik_vector.values import frozen

Matrix = NDArray[np.float64]
Whole = tuple[tuple[int, int], tuple[int, int]]
"""A 2 × 2 matrix of whole numbers, row by row."""

IDENTITY: Whole = ((1, 0), (0, 1))


@frozen
class Turn:
    """A linear part that maps a lattice onto itself.

    ``matrix`` acts on lattice coordinates; ``order`` is 2, 3, 4 or 6 for a rotation, 2 for a reflection.
    ``stretch`` is how far (0.01 is one percent) the lattice is from one for which it were an isometry.
    """

    matrix: Whole
    order: int
    mirror: bool
    stretch: float

    @property
    def inverse(self) -> Whole:
        """The inverse matrix."""
        (a, b), (c, d) = self.matrix
        sign = determinant(self.matrix)
        return (sign * d, -sign * b), (-sign * c, sign * a)


def times(a: Whole, b: Whole) -> Whole:
    """Return the matrix product."""
    (p, q), (r, s) = b
    return tuple((row[0] * p + row[1] * r, row[0] * q + row[1] * s) for row in a)  # type: ignore[return-value]


def determinant(a: Whole) -> int:
    """Return the determinant."""
    return a[0][0] * a[1][1] - a[0][1] * a[1][0]


def order_of(a: Whole) -> int | None:
    """Return the least power that is the identity; None where none up to six is."""
    power = a
    for order in range(1, 7):
        if power == IDENTITY:
            return order
        power = times(power, a)
    return None


def reduced(basis: Matrix) -> Matrix:
    """Return a basis (columns) of the same lattice with the shortest vectors, anticlockwise.

    Lagrange's reduction, often named after Gauss; the angle between the vectors is 60° to 90° or, where
    turning one about would change the orientation, 90° to 120°.
    """
    a, b = basis[:, 0].copy(), basis[:, 1].copy()
    while True:
        if a @ a > b @ b:
            a, b = b, a
        steps = np.rint((a @ b) / (a @ a))
        # A tie within rounding would swap for ever.
        if steps == 0 or abs((a @ b) / (a @ a)) <= 0.5 + 1e-9:
            break
        b = b - steps * a
    if a[0] < -1e-9 or (abs(a[0]) <= 1e-9 and a[1] < 0):
        a = -a
    if a[0] * b[1] - a[1] * b[0] < 0:
        b = -b
    return np.column_stack([a, b])


def refined(translations: Iterable[tuple[Fraction, Fraction]]) -> tuple[tuple[Fraction, ...], ...]:
    """Return a basis (rows) of the lattice that these translations and the unit ones generate."""
    given = list(translations)
    common = lcm(1, *(part.denominator for pair in given for part in pair))
    rows = [[common, 0], [0, common]] + [[int(part * common) for part in pair] for pair in given]
    basis = []
    for column in (0, 1):
        while True:
            live = sorted((row for row in rows if row[column]), key=lambda row: abs(row[column]))
            if len(live) == 1:
                break
            for row in live[1:]:
                turns = row[column] // live[0][column]
                row[0] -= turns * live[0][0]
                row[1] -= turns * live[0][1]
        rows = [row for row in rows if row is not live[0]]
        basis.append(tuple(Fraction(part, common) for part in live[0]))
    return tuple(basis)


SHEARED = 0.1
"""How far, in lengths of the shorter vector of a lattice, a stretch may carry the end of the longer one: a
shear all but maps a long lattice onto itself, and is known by the whole short vector it makes at the end."""


def turns(basis: Matrix, limit: float) -> list[Turn]:
    """Return the rotations and reflections that map a lattice onto itself, but for a stretch within limit.

    Args:
        basis: reduced, as columns, in mm.
        limit: of the stretch, as a fraction; on a long lattice ``SHEARED`` is the less that counts.

    Returns:
        Rotations first, of higher order first; then reflections. Never the identity.
    """
    found = []
    short, long = np.sort(np.hypot(*basis))
    length = long / short
    for p, q, r, s in product((-1, 0, 1), repeat=4):
        matrix: Whole = ((p, q), (r, s))
        sign = determinant(matrix)
        order = order_of(matrix) if abs(sign) == 1 else None
        if order is None or order == 1:
            continue
        stretch = stretch_of(basis, matrix, order)
        if stretch <= limit and stretch * length <= SHEARED:
            found.append(Turn(matrix, order, sign < 0, stretch))
    return sorted(found, key=lambda turn: (turn.mirror, -turn.order, turn.matrix))


def stretch_of(basis: Matrix, matrix: Whole, order: int) -> float:
    """Return by what fraction a lattice must be stretched along one line to let a matrix be an isometry.

    The metric averaged over the matrix' powers is one that they keep; the ratio of the two metrics' axes
    is the stretch. A cell of 26 : 15 for 1 : √3 gives 0.0007.
    """
    metric = basis.T @ basis
    power, total = np.eye(2), np.zeros((2, 2))
    for _ in range(order):
        total += power.T @ metric @ power
        power = power @ np.array(matrix, float)
    low, high = np.sort(np.linalg.eigvals(np.linalg.solve(total, metric)).real)
    return float(np.sqrt(high / low) - 1)


def fractions_of(place: NDArray[np.float64], basis: Matrix, slack: float) -> tuple[Fraction, Fraction] | None:
    """Return lattice coordinates as the simplest fractions of one denominator within slack (mm) of them."""
    for parts in range(1, MOST_PARTS + 1):
        whole = np.rint(place * parts)
        if np.hypot(*(basis @ (place - whole / parts))) <= slack:
            return Fraction(int(whole[0]), parts), Fraction(int(whole[1]), parts)
    return None


MOST_PARTS = 64
"""Into how many equal parts a translation of the cell may fall."""


MOST_OPERATIONS = 12
"""Linear parts of p6m, the largest plane group."""


def closed(
    found: Mapping[Whole, NDArray[np.float64]], turn: Whole, shift: NDArray[np.float64]
) -> dict[Whole, NDArray[np.float64]] | None:
    """Return the operations that those given and one more generate, modulo the lattice.

    None where these are more than any plane group has: linear parts that hold one by one, on a stretched
    lattice, need not make up a group.

    Args:
        found: a group of operations x → A x + t in lattice coordinates, linear part → translation part.
        turn: the linear part of the new one.
        shift: its translation part.
    """
    makers = [*found.items(), (turn, shift)]
    group = dict(makers)
    queue = list(group)
    while queue:
        a = queue.pop(0)
        for b, moved in makers:
            product_ = times(a, b)
            if product_ not in group:
                if len(group) == MOST_OPERATIONS:
                    return None
                group[product_] = np.array(a, float) @ moved + group[a]
                queue.append(product_)
    return group
