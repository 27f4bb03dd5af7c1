"""The normal form: what every recipe compiles to and every exporter writes.

An :class:`Artwork` is a page of ink layers. What holds for each of them, and need not be asked again:

* coordinates are millimetres on cloth, y upwards, the cell's lower left corner at (0, 0);
* every coordinate is finite and lies on the 1 µm grid (it is the float ``k / 1000``);
* areas are valid, non-empty polygons, outer rings anticlockwise, holes clockwise;
* lines are polylines of at least two distinct points, no step of length zero; a closed line repeats its
  first point at its end;
* nothing lies outside the cell grown by ``bleed``;
* nothing is drawn twice: no two areas of a layer overlap unless its ink says ``overlay``, and no two
  lines of a layer share a stretch;
* layer order is painting order, the first layer at the bottom; ink names are unique.

:func:`violations` lists whatever breaks these rules; tests, ``batik-vector check`` and the exporters
rely on its being empty.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any, Protocol

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import ExportError, GeometryError
from batik_vector.geometry.outlines import MM, Outlines, of_polygons, of_polylines
from batik_vector.units import GRID_MM, STEPS_PER_MM, nearest_steps, on_grid
from batik_vector.values import frozen

Geometries = NDArray[np.object_]
"""A one-dimensional array of shapely geometries."""

PIECE = 1 << 16
"""Vertices that a page hands over at a time, about: what is made of them stays in the processor's cache."""


class Overlap(enum.StrEnum):
    """What the marks of an ink do to what lies beneath them."""

    WELD = "weld"
    """Marks of the ink merge into one region; other inks beneath stay whole."""
    KNOCKOUT = "knockout"
    """Marks merge, and marks of other inks that were placed before them are cut away under them."""
    OVERLAY = "overlay"
    """Marks stay single shapes laid over one another; nothing is merged or cut."""


class DropAxis(enum.StrEnum):
    """Which neighbours a drop repeat shifts."""

    COLUMN = "column"
    """Each column stands p/q of the height above its left neighbour (half-drop)."""
    ROW = "row"
    """Each row stands p/q of the width right of the one below (brick)."""


@frozen
class Ink:
    """One bath, screen, pen or tool: one layer of the file.

    ``width`` is the breadth in mm of a line drawn with it (the canting's spout).
    """

    name: str
    colour: str
    width: float = 1.0
    overlap: Overlap = Overlap.WELD


@frozen
class Cell:
    """The rectangle a tile fills, and the lattice on which it repeats.

    ``columns`` and ``rows`` are whole grid steps (µm). With a drop p/q the neighbours along ``axis``
    are shifted by p/q of the other side, which is a whole number of steps.
    """

    columns: int
    rows: int
    drop: Fraction = Fraction(0)
    axis: DropAxis = DropAxis.COLUMN

    def __post_init__(self) -> None:
        if self.columns < 1 or self.rows < 1:
            raise ValueError("a cell has a positive width and height")
        side = self.rows if self.axis == DropAxis.COLUMN else self.columns
        if (self.drop * side).denominator != 1:
            raise ValueError(f"a drop of {self.drop} does not land on the grid: {side} µm is no multiple")

    @property
    def width(self) -> float:
        """Width in mm."""
        return self.columns / STEPS_PER_MM

    @property
    def height(self) -> float:
        """Height in mm."""
        return self.rows / STEPS_PER_MM

    @property
    def lattice(self) -> tuple[tuple[int, int], tuple[int, int]]:
        """The two translations that repeat the cell, in grid steps."""
        if self.axis == DropAxis.COLUMN:
            return (self.columns, int(self.drop * self.rows)), (0, self.rows)
        return (self.columns, 0), (int(self.drop * self.columns), self.rows)

    @property
    def rectangle(self) -> Cell:
        """The smallest rectangle of whole cells that repeats without a drop."""
        q = self.drop.denominator
        if self.axis == DropAxis.COLUMN:
            return Cell(self.columns * q, self.rows)
        return Cell(self.columns, self.rows * q)


def _no_geometry() -> Geometries:
    return np.empty(0, dtype=object)


@frozen(eq=False)
class Layer:
    """All marks of one ink: filled polygons and centre lines, each with the name of its element.

    ``area_names`` and ``line_names`` run beside ``areas`` and ``lines``; a name is what a designer
    reads beside the path ("flower.petal").
    """

    ink: Ink
    areas: Geometries = field(default_factory=_no_geometry)
    lines: Geometries = field(default_factory=_no_geometry)
    area_names: tuple[str, ...] = ()
    line_names: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not self.area_names and len(self.areas):
            object.__setattr__(self, "area_names", ("",) * len(self.areas))
        if not self.line_names and len(self.lines):
            object.__setattr__(self, "line_names", ("",) * len(self.lines))


