"""Stripes: lines that run over the repeat, and close on it to the bit."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.errors import GeometryError
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.tiling.layouts.grounds import Stripes
from batik_vector.tiling.torus.torus import Lattice, Steps, to_mm
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

NODE = 1e-9
"""How near to 0 or 1 an x must be to be an end of a link; floats of curves stray no farther."""


@frozen
class Courses:
    """Where the lines of a ground run.

    Every line begins on a grid step and ends one ``vector`` on. Its links meet in nodes: their points are
    computed from the number of the node, so that both links have the same bits, and the last node is the
    first moved by the vector.

    Attributes:
        vector: along which a line closes, in grid steps.
        starts: where the lines begin, whole grid steps, shape (count, 2).
        sides: 1 or -1 for each line: which way the motif's y points.
        links: motifs end to end along each.
        scale: mm to one motif unit across.
    """

    vector: tuple[int, int]
    starts: Steps
    sides: NDArray[np.int64]
    links: int
    scale: float

    @property
    def stretch(self) -> float:
        """The largest factor from motif units to mm."""
        return max(self.scale, math.hypot(*self.vector) / STEPS_PER_MM / self.links)

    def areas(self, shapes: Geometries) -> Geometries:
        """Return all copies of polygons, in mm on the grid."""
        if not len(shapes):
            return shapes
        made = [
            self._copy(shapes, line, link) for line in range(len(self.starts)) for link in range(self.links)
        ]
        return to_mm(np.concatenate(made))

    def lines(self, shapes: Geometries) -> Geometries:
        """Return all copies of polylines, in mm on the grid, joined end to end along each line.

        One that runs from end to end goes on over its own beginning by one stretch: what is drawn twice is
        drawn once in the end, and thereby joined.

        Raises:
            GeometryError: where a line that runs from end to end does not end at the height it began at.
        """
        if not len(shapes):
            return shapes
        _check_heights(shapes)
        made = []
        for line in range(len(self.starts)):
            links = [self._copy(shapes, line, link) for link in range(self.links)]
            joined = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(np.concatenate(links))))
            made.append(self._gone_on(joined))
        return to_mm(np.concatenate(made))

    def _copy(self, shapes: Geometries, line: int, link: int) -> Geometries:
        """Return copies in whole grid steps."""

        def carried(points: Array) -> Array:
            x, y = points[:, 0], points[:, 1]
            end = np.rint(x)
            node = (np.abs(x - end) < NODE) & ((end == 0) | (end == 1))
            along = link + np.where(node, end, x)
            last = node & (along == self.links)
            share = np.where(last, 0.0, along) / self.links
            across = y * self.scale * STEPS_PER_MM * self.sides[line] / math.hypot(*self.vector)
            vx, vy = self.vector
            out = np.column_stack([share * vx - across * vy, share * vy + across * vx])
            return np.asarray(np.rint(out + self.starts[line]) + last[:, None] * np.array(self.vector))

        return np.asarray(shapely.transform(shapes, carried), dtype=object)

    def _gone_on(self, lines: Geometries) -> Geometries:
        """Return lines; those that close with the vector are drawn a stretch farther."""
        made = []
        for line in lines:
            points = shapely.get_coordinates(line)
            gap = points[-1] - points[0]
            if (gap == -np.array(self.vector)).all():
                points, gap = points[::-1], -gap
            if (gap == self.vector).all():
                points = np.vstack([points, points[1] + gap])
            made.append(shapely.linestrings(points))
        return np.array(made, dtype=object)


def courses(spec: Stripes, lattice: Lattice, at: tuple[float, float], scale: float) -> Courses:
    """Return where the lines of a ground run.

    Args:
        spec: how many, and how often they go round.
        lattice: of the repeat, in grid steps.
        at: where the first begins, in mm.
        scale: mm to one motif unit.
    """
    a, b = (np.array(vector, np.int64) for vector in lattice)
    p, q = spec.winding
    vector = p * a + q * b
    length = float(np.hypot(*vector))
    links = spec.links or max(1, round(length / (scale * STEPS_PER_MM)))
    r, s = _complement(p, q)
    # The line after the last is the first, moved by a period that goes once across all of them.
    across = r * a + s * b
    across = across - round(float(across @ vector) / length**2) * vector
    shares = np.arange(spec.count) / spec.count
    creep = shares * spec.creep / links
    offsets = shares[:, None] * across + creep[:, None] * vector
    starts = np.rint(np.array(at) * STEPS_PER_MM + offsets).astype(np.int64)
    sides = np.where(np.arange(spec.count) % 2, -1 if spec.flip else 1, 1)
    return Courses((int(vector[0]), int(vector[1])), starts, sides, links, scale)


def _complement(p: int, q: int) -> tuple[int, int]:
    """Return r and s with p·s − q·r = 1, for p and q without a common factor (Bézout)."""
    old, new = (abs(p), 1, 0), (abs(q), 0, 1)
    while new[0]:
        times = old[0] // new[0]
        old, new = new, (old[0] - times * new[0], old[1] - times * new[1], old[2] - times * new[2])
    # |p|·x + |q|·y = 1, so s = ±x and r = ∓y.
    return (-old[2] if q >= 0 else old[2]), (old[1] if p >= 0 else -old[1])


def _check_heights(lines: Geometries) -> None:
    """Raise where a line from x = 0 to x = 1 ends higher or lower than it began."""
    begins, ends = (shapely.get_coordinates(shapely.get_point(lines, k)) for k in (0, -1))
    spans = (np.abs(np.abs(ends[:, 0] - begins[:, 0]) - 1) < NODE) & (
        np.abs(np.minimum(begins[:, 0], ends[:, 0])) < NODE
    )
    rise = np.abs(ends[:, 1] - begins[:, 1])
    apart: Indices = np.flatnonzero(spans & (rise > NODE))
    if len(apart):
        y0, y1 = begins[apart[0], 1], ends[apart[0], 1]
        raise GeometryError(
            f"a line from x = 0 to x = 1 begins at y = {y0:.3g} and ends at y = {y1:.3g}: expected the same "
            "height, for the next link goes on from there"
        )
