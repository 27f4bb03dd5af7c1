"""What a drawing paints as areas in painting order, each in an ink: the marks that a recipe is to draw."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.regions import oriented
from batik_vector.importing.fills import solid
from batik_vector.importing.inks import Marks
from batik_vector.importing.pens import Pen, bodies
from batik_vector.values import frozen

Index = NDArray[np.intp]

BARE = -1
"""The ink of a mark that has the colour of the cloth: it cuts what lies beneath it."""


@frozen(eq=False)
class Painted:
    """Areas in painting order, the lowest first: valid polygons in mm, y up.

    ``ink`` is the number of each one's colour in ``colours``, or ``BARE``. ``name`` is what the drawing calls
    it, or nothing.
    """

    shapes: Geometries
    ink: Index
    names: NDArray[np.object_]
    colours: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.shapes)

    def taken(self, which: Index | NDArray[np.bool_]) -> Painted:
        """Return some of the areas."""
        return replace(self, shapes=self.shapes[which], ink=self.ink[which], names=self.names[which])


def painted_areas(marks: Marks, cloth: str, tolerance: float, bare: bool) -> Painted:
    """Return what marks paint; strokes count by their bodies, hairs thinner than the tolerance not at all.

    Args:
        marks: of a drawing, without its cloth.
        cloth: the colour of the cloth.
        tolerance: mm; of round caps and joins.
        bare: whether what has the colour of the cloth shows the cloth, and is no ink of its own.
    """
    body, owner = _bodies(marks, tolerance)
    shapes = np.concatenate([marks.areas, body])
    number = np.concatenate([marks.area_shape, marks.line_shape[owner]])
    over = np.repeat([0, 1], [len(marks.areas), len(body)])
    order = np.lexsort([over, number])
    colour = [
        marks.shapes[shape].stroke if stroke else marks.shapes[shape].fill
        for shape, stroke in zip(number[order].tolist(), over[order].tolist(), strict=True)
    ]
    known = [each for each in dict.fromkeys(colour) if not (bare and each == cloth)]
    numbers = {each: i for i, each in enumerate(known)}
    ink = np.array([numbers.get(each, BARE) for each in colour], np.intp)
    names = np.array([marks.shapes[shape].name for shape in number[order].tolist()], dtype=object)
    shapes = oriented(shapes[order])
    drawn = 2 * shapely.area(shapes) > tolerance * shapely.length(shapes)
    return Painted(shapes, ink, names, tuple(known)).taken(drawn)


def _bodies(marks: Marks, tolerance: float) -> tuple[Geometries, Index]:
    """Return the bodies of strokes, and the line of each."""
    kinds: dict[tuple[float, Pen], list[int]] = {}
    for row, number in enumerate(marks.line_shape.tolist()):
        shape = marks.shapes[number]
        kinds.setdefault((shape.width, shape.pen), []).append(row)
    shapes, owners = [marks.lines[:0]], [np.empty(0, np.intp)]
    for (breadth, pen), rows in kinds.items():
        drawn, number = bodies(marks.lines[rows], breadth, pen, tolerance)
        parts, piece = shapely.get_parts(drawn, return_index=True)
        shapes.append(parts)
        owners.append(np.array(rows, np.intp)[number[piece]])
    shape, owner = np.concatenate(shapes), np.concatenate(owners)
    some = ~shapely.is_empty(shape) & (shapely.get_type_id(shape) == shapely.GeometryType.POLYGON)
    some[some] = solid(shape[some])
    return shape[some], owner[some]


def levels(shapes: Geometries, ink: Index, order: Index, hair: float) -> Index:
    """Return how high marks lie: each above all marks of other inks that it hides a part of.

    Args:
        shapes: valid polygons; translates of one mark may be among them.
        ink: of each.
        order: of each the rank in painting order; translates of one mark share theirs.
        hair: mm; what lies over another by less, on the mean, lies beside it.

    Returns:
        A level for each rank, shape (max(order) + 1,).
    """
    count = int(order.max(initial=-1)) + 1
    level = np.zeros(count, np.intp)
    lower, upper = np.array(_over(shapes, ink, hair)).reshape(2, -1)
    pairs = np.unique(np.sort(np.column_stack([order[lower], order[upper]]), axis=1), axis=0)
    pairs = pairs[pairs[:, 0] < pairs[:, 1]]
    for below, above in pairs[np.lexsort([pairs[:, 0], pairs[:, 1]])].tolist():
        level[above] = max(level[above], level[below] + 1)
    return level


def _over(shapes: Geometries, ink: Index, hair: float) -> tuple[Index, Index]:
    """Return the pairs of shapes of different inks of which one lies over the other."""
    if not len(shapes):
        return ink, ink
    a, b = shapely.STRtree(shapes).query(shapes)
    keep = (a < b) & (ink[a] != ink[b])
    a, b = a[keep], b[keep]
    over = shapely.relate_pattern(shapes[a], shapes[b], "T********")
    a, b = a[over], b[over]
    shared = shapely.area(shapely.intersection(shapes[a], shapes[b]))
    deep = 2 * shared > hair * np.minimum(shapely.length(shapes[a]), shapely.length(shapes[b]))
    return a[deep], b[deep]


def shown(shapes: Sequence[Geometries], inks: int) -> list[shapely.Geometry]:
    """Return what is seen of each ink, where sheets are laid one over another.

    Args:
        shapes: of each level the areas of every ink, those of bare cloth last: number
            ``level * (inks + 1) + ink``.
        inks: how many there are.
    """
    seen: list[shapely.Geometry] = [shapely.Polygon()] * inks
    for level in range(len(shapes) // (inks + 1)):
        sheets = shapes[level * (inks + 1) : (level + 1) * (inks + 1)]
        covers = [shapely.union_all(sheet) for sheet in sheets]
        for number in range(inks):
            others = [cover for i, cover in enumerate(covers) if i != number and not cover.is_empty]
            if others:
                seen[number] = shapely.difference(seen[number], shapely.union_all(others))
            if not covers[number].is_empty:
                seen[number] = shapely.union(seen[number], covers[number])
    return seen
