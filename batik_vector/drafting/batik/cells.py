"""What a drawing is to a batik maker: cells that lie side by side, each to be filled, and lines between them.

Each cell is what is seen of one thing painted. Thin strokes are lines; what lines alone close round becomes a
cell as well, broad strokes and whatever is filled are cells themselves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.errors import GeometryError
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.paths.outline import joined
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.importing.drawing.marks import Mark
from batik_vector.importing.drawing.shapes import Shapes
from batik_vector.values import frozen

MOST_NODES = 200_000
"""Nodes of a drawing past which it is refused."""
MOST_CELLS = 4_000
"""Cells past which a drawing is a picture, and no motif."""
BROAD = 2.6
"""mm on cloth from which a stroke is no line but an area."""
CRUMB = 0.3
"""mm: cells less deep than that are left out; a canting draws no such thing."""
JOIN = 0.012
"""Share of the drawing's larger side across which ends of lines are joined to the nearest line."""
LEAST_LINE = 1.2
"""mm: shorter rests of lines are left out."""
FINE = 0.02
"""mm on cloth: how far what is taken over may stand from the drawing."""


@frozen(eq=False)
class Cell:
    """Something to be filled: its ``shape`` in mm on cloth, its colour where it has one, and its name."""

    shape: shapely.Polygon
    colour: str
    name: str
    depth: float


@frozen(eq=False)
class Cells:
    """The cells of a drawing, bottom first, and the lines that border none of them, in mm on cloth."""

    cells: tuple[Cell, ...]
    lines: Geometries


def cells_of(marks: Sequence[Mark], scale: float) -> Cells:
    """Return the cells and the lines of a drawing.

    Args:
        marks: what it paints, bottom first, in its own mm.
        scale: mm on cloth of one of those.

    Raises:
        GeometryError: where it is far too large, or closes round nothing.
    """
    nodes = len(joined([mark.outline for mark in marks]).points)
    if nodes > MOST_NODES:
        raise GeometryError(
            f"{nodes:,} nodes, expected at most {MOST_NODES:,}: simplify it first (Inkscape: Path → Simplify)"
        )
    if len(marks) > MOST_CELLS:
        raise _picture(len(marks))
    larger = Affine.scale(scale)
    painted = list(_painted(marks, scale))
    areas = [(larger.apply(shapes), colour, name) for shapes, colour, name in painted]
    lines = larger.apply(_thin(marks, scale))
    if sum(len(shapes) for shapes, _, _ in areas) > MOST_CELLS:
        raise _picture(sum(len(shapes) for shapes, _, _ in areas))
    seen = _seen(areas)
    found = list(_deep(seen))
    faces, rest = _faces(lines, [shape for shape, _, _ in seen])
    found += list(_deep([(face, "", "") for face in faces]))
    if len(found) > MOST_CELLS:
        raise _picture(len(found))
    if not found:
        raise GeometryError(
            "no closed region: nothing in it is filled, and its lines close round nothing; fill its shapes "
            "with colours, or let its lines meet"
        )
    return Cells(tuple(found), rest)


def _picture(count: int) -> GeometryError:
    return GeometryError(
        f"{count:,} regions: a picture and no drawing, expected at most {MOST_CELLS:,}; trace it with fewer "
        "colours and less detail, or pick some of it"
    )


def _painted(marks: Sequence[Mark], scale: float) -> Iterator[tuple[Geometries, str, str]]:
    """Yield what each mark covers, bottom first, its colour and its name: fills, and broad strokes."""
    shapes = Shapes(marks, FINE / scale)
    filled = [number for number, mark in enumerate(marks) if mark.fill]
    broad = [number for number, mark in enumerate(marks) if mark.stroke and mark.width * scale >= BROAD]
    found: dict[tuple[int, bool], Geometries] = {}
    for which, taken, line in ((filled, shapes.regions, False), (broad, shapes.bodies, True)):
        areas, owner = taken(which) if which else (np.empty(0, dtype=object), np.empty(0, np.intp))
        ends = np.searchsorted(owner, np.arange(len(marks) + 1))
        found |= {(number, line): areas[ends[number] : ends[number + 1]] for number in which}
    for number, mark in enumerate(marks):
        for line in (True, False) if mark.stroke_first else (False, True):
            if len(found.get((number, line), ())):
                yield found[number, line], mark.stroke if line else mark.fill, mark.name


