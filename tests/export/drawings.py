"""Small artworks to write, and what is true of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from batik_vector.artwork import (
    Artwork,
    Cell,
    Geometries,
    Ink,
    Layer,
    Margins,
    Overlap,
    Plate,
    Provenance,
)
from batik_vector.geometry.outlines import Outlines
from batik_vector.units import on_grid

NASTY = (
    'title = "Ünïcode \U0001f33a ]]> <!-- -- & <b> \\" \'"\r\nlines = "CRLF"\r\nbare = "\r"\n\ttab\n'
    "@ENTITIES@ %d {x} EOF\n  0\nENDSEC\n  \n" + "# padding ä\n" * 8000
)


MADE = Provenance("motif = 1\n", 7, "0.1.0")


def geometries(*shapes: BaseGeometry) -> Geometries:
    """Shapes on the grid, rings oriented as the normal form asks."""
    out = np.empty(len(shapes), object)
    out[:] = [shapely.orient_polygons(shape) if shape.geom_type == "Polygon" else shape for shape in shapes]
    return np.asarray(shapely.transform(out, on_grid), dtype=object)


def disc(x: float, y: float, radius: float, hole: float = 0.0) -> BaseGeometry:
    centre = shapely.Point(x, y)
    return centre.buffer(radius).difference(centre.buffer(hole)) if hole else centre.buffer(radius)


def line(*points: Sequence[float]) -> BaseGeometry:
    return shapely.LineString(points)


def sample(bleed: float = 0.0, provenance: Provenance = MADE, title: str = "Kawung") -> Artwork:
    """Three inks: areas with and without holes; lines open and closed; both at once."""
    wax = Layer(
        Ink("wax", "#f4efe2"),
        areas=geometries(disc(12, 10, 8, 5), disc(30, 20, 6.5)),
        area_names=("flower.petal", "flower.core"),
    )
    soga = Layer(
        Ink("soga brown", "#a03020", 0.4),
        lines=geometries(
            line((1, 1), (39, 1), (39, 3.5)),
            line((2, 25), (6, 25), (4, 28), (2, 25)),
            line((5, 5), (9, 5.25)),
        ),
        line_names=("stem", "ring", "stem"),
    )
    both = Layer(
        Ink("Indigo/2", "#1d2f5f", 1.25),
        areas=geometries(shapely.box(20, 2, 26, 4)),
        lines=geometries(line((20, 6), (26, 6.125))),
        area_names=("bar",),
        line_names=("bar",),
    )
    return Artwork(title, Cell(40_000, 30_000), (wax, soga, both), "#123456", 0.02, bleed, provenance)


def stacked() -> Artwork:
    """Two overlapping marks of an ink that overlays."""
    marks = geometries(shapely.box(1, 1, 6, 6), shapely.box(4, 4, 9, 9))
    return Artwork(
        "stack", Cell(10_000, 10_000), (Layer(Ink("w", "#ff0000", 1, Overlap.OVERLAY), areas=marks),)
    )


def empty() -> Artwork:
    """No layers at all."""
    return Artwork("", Cell(10_000, 10_000), ())


def area_of(artwork: Artwork, ink: int) -> float:
    return float(shapely.area(artwork.layers[ink].areas).sum())


def length_of(artwork: Artwork, ink: int) -> float:
    return float(shapely.length(artwork.layers[ink].lines).sum())


@dataclass(frozen=True)
class InPieces:
    """An artwork as a page that comes ring by ring, polygons with holes in several pieces.

    ``guides`` adds a layer that no pen draws; ``margins`` are the artwork's where they are not given.
    """

    artwork: Artwork
    rings: int = 1
    guides: Outlines | None = None
    own_margins: Margins | None = None

    @property
    def title(self) -> str:
        return self.artwork.title

    @property
    def cell(self) -> Cell:
        return self.artwork.cell

    @property
    def margins(self) -> Margins:
        return self.own_margins or self.artwork.margins

    @property
    def bleed(self) -> float:
        return self.artwork.bleed

    @property
    def cloth(self) -> str:
        return self.artwork.cloth

    @property
    def tolerance(self) -> float:
        return self.artwork.tolerance

    @property
    def provenance(self) -> Provenance:
        return self.artwork.provenance

    @property
    def vertex_count(self) -> int:
        return self.artwork.vertex_count

    @property
    def plates(self) -> tuple[Plate, ...]:
        marks = Plate(Ink("marks", "#000000", 0.2), areas=False, lines=True, guide=True)
        return self.artwork.plates + ((marks,) if self.guides else ())

    def areas(self, number: int) -> Iterator[Outlines]:
        if number < len(self.artwork.plates):
            yield from pieces(self.artwork.areas(number), self.rings)

    def lines(self, number: int) -> Iterator[Outlines]:
        if number < len(self.artwork.plates):
            yield from pieces(self.artwork.lines(number), self.rings)
        elif self.guides is not None:
            yield self.guides


def pieces(whole: Iterator[Outlines], rings: int) -> Iterator[Outlines]:
    """Cut outlines after every so many rings, wherever that is."""
    for outlines in whole:
        count = len(outlines.closed)
        for first, stop in pairwise([*range(0, count, rings), count]):
            marks = [first, *(m for m in outlines.marks.tolist() if first < m < stop), stop]
            owner = np.searchsorted(outlines.marks, marks[:-1], side="right") - 1
            points = slice(outlines.rings[first], outlines.rings[stop])
            yield replace(
                outlines,
                points=outlines.points[points],
                rings=outlines.rings[first : stop + 1] - outlines.rings[first],
                marks=np.array(marks) - first,
                closed=outlines.closed[first:stop],
                names=[outlines.names[mark] for mark in owner],
                unfinished=stop not in outlines.marks,
            )
