"""What an image should be, found another way: dense samples of each edge, without refining or thinning."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.maps import FlameMap, Geometries
from batik_vector.geometry.maps.images.result import Images

Array = NDArray[np.float64]
Complexes = NDArray[np.complex128]


def array_of(*shapes: shapely.Geometry) -> Geometries:
    """Return shapes as an array."""
    found = np.empty(len(shapes), dtype=object)
    found[:] = shapes
    return found


def outlines(geometry: Any) -> list[Complexes]:
    """Return the rings of a polygon, or a line, as complex vertices."""
    parts = [geometry.exterior, *geometry.interiors] if geometry.geom_type == "Polygon" else [geometry]
    return [np.asarray(part.coords) @ np.array([1, 1j]) for part in parts]


def stations(start: complex, end: complex, count: int) -> Array:
    """Return parameters along an edge, evenly spread, and ever denser towards its point nearest to 0."""
    even = np.linspace(0, 1, count)
    step = end - start
    foot = 0.0 if step == 0 else min(max(-(start * np.conj(step)).real / abs(step) ** 2, 0.0), 1.0)
    graded = np.geomspace(1e-15, 1, count)
    every = np.concatenate([even, foot + (1 - foot) * graded, foot - foot * graded, [foot]])
    return np.unique(np.clip(every, 0.0, 1.0))


def edge_images(flame: FlameMap, geometry: shapely.Geometry, count: int = 100) -> list[Complexes]:
    """Return the dense image of every edge on every branch; angles follow each edge from its start."""
    found = []
    for z in outlines(geometry):
        for start, end in pairwise(z):
            a, b = flame.pre.at_complex(np.array([start, end]))
            t = stations(a, b, count)
            points = a + (b - a) * t
            reach = max(abs(a), abs(b))
            points[np.abs(points) < 1e-13 * reach] = 0
            live = np.flatnonzero(points != 0)
            for group in np.split(live, np.flatnonzero(np.diff(live) > 1) + 1):
                # With the zero before and after it, where the edge runs through the origin.
                run = points[max(group[0] - 1, 0) : group[-1] + 2]
                base = points[group[len(group) // 2]]
                angle = np.angle(base) + np.angle(run / base)
                found += [flame.post.at_complex(flame.core(run, angle, k)) for k in range(flame.branches)]
    return found


def as_lines(curves: Sequence[Complexes]) -> Geometries:
    """Return curves as LineStrings."""
    return array_of(
        *(shapely.LineString(np.column_stack([z.real, z.imag])) for z in curves if np.ptp(z) != 0)
    )


def farthest(points: Array, edges: Geometries) -> float:
    """Return the largest distance from any of the points to the nearest of the lines."""
    tree = shapely.STRtree(edges)
    marks = shapely.points(points)
    _, distance = tree.query_nearest(marks, return_distance=True, all_matches=False)
    return float(distance.max())


def stray(
    flame: FlameMap, geometry: shapely.Geometry, images: Images, count: int = 100
) -> tuple[float, float]:
    """Return how far images stand from the dense truth, and the truth from them.

    The first looks also inside the images' edges, at three points of each: an edge that leaps from one
    branch to another lies far from the truth though both its ends are right.
    """
    truth = edge_images(flame, geometry, count)
    drawn = [z for image in images.geometries for z in outlines(image)]
    inside = [z[:-1] + (z[1:] - z[:-1]) * part for z in drawn for part in (0, 0.21, 0.5, 0.79)]
    flat = np.concatenate(inside)
    dense = np.concatenate(truth)
    there = farthest(np.column_stack([flat.real, flat.imag]), as_lines(truth))
    back = farthest(np.column_stack([dense.real, dense.imag]), as_lines(drawn))
    return there, back


def julian_area(polygon: shapely.Polygon, power: int, exponent: float, rate: float) -> float:
    """Return the area of all branches together, by Green's theorem: |P1|·|m|/2 · ∮ r^(2q) dθ."""
    total = 0.0
    for ring in outlines(shapely.orient_polygons(polygon)):
        for start, end in pairwise(ring):
            z = start + (end - start) * stations(start, end, 400)
            z = z[np.abs(z) > 1e-14]
            sweep = np.angle(z[1:] * np.conj(z[:-1]))
            radius = np.abs(z) ** (2 * exponent)
            total += float(((radius[1:] + radius[:-1]) / 2 * sweep).sum())
    return abs(total) / 2 * abs(power) * abs(rate)


def optimum(curve: Complexes, tolerance: float) -> float:
    """Return ∫ √(κ/8ε) ds: the vertices that a smooth curve, given densely, needs at least."""
    step = np.diff(curve)
    turn = np.abs(np.angle(step[1:] * np.conj(step[:-1])))
    length = (np.abs(step[1:]) + np.abs(step[:-1])) / 2
    smooth = turn < 0.5
    return float(np.sqrt(turn[smooth] * length[smooth] / (8 * tolerance)).sum())


FULL = 2 * math.pi
