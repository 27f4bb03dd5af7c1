"""A sound tile built from plain shapes, and the tools to break it by hand.

The tile is 100 × 80 mm. A bar slopes over the left and right edges, a post stands over the lower and upper
ones, a diamond lies over the corner, a plain square inside; a second ink draws a slanting line over the
left and right edges and one up over the others. All of it has straight edges, so that places are known.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from fractions import Fraction
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, DropAxis, Geometries, Ink, Layer, Overlap, RawArtwork
from batik_vector.certificate import Certificate, Kind, SeamFault, certify
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.tiling.welding.stack import assemble

WIDTH, HEIGHT = 100.0, 80.0
WAX, PEN = Ink("wax", "#f4efe2"), Ink("pen", "#8c2f2b", width=0.8)
Points = NDArray[np.float64]
Shapes = Sequence[Any]
"""Each a sequence of points."""

AREAS = (
    # Its lower border crosses the seam at y = 20, the upper one at y = 26, both rising by 1 in 10.
    [(-30, 17), (30, 23), (30, 29), (-30, 23)],
    # It crosses the lower and upper edges from x = 60 to x = 64.
    [(60, -15), (64, -15), (64, 15), (60, 15)],
    [(-8, 0), (0, -6), (8, 0), (0, 6)],
    [(70, 40), (80, 40), (80, 50), (70, 50)],
)
# They cross the left and right edges at y = 60, the lower and upper ones at x = 30.
LINES = ([(-20, 56), (20, 64)], [(30, -20), (30, 10)])


def marks(shapes: Shapes) -> Geometries:
    return listed([shapely.Polygon(shape) for shape in shapes])


def strokes(shapes: Shapes) -> Geometries:
    return listed([shapely.LineString(shape) for shape in shapes])


def listed(geometries: Sequence[shapely.Geometry]) -> Geometries:
    found = np.empty(len(geometries), dtype=object)
    found[:] = geometries
    return found


def tile(drop: Fraction = Fraction(0), areas: Shapes = AREAS, lines: Shapes = LINES) -> Artwork:
    """The sound tile, cut by the package."""
    cell = Cell(100_000, 80_000, drop, DropAxis.COLUMN)
    sheets = [Sheet("bar", WAX, areas=marks(areas)), Sheet("thread", PEN, lines=strokes(lines))]
    layers, borders = assemble(sheets, [WAX, PEN], cell, cell.lattice, 0.02)
    return Artwork("tile", cell, layers, borders=borders)


def moved(artwork: Artwork, ink: str, change: Callable[[Points], Points]) -> Artwork:
    """The tile with the vertices of one ink changed; nothing is snapped."""

    def touched(geometries: Geometries) -> Geometries:
        if not len(geometries):
            return geometries
        return np.asarray(shapely.transform(geometries, lambda xy: change(xy.copy())), dtype=object)

    return with_layers(
        artwork,
        [
            Layer(layer.ink, touched(layer.areas), touched(layer.lines)) if layer.ink.name == ink else layer
            for layer in artwork.layers
        ],
    )


def vertex_moved(artwork: Artwork, ink: str, at: tuple[float, float], by: tuple[float, float]) -> Artwork:
    """The tile with the vertices of one ink at a place moved."""

    def change(xy: Points) -> Points:
        hit = (np.abs(xy - np.array(at)) < 1e-9).all(axis=1)
        assert hit.any(), f"no vertex at {at}"
        xy[hit] += np.array(by)
        return xy

    return moved(artwork, ink, change)


def with_layers(artwork: Artwork, layers: list[Layer]) -> Artwork:
    return as_read(replace(artwork, layers=tuple(layers)))


def as_read(artwork: Artwork) -> RawArtwork:
    """The tile as if it had been read from a foreign file, which keeps to no form."""
    return RawArtwork(**{each.name: getattr(artwork, each.name) for each in fields(Artwork)})


def only(artwork: Artwork, ink: str, keep: Callable[[Points], bool]) -> Artwork:
    """The tile with those marks of one ink whose bounds (left, bottom, right, top) are kept."""

    def kept(geometries: Geometries) -> Geometries:
        return (
            geometries[[keep(low) for low in shapely.bounds(geometries)]] if len(geometries) else geometries
        )

    return with_layers(
        artwork,
        [
            Layer(layer.ink, kept(layer.areas), kept(layer.lines)) if layer.ink.name == ink else layer
            for layer in artwork.layers
        ],
    )


def added(artwork: Artwork, ink: Ink, areas: Shapes = (), lines: Shapes = ()) -> Artwork:
    """The tile with more marks in one ink."""
    more = Layer(ink, marks(areas), strokes(lines))
    return with_layers(artwork, [*artwork.layers, more])


def far_apart(artwork: Artwork, fault: SeamFault, place: tuple[float, float]) -> float:
    """How far (mm) a fault is from a place, on the torus."""
    (ax, ay), (bx, by) = artwork.cell.lattice
    return min(
        float(
            np.hypot(
                fault.where[0] - place[0] + (i * ax + j * bx) / 1000,
                fault.where[1] - place[1] + (i * ay + j * by) / 1000,
            )
        )
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    )


def accused(artwork: Artwork, kind: Kind, place: tuple[float, float]) -> SeamFault:
    """Certify a broken tile; return its fault of a kind, which must lie within 1 mm of a place."""
    certificate = certify(artwork)
    assert not certificate.passed
    found = [fault for fault in certificate.faults if fault.kind == kind]
    assert found, f"no {kind} among {[str(fault.kind) for fault in certificate.faults]}"
    nearest = min(found, key=lambda fault: far_apart(artwork, fault, place))
    assert far_apart(artwork, nearest, place) < 1, nearest
    return nearest


def kinds(certificate: Certificate) -> set[str]:
    return {str(fault.kind) for fault in certificate.faults}


OVERLAY = replace(WAX, overlap=Overlap.OVERLAY)
