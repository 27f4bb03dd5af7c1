"""Bands: lines with a body of their own, that taper as a brush lets them, as outlines."""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.splines import through
from batik_vector.geometry.sampling import Array, Points

CAP = np.array([0.3, 0.7])
"""Where a round end has nodes beside its two corners and its middle, as shares of its half turn."""


def band(centre: Points, half: Array) -> Outline:
    """Return a band as one closed smooth subpath; its ends are round, or points where it has no breadth.

    Args:
        centre: places along its middle, shape (n, 2), n ≥ 3; none twice in a row.
        half: half its breadth at each of them, shape (n,), above 0 but at its ends.

    The band must be narrower than the bends of its middle are wide.
    """
    line = centre[:, 0] + 1j * centre[:, 1]
    along = directions(line)
    out = 1j * along * half
    right, left = line - out, line + out
    begin, end = _cap(line[0], -along[0], half[0]), _cap(line[-1], along[-1], half[-1])
    inner = slice(1 if not half[0] else 0, -1 if not half[-1] else None)
    # From the left of the beginning round its end, up the right side, and back down the left.
    ring = np.concatenate([begin, right[inner], end, left[inner][::-1]])
    # A point is a corner; so are both ends of a cap, for a spline through sides and cap would swing there.
    first, last, total = len(begin), len(begin) + len(right[inner]), len(ring)
    corners = [first, total - 1] if half[0] else [0]
    corners += [last - 1, last + len(end)] if half[-1] else [last]
    return through(np.column_stack([ring.real, ring.imag]), True, True, corners)


def directions(line: Array) -> Array:
    """Return the directions of a line of complex numbers at its places: those of parabolas through three."""
    step = np.diff(line)
    size = np.abs(step)
    slope = step / size
    inner = (slope[:-1] * size[1:] + slope[1:] * size[:-1]) / (size[1:] + size[:-1])
    along = np.concatenate([[2 * slope[0] - inner[0]], inner, [2 * slope[-1] - inner[-1]]])
    return np.asarray(along / np.abs(along))


def _cap(place: complex, along: complex, half: float) -> Array:
    """Return the nodes of a round end between its two corners, or the one of a point."""
    if not half:
        return np.array([place])
    angle = np.pi * (np.concatenate([CAP[:1], [0.5], CAP[1:]]) - 0.5)
    return np.asarray(place + half * along * np.exp(1j * angle))


FINE = 16
"""Steps for each node of a curl: its places come from a sum, whose error is then a 10,000th of its length."""


def curl(length: float, turn: float, power: float = 2.0, nodes: int = 0) -> Points:
    """Return places along a tendril that leaves the origin along +x, shape (n, 2).

    Its direction turns by turn·s^power at a share s of its length: 1 is an arc of a circle, 2 Euler's spiral
    (the clothoid), and more stays straight for longer and curls up at its end.

    Args:
        length: of the tendril.
        turn: degrees in all, to the left.
        nodes: how many places; as many as the turn needs when 0.
    """
    nodes = nodes or 6 + int(abs(turn) * power / 40)
    step = 1 / (nodes * FINE)
    middle = (np.arange(nodes * FINE) + 0.5) * step
    line = np.cumsum(np.exp(1j * np.radians(turn) * middle**power)) * (length * step)
    line = np.concatenate([[0.0], line[FINE - 1 :: FINE]])
    return np.column_stack([line.real, line.imag])
