"""The fills of a motif's elements (*isen-isen*): what is seen of each, filled in the plane of its curve.

Marks become figures of the motif, so that whatever sets out the motif sets them out with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import shapely

from batik_vector.artwork import Ink
from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.fills.insets import Parts
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Array, Geometries, Indices
from batik_vector.recipe.drawing import Part, Svg
from batik_vector.recipe.figures import Figure
from batik_vector.recipe.fills import Fill, Room
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.recipe.motif import Element, Motif
from batik_vector.recipe.placement import Placement

FILLED = (Treatment.AREA, Treatment.BOTH)
LINED = (Treatment.LINE, Treatment.STROKE, Treatment.BOTH)

ALIKE = 1e-6
"""In mm: regions whose corners differ by less in the planes of their curves are filled alike."""

CRUMB = 1e-6
"""In mm²: areas by which regions that only touch may overlap in floats."""


class Work(NamedTuple):
    """What fills hang on beside the motif: ``tolerance`` in mm, ``limit`` in vertices; ``turns`` is the order
    of the turns about the motif's centre that its place asks for.
    """

    placement: Placement
    inks: Mapping[str, Ink]
    tolerance: float
    seed: int
    limit: int
    turns: int = 1


def has_fills(motif: Motif, placement: Placement) -> bool:
    """Whether anything of a motif is filled with marks."""
    return placement.fill_with is not None or any(part.fill_with for part in motif.parts())


def filled(
    figures: Sequence[Figure], name: str, motif: Motif, copies: Affines, times: int, work: Work
) -> list[Figure]:
    """Return figures of a motif, bottom first, and over each the marks that fill it.

    Args:
        figures: of the motif, in its units.
        name: of the motif.
        motif: itself.
        copies: to mm on cloth; lengths of a fill are those of the largest.
        times: how often these are drawn again.
        work: what else fills hang on.

    Raises:
        GeometryError: where a fill that was asked for is empty.
        TooLargeError: where the marks of all copies are past the limit.
    """
    if not has_fills(motif, work.placement):
        return list(figures)
    found, over, count = list[Figure](), np.empty(0, dtype=object), 0
    bare, laid = dict[Fill, GeometryError](), set[Fill]()
    scale, drawn = float(copies.stretches.max()), len(copies) * times
    for figure, key in zip(reversed(figures), reversed(motif.keys()), strict=True):
        fill, own = _fill_of(figure.element, work.placement)
        if fill is not None and len(figure.areas):
            where = ".".join(filter(None, ("motif", name, key, "fill_with"))) if own else "fill_with"
            isen = _isen(figure, fill, over, where, scale, work)
            if len(isen.areas):
                laid.add(fill)
            elif own and not fill.may_be_none:
                bare.setdefault(fill, GeometryError(_empty_in(figure, fill, where, scale)))
            count += int(shapely.get_num_coordinates(isen.areas).sum())
            if count * drawn > work.limit:
                raise TooLargeError(
                    f"{where}.spacing = {fill.spacing:g}: about {count * drawn:,} vertices in all copies, "
                    f"past the limit of {work.limit:,}: expected a larger spacing"
                )
            found += [isen] if len(isen.areas) else []
        found.append(figure)
        over = np.concatenate([over, _hiding(figure, scale, work)])
    # What means several marks of a drawing may find no room in some of them.
    for fill, error in bare.items():
        if not (isinstance(motif, Svg) and fill in laid):
            raise error
    if work.placement.fill_with is not None and len(found) == len(figures):
        raise GeometryError(_empty(work.placement.fill_with, "fill_with", "any element of the motif", 0.0))
    return found[::-1]


def _fill_of(element: Dress, placement: Placement) -> tuple[Fill | None, bool]:
    """Return what fills an element, and whether it says so itself."""
    if element.fill_with is not None:
        return element.fill_with, True
    return (None if element.treatment == Treatment.CUT else placement.fill_with), False


def _isen(figure: Figure, fill: Fill, over: Geometries, where: str, scale: float, work: Work) -> Figure:
    """Return the marks of one element as a figure."""
    areas = Affine.scale(scale).apply(figure.areas)
    frames = Affines(figure.frames.rows * np.array([1, 1, 1, 1, scale, scale]))
    each = len(areas) // len(frames)
    regions, of = _seen(areas, np.arange(len(areas)) // each, _body(figure, scale, work), over)
    try:
        marks = _laid(fill, regions, frames.taken(of), work)
    except TooLargeError as error:
        raise TooLargeError(f"{where}.{error}") from None
    look = _look(figure.element, fill, where, work)
    return Figure(look, Affine.scale(1 / scale).apply(marks), figure.lines[:0])


def _empty_in(figure: Figure, fill: Fill, where: str, scale: float) -> str:
    depth = scale * shapely.length(shapely.maximum_inscribed_circle(figure.areas)).max()
    return _empty(fill, where, figure.element.name or "the element", float(depth))


def _empty(fill: Fill, where: str, what: str, depth: float) -> str:
    deep = f", {depth:.3g} mm from its edge to its middle at most" if depth else ""
    return (
        f'{where}.margin = {fill.margin:g}: no mark of "{fill.kind}" has room within {what}{deep}, '
        "expected a smaller margin or smaller marks"
    )


def _look(element: Element | Part, fill: Fill, where: str, work: Work) -> Part:
    """Return how the marks of a fill are drawn: bare in what is filled, unless they have an ink."""
    name = f"{element.name}.{fill.kind}" if element.name else fill.kind
    whole = fill.whole or element.whole
    if not fill.ink and element.treatment in FILLED:
        return Part(name=name, treatment=Treatment.CUT, whole=whole)
    ink = fill.ink or element.ink
    beneath = element.ink or work.placement.ink or next(iter(work.inks))
    if element.treatment in FILLED and ink == beneath:
        raise GeometryError(
            f'{where}.ink = "{ink}": the element itself is filled with that ink, so that no mark would show: '
            'leave it out for marks that stay bare, or give the element treatment = "stroke"'
        )
    return Part(name=name, ink=ink, gap=0.0, whole=whole)


def _seen(
    areas: Geometries, frame: Indices, body: Geometries, over: Geometries
) -> tuple[Geometries, Indices]:
    """Return what of areas is to be seen under what lies over them, and the frame of each part.

    What two of the areas share belongs to neither.
    """
    hiding = _near(np.concatenate([body, over]), areas)
    left = np.array(areas, dtype=object)
    if len(hiding):
        left = shapely.difference(left, shapely.union_all(hiding))
    a, b = shapely.STRtree(areas).query(areas)
    pairs = a != b
    shared = shapely.area(shapely.intersection(areas[a[pairs]], areas[b[pairs]])) > CRUMB
    for one, other in zip(a[pairs][shared].tolist(), b[pairs][shared].tolist(), strict=True):
        left[one] = shapely.difference(left[one], areas[other])
    parts, of = shapely.get_parts(left, return_index=True)
    solid = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & (shapely.area(parts) > CRUMB)
    return oriented(parts[solid]), frame[of[solid]]


def _near(marks: Geometries, areas: Geometries) -> Geometries:
    """Return those of some marks whose boxes meet the box of areas: drawings have thousands."""
    if not len(marks) or not len(areas):
        return marks[:0]
    left, low, right, high = shapely.total_bounds(areas)
    box = shapely.bounds(marks)
    off = (box[:, 0] > right) | (box[:, 2] < left) | (box[:, 1] > high) | (box[:, 3] < low)
    return np.asarray(marks[~off], dtype=object)


def _body(figure: Figure, scale: float, work: Work) -> Geometries:
    """Return the bodies of a figure's own lines, in mm, where it has any."""
    element = figure.element
    if element.treatment not in LINED or not len(figure.lines):
        return figure.lines[:0]
    half = _pen(element, work) / 2
    lines = Affine.scale(scale).apply(figure.lines)
    return np.asarray(shapely.buffer(lines, half, quad_segs=16), dtype=object)


