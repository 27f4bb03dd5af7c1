"""Small pictures of pages, as fragments of SVG: coarse outlines on whole units, ink by ink."""

from __future__ import annotations

import io

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Geometries, Layer, Page
from batik_vector.values import frozen

UNITS = 1600
"""Units along a picture's longer side: a tenth of a millimetre on a large sheet."""
COARSE = 0.6
"""How far in units a picture may stand from the page."""
MOST_VERTICES = 4_000_000
"""Vertices of a page past which only its ground is shown."""


@frozen
class Thumbnail:
    """A picture ``width`` × ``height`` units large, y down; ``marks`` are elements of SVG."""

    width: int
    height: int
    cloth: str
    marks: str


def thumbnail(page: Page) -> Thumbnail:
    """Return a page's picture, trimmed to its cell."""
    scale = UNITS / max(page.cell.width, page.cell.height)
    width, height = (max(1, round(side * scale)) for side in (page.cell.width, page.cell.height))
    marks = "".join(_layer(layer, scale, height) for layer in _layers(page))
    return Thumbnail(width, height, page.cloth, marks)


def _layers(page: Page) -> tuple[Layer, ...]:
    if isinstance(page, Artwork):
        return page.layers
    if page.vertex_count > MOST_VERTICES:
        return ()
    from batik_vector.tiling.cloth.field import collected

    return collected(page).layers


def _layer(layer: Layer, scale: float, height: int) -> str:
    colour, told = layer.ink.colour, ""
    if areas := _data(layer.areas, scale, height, "Z"):
        told += f'<path fill="{colour}" d="{areas}"/>'
    if lines := _data(layer.lines, scale, height, ""):
        look = f'stroke-width="{layer.ink.width * scale:.1f}" stroke-linecap="round" stroke-linejoin="round"'
        told += f'<path fill="none" stroke="{colour}" {look} d="{lines}"/>'
    return told


def _data(marks: Geometries, scale: float, height: int, end: str) -> str:
    """Return path data. Holes run the other way round, so that either rule fills them alike."""
    if not len(marks):
        return ""
    coarse = shapely.simplify(marks, COARSE / scale, preserve_topology=False)
    # What is smaller than a unit leaves nothing; a square of one stands for it.
    gone = shapely.is_empty(coarse)
    coarse[gone] = shapely.box(*shapely.bounds(marks[gone]).T)
    rings = shapely.get_rings(coarse) if end else shapely.get_parts(coarse)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    points = np.rint(points * (scale, -scale) + (0, height)).astype(np.int64)
    kept = np.append(True, (np.diff(points, axis=0) != 0).any(axis=1) | (np.diff(ring) != 0))
    points, ring = points[kept], ring[kept]
    starts = np.flatnonzero(np.append(True, np.diff(ring) != 0)).tolist()
    told = io.StringIO()
    places = [f"{x} {y}" for x, y in points.tolist()]
    for first, stop in zip(starts, [*starts[1:], len(places)], strict=True):
        last = stop - 1 if end and stop - first > 1 else stop
        told.write("M" + " ".join(places[first:last]) + end)
    return told.getvalue()
