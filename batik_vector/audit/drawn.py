"""What an artwork draws, ink by ink, as contours on the torus.

What is in the normal form is taken as it is. What another program drew, what reaches beyond the page, and
inks whose marks lie over one another are first joined, as the seam certificate does.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Layer, Overlap, RawArtwork
from batik_vector.audit.contours import Borders, Contours, contours
from batik_vector.certificate.drawing import Edges, Frame, InkDrawing, drawing
from batik_vector.geometry.outlines import MM, Outlines, nothing, of_polygons, of_polylines, together
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen


@frozen(eq=False)
class DrawnInk:
    """One ink on a page: its contours, and the breadth in mm of its lines.

    ``strokes`` is what a page shows whose lines may lie off the grid.
    """

    name: str
    width: float
    contours: Contours
    strokes: InkDrawing | None = None


def drawn(artwork: Artwork, cuts: bool = False) -> tuple[Frame, list[DrawnInk]]:
    """Return the page in steps, and what each ink draws on it.

    Args:
        artwork: a tile.
        cuts: whether lines are cuts, which have no breadth.

    Raises:
        GeometryError: where a coordinate is not finite.
    """
    loose = isinstance(artwork, RawArtwork) or artwork.bleed > 0
    if loose or any(layer.ink.overlap == Overlap.OVERLAY for layer in artwork.layers):
        return _joined(artwork, cuts)
    frame = Frame(artwork.cell, STEPS_PER_MM, True)
    return frame, [_as_is(layer, artwork, frame, cuts) for layer in artwork.layers]


def _as_is(layer: Layer, artwork: Artwork, frame: Frame, cuts: bool) -> DrawnInk:
    areas, lines = of_polygons(layer.areas, MM), of_polylines(layer.lines, MM)
    own = _borders(artwork, layer.ink.name, 1)
    body = 0.0 if cuts else layer.ink.width
    return DrawnInk(layer.ink.name, layer.ink.width, contours(areas, lines, body, frame, own))


def _joined(artwork: Artwork, cuts: bool) -> tuple[Frame, list[DrawnInk]]:
    tile = drawing(artwork)
    frame = tile.frame
    inks = []
    for ink in tile:
        areas = of_polygons(np.asarray(shapely.orient_polygons(ink.areas), dtype=object))
        own = _borders(artwork, ink.ink.name, frame.per_mm // STEPS_PER_MM)
        body = 0.0 if cuts else ink.ink.width
        joined = contours(areas, _polylines(ink.strokes), body, frame, own)
        inks.append(DrawnInk(ink.ink.name, ink.ink.width, joined, None if frame.exact else ink))
    return frame, inks


def _borders(artwork: Artwork, ink: str, finer: int) -> Borders:
    own = sorted(
        (axis, low * finer, high * finer) for name, axis, low, high in artwork.borders if name == ink
    )
    return np.array(own, np.int64).reshape(-1, 3)


def _polylines(strokes: Edges) -> Outlines:
    """Return edges as the polylines that they make up, cut where the page cuts them."""
    if not len(strokes):
        return nothing()
    goes_on = (strokes.owner[1:] == strokes.owner[:-1]) & (strokes.begin[1:] == strokes.end[:-1]).all(axis=1)
    first = np.flatnonzero(np.append(True, ~goes_on))
    stop = np.append(first[1:], len(strokes))
    parts = [
        np.concatenate([strokes.begin[low:high], strokes.end[high - 1 : high]])
        for low, high in zip(first, stop, strict=True)
    ]
    return together([_polyline(points) for points in parts])


def _polyline(points: np.ndarray[tuple[int, int], np.dtype[np.int64]]) -> Outlines:
    shut = len(points) > 3 and bool((points[0] == points[-1]).all())
    points = points[:-1] if shut else points
    ends = np.array([0, len(points)])
    return Outlines(points, ends, np.array([0, 1]), np.array([shut]))
