"""Lines at the seam: one that leaves by an edge goes on at the opposite one.

A place on the seam is one place of the torus, wherever it shows on the page's rim. A line that has an end
there ought to go on, on either side or along the seam. Where no other line of the ink begins, it dangles:
its other half is missing, out of register, or stops short. A line that was drawn to end on the seam looks
the same; the artwork says where one does, by a border of no length.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.drawing import Borders, Edges, Frame, InkDrawing
from batik_vector.certificate.report import Kind, Limits, Measures, SeamFault
from batik_vector.certificate.seam import Seam
from batik_vector.certificate.shifts import Events
from batik_vector.tiling.torus.torus import Steps
from batik_vector.units import format_mm
from batik_vector.values import frozen


@frozen(eq=False)
class LineEnds:
    """Where the lines of one ink meet one seam, in steps on the near edge.

    ``near`` and ``far`` are the places at which a line of either edge has no other to go on in;
    ``apart`` are the pairs of these (rows of near, far) that stand within reach of each other.
    """

    ink: InkDrawing
    seam: Seam
    near: NDArray[np.int64]
    far: NDArray[np.int64]
    apart: NDArray[np.intp]
    met: NDArray[np.int64]

    def only(self, counts: Callable[[float, float], bool]) -> LineEnds:
        """Return what is left where of all places that are alone only some count."""
        near = np.array([counts(along, along) for along in self.near.tolist()], bool)
        far = np.array([counts(along, along) for along in self.far.tolist()], bool)
        # Of a pair that stands apart both count, or neither.
        for row, column in self.apart.tolist():
            near[row] = far[column] = near[row] or far[column]
        number, other = np.cumsum(near) - 1, np.cumsum(far) - 1
        pairs = self.apart[near[self.apart[:, 0]]] if len(self.apart) else self.apart
        apart = np.column_stack([number[pairs[:, 0]], other[pairs[:, 1]]]) if len(pairs) else pairs
        return replace(self, near=self.near[near], far=self.far[far], apart=apart)

    @property
    def displacement(self) -> NDArray[np.float64]:
        """How far (mm) the ends of each pair stand apart."""
        length = self.seam.length
        apart = self.near[self.apart[:, 0]] - self.far[self.apart[:, 1]]
        return np.asarray(np.abs((apart + length // 2) % length - length // 2) / self.seam.frame.per_mm)

    def measures(self, limit: float) -> Measures:
        """Return counts and the worst displacement; pairs within the limit (mm) go on in one another."""
        paired = int((self.displacement <= limit).sum())
        loose = len(self.near) + len(self.far) - 2 * paired
        worst = float(self.displacement.max(initial=0.0))
        return Measures(crossings=len(self.met) + paired, unpaired=loose, mismatch=worst)

    def broken(self, limit: float) -> list[float]:
        """Return where lines do not go on, in steps along the near edge."""
        good = self.apart[self.displacement <= limit]
        near, far = np.delete(self.near, good[:, 0]), np.delete(self.far, good[:, 1])
        return [float(along) for along in (*near.tolist(), *far.tolist())]

    def events(self, number: int) -> tuple[Events, Events]:
        """Return where lines of near and far edge meet the seam."""
        near, far = (np.concatenate([self.met, alone]) for alone in (self.near, self.far))
        sort = 3 * number + 2
        return Events(near, np.full(len(near), sort)), Events(far, np.full(len(far), sort))


def line_ends(
    ink: InkDrawing, seams: list[Seam], borders: Borders, limits: Limits, finer: int
) -> list[LineEnds]:
    """Return the line ends of an ink, seam by seam; those in a corner of the page belong to the first.

    Args:
        ink: whose lines.
        seams: both seams of the page.
        borders: those of no length are places where a line ends on purpose.
        limits: how far ends may stand apart.
        finer: how many steps a step of the borders is.
    """
    edges = ink.strokes
    points = np.concatenate([edges.begin, edges.end])
    rim = np.zeros(len(points), bool)
    for seam in seams:
        rim |= (points[:, seam.axis] == seam.near) | (points[:, seam.axis] == seam.far)
    points = points[rim]
    frame = seams[0].frame
    _, number, counts = np.unique(frame.canonical(points), axis=0, return_inverse=True, return_counts=True)
    alone = counts[number.ravel()] == 1
    alone &= ~_meant(points, ink.ink.name, borders, frame, finer)
    found = []
    for seam in seams:
        near, far = points[:, seam.axis] == seam.near, points[:, seam.axis] == seam.far
        mine = near | far
        found.append(_ends(ink, seam, points, (near, far, alone), limits))
        points, alone = points[~mine], alone[~mine]
    return found


def _meant(points: Steps, ink: str, borders: Borders, frame: Frame, finer: int) -> NDArray[np.bool_]:
    """Tell at which points of the rim a line of an ink ends on purpose."""
    places = [
        (0, low * finer) if axis == 0 else (low * finer, 0)
        for name, axis, low, high in sorted(borders)
        if name == ink and low == high
    ]
    legal = frame.canonical(np.array(places, np.int64).reshape(-1, 2))
    span = frame.cell.columns + frame.cell.rows + 1
    mine = frame.canonical(points)
    return np.isin(mine[:, 0] * span + mine[:, 1], legal[:, 0] * span + legal[:, 1])


def _ends(
    ink: InkDrawing,
    seam: Seam,
    points: Steps,
    which: tuple[NDArray[np.bool_], NDArray[np.bool_], NDArray[np.bool_]],
    limits: Limits,
) -> LineEnds:
    near, far, alone = which
    along = points[:, 1 - seam.axis]
    here = along[near & alone] % seam.length
    there = (along[far & alone] - seam.slip) % seam.length
    met = np.intersect1d(along[near & ~alone] % seam.length, (along[far & ~alone] - seam.slip) % seam.length)
    return LineEnds(ink, seam, here, there, _pairs(here, there, seam, limits), met)


def _pairs(here: NDArray[np.int64], there: NDArray[np.int64], seam: Seam, limits: Limits) -> NDArray[np.intp]:
    """Return the rows of places on either edge that are nearest to each other, and within reach."""
    if not len(here) or not len(there):
        return np.empty((0, 2), np.intp)
    apart = np.abs((here[:, None] - there[None, :] + seam.length // 2) % seam.length - seam.length // 2)
    best, back = apart.argmin(axis=1), apart.argmin(axis=0)
    rows = np.arange(len(here))
    good = (back[best] == rows) & (apart[rows, best] <= limits.reach * seam.frame.per_mm)
    return np.column_stack([rows[good], best[good]])


def end_faults(found: LineEnds, limits: Limits) -> list[SeamFault]:
    """Return a fault for each line that does not go on across a seam."""
    seam, name = found.seam, found.ink.ink.name
    faults = []
    for (row, column), apart in zip(found.apart.tolist(), found.displacement.tolist(), strict=True):
        if apart > limits.position:
            near, far = int(found.near[row]), int(found.far[column])
            words = (
                f"a line leaves by {seam.at(far, True)} and comes in by {seam.at(near, False)}, "
                f"{format_mm(apart) if apart >= 0.001 else f'{apart:.6f}'} mm out of register"
            )
            faults.append(SeamFault(Kind.OFFSET, name, seam.place(near, False), words, apart))
    for far, places, rows in ((False, found.near, found.apart[:, 0]), (True, found.far, found.apart[:, 1])):
        for along in np.delete(places, rows).tolist():
            faults.append(_dangling(found, along, far, limits))
    return faults


def _dangling(found: LineEnds, along: int, far: bool, limits: Limits) -> SeamFault:
    seam, name = found.seam, found.ink.ink.name
    words = f"a line ends at {seam.at(along, far)}, and none goes on at {seam.at(along, not far)}"
    short = _stops_short(found.ink.strokes, seam, seam.steps(along, not far)) / seam.frame.per_mm
    if short > limits.reach:
        return SeamFault(Kind.UNPAIRED, name, seam.place(along, far), words, 0.0)
    words += f": one stops {format_mm(short)} mm short"
    return SeamFault(Kind.UNPAIRED, name, seam.place(along, not far), words, short)


def _stops_short(strokes: Edges, seam: Seam, place: tuple[float, float]) -> float:
    """Return how far (steps) the nearest loose end of a line inside the page is from a place."""
    points, counts = np.unique(np.concatenate([strokes.begin, strokes.end]), axis=0, return_counts=True)
    inside = (points[:, seam.axis] > seam.near) & (points[:, seam.axis] < seam.far)
    apart = points[(counts == 1) & inside] - np.array(place)
    return float(np.hypot(apart[:, 0], apart[:, 1]).min(initial=np.inf))
