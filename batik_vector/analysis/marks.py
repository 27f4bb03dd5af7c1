"""Marks: what a drawing draws, one by one, each with the measures by which like is told from unlike.

Only shapes count: not what a layer or an element is called, what colour it has, or how the file writes it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries, Layer
from batik_vector.values import frozen

Numbers = NDArray[np.float64]
Indices = NDArray[np.intp]
Points = NDArray[np.float64]
Place = NDArray[np.float64]

BARE = -1
"""The ink of what is left bare within a mark."""

LEAST = 1e-6
"""The share of the drawing's extent, squared, below which an area is a crumb and no mark."""

SIZE, SHAPE = 0.12, np.array([0.06, 0.09, 0.06, 0.25])
"""How far marks of one kind may be apart: in the logarithm of size, and in the four measures of shape."""

SIMILAR = 0.4
"""How much nearer to each other the measures of shape have to be where sizes are not compared."""

ROUND_ENDS = 4
"""Segments of a quarter circle at the ends of a pen's line."""


@frozen(eq=False)
class Marks:
    """Marks as filled outlines, holes left out; every array has one entry for each.

    ``outlines`` are polygons in mm and ``inks`` the numbers of their layers, ``BARE`` for ground that a mark
    encloses. ``places`` (n, 2) are their centroids, ``sizes`` the square roots of their areas, ``ways`` (n,
    2) unit vectors along their long axes. ``shapes`` (n, 4) are what does not change when a mark is moved,
    turned, mirrored or scaled: short axis to long, 4πA/P², the share of the convex hull that is filled, and
    how much fuller one end is.
    """

    outlines: Geometries
    inks: Indices
    places: Points
    sizes: Numbers
    ways: Points
    shapes: Numbers

    def __len__(self) -> int:
        return len(self.inks)

    def __getitem__(self, rows: Indices | NDArray[np.bool_]) -> Marks:
        return Marks(
            self.outlines[rows],
            self.inks[rows],
            self.places[rows],
            self.sizes[rows],
            self.ways[rows],
            self.shapes[rows],
        )

    @property
    def slimness(self) -> Numbers:
        """Short axis to long of each, 1 for a circle."""
        return np.asarray(self.shapes[:, 0])


def marks_of(layers: Sequence[Layer]) -> Marks:
    """Return the marks of a drawing.

    They are its areas, its closed lines as what they enclose, its open lines as bodies. What overlaps in one
    ink is one mark. A lowest area that holds everything else is the cloth, and is left out, and so are
    crumbs.
    """
    outlines: list[Geometries] = []
    inks: list[int] = []
    for number, layer in enumerate(layers):
        mine = np.concatenate([joined(sound(layer.areas)), _of_lines(layer)])
        outlines.append(mine)
        inks += [number] * len(mine)
    if not inks:
        return measured(np.empty(0, dtype=object), np.empty(0, np.intp))
    marks, ink = np.concatenate(outlines), np.array(inks, np.intp)
    marks, ink = _uncovered(marks, ink)
    bare = _bare(marks)
    marks, ink = np.concatenate([marks, bare]), np.concatenate([ink, np.full(len(bare), BARE, np.intp)])
    found = measured(_filled(marks), ink)
    if not len(found):
        return found
    low_x, low_y, high_x, high_y = shapely.total_bounds(found.outlines)
    extent = max(high_x - low_x, high_y - low_y)
    return _once(found[found.sizes**2 > LEAST * extent**2])


def sound(areas: Geometries) -> Geometries:
    """Return areas as valid polygons, what is broken mended, what is not finite left out."""
    areas = np.asarray(areas, dtype=object)
    areas = areas[np.isfinite(shapely.bounds(areas)).all(axis=1)] if len(areas) else areas
    broken = ~shapely.is_valid(areas)
    if broken.any():
        areas = areas.copy()
        areas[broken] = shapely.make_valid(areas[broken])
    parts = np.asarray(shapely.get_parts(shapely.get_parts(areas)), dtype=object)
    polygons: Geometries = parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON]
    return polygons