@frozen
class Provenance:
    """Where a file comes from: enough to make it again. ``recipe`` is the recipe's TOML text."""

    recipe: str = ""
    seed: int = 0
    version: str = ""


@frozen
class Plate:
    """What one layer of a page holds: whether there are any areas and any lines.

    A ``guide`` is no ink: marks for those who print and cut, outside the drawing, which plotters skip.
    """

    ink: Ink
    areas: bool = True
    lines: bool = True
    guide: bool = False


@frozen
class Margins:
    """How far a page reaches beyond its cell on each side, in grid steps."""

    left: int = 0
    bottom: int = 0
    right: int = 0
    top: int = 0


class Page(Protocol):
    """What a writer draws: layers of marks that come piece by piece, so that no page need fit in memory.

    The cell is what is left when the page is trimmed; its lower left corner is (0, 0). An :class:`Artwork`
    is a page in one piece.
    """

    @property
    def title(self) -> str:
        """What the design is called."""

    @property
    def cell(self) -> Cell:
        """The rectangle to which the page is trimmed."""

    @property
    def margins(self) -> Margins:
        """How far the page reaches beyond the cell."""

    @property
    def bleed(self) -> float:
        """How far the drawing reaches beyond the cell on every side, in mm."""

    @property
    def cloth(self) -> str:
        """The ground's colour on screen."""

    @property
    def tolerance(self) -> float:
        """How far any drawn edge may stand from the true curve, in mm."""

    @property
    def provenance(self) -> Provenance:
        """Recipe, seed and version."""

    @property
    def vertex_count(self) -> int:
        """Vertices of all marks together, or a fair estimate of them."""

    @property
    def plates(self) -> Sequence[Plate]:
        """The layers, the lowest first."""

    def areas(self, number: int) -> Iterator[Outlines]:
        """Yield the areas of a layer, in pieces."""

    def lines(self, number: int) -> Iterator[Outlines]:
        """Yield the centre lines of a layer, in pieces."""


@frozen(eq=False)
class Artwork:
    """A page of ink layers on cloth, in the normal form that the head of this module states.

    ``tolerance`` (mm) is how far any drawn edge may stand from the true curve. ``bleed`` (mm) is how
    far the geometry reaches beyond the cell on every side. ``borders`` are the stretches of the seam along
    which a mark's own border runs, so that it has no twin on the opposite edge: (ink, axis, from, to), the
    last two in grid steps along the left edge (axis 0) or the lower one (axis 1). ``facts`` are plain values
    on how it was made, for reports: how a toss came out, what a fit stretched.
    """

    title: str
    cell: Cell
    layers: tuple[Layer, ...]
    cloth: str = "#ffffff"
    tolerance: float = 0.02
    bleed: float = 0.0
    provenance: Provenance = Provenance()
    borders: frozenset[tuple[str, int, int, int]] = frozenset()
    facts: Mapping[str, Any] = field(default_factory=dict)

    @property
    def vertex_count(self) -> int:
        """Vertices in all areas and lines together."""
        return sum(
            int(shapely.get_num_coordinates(marks).sum())
            for layer in self.layers
            for marks in (layer.areas, layer.lines)
        )

    @property
    def margins(self) -> Margins:
        """How far the page reaches beyond the cell: as far as the geometry."""
        bleed = round(self.bleed * STEPS_PER_MM)
        return Margins(bleed, bleed, bleed, bleed)

    @property
    def plates(self) -> tuple[Plate, ...]:
        """The layers as a page tells of them."""
        return tuple(Plate(layer.ink, len(layer.areas) > 0, len(layer.lines) > 0) for layer in self.layers)

    def areas(self, number: int) -> Iterator[Outlines]:
        """Yield the areas of a layer, about ``PIECE`` vertices at a time.

        Raises:
            ExportError: where a coordinate is not finite, or an area is no polygon.
        """
        layer = self.layers[number]
        _check_marks(layer.areas, shapely.GeometryType.POLYGON, layer.ink.name, "an area is no polygon")
        yield from _pieces(of_polygons, layer.areas, layer.area_names, layer.ink.name)

    def lines(self, number: int) -> Iterator[Outlines]:
        """Yield the lines of a layer, about ``PIECE`` vertices at a time.

        Raises:
            ExportError: where a coordinate is not finite, or a line is no polyline.
        """
        layer = self.layers[number]
        _check_marks(layer.lines, shapely.GeometryType.LINESTRING, layer.ink.name, "a line is no polyline")
        yield from _pieces(of_polylines, layer.lines, layer.line_names, layer.ink.name)

    def _repr_svg_(self) -> str:
        """Show the tile in a notebook."""
        from batik_vector.export.svg import svg_text

        return svg_text(self)


