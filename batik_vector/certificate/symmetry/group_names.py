"""Which of the seventeen groups a set of operations makes up.

The decision tree is the usual one (Schattschneider, "The plane symmetry groups", 1978); orbifold symbols
are Conway's ("The Symmetries of Things", 2008).
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from math import gcd

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.symmetry.lattice import Matrix, Whole, determinant, order_of

ORBIFOLDS = {
    "p1": "o",
    "p2": "2222",
    "pm": "**",
    "pg": "xx",
    "cm": "*x",
    "pmm": "*2222",
    "pmg": "22*",
    "pgg": "22x",
    "cmm": "2*22",
    "p4": "442",
    "p4m": "*442",
    "p4g": "4*2",
    "p3": "333",
    "p3m1": "*333",
    "p31m": "3*3",
    "p6": "632",
    "p6m": "*632",
}
"""The orbifold symbol of each group; x is a crossing, o the torus."""


class Axes(enum.Enum):
    """What the parallel axes of one reflection are."""

    MIRRORS = "mirrors"
    GLIDES = "glides"
    BOTH = "mirrors and glides in turn"


def axis_of(turn: Whole) -> tuple[int, int]:
    """Return the shortest lattice vector that a reflection keeps."""
    columns = [(1 + turn[0][0], turn[1][0]), (turn[0][1], 1 + turn[1][1])]
    x, y = next(column for column in columns if any(column))
    return x // gcd(x, y), y // gcd(x, y)


def axes_of(turn: Whole, shift: NDArray[np.float64]) -> Axes:
    """Return what a reflection x → A x + t (lattice coordinates) has for axes.

    Its square is m times the lattice vector e along the axis. Other axes of the same direction differ in m
    by the multiples of e that vectors l + A l come to: all of them, or the even ones only.
    """
    x, y = axis_of(turn)
    steps = [(1 + turn[0][0]) + turn[0][1] * 1j, turn[1][0] + (1 + turn[1][1]) * 1j]
    row = steps[0] if x else steps[1]
    part = x or y
    if gcd(int(row.real) // part, int(row.imag) // part) == 1:
        return Axes.BOTH
    square = shift + np.array(turn, float) @ shift
    return Axes.GLIDES if round(square[0 if x else 1] / part) % 2 else Axes.MIRRORS


def name_of(operations: Mapping[Whole, NDArray[np.float64]], basis: Matrix) -> str:
    """Return the name of the group of the operations: linear part → translation part, lattice coordinates.

    ``basis`` is the lattice of all translations, reduced, as columns in mm.
    """
    rotations = [order_of(turn) or 1 for turn in operations if determinant(turn) > 0]
    mirrors = {turn: axes_of(turn, shift) for turn, shift in operations.items() if determinant(turn) < 0}
    order = max(rotations, default=1)
    kinds = list(mirrors.values())
    if not kinds:
        return f"p{order}"
    if order == 1:
        return {Axes.BOTH: "cm", Axes.MIRRORS: "pm", Axes.GLIDES: "pg"}[kinds[0]]
    if order == 2:
        if Axes.BOTH in kinds:
            return "cmm"
        return ("pmm", "pmg", "pgg")[kinds.count(Axes.GLIDES)]
    if order == 3:
        # Mirrors through all three-fold centres stand upright on the shortest translations.
        axis = np.hypot(*(basis @ np.array(axis_of(next(iter(mirrors))), float)))
        return "p3m1" if axis > 1.3 * np.hypot(*basis[:, 0]) else "p31m"
    if order == 4:
        return "p4g" if Axes.GLIDES in kinds else "p4m"
    return "p6m"