def joined(areas: Geometries) -> Geometries:
    """Unite what overlaps, and leave alone what does not."""
    if len(areas) < 2:
        return areas
    tree = shapely.STRtree(areas)
    one, other = tree.query(areas, predicate="intersects")
    pairs = one < other
    if not pairs.any():
        return areas
    group = _components(len(areas), one[pairs], other[pairs])
    counts = np.bincount(group)
    alone = counts[group] == 1
    united = [shapely.union_all(areas[group == each]) for each in np.flatnonzero(counts > 1)]
    parts = np.asarray(shapely.get_parts(united), dtype=object)
    return np.concatenate([areas[alone], parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON]])


def _components(count: int, one: Indices, other: Indices) -> Indices:
    """Return for each of so many things the number of its component, given the pairs that hang together."""
    label: Indices = np.arange(count)
    while True:
        least = label.copy()
        np.minimum.at(least, one, label[other])
        np.minimum.at(least, other, label[one])
        least = np.minimum(least, least[least])
        if (least == label).all():
            return np.asarray(np.unique(label, return_inverse=True)[1]).reshape(-1)
        label = least


def _of_lines(layer: Layer) -> Geometries:
    """Return what closed lines enclose, and the bodies of open ones."""
    lines = np.asarray(layer.lines, dtype=object)
    if not len(lines):
        return lines
    closed = shapely.is_closed(lines) & (shapely.get_num_coordinates(lines) > 3)
    xy, owner = shapely.get_coordinates(lines[closed], return_index=True)
    rings = (
        sound(np.asarray(shapely.polygons(shapely.linearrings(xy, indices=owner))))
        if closed.any()
        else lines[:0]
    )
    bodies = shapely.buffer(lines[~closed], layer.ink.width / 2, quad_segs=ROUND_ENDS)
    return np.concatenate([rings, joined(sound(bodies))])


def _uncovered(marks: Geometries, inks: Indices) -> tuple[Geometries, Indices]:
    """Leave out a lowest mark that is the cloth: without corners drawn in, and behind all the others."""
    if len(marks) < 2:
        return marks, inks
    lowest = np.flatnonzero(inks == inks.min())
    largest = lowest[int(np.argmax(shapely.area(marks[lowest])))]
    cloth, others = marks[largest], np.delete(marks, largest)
    convex = shapely.area(shapely.convex_hull(cloth)) <= 1.001 * shapely.area(cloth)
    around = shapely.envelope(cloth).covers(shapely.box(*shapely.total_bounds(others)))
    if convex and around and shapely.covers(cloth, shapely.multipoints(shapely.centroid(others))):
        return others, np.delete(inks, largest)
    return marks, inks


def _filled(marks: Geometries) -> Geometries:
    """Return polygons without their holes."""
    if not len(marks):
        return marks
    return np.asarray(shapely.polygons(shapely.get_exterior_ring(marks)), dtype=object)


def _bare(marks: Geometries) -> Geometries:
    """Return the ground that marks enclose, where it holds no other mark: a slit, an eye."""
    holed = np.flatnonzero(shapely.get_num_interior_rings(marks) > 0)
    if not len(holed):
        return marks[:0]
    rings = np.concatenate([shapely.get_rings(mark)[1:] for mark in marks[holed]])
    holes = np.asarray(shapely.polygons(rings), dtype=object)
    hole, _ = shapely.STRtree(shapely.point_on_surface(marks)).query(holes, predicate="contains")
    return np.delete(holes, np.unique(hole))


