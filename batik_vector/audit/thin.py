"""Marks and holes that are narrow all over: no disc of the asked-for breadth fits in."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.audit.contours import Contours, Floats, Mask
from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen

FINE = 0.002
"""How closely (share of the breadth asked for) the largest disc that fits is found."""


@frozen(eq=False)
class Thin:
    """Contours that are narrow all over: which, the breadth of each (steps) and its place, and its length."""

    contour: Index
    breadth: Floats
    at: Floats
    length: Floats


def enclosed(contours: Contours, ends: Floats) -> tuple[Floats, Floats]:
    """Return the area that each contour encloses, negative for holes, nan for what encloses none; its length.

    Both in steps, the area squared.
    """
    if not len(contours):
        return np.empty(0), np.empty(0)
    first = contours.points[contours.starts[:-1]]
    base = np.repeat(first, np.diff(contours.starts), axis=0)
    a, b = contours.points - base, ends - base
    double = np.add.reduceat(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], contours.starts[:-1])
    length = np.add.reduceat(np.hypot(*(b - a).T), contours.starts[:-1])
    closes = contours.outline & contours.closed & (contours.shift == 0).all(axis=1)
    return np.where(closes, double / 2, np.nan), length


def thin(contours: Contours, which: Index, area: Floats, length: Floats, breadth: float) -> Thin:
    """Return those of some contours in which no disc of a diameter (steps) fits.

    Args:
        contours: all of them.
        which: closed ones.
        area: what each of all encloses.
        length: of each of all.
        breadth: the diameter.
    """
    # A disc fits in whose radius is the area over the outline's length, or a larger one.
    which = which[np.abs(area[which]) < breadth / 2 * length[which]]
    shapes = _shapes(contours, which)
    lost = shapely.is_empty(shapely.buffer(shapes, -breadth / 2, quad_segs=2))
    which, shapes = which[lost], shapes[lost]
    discs = [shapely.maximum_inscribed_circle(each, tolerance=FINE * breadth) for each in shapes]
    radius = np.array([disc.length for disc in discs])
    at = np.array([disc.coords[0] for disc in discs]).reshape(-1, 2)
    return Thin(which, 2 * radius, at, _lengths(np.abs(area[which]), length[which]))


def _shapes(contours: Contours, which: Index) -> Geometries:
    rings = [contours.points[contours.starts[i] : contours.starts[i + 1]] for i in which.tolist()]
    shapes = np.array([shapely.Polygon(ring) for ring in rings], dtype=object)
    broken: Mask = ~shapely.is_valid(shapes)
    shapes[broken] = shapely.make_valid(shapes[broken])
    return shapes


def _lengths(area: Floats, rim: Floats) -> Floats:
    """Return the length of a strip with so much area and so long a rim."""
    half = rim / 2
    return np.asarray((half + np.sqrt(np.maximum(half * half - 4 * area, 0.0))) / 2)
