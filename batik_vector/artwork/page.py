"""The page as values: inks, the cell, layers of marks, and the artwork that they make."""

from __future__ import annotations

import enum
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from fractions import Fraction
from itertools import chain, pairwise
from typing import Annotated, Any, Protocol, TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from batik_vector.artwork.dyeing import Dyeing
from batik_vector.errors import ExportError, GeometryError
from batik_vector.fields import Between, Converted, check
from batik_vector.geometry.outlines import MM, Outlines, of_polygons, of_polylines
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Geometries = NDArray[np.object_]
"""A one-dimensional array of shapely geometries."""

MOST_STEPS = 2**53
"""Beyond it grid steps are no longer whole numbers of the floats that hold them."""

Border: TypeAlias = tuple[str, int, int, int]
"""Ink, axis, from, to: see :class:`Artwork`."""

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


_Percent: TypeAlias = Annotated[float, Between(0, 100)]
_Opponent: TypeAlias = Annotated[float, Between(-128, 127)]

Cmyk: TypeAlias = tuple[_Percent, _Percent, _Percent, _Percent]
"""Cyan, magenta, yellow and black in per cent."""

Lab: TypeAlias = tuple[_Percent, _Opponent, _Opponent]
"""L*, a* and b* of CIE 1976 under D50."""


@frozen
class Ink:
    """One bath, screen, pen or tool: one layer of the file.

    ``width`` is the breadth in mm of a line drawn with it (the canting's spout). ``cmyk`` and ``lab`` are its
    colour in print, where it was measured or agreed on; ``colour`` is that on screen.
    """

    name: str
    colour: str
    width: float = 1.0
    overlap: Overlap = Overlap.WELD
    cmyk: Cmyk | None = None
    lab: Lab | None = None

    def __post_init__(self) -> None:
        check(self)


@frozen
class Cell:
    """The rectangle a tile fills, and the lattice on which it repeats.

    ``columns`` and ``rows`` are whole grid steps (µm). With a drop p/q the neighbours along ``axis``
    are shifted by p/q of the other side, which is a whole number of steps.
    """

    columns: Annotated[int, Between(1, MOST_STEPS)]
    rows: Annotated[int, Between(1, MOST_STEPS)]
    drop: Annotated[Fraction, Converted(Fraction, "a fraction such as 1/2")] = Fraction(0)
    axis: DropAxis = DropAxis.COLUMN

    def __post_init__(self) -> None:
        check(self)
        side = self.rows if self.axis == DropAxis.COLUMN else self.columns
        if (self.drop * side).denominator != 1:
            raise GeometryError(f"a drop of {self.drop} does not land on the grid: {side} µm is no multiple")

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


def _geometries(given: Any) -> Geometries:
    """Return geometries of shapely, one or any number of them, as an array.

    Raises:
        TypeError: where they are none.
    """
    if isinstance(given, np.ndarray) and given.dtype == object and given.ndim == 1:
        found = given
    else:
        listed = [given] if isinstance(given, BaseGeometry) else list(given)
        found = np.empty(len(listed), dtype=object)
        found[:] = listed
    if not shapely.is_geometry(found).all():
        raise TypeError
    return found


def _borders(given: Any) -> frozenset[Border]:
    """Return stretches of the seam as a set.

    Raises:
        TypeError: where one is none.
    """
    found = given if type(given) is frozenset else frozenset(map(tuple, given))
    # There may be many: all are looked at in one go.
    if set(map(len, found)) <= {4} and set(map(type, chain.from_iterable(found))) <= {str, int}:
        return found
    raise TypeError


Marks = Converted(_geometries, "a list of shapely geometries")
"""Marks a field that holds geometries."""


@frozen(eq=False)
class Layer:
    """All marks of one ink: filled polygons and centre lines, each with the name of its element.

    ``area_names`` and ``line_names`` run beside ``areas`` and ``lines``; a name is what a designer
    reads beside the path ("flower.petal").
    """

    ink: Ink
    areas: Annotated[Geometries, Marks] = field(default_factory=_no_geometry)
    lines: Annotated[Geometries, Marks] = field(default_factory=_no_geometry)
    area_names: tuple[str, ...] = ()
    line_names: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        check(self)
        if not self.area_names and len(self.areas):
            object.__setattr__(self, "area_names", ("",) * len(self.areas))
        if not self.line_names and len(self.lines):
            object.__setattr__(self, "line_names", ("",) * len(self.lines))


@frozen
class Provenance:
    """Where a file comes from: enough to make it again.

    ``recipe`` is the recipe's TOML text; ``processes`` are what the page went through for a machine;
    ``plugins`` are the packages, with their versions, that brought kinds which it uses.
    """

    recipe: str = ""
    seed: int = 0
    version: str = ""
    processes: tuple[str, ...] = ()
    plugins: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        check(self)


@frozen
class Plate:
    """What one layer of a page holds: whether there are any areas and any lines.

    A ``guide`` is no ink: marks for those who print and cut, outside the drawing, which plotters skip.
    ``pen`` is the number of the pen that draws it; where it is 0, the one after the layer's below.
    """

    ink: Ink
    areas: bool = True
    lines: bool = True
    guide: bool = False
    pen: int = 0


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


def dyeing_of(page: Page) -> Dyeing | None:
    """Return the baths that the cloth of a page goes through; a page need not know of any."""
    dyeing: Dyeing | None = getattr(page, "dyeing", None)
    return dyeing


@frozen(eq=False)
class Artwork:
    """A page of ink layers on cloth, in the normal form that :mod:`batik_vector.artwork` states.

    ``tolerance`` (mm) is how far any drawn edge may stand from the true curve. ``bleed`` (mm) is how
    far the geometry reaches beyond the cell on every side. ``borders`` are the stretches of the seam along
    which a mark's own border runs, so that it has no twin on the opposite edge: (ink, axis, from, to), the
    last two in grid steps along the left edge (axis 0) or the lower one (axis 1). ``facts`` are plain values
    on how it was made, for reports: how a toss came out, what a fit stretched. ``dyeing`` says which baths
    each ink stands for.
    """

    title: str
    cell: Cell
    layers: tuple[Layer, ...]
    cloth: str = "#ffffff"
    tolerance: float = 0.02
    bleed: float = 0.0
    provenance: Provenance = Provenance()
    borders: Annotated[frozenset[Border], Converted(_borders, "a set of (ink, axis, from, to)")] = frozenset()
    facts: Mapping[str, Any] = field(default_factory=dict)
    dyeing: Dyeing | None = None

    def __post_init__(self) -> None:
        check(self)

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


@frozen(eq=False)
class RawArtwork(Artwork):
    """A page as another program drew it: its marks may overlap, lie off the grid and reach beyond the cell.

    The certificate measures it as it shows; writers want it brought to the normal form first.
    """


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