def measured(outlines: Geometries, inks: Indices) -> Marks:
    """Return polygons without holes as marks."""
    count = len(outlines)
    if not count:
        return Marks(outlines, inks, np.empty((0, 2)), np.empty(0), np.empty((0, 2)), np.empty((0, 4)))
    areas: Numbers = shapely.area(outlines)
    places = shapely.get_coordinates(shapely.centroid(outlines))
    xy, owner = shapely.get_coordinates(outlines, return_index=True)
    xy = xy - places[owner]
    inner = owner[1:] == owner[:-1]
    row, a, b = owner[:-1][inner], xy[:-1][inner], xy[1:][inner]
    cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    sign = np.sign(np.bincount(row, cross, count))

    def moment(values: Numbers, parts: float) -> Numbers:
        """Return ∫ dA of a monomial: the sums over edges of Green's theorem."""
        return np.asarray(sign * np.bincount(row, cross * values, count) / parts)

    xx = moment(a[:, 0] ** 2 + a[:, 0] * b[:, 0] + b[:, 0] ** 2, 12.0)
    yy = moment(a[:, 1] ** 2 + a[:, 1] * b[:, 1] + b[:, 1] ** 2, 12.0)
    xy_ = moment(2 * a[:, 0] * a[:, 1] + a[:, 0] * b[:, 1] + b[:, 0] * a[:, 1] + 2 * b[:, 0] * b[:, 1], 24.0)
    spread = np.hypot((xx - yy) / 2, xy_)
    long, short = (xx + yy) / 2 + spread, np.maximum((xx + yy) / 2 - spread, 0.0)
    turn = np.arctan2(2 * xy_, xx - yy) / 2
    ways = np.column_stack([np.cos(turn), np.sin(turn)])
    u, v = (a * ways[row]).sum(axis=1), (b * ways[row]).sum(axis=1)
    skew = moment((u + v) * (u * u + v * v), 20.0)
    perimeter: Numbers = shapely.length(outlines)
    hull: Numbers = shapely.area(shapely.convex_hull(outlines))
    long = np.maximum(long, 1e-300)
    shapes = np.column_stack(
        [
            np.sqrt(short / long),
            4 * np.pi * areas / np.maximum(perimeter, 1e-300) ** 2,
            areas / np.maximum(hull, 1e-300),
            np.abs(skew) * np.sqrt(areas) / long**1.5,
        ]
    )
    return Marks(outlines, inks, places, np.sqrt(areas), ways, shapes)


def _once(marks: Marks) -> Marks:
    """Leave out marks that lie on others of the same outline, as the line along the edge of an area does."""
    if len(marks) < 2:
        return marks
    near = shapely.STRtree(np.asarray(shapely.points(marks.places))).query(
        shapely.points(marks.places), predicate="dwithin", distance=0.02 * float(marks.sizes.max())
    )
    one, other = near
    earlier = other < one
    one, other = one[earlier], other[earlier]
    away = np.hypot(*(marks.places[one] - marks.places[other]).T) <= 0.02 * marks.sizes[one]
    same = away & alike(marks, one, other, size=0.03)
    return marks[np.delete(np.arange(len(marks)), np.unique(one[same]))]


def alike(marks: Marks, one: Indices, other: Indices, size: float | None = SIZE) -> NDArray[np.bool_]:
    """Return which pairs are of one shape, and of one size unless ``size`` is None."""
    shape = SHAPE * (SIMILAR if size is None else 1.0)
    same = (np.abs(marks.shapes[one] - marks.shapes[other]) <= shape).all(axis=1)
    if size is not None:
        same &= np.abs(np.log(marks.sizes[one] / marks.sizes[other])) <= size
    return np.asarray(same)


def kinds_of(marks: Marks, most: int) -> Indices | None:
    """Return for each mark the number of its kind, the largest marks first; None past ``most`` kinds."""
    kind = np.full(len(marks), -1, np.intp)
    every: Indices = np.arange(len(marks))
    number = 0
    for leader in np.argsort(-marks.sizes, kind="stable").tolist():
        if kind[leader] >= 0:
            continue
        if number == most:
            return None
        mine = alike(marks, np.full(len(marks), leader), every) & (kind < 0)
        mine[leader] = True
        kind[mine] = number
        number += 1
    return kind


def joined_with(marks: Marks, more: Marks) -> Marks:
    """Return two lots of marks as one."""
    return Marks(
        np.concatenate([marks.outlines, more.outlines]),
        np.concatenate([marks.inks, more.inks]),
        np.concatenate([marks.places, more.places]),
        np.concatenate([marks.sizes, more.sizes]),
        np.concatenate([marks.ways, more.ways]),
        np.concatenate([marks.shapes, more.shapes]),
    )
