"""The curves of the four-square flower, for programs that draw points and know no flowers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

POINTS = 200
SCALE = 52.5
PLACES = ((1, 1), (-1, 1), (-1, -1), (1, -1))


def four_square(pistil: float, side: float, petal: float = 1.0) -> list[NDArray[np.float64]]:
    """Return the curves of four flowers on a tile of so many mm: 15,200 points."""
    curves = []
    for x, y in PLACES:
        middle = side / 2 + np.array([x, y]) * SCALE * 4 / 3
        curves += [curve * SCALE + middle for curve in flower(pistil, petal)]
    return curves


def flower(pistil: float, petal: float = 1.0) -> list[NDArray[np.float64]]:
    """Return the curves of a flower: leaves, petals, pistil, core and its circle, in motif units."""
    t = np.linspace(0, 2 * np.pi, POINTS)
    theta = np.linspace(-np.pi / 4, np.pi / 4, POINTS)
    leaf = np.column_stack(
        [1.2 * np.sign(np.cos(t)) * abs(np.cos(t)) ** 0.2, 0.3 * np.sign(np.sin(t)) * abs(np.sin(t)) ** 20]
    )
    rose = petal * np.cos(2 * theta)[:, None] * np.column_stack([np.cos(theta), np.sin(theta)])
    q, turns = 16 / 5, np.linspace(0, 10 * np.pi, 5 * POINTS)
    star = np.column_stack(
        [(q - 1) * np.cos(turns) + np.cos((q - 1) * turns), (q - 1) * np.sin(turns) - np.sin((q - 1) * turns)]
    )
    core = 0.5 * np.cos(4 * t)[:, None] * np.column_stack([np.cos(t), np.sin(t)])
    circle = 0.1 * np.column_stack([np.cos(t), np.sin(t)])
    leaves = [turned(leaf, 22.5 + 45 * number) for number in range(4)]
    petals = [turned(rose, 45 * number) for number in range(8)]
    return [*leaves, *petals, pistil / q * star, core, circle]


def turned(points: NDArray[np.float64], degrees: float) -> NDArray[np.float64]:
    """Return points turned about the origin."""
    angle = np.radians(degrees)
    matrix = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.asarray(points @ matrix)
