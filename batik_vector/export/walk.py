"""The one walk over an artwork: every format is a surface that it drives.

The walker checks what every writer relies on, turns shapely geometries into arrays of whole grid steps,
and hands each ink's marks over in bulk. A surface spells them out and knows nothing of shapely.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Geometries, Ink
from batik_vector.errors import ExportError
from batik_vector.export.numbers import Steps, check_range
from batik_vector.units import STEPS_PER_MM

Offsets = NDArray[np.int64]


@dataclass(frozen=True)
class Outlines:
    """The marks of an ink as arrays.

    ``points`` has shape (n, 2), in steps of 1 µm, y up. Ring (or polyline) i is
    ``points[rings[i]:rings[i + 1]]``, and a closed one does not repeat its first point. Mark j is made of
    the rings ``marks[j]`` to ``marks[j + 1]``: a polygon's outer ring and its holes, or one polyline.
    """

    points: Steps
    rings: Offsets
    marks: Offsets
    closed: NDArray[np.bool_]
    names: Sequence[str] = ()

    def __len__(self) -> int:
        return len(self.marks) - 1

    def moved(self, right: int = 0, up: int = 0) -> Outlines:
        """Return the same marks elsewhere."""
        return self if right == up == 0 else replace(self, points=self.points + np.array([right, up]))

    def flipped(self, height: int) -> Outlines:
        """Return the same marks with y pointing down from the top of a page ``height`` steps high."""
        return replace(self, points=self.points * np.array([1, -1]) + np.array([0, height]))

    def repeating(self) -> tuple[Steps, Offsets]:
        """Return points and ring offsets with the first point of each closed ring repeated at its end."""
        shut = np.flatnonzero(self.closed)
        points = np.insert(self.points, self.rings[shut + 1], self.points[self.rings[shut]], axis=0)
        return points, self.rings + np.r_[0, np.cumsum(self.closed)]


class Surface(Protocol):
    """What a format does with a drawing. Calls come in this order, inks from the bottom up."""

    def begin(self, artwork: Artwork) -> None:
        """Open the page. Only its size, title, cloth and provenance are to be read here."""

    def ink(self, ink: Ink, pen: int) -> None:
        """Open the layer of an ink; pens count from 1."""

    def areas(self, outlines: Outlines) -> None:
        """Fill outlines with the ink opened last. Not called when there are none."""

    def lines(self, outlines: Outlines) -> None:
        """Draw lines with the ink opened last, as broad as the ink says. Not called when there are none."""

    def end(self) -> None:
        """Close the page."""


def walk(artwork: Artwork, surface: Surface) -> None:
    """Drive a surface over an artwork.

    Raises:
        ExportError: where a coordinate is not finite or out of range, or a mark is of the wrong kind.
    """
    surface.begin(artwork)
    for pen, layer in enumerate(artwork.layers, start=1):
        surface.ink(layer.ink, pen)
        if len(layer.areas):
            surface.areas(_areas(layer.areas, layer.area_names, layer.ink.name))
        if len(layer.lines):
            surface.lines(_lines(layer.lines, layer.line_names, layer.ink.name))
    surface.end()


def _areas(areas: Geometries, names: Sequence[str], ink: str) -> Outlines:
    if (shapely.get_type_id(areas) != shapely.GeometryType.POLYGON).any() or shapely.is_empty(areas).any():
        raise ExportError(f'ink "{ink}": an area is no polygon, or empty')
    _, coords, (rings, marks) = shapely.to_ragged_array(areas, include_z=False)
    points = _steps(coords, ink)
    keep = np.ones(len(points), bool)
    keep[rings[1:] - 1] = False
    starts = np.asarray(rings, np.int64)
    return Outlines(
        points[keep],
        starts - np.arange(len(starts), dtype=np.int64),
        np.asarray(marks, np.int64),
        np.ones(len(starts) - 1, bool),
        names,
    )


def _lines(lines: Geometries, names: Sequence[str], ink: str) -> Outlines:
    if (shapely.get_type_id(lines) != shapely.GeometryType.LINESTRING).any() or shapely.is_empty(lines).any():
        raise ExportError(f'ink "{ink}": a line is no polyline, or empty')
    _, coords, (bounds,) = shapely.to_ragged_array(lines, include_z=False)
    points = _steps(coords, ink)
    offsets: Offsets = np.array(bounds, np.int64)
    first, last = offsets[:-1], offsets[1:] - 1
    # Fewer than three different places enclose nothing: there and back is an open line.
    closed = (points[first] == points[last]).all(axis=1) & (last - first >= 3)
    keep = np.ones(len(points), bool)
    keep[last[closed]] = False
    offsets[1:] -= np.cumsum(closed)
    return Outlines(points[keep], offsets, np.arange(len(offsets)), closed, names)


def _steps(coords: NDArray[np.float64], ink: str) -> Steps:
    if not np.isfinite(coords).all():
        raise ExportError(f'ink "{ink}": a coordinate is not finite')
    # A float beyond int64 would wrap round unseen; clipped, it is still beyond every range we write.
    steps = np.clip(np.rint(coords * STEPS_PER_MM), -(2.0**62), 2.0**62).astype(np.int64)
    check_range(steps)
    return steps


@dataclass
class RecordingSurface:
    """Keeps what it is told, in order: (method, arguments)."""

    calls: list[tuple[str, tuple[object, ...]]] = field(default_factory=list)

    def begin(self, artwork: Artwork) -> None:
        """Record the page."""
        self.calls.append(("begin", (artwork,)))

    def ink(self, ink: Ink, pen: int) -> None:
        """Record the layer."""
        self.calls.append(("ink", (ink, pen)))

    def areas(self, outlines: Outlines) -> None:
        """Record the areas."""
        self.calls.append(("areas", (outlines,)))

    def lines(self, outlines: Outlines) -> None:
        """Record the lines."""
        self.calls.append(("lines", (outlines,)))

    def end(self) -> None:
        """Record the end."""
        self.calls.append(("end", ()))
