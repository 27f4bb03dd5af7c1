"""What is cut out of a page: the regions of each ink, lines with the body that the ink gives them."""

from __future__ import annotations

import math

import numpy as np
import shapely

from batik_vector.artwork import Ink
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Outlines, to_polygons, to_polylines
from batik_vector.geometry.regions import FillRule, polygonal, settle
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.choices import LineBodies
from batik_vector.processes.cutting.overlays import meeting, on_grid, united
from batik_vector.units import STEPS_PER_MM

SAG = 0.5
"""Steps by which chords about the ends of lines may lie within their arcs."""
LEAST = 16
"""Chords of a quarter of such an arc, at least: fine lines would lose some of their breadth."""


def regions_of(areas: Outlines, strokes: Outlines, ink: Ink, lines: LineBodies) -> tuple[Geometries, int]:
    """Return what an ink covers as polygons that do not overlap, in steps, and how many lines became areas.

    Args:
        areas: its areas.
        strokes: its lines.
        ink: the ink.
        lines: what becomes of them.

    Raises:
        GeometryError: where there are open lines and they are refused, or their ink has no breadth.
    """
    filled = to_polygons(areas)
    if lines is LineBodies.SKIP or not len(strokes):
        return welded(filled), 0
    if lines is LineBodies.REFUSE:
        return welded(np.concatenate([filled, _outlined(strokes, ink.name)])), 0
    if not ink.width > 0:
        raise GeometryError(
            f'lines = "body", expected ink "{ink.name}" to be broader than 0: its {len(strokes)} lines have '
            'no body to cut round; give it a width, or say lines = "skip"'
        )
    radius = ink.width * STEPS_PER_MM / 2
    body = shapely.buffer(to_polylines(strokes), radius, quad_segs=_chords(radius))
    return welded(np.concatenate([filled, body])), len(strokes)


def _chords(radius: float) -> int:
    """Return into how many chords a quarter of a circle is divided."""
    return max(LEAST, math.ceil(round(math.pi / 4 / math.acos(max(1 - SAG / radius, 0.5)), 6)))


def _outlined(strokes: Outlines, ink: str) -> Geometries:
    """Return the areas that closed lines enclose: what lies in one and in no other, and so on inward."""
    opened = np.flatnonzero(~strokes.closed)
    if len(opened):
        x, y = (strokes.points[strokes.rings[opened[0]]] / STEPS_PER_MM).tolist()
        raise GeometryError(
            f'lines = "refuse", expected closed lines alone: {len(opened)} of ink "{ink}" are open, the '
            f'first begins at ({x:.3f}, {y:.3f}) mm; lines = "body" cuts round them as broad as their ink '
            'is, lines = "skip" leaves them out'
        )
    points, rings = strokes.repeating()
    return settle(np.split(points.astype(float), rings[1:-1]), FillRule.EVENODD)


def welded(areas: Geometries) -> Geometries:
    """Return polygons as polygons that do not overlap and share no edge, on the grid; all valid."""
    good = areas[~shapely.is_empty(areas)]
    if len(good) < 2 and shapely.is_valid(good).all():
        return on_grid(good)
    if not shapely.is_valid(good).all():
        good = polygonal(shapely.make_valid(good, method="structure"))
    near = meeting(good)
    if not near.any():
        return on_grid(good)
    return np.concatenate([on_grid(good[~near]), united(good[near])])