def _thin(marks: Sequence[Mark], scale: float) -> Geometries:
    """Return the strokes that are lines: those of marks without a fill, whose outline is drawn anyway."""
    plain = [
        replace(mark, pen=replace(mark.pen, dashes=()))
        for mark in marks
        if mark.stroke and not mark.fill and mark.width * scale < BROAD
    ]
    if not plain:
        return np.empty(0, dtype=object)
    return Shapes(plain, FINE / scale).lines(range(len(plain)))[0]


Painted = tuple[shapely.Geometry, str, str]


def _seen(areas: Sequence[tuple[Geometries, str, str]]) -> list[Painted]:
    """Return what is seen of each thing painted, bottom first, in connected pieces."""
    whole = np.array([shapely.union_all(shapes) for shapes, _, _ in areas], dtype=object)
    tree = shapely.STRtree(whole)
    under, over = tree.query(whole, predicate="intersects")
    higher = over > under
    under, over = under[higher], over[higher]
    order = np.argsort(under, kind="stable")
    under, over = under[order], over[order]
    left = whole.copy()
    # Of each thing what lies over it is joined once: there are as many as things that are covered.
    for number in np.unique(under).tolist():
        hiding = shapely.union_all(whole[over[under == number]])
        left[number] = shapely.difference(whole[number], hiding)
    return [
        (piece, colour, name)
        for shape, (_, colour, name) in zip(left, areas, strict=True)
        for piece in polygonal(shape)
    ]


def _deep(pieces: Sequence[Painted]) -> Iterator[Cell]:
    """Yield the pieces that a canting can draw."""
    if not pieces:
        return
    shapes = oriented(np.array([shape for shape, _, _ in pieces], dtype=object))
    depth = shapely.length(shapely.maximum_inscribed_circle(shapes)).tolist()
    for shape, deep, (_, colour, name) in zip(shapes, depth, pieces, strict=True):
        if deep >= CRUMB:
            yield Cell(shape, colour, name, deep)


def _faces(lines: Geometries, areas: Sequence[shapely.Geometry]) -> tuple[Geometries, Geometries]:
    """Return what lines close round where nothing is painted, and what of the lines borders none of that."""
    none = np.empty(0, dtype=object)
    if not len(lines):
        return none, none
    noded = shapely.node(shapely.multilinestrings(_closed_up(lines)))
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    painted = shapely.union_all(np.array(areas, dtype=object)) if areas else shapely.Polygon()
    free = _free(faces, painted)
    edges = shapely.buffer(shapely.union_all(shapely.boundary(free)), 2 * FINE) if len(free) else painted
    rest = shapely.difference(lines, edges) if len(free) else lines
    parts = shapely.get_parts(shapely.line_merge(rest))
    return free, parts[shapely.length(parts) >= LEAST_LINE]


def _free(faces: Geometries, painted: shapely.Geometry) -> Geometries:
    """Return the faces of which nothing is painted over."""
    inside = shapely.area(shapely.intersection(faces, painted)) <= 0.05 * shapely.area(faces)
    return np.asarray(faces[inside], dtype=object)


def _closed_up(lines: Geometries) -> list[shapely.Geometry]:
    """Return lines, and short ones more from ends to what is near to them, so that gaps of a hand close."""
    left, low, right, high = shapely.total_bounds(lines)
    reach = JOIN * max(right - left, high - low)
    open_ones = lines[~shapely.is_closed(lines)]
    ends = np.concatenate([shapely.get_point(open_ones, 0), shapely.get_point(open_ones, -1)])
    more: list[shapely.Geometry] = []
    if len(ends):
        own = np.tile(np.flatnonzero(~shapely.is_closed(lines)), 2)
        asked, found = shapely.STRtree(lines).query(ends, predicate="dwithin", distance=reach)
        other = own[asked] != found
        bridges = _beyond(shapely.shortest_line(ends[asked[other]], lines[found[other]]))
        # The two ends of one line.
        half = len(open_ones)
        near = shapely.distance(ends[:half], ends[half:]) <= reach
        own_ends = shapely.shortest_line(ends[:half][near], ends[half:][near])
        every = np.concatenate([bridges, own_ends])
        more = list(every[shapely.length(every) > 0])
    return [*lines, *more]


def _beyond(bridges: Geometries) -> Geometries:
    """Return lines of two points a hair longer, so that they cross what they lead to."""
    bridges = bridges[shapely.length(bridges) > 0]
    points = shapely.get_coordinates(bridges).reshape(-1, 2, 2)
    way = points[:, 1] - points[:, 0]
    points[:, 1] += way / np.hypot(*way.T)[:, None] * (FINE / 2)
    return np.asarray(shapely.linestrings(points), dtype=object)
