"""A seam as a circle: two opposite edges of the page, the far one moved onto the near one by the drop."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.certificate.drawing import Edges, Frame
from batik_vector.certificate.report import Place
from batik_vector.tiling.torus import seams
from batik_vector.tiling.torus.seams import Intervals
from batik_vector.units import format_mm
from batik_vector.values import frozen

EDGE_NAMES = (("left", "right"), ("lower", "upper"))


@frozen(eq=False)
class Seam:
    """One pair of opposite edges: ``near`` and ``far`` are their abscissa or ordinate in steps.

    The place s of the near edge is s + ``slip`` on the far one, modulo ``length``. ``axis`` is 0 for the
    left and right edges, 1 for the lower and upper ones.
    """

    frame: Frame
    axis: int
    near: int
    far: int
    slip: int
    length: int

    @property
    def names(self) -> str:
        """Both edges in words."""
        return " and ".join(EDGE_NAMES[self.axis])

    def steps(self, along: float, far: bool) -> tuple[float, float]:
        """Return a place of the near edge, or its twin on the far one, in steps."""
        along = (along + (self.slip if far else 0)) % self.length
        value = self.far if far else self.near
        return (value, along) if self.axis == 0 else (along, value)

    def place(self, along: float, far: bool) -> Place:
        """Return the same in mm."""
        x, y = self.steps(along, far)
        return x / self.frame.per_mm, y / self.frame.per_mm

    def at(self, along: float, far: bool) -> str:
        """Return the same in words."""
        mm = self.place(along, far)[1 - self.axis]
        return f"the {EDGE_NAMES[self.axis][far]} edge at {'yx'[self.axis]} = {format_mm(mm)}"


def seams_of(frame: Frame) -> list[Seam]:
    """Return the two seams of a page."""
    lengths = frame.cell.rows, frame.cell.columns
    return [
        Seam(frame, axis, near, far, slip % lengths[axis], lengths[axis])
        for axis, near, far, slip in seams.opposite_edges(frame.cell)
    ]


def traces(areas: Geometries, seam: Seam) -> tuple[Intervals, Intervals]:
    """Return what areas (steps) cover of the near edge, and of the far one moved onto it."""
    here = seams.border(areas, seam.axis, seam.near)
    there = seams.rolled(seams.border(areas, seam.axis, seam.far), -seam.slip, seam.length)
    return here, there


@frozen(eq=False)
class Germs:
    """Edges that leave a seam to one of its sides, one item each.

    ``along`` is where (steps, on the near edge), ``away`` the unit vector that leads from the seam,
    ``length`` that of the edge in steps, ``next_turn`` (radians) how far the way turns at its other end.
    ``leaves`` says that the edge runs away from the seam; others run towards it.
    """

    along: NDArray[np.int64]
    away: NDArray[np.float64]
    length: NDArray[np.float64]
    next_turn: NDArray[np.float64]
    leaves: NDArray[np.bool_]

    def only(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Germs:
        """Return some of them."""
        return Germs(
            self.along[which], self.away[which], self.length[which], self.next_turn[which], self.leaves[which]
        )


def germs(edges: Edges, seam: Seam, far: bool) -> Germs:
    """Return the edges that leave the near edge of the page, or the far one, ordered by their place."""
    value = seam.far if far else seam.near
    begins, ends = edges.begin[:, seam.axis] == value, edges.end[:, seam.axis] == value
    leaves, enters = np.flatnonzero(begins & ~ends), np.flatnonzero(ends & ~begins)
    root = np.concatenate([edges.begin[leaves], edges.end[enters]])
    tip = np.concatenate([edges.end[leaves], edges.begin[enters]])
    step = (tip - root).astype(np.float64)
    length = np.hypot(step[:, 0], step[:, 1])
    found = Germs(
        (root[:, 1 - seam.axis] - (seam.slip if far else 0)) % seam.length,
        step / length[:, None],
        length,
        np.concatenate([edges.turn_end[leaves], edges.turn_begin[enters]]),
        np.concatenate([np.ones(len(leaves), bool), np.zeros(len(enters), bool)]),
    )
    return found.only(np.argsort(found.along, kind="stable"))


def nearest_distance(
    marks: Geometries, point: tuple[float, float], reach: float
) -> tuple[float, Place] | None:
    """Return how far the nearest of some geometries is from a point, and where; None beyond ``reach``."""
    if not len(marks):
        return None
    here = shapely.Point(point)
    lines = shapely.shortest_line(here, marks)
    lengths = shapely.length(lines)
    best = int(np.argmin(lengths))
    if lengths[best] > reach:
        return None
    x, y = shapely.get_coordinates(lines[best])[-1]
    return float(lengths[best]), (float(x), float(y))
