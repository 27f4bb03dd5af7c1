"""Small artworks to write, and what is true of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Layer, Overlap, Provenance
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
