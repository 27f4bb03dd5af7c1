"""Whether an artwork is in the normal form: what breaks its rules, in words, and where."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork.page import Artwork, Geometries, Layer, Overlap
from batik_vector.fields import given
from batik_vector.geometry.sampling import Points
from batik_vector.units import GRID_MM, STEPS_PER_MM, nearest_steps, on_grid
from batik_vector.values import frozen

Place = tuple[float, float]

MOST_MM = 1e9
"""Beyond it coordinates are not counted in whole steps."""


@frozen
class Breach:
    """A rule that is broken; by which ink and where first (mm), if it is one ink and has a place."""

    ink: str
    words: str
    where: Place | None = None

    def __str__(self) -> str:
        return f"{self.ink}: {self.words}" if self.ink else self.words


def violations(artwork: Artwork) -> list[str]:
    """Return what breaks the rules of the normal form, in words; an empty list is a clean artwork."""
    return [str(breach) for breach in breaches(artwork)]


def breaches(artwork: Artwork) -> list[Breach]:
    """Return what breaks the rules of the normal form, and where."""
    given(artwork, Artwork, "artwork")
    names = Counter(layer.ink.name for layer in artwork.layers)
    found = [Breach("", f'two layers named "{name}"') for name, times in names.items() if times > 1]
    for layer in artwork.layers:
        found += [Breach(layer.ink.name, words, where) for words, where in _of_layer(layer, artwork)]
    return found


Found = Iterator[tuple[str, Place | None]]


def _of_layer(layer: Layer, artwork: Artwork) -> Found:
    if len(layer.area_names) != len(layer.areas) or len(layer.line_names) != len(layer.lines):
        yield "names do not run beside the marks", None
    coords = shapely.get_coordinates(np.concatenate([layer.areas, layer.lines]))
    if not np.isfinite(coords).all():
        yield "a coordinate is not finite", None
        return
    off = np.asarray((on_grid(coords) != coords).any(axis=1))
    if off.any():
        yield "a coordinate is off the 1 µm grid", _first(coords, off)
    low = -artwork.bleed - GRID_MM / 2
    high = np.array([artwork.cell.width, artwork.cell.height]) - low
    outside = np.asarray(((coords < low) | (coords > high)).any(axis=1))
    if outside.any():
        yield "a mark lies outside the cell", _first(coords, outside)
    if np.abs(coords).max(initial=0.0) > MOST_MM:
        return
    yield from _of_areas(layer)
    yield from _of_lines(layer.lines)


def _first(coords: Points, chosen: NDArray[np.bool_]) -> Place:
    x, y = coords[np.argmax(chosen)].tolist()
    return x, y


def _of_areas(layer: Layer) -> Found:
    areas = layer.areas
    if not len(areas):
        return
    if (shapely.get_type_id(areas) != shapely.GeometryType.POLYGON).any() or shapely.is_empty(areas).any():
        yield "an area is no polygon, or empty", None
        return
    valid = shapely.is_valid(areas)
    if not valid.all():
        reason = shapely.is_valid_reason(areas[~valid][0])
        yield f"{int((~valid).sum())} invalid areas, the first: {reason}", _place_in(reason)
        return
    outer = shapely.get_exterior_ring(areas)
    clockwise = ~shapely.is_ccw(outer)
    if clockwise.any():
        yield "an outer ring runs clockwise", _begin(outer[clockwise])
    rings, owner = shapely.get_rings(areas, return_index=True)
    holes = rings[np.r_[False, owner[1:] == owner[:-1]]]
    wrong = shapely.is_ccw(holes)
    if wrong.any():
        yield "a hole runs anticlockwise", _begin(holes[wrong])
    if layer.ink.overlap != Overlap.OVERLAY and len(areas) > 1:
        yield from _overlaps(areas)


def _overlaps(areas: Geometries) -> Found:
    a, b = shapely.STRtree(areas).query(areas, predicate="intersects")
    a, b = a[a < b], b[a < b]
    over = shapely.relate_pattern(areas[a], areas[b], "T********")
    if over.any():
        both = shapely.intersection(areas[a[over][0]], areas[b[over][0]])
        yield f"{int(over.sum())} pairs of areas overlap", _begin(np.array([both.representative_point()]))


def _of_lines(lines: Geometries) -> Found:
    if not len(lines):
        return
    if (shapely.get_type_id(lines) != shapely.GeometryType.LINESTRING).any() or shapely.is_empty(lines).any():
        yield "a line is no polyline, or empty", None
        return
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    step = nearest_steps(coords[1:] - coords[:-1])
    inside = owner[1:] == owner[:-1]
    still = inside & (step == 0).all(axis=1)
    if still.any():
        yield "a line has a step of length zero", _first(coords, still)
    ends = nearest_steps(np.hstack([coords[:-1], coords[1:]])[inside]).astype(np.int64)
    flip = (ends[:, 0] > ends[:, 2]) | ((ends[:, 0] == ends[:, 2]) & (ends[:, 1] > ends[:, 3]))
    ends[flip] = ends[flip][:, [2, 3, 0, 1]]
    once, times = np.unique(ends, axis=0, return_counts=True)
    if len(once) < len(ends):
        x, y = (once[times > 1][0, :2] / STEPS_PER_MM).tolist()
        yield f"{len(ends) - len(once)} line segments are drawn twice", (x, y)


def _begin(marks: Geometries) -> Place:
    x, y = shapely.get_coordinates(marks[0])[0].tolist()
    return x, y


def _place_in(reason: str) -> Place | None:
    """Return the place that GEOS names with a fault: ``Self-intersection[2.5 2.5]``."""
    found = re.search(r"\[(\S+) (\S+)\]$", reason)
    return (float(found[1]), float(found[2])) if found else None
