"""What marks cover and where their lines run, sampled to a tolerance: all marks of a drawing at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.paths.matrix import Matrix, inverse_of, moved, spread
from batik_vector.geometry.paths.outline import joined
from batik_vector.geometry.paths.sampling import Polylines, sampled
from batik_vector.geometry.regions import oriented
from batik_vector.geometry.sampling import Array, Points
from batik_vector.importing.drawing.marks import Mark
from batik_vector.importing.fills import filled
from batik_vector.importing.pens import Pen, bodies, dashed

Indices = NDArray[np.intp]
Tolerance: TypeAlias = float | Callable[[Points], Array]
BODY_SHARE = 0.5
"""Share of the tolerance that the centre line of a stroke's body may use; caps and joins have the rest."""


class Shapes:
    """Geometry of marks, in mm, each array with the number of the mark that each geometry belongs to."""

    def __init__(self, marks: Sequence[Mark], tolerance: Tolerance) -> None:
        """Ready marks to be sampled.

        Args:
            marks: bottom first.
            tolerance: in mm; or a function of places giving it, as :func:`~.geometry.paths.sampling.sampled`
                takes it.
        """
        self._marks = marks
        self._tolerance = tolerance

    def regions(self, which: Sequence[int]) -> tuple[Geometries, Indices]:
        """Return what some marks, ascending, cover when filled; without a fill only what they close round."""
        lines, owner = self._sampled(which, self._tolerance)
        fill = np.array([bool(self._marks[number].fill) for number in which], bool)
        keep = lines.closed | fill[owner]
        count = np.diff(lines.offsets)
        points = lines.points[np.repeat(keep, count)]
        offsets = np.append(0, np.cumsum(count[keep])).astype(np.intp)
        evenodd = np.array([mark.evenodd for mark in self._marks], bool)
        return filled(points, offsets, np.asarray(which, np.intp)[owner[keep]], evenodd)

    def lines(self, which: Sequence[int], tolerance: Tolerance | None = None) -> tuple[Geometries, Indices]:
        """Return the outlines of some marks as lines, in dashes where they are dashed."""
        lines, owner = self._sampled(which, self._tolerance if tolerance is None else tolerance)
        # A line needs two places.
        again = (lines.points[1:] == lines.points[:-1]).all(axis=1)
        ring = np.repeat(np.arange(len(owner)), np.diff(lines.offsets))
        keep = np.append(True, ~again | (np.diff(ring) > 0))[: len(ring)]
        enough = np.bincount(ring[keep], minlength=len(owner)) >= 2
        keep &= enough[ring]
        number = np.asarray(which, np.intp)[owner[enough]]
        if not keep.any():
            return np.empty(0, dtype=object), number
        drawn = shapely.linestrings(lines.points[keep], indices=(np.cumsum(enough) - 1)[ring[keep]])
        return self._in_dashes(np.asarray(drawn, dtype=object), number)

    def _in_dashes(self, lines: Geometries, owner: Indices) -> tuple[Geometries, Indices]:
        pens = [self._marks[number].pen for number in owner.tolist()]
        if not any(pen.dashes for pen in pens):
            return lines, owner
        parts = [dashed(line, pen) if pen.dashes else [line] for line, pen in zip(lines, pens, strict=True)]
        count = [len(each) for each in parts]
        found = np.empty(sum(count), dtype=object)
        found[:] = [line for each in parts for line in each]
        return found, np.repeat(owner, count)

    def bodies(self, which: Sequence[int]) -> tuple[Geometries, Indices]:
        """Return what the strokes of some marks cover, in the breadth that they are drawn with."""
        whole = self._tolerance

        def share(points: Points) -> Array:
            assert callable(whole)
            return whole(points) * BODY_SHARE

        lines, owner = self.lines(which, share if callable(whole) else whole * BODY_SHARE)
        rest = self._least(lines)
        kinds: dict[tuple[float, Pen, Matrix | None, float], list[int]] = {}
        for row, number in enumerate(owner.tolist()):
            mark = self._marks[number]
            kinds.setdefault((mark.width, mark.pen, mark.lean, rest[row]), []).append(row)
        found, owners = [lines[:0]], [owner[:0]]
        for (width, pen, lean, tolerance), rows in kinds.items():
            body = _bodies(lines[rows], width, pen, lean, tolerance)
            parts, of = shapely.get_parts(body, return_index=True)
            found.append(parts)
            owners.append(owner[rows][of])
        areas, number = np.concatenate(found), np.concatenate(owners)
        some = np.flatnonzero(~shapely.is_empty(areas))
        order = some[np.argsort(number[some], kind="stable")]
        return oriented(areas[order]), number[order]

    def _least(self, lines: Geometries) -> list[float]:
        """Return for each line what its caps and joins may use of the tolerance, in halvings."""
        if not callable(self._tolerance):
            return [self._tolerance * (1 - BODY_SHARE)] * len(lines)
        points, line = shapely.get_coordinates(lines, return_index=True)
        least = np.full(len(lines), np.inf)
        np.minimum.at(least, line, self._tolerance(points) * (1 - BODY_SHARE))
        return list(2.0 ** np.floor(np.log2(least)))

    def _sampled(self, which: Sequence[int], tolerance: Tolerance) -> tuple[Polylines, Indices]:
        """Return the subpaths of some marks, and for each which of them it belongs to."""
        outlines = [self._marks[number].outline for number in which]
        owner = np.repeat(np.arange(len(which)), [len(each.closed) for each in outlines])
        return sampled(joined(outlines), tolerance), owner


def _bodies(lines: Geometries, width: float, pen: Pen, lean: Matrix | None, tolerance: float) -> Geometries:
    """Return the bodies of lines, dashed already, drawn with one pen."""
    plain = Pen(pen.cap, pen.join, pen.limit)
    if lean is None:
        return bodies(lines, width, plain, tolerance)[0]
    upright = _under(inverse_of(lean), lines)
    return _under(lean, bodies(upright, width, plain, tolerance / spread(lean)[0])[0])


def _under(matrix: Matrix, marks: Geometries) -> Geometries:
    return np.asarray(shapely.transform(marks, lambda points: moved(points, matrix)), dtype=object)
