"""Clips: regions of the page beyond which nothing of a mark shows, and marks cut to them.

A stroke that a clip cuts is no line any more: its body is cut, and is an area from then on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.errors import TooLargeError
from batik_vector.geometry.paths.outline import Outline, joined
from batik_vector.geometry.regions import polygonal
from batik_vector.importing.clip_paths import Clip
from batik_vector.importing.fills import filled, solid
from batik_vector.importing.inks import Marks
from batik_vector.importing.pens import Pen, bodies
from batik_vector.importing.polylines import Lines
from batik_vector.importing.scene import Shape

Indices = NDArray[np.intp]

MAX_CUT = 10_000_000
"""Vertices of marks and clips that cutting may come to, each clip counted for every mark that it cuts."""

Flatten = Callable[[Outline], Lines]
"""From outlines on the page, in mm, y down, to polylines on the cell, y up."""


def clipped(marks: Marks, flatten: Flatten, tolerance: float) -> Marks:
    """Return what the clips of their shapes leave of marks.

    Args:
        marks: uncut, in mm on the cell, y up.
        flatten: from the outlines of clips to where the marks lie.
        tolerance: mm; of round caps and joins.

    Raises:
        TooLargeError: where cutting would come to more than ``MAX_CUT`` vertices.
    """
    groups: dict[tuple[Clip, ...], list[int]] = {}
    for number, shape in enumerate(marks.shapes):
        if shape.clips:
            groups.setdefault(shape.clips, []).append(number)
    if not groups:
        return marks
    regions = _Regions(groups, flatten)
    cutter = _Cutter(marks, tolerance)
    for clips, numbers in groups.items():
        cutter.cut(numbers, regions.within(clips))
    return cutter.marks()


class _Regions:
    """The regions that clips leave, each worked out once."""

    def __init__(self, groups: Iterable[tuple[Clip, ...]], flatten: Flatten) -> None:
        self._clips = _all(clip for clips in groups for clip in clips)
        parts = [part for clip in self._clips for part in clip.parts]
        lines = flatten(joined([clip.outline for clip in self._clips]))
        shape = np.repeat(np.arange(len(parts)), [part.subpaths for part in parts])
        evenodd = np.array([part.evenodd for part in parts], bool)
        areas, owner = filled(lines.points, lines.offsets, shape, evenodd)
        ends = np.searchsorted(owner, np.arange(len(parts) + 1))
        self._areas = {
            id(part): areas[begin:end] for part, begin, end in zip(parts, ends, ends[1:], strict=False)
        }
        self._known: dict[int, shapely.Geometry] = {}

    def within(self, clips: Sequence[Clip]) -> shapely.Geometry:
        """Return what several clips leave together."""
        region, *others = (self._of(clip) for clip in dict.fromkeys(clips))
        for other in others:
            region = shapely.intersection(region, other)
        return region

    def _of(self, clip: Clip) -> shapely.Geometry:
        if id(clip) not in self._known:
            found = []
            for part in clip.parts:
                area = shapely.union_all(self._areas[id(part)])
                found.append(shapely.intersection(area, self.within(part.within)) if part.within else area)
            self._known[id(clip)] = shapely.union_all(np.array(found, dtype=object))
        return self._known[id(clip)]


def _all(clips: Iterable[Clip]) -> list[Clip]:
    """Return clips, and those that clip their parts, each once."""
    found: dict[Clip, None] = {}
    left = list(clips)
    while left:
        clip = left.pop()
        if clip not in found:
            found[clip] = None
            left += [each for part in clip.parts for each in part.within]
    return list(found)


class _Cutter:
    """Cuts marks, group by group."""

    def __init__(self, marks: Marks, tolerance: float) -> None:
        self._marks = marks
        self._tolerance = tolerance
        self._whole = [np.ones(len(kind), bool) for kind in (marks.areas, marks.lines)]
        self._areas: list[Geometries] = [marks.areas[:0]]
        self._owners: list[Indices] = [marks.area_shape[:0]]
        self._bodies: list[Geometries] = [marks.areas[:0]]
        self._body_owners: list[Indices] = [marks.area_shape[:0]]
        self._work = 0

    def cut(self, numbers: list[int], region: shapely.Geometry) -> None:
        """Cut the marks of some shapes, ascending, to a region."""
        shapely.prepare(region)
        marks = self._marks
        rows = _rows(marks.area_shape, numbers)
        rows = rows[~shapely.covers(region, marks.areas[rows])]
        self._whole[0][rows] = False
        parts, owner = self._left(marks.areas[rows], region)
        self._areas.append(parts)
        self._owners.append(marks.area_shape[rows[owner]])
        rows = self._reaching(_rows(marks.line_shape, numbers), region)
        drawn, line = self._drawn(rows)
        over = np.zeros(len(rows), bool)
        np.logical_or.at(over, line, ~shapely.covers(region, drawn))
        self._whole[1][rows[over]] = False
        drawn, line = drawn[over[line]], line[over[line]]
        parts, owner = self._left(drawn, region)
        self._bodies.append(parts)
        self._body_owners.append(marks.line_shape[rows[line[owner]]])

    def _left(self, marks: Geometries, region: shapely.Geometry) -> tuple[Geometries, Indices]:
        """Return the polygons that a region leaves of marks, and the number of the mark of each."""
        meets = np.flatnonzero(shapely.intersects(region, marks))
        each = shapely.get_num_coordinates(marks[meets])
        self._work += int(each.sum()) + len(meets) * int(shapely.get_num_coordinates(region))
        if self._work > MAX_CUT:
            raise TooLargeError(
                f"cutting its marks to their clips comes to more than {MAX_CUT:,} points: "
                "cut them in the program that drew them, or simplify the clips"
            )
        found = np.asarray(shapely.intersection(marks[meets], region), dtype=object)
        parts, owner = [], []
        for number, piece in zip(meets.tolist(), found, strict=True):
            pieces = polygonal(piece)
            parts.append(pieces)
            owner.append(np.full(len(pieces), number, np.intp))
        if not parts:
            return marks[:0], np.empty(0, np.intp)
        areas, numbers = np.concatenate(parts), np.concatenate(owner)
        keep = solid(areas)
        return areas[keep], numbers[keep]

    def _reaching(self, rows: Indices, region: shapely.Geometry) -> Indices:
        """Leave out the lines whose bodies cannot reach beyond a region."""
        shapes = self._marks.shapes
        reach = np.array(
            [
                shapes[i].width / 2 * max(shapes[i].pen.limit, 1.5)
                for i in self._marks.line_shape[rows].tolist()
            ]
        )
        low, high = np.split(shapely.bounds(self._marks.lines[rows]).reshape(-1, 4), 2, axis=1)
        boxes = shapely.box(*(low - reach[:, None]).T, *(high + reach[:, None]).T) if len(rows) else rows
        return rows[~shapely.covers(region, boxes)] if len(rows) else rows

    def _drawn(self, rows: Indices) -> tuple[Geometries, Indices]:
        """Return the bodies of lines, and which of the rows each belongs to."""
        kinds: dict[tuple[float, Pen], list[int]] = {}
        for i, number in enumerate(self._marks.line_shape[rows].tolist()):
            shape = self._marks.shapes[number]
            kinds.setdefault((shape.width, shape.pen), []).append(i)
        found, owner = [self._marks.areas[:0]], [np.empty(0, np.intp)]
        for (breadth, pen), mine in kinds.items():
            drawn, line = bodies(self._marks.lines[rows[mine]], breadth, pen, self._tolerance)
            found.append(drawn)
            owner.append(np.array(mine, np.intp)[line])
        return np.concatenate(found), np.concatenate(owner)

    def marks(self) -> Marks:
        """Return what is left: bodies of strokes that were cut are shapes of their own, over their fills."""
        marks = self._marks
        cut = np.unique(np.concatenate(self._body_owners))
        number = np.arange(len(marks.shapes)) + np.searchsorted(cut, np.arange(len(marks.shapes)))
        shapes: list[Shape] = []
        strokes = set(cut.tolist())
        for i, shape in enumerate(marks.shapes):
            shapes.append(shape)
            if i in strokes:
                shapes.append(replace(shape, fill=shape.stroke, stroke="", looks=shape.looks[::-1]))
        whole, lines = self._whole
        areas = np.concatenate([marks.areas[whole], *self._areas, *self._bodies])
        owner = np.concatenate([marks.area_shape[whole], *self._owners])
        owner = np.concatenate([number[owner], number[np.concatenate(self._body_owners)] + 1])
        order = np.argsort(owner, kind="stable")
        return Marks(shapes, areas[order], owner[order], marks.lines[lines], number[marks.line_shape[lines]])


def _rows(owner: Indices, numbers: list[int]) -> Indices:
    """Return where marks of some shapes stand."""
    return np.flatnonzero(np.isin(owner, numbers))