def _check_marks(marks: Geometries, kind: shapely.GeometryType, ink: str, words: str) -> None:
    if (shapely.get_type_id(marks) != kind).any() or shapely.is_empty(marks).any():
        raise ExportError(f'ink "{ink}": {words}, or empty')


def _pieces(
    outlines_of: Callable[[Geometries, float], Outlines], marks: Geometries, names: Sequence[str], ink: str
) -> Iterator[Outlines]:
    """Yield whole marks as outlines with their names, in pieces."""
    total = np.cumsum(shapely.get_num_coordinates(marks))
    cuts = np.flatnonzero(np.diff(total // PIECE)) + 1
    for first, stop in pairwise(sorted({0, *cuts.tolist(), len(marks)})):
        try:
            outlines = outlines_of(marks[first:stop], MM)
        except GeometryError as error:
            raise ExportError(f'ink "{ink}": {error}') from None
        yield replace(outlines, names=names[first:stop])


def violations(artwork: Artwork) -> list[str]:
    """Return what breaks the rules at the head of this module, in words; an empty list is a clean artwork."""
    found = [
        f'two layers named "{name}"'
        for name, times in _counts(layer.ink.name for layer in artwork.layers).items()
        if times > 1
    ]
    for layer in artwork.layers:
        found += [f"{layer.ink.name}: {words}" for words in _layer_violations(layer, artwork)]
    return found


def _counts(names: Iterator[str]) -> dict[str, int]:
    counts: dict[str, int] = {}
    for name in names:
        counts[name] = counts.get(name, 0) + 1
    return counts


def _layer_violations(layer: Layer, artwork: Artwork) -> Iterator[str]:
    if len(layer.area_names) != len(layer.areas) or len(layer.line_names) != len(layer.lines):
        yield "names do not run beside the marks"
    areas, lines = layer.areas, layer.lines
    coords = shapely.get_coordinates(np.concatenate([areas, lines]))
    if not np.isfinite(coords).all():
        yield "a coordinate is not finite"
        return
    if not np.array_equal(on_grid(coords), coords):
        yield "a coordinate is off the 1 µm grid"
    low, high = -artwork.bleed, artwork.bleed
    if len(coords) and (
        coords.min() < low - GRID_MM / 2
        or coords[:, 0].max() > artwork.cell.width + high + GRID_MM / 2
        or coords[:, 1].max() > artwork.cell.height + high + GRID_MM / 2
    ):
        yield "a mark lies outside the cell"
    yield from _area_violations(layer)
    yield from _line_violations(lines)


def _area_violations(layer: Layer) -> Iterator[str]:
    areas = layer.areas
    if not len(areas):
        return
    if (shapely.get_type_id(areas) != shapely.GeometryType.POLYGON).any() or shapely.is_empty(areas).any():
        yield "an area is no polygon, or empty"
        return
    valid = shapely.is_valid(areas)
    if not valid.all():
        yield f"{int((~valid).sum())} invalid areas, the first: {shapely.is_valid_reason(areas[~valid][0])}"
        return
    if not shapely.is_ccw(shapely.get_exterior_ring(areas)).all():
        yield "an outer ring runs clockwise"
    rings, owner = shapely.get_rings(areas, return_index=True)
    holes = np.r_[False, owner[1:] == owner[:-1]]
    if shapely.is_ccw(rings[holes]).any():
        yield "a hole runs anticlockwise"
    if layer.ink.overlap != Overlap.OVERLAY and len(areas) > 1:
        tree = shapely.STRtree(areas)
        a, b = tree.query(areas, predicate="intersects")
        pairs = a < b
        over = shapely.relate_pattern(areas[a[pairs]], areas[b[pairs]], "T********")
        if over.any():
            yield f"{int(over.sum())} pairs of areas overlap"


def _line_violations(lines: Geometries) -> Iterator[str]:
    if not len(lines):
        return
    if (shapely.get_type_id(lines) != shapely.GeometryType.LINESTRING).any() or shapely.is_empty(lines).any():
        yield "a line is no polyline, or empty"
        return
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    step = nearest_steps(coords[1:] - coords[:-1])
    inside = owner[1:] == owner[:-1]
    if (inside & (step == 0).all(axis=1)).any():
        yield "a line has a step of length zero"
    ends = nearest_steps(np.hstack([coords[:-1], coords[1:]])[inside]).astype(np.int64)
    flip = (ends[:, 0] > ends[:, 2]) | ((ends[:, 0] == ends[:, 2]) & (ends[:, 1] > ends[:, 3]))
    ends[flip] = ends[flip][:, [2, 3, 0, 1]]
    twice = len(ends) - len(np.unique(ends, axis=0))
    if twice:
        yield f"{twice} line segments are drawn twice"
