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
class StripesReport:
    """How lines were fitted to the repeat.

    ``asked`` and ``angle`` are degrees; ``distance`` of the lines and ``link`` along them mm; ``stretch`` is
    of links along their line beside across.
    """

    asked: float | None
    angle: float
    lines: int
    distance: float
    link: float
    stretch: float


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
        report: what was asked for and what came of it, where something was fitted.
    """

    vector: tuple[int, int]
    starts: Steps
    sides: NDArray[np.int64]
    links: int
    scale: float
    report: StripesReport | None = None

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


def courses(
    spec: Stripes, lattice: Lattice, at: tuple[float, float], scale: float, breadth: float = 0.0
) -> Courses:
    """Return where the lines of a ground run.

    Args:
        spec: how many, and how often they go round.
        lattice: of the repeat, in grid steps.
        at: where the first begins, in mm.
        scale: mm to one motif unit.
        breadth: of the band, in motif units, where the spec fits it to the distance of the lines.

    Raises:
        GeometryError: where no line runs at about the angle asked for.
    """
    way = _nearest(spec, lattice, scale, breadth)
    (p, q), count, links, across = way.winding, way.count, way.links, way.scale
    a, b = (np.array(vector, np.int64) for vector in lattice)
    vector = p * a + q * b
    length = float(np.hypot(*vector))
    report = None
    if spec.fit or spec.angle is not None:
        area = abs(float(a[0]) * float(b[1]) - float(a[1]) * float(b[0]))
        report = StripesReport(
            asked=spec.angle,
            angle=round(math.degrees(math.atan2(*vector[::-1].tolist())), 3),
            lines=count,
            distance=round(area / length / count / STEPS_PER_MM, 4),
            link=round(length / links / STEPS_PER_MM, 4),
            stretch=round(way.stretch, 5),
        )
    r, s = _complement(p, q)
    # The line after the last is the first, moved by a period that goes once across all of them.
    over = r * a + s * b
    over = over - round(float(over @ vector) / length**2) * vector
    shares = np.arange(count) / count
    creep = shares * spec.creep / links
    offsets = shares[:, None] * over + creep[:, None] * vector
    starts = np.rint(np.array(at) * STEPS_PER_MM + offsets).astype(np.int64)
    sides = np.where(np.arange(count) % 2, -1 if spec.flip else 1, 1)
    return Courses((int(vector[0]), int(vector[1])), starts, sides, links, across, report)


LINES = 12
"""Lines where a recipe says nothing of them."""
MOST_TURNS = 12
"""How often lines that are to run at an angle go round the repeat at most, across and up."""
DEGREES, SIZES, SHAPES = 1.0, 0.06, 0.03
"""What weighs as much: a degree off the angle, bands 6 % off their size, links stretched by 3 %."""
FARTHEST = 10.0
"""Degrees that lines may run off the angle asked for."""


@frozen
class _Way:
    """One way of laying lines, ``stretch`` of links along beside across, ``off`` degrees from the angle."""

    winding: tuple[int, int]
    count: int
    links: int
    scale: float
    stretch: float
    off: float


def _nearest(spec: Stripes, lattice: Lattice, scale: float, breadth: float) -> _Way:
    """Return the way of laying the lines that comes nearest to what is asked for."""
    if spec.angle is None:
        return _way(spec, lattice, spec.winding, scale, breadth, 0.0)
    turns = range(-MOST_TURNS, MOST_TURNS + 1)
    found = []
    for winding in ((p, q) for p in turns for q in turns if math.gcd(p, q) == 1):
        (ax, ay), (bx, by) = lattice
        x, y = winding[0] * ax + winding[1] * bx, winding[0] * ay + winding[1] * by
        # A line and its way back are one.
        off = abs((math.degrees(math.atan2(y, x)) - spec.angle + 180) % 360 - 180)
        if off <= FARTHEST:
            found.append(_way(spec, lattice, winding, scale, breadth, off))
    if not found:
        raise GeometryError(
            f"angle = {spec.angle:g}: no lines that close on this repeat run within {FARTHEST:g} degrees of "
            "it, expected the winding"
        )
    return min(found, key=lambda way: (round(_cost(way, scale), 6), way.winding))


def _cost(way: _Way, scale: float) -> float:
    shape = abs(math.log(way.scale / scale)) / SIZES + abs(math.log(way.stretch)) / SHAPES
    return way.off / DEGREES + shape + 0.05 * (abs(way.winding[0]) + abs(way.winding[1]))


def _way(
    spec: Stripes, lattice: Lattice, winding: tuple[int, int], scale: float, breadth: float, off: float
) -> _Way:
    """Return how lines of a winding are laid: in fitting bands, or in lines of the placement's scale."""
    (ax, ay), (bx, by) = lattice
    (p, q), steps = winding, STEPS_PER_MM
    length = math.hypot(p * ax + q * bx, p * ay + q * by) / steps
    count, across = spec.count or LINES, scale
    if spec.fit:
        room = abs(ax * by - ay * bx) / steps**2 / length
        pairs = 2 if spec.flip else 1
        count = spec.count or min(max(pairs, pairs * round(room / (scale * breadth * pairs))), 2000)
        across = room / count / breadth
    links = spec.links or max(1, round(length / across))
    return _Way(winding, count, links, across, length / links / across, off)


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
