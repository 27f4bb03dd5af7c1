"""Figures: the elements of a motif sampled and settled as geometry, in motif units."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import shapely

from batik_vector.errors import TooLargeError, shortened
from batik_vector.geometry import work
from batik_vector.geometry.curves import Curve, trace
from batik_vector.geometry.ifs import distinct
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.maps.affines import ONE, Affines, turns
from batik_vector.geometry.regions import FillRule, oriented, settle
from batik_vector.geometry.sampling import Array, Geometries, Points
from batik_vector.recipe.drawing import Part, Svg
from batik_vector.recipe.motif import Element, Motif, Ring
from batik_vector.values import frozen

PER_CROSSING, ALL_PER_CROSSING = 25.0, 300.0
"""What a crossing of contours costs that lie over one another by turns, where each is a corner of four faces;
and what it costs in all until it lies in a tile, cut and welded: 290 and 790 were measured."""

MANY_CROSSINGS = 2_000
"""Crossings of contours past which all are settled at once: two by two they cost the square of the faces."""


@frozen
class Figure:
    """An element as geometry, in motif units: ``areas`` filled, ``lines`` its centre lines."""

    element: Element | Part
    areas: Geometries
    lines: Geometries
    frames: Affines = ONE
    """Where the copies of its curve are set: each has as many of the areas, one copy's together."""


def draw(motif: Motif, tolerance: float | Callable[[Points], Array]) -> list[Figure]:
    """Sample and settle every element of a motif.

    Args:
        motif: in its own units.
        tolerance: in motif units; or a function of places in the motif, shape (n, 2) → (n,).

    Returns:
        One figure per element, bottom first. Line and region of an element share their vertices.

    Raises:
        TooLargeError: where a curve crosses itself too often to be filled.
    """
    if isinstance(motif, Svg):
        return [Figure(*shape) for shape in motif.shapes(tolerance)]
    return [_named(element, tolerance) for element in motif.parts()]


def size_of(motif: Motif) -> float:
    """Return about how far a motif reaches from its middle, in its units: 1 for those of the paper's size."""
    if isinstance(motif, Svg):
        return motif.size
    # What is drawn by hand has any size; curves of a formula have the paper's.
    outlines = [(part, part.curve.outline()) for part in motif.parts()]
    reaches = [
        abs(part.radius) + float(np.abs(outline.points).max()) if outline else 1.0
        for part, outline in outlines
    ]
    return max(reaches)


def _named(element: Element, tolerance: float | Callable[[Points], Array]) -> Figure:
    try:
        return _draw(element, tolerance)
    except TooLargeError as error:
        known = f'element "{shortened(element.name)}"' if element.name else "an element without a name"
        contours = f", contours = {element.contours}" if element.contours > 1 else ""
        kind = type(element.curve).__name__.lower().removesuffix("curve")
        raise TooLargeError(f"{known} ({kind}{contours}): {error}") from None


def _draw(element: Element, tolerance: float | Callable[[Points], Array]) -> Figure:
    if not callable(tolerance):
        look = element.curve, element.fill, element.contours, tolerance
        return Figure(element, *_copied(look, element.ring))
    return Figure(element, *_told(element.curve, element.fill, element.contours, element.ring, tolerance))


@functools.lru_cache(maxsize=32)
def _told(
    curve: Curve, fill: FillRule, contours: int, ring: Ring, tolerance: Callable[[Points], Array]
) -> tuple[Geometries, Geometries, Affines]:
    """Return areas and lines of a curve and its copies by a tolerance told place by place. Kept, too."""
    copies = copies_of(*ring)

    def everywhere(points: Points) -> Array:
        return np.asarray(np.min([tolerance(images) for images in copies.at(points)], axis=0))

    areas, lines = _outlined(curve, fill, contours, everywhere)
    reach = float(np.min(everywhere(shapely.get_coordinates(lines))))
    return _unchanging(*_turned(areas, lines, copies, reach))


Look: TypeAlias = tuple[Curve, FillRule, int, float]
"""What a curve's geometry hangs on: the curve, its fill rule, its contours, the tolerance."""


def copies_of(
    count: int, radius: float, turn: float, arc: float, spin: float, mirror: bool, poses: bytes = b""
) -> Affines:
    """Return where the copies of an element are drawn, at each of its poses: see :class:`Element`."""
    shift = Affine.translation((radius, 0)) @ Affine.turn(spin)
    turned = turns([turn + arc * k / count for k in range(count)])
    copies = (turned.after(Affines.of([IDENTITY, Affine.mirror(0)])) if mirror else turned) @ shift
    return Affines(np.frombuffer(poses).reshape(-1, 6)).after(copies) if poses else copies


@functools.lru_cache(maxsize=128)
def _copied(look: Look, ring: Ring) -> tuple[Geometries, Geometries, Affines]:
    """Return areas and lines of a curve and its copies. Kept: who turns one knob draws the rest again."""
    return _unchanging(*_turned(*_alone(look), copies_of(*ring), look[-1]))


def _unchanging(
    areas: Geometries, lines: Geometries, frames: Affines
) -> tuple[Geometries, Geometries, Affines]:
    """Return arrays that nobody writes into: others are given the same."""
    for marks in (areas, lines):
        marks.flags.writeable = False
    return areas, lines, frames


@functools.lru_cache(maxsize=128)
def _alone(look: Look) -> tuple[Geometries, Geometries]:
    return _outlined(*look)


def _outlined(
    curve: Curve, fill: FillRule, contours: int, tolerance: float | Callable[[Points], Array]
) -> tuple[Geometries, Geometries]:
    """Return the region and the centre lines of a curve."""
    traced = trace(curve, tolerance)
    scales = [k / contours for k in range(contours, 0, -1)]
    lines = np.array(
        [shapely.linestrings(strand * k) for strand in traced.strands for k in scales], dtype=object
    )
    areas = np.empty(0, dtype=object)
    if traced.rings:
        region = settle(traced.rings, fill) if traced.areas is None else traced.areas
        areas = _bands([Affine.scale(k).apply(region) for k in scales])
    return areas, lines


def _turned(
    areas: Geometries, lines: Geometries, copies: Affines, reach: float
) -> tuple[Geometries, Geometries, Affines]:
    """Return the copies of an element that differ."""
    kept = distinct(copies, [np.concatenate([areas, lines])], reach)
    return kept.apply(areas), kept.apply(lines), kept


def _bands(nested: list[Geometries]) -> Geometries:
    """Return every other band between nested contours, the outermost filled."""
    if len(nested) == 1:
        return nested[0]
    rings = shapely.get_rings(np.concatenate(nested))
    crossings = work.self_crossings(rings)
    if crossings > MANY_CROSSINGS:
        # Thousands of faces are put together at one go, and not over and over again.
        vertices = float(shapely.get_num_coordinates(rings).sum())
        work.foretell(vertices, crossings, per_crossing=ALL_PER_CROSSING)
        return settle([shapely.get_coordinates(ring) for ring in rings], FillRule.EVENODD)
    # Two by two, and these two by two again: one after another, each would be overlaid with all before it.
    total = np.array([shapely.union_all(part) for part in nested], dtype=object)
    while len(total) > 1:
        pairs = len(total) // 2
        joined = shapely.symmetric_difference(total[: 2 * pairs : 2], total[1 : 2 * pairs : 2])
        work.spend_on_union(total[: 2 * pairs], joined, per_crossing=PER_CROSSING)
        total = np.concatenate([joined, total[2 * pairs :]])
    # Where bands meet in a point a hair of line may be left.
    parts = shapely.get_parts(total)
    return oriented(parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON])