def _hiding(figure: Figure, scale: float, work: Work) -> Geometries:
    """Return what a figure hides of those beneath it, in mm."""
    element, shapes = figure.element, [_body(figure, scale, work)]
    if element.treatment not in (Treatment.LINE, Treatment.STROKE) or element.gap is not None:
        shapes.append(Affine.scale(scale).apply(figure.areas))
    found = np.concatenate(shapes)
    return np.asarray(shapely.buffer(found, element.gap), dtype=object) if element.gap else found


def _pen(element: Dress, work: Work) -> float:
    ink = work.inks.get(element.line_ink or element.ink or work.placement.ink)
    return ink.width if ink else max(each.width for each in work.inks.values())


def _laid(fill: Fill, regions: Geometries, frames: Affines, work: Work) -> Geometries:
    """Return the marks of regions, in mm, each filled in the plane of its frame, congruent ones alike."""
    if not len(regions):
        return regions
    back = _inverse(frames)
    local = oriented(_mapped(regions, back, np.arange(len(regions))))
    first, like = _alike(local)
    parts = Parts(local[first], np.arange(len(first), dtype=np.intp))
    room = Room(parts, back.shifts[first], work.turns, work.tolerance, work.seed)
    marks, region = fill.lay(room)
    order = np.argsort(region, kind="stable")
    marks, region = marks[order], region[order]
    low = np.searchsorted(region, like)
    count = np.searchsorted(region, like, side="right") - low
    copy = np.repeat(np.arange(len(like)), count)
    mark = low[copy] + np.arange(len(copy)) - np.repeat(np.cumsum(count) - count, count)
    return polygonal(oriented(_mapped(marks[mark], frames, copy)))


def _inverse(maps: Affines) -> Affines:
    a, b, c, d, e, f = maps.rows.T
    det = maps.determinants
    rows = d, -b, -c, a, b * f - d * e, c * e - a * f
    return Affines(np.column_stack([row / det for row in rows]))


def _mapped(marks: Geometries, maps: Affines, which: Indices) -> Geometries:
    """Return marks, each under the map of that number."""
    points, of = shapely.get_coordinates(marks, return_index=True)
    a, b, c, d, e, f = maps.rows[which[of]].T
    x, y = points.T
    moved: Array = np.column_stack([a * x + b * y + e, c * x + d * y + f])
    return np.asarray(shapely.set_coordinates(np.array(marks, dtype=object), moved), dtype=object)


def _alike(regions: Geometries) -> tuple[Indices, Indices]:
    """Return the numbers of regions that differ, and for each region which of those it is like."""
    known: dict[bytes, int] = {}
    first, like = list[int](), list[int]()
    for number, region in enumerate(shapely.normalize(regions)):
        corners = np.floor(shapely.get_coordinates(region) / ALIKE + 0.382).astype(np.int64)
        key = corners.tobytes()
        if key not in known:
            known[key] = len(first)
            first.append(number)
        like.append(known[key])
    return np.array(first, np.intp), np.array(like, np.intp)
