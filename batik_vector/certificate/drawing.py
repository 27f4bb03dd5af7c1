"""A tile as it is measured: what the page shows of every ink, in whole steps.

Artworks of this package lie on the 1 µm grid, and their steps are those. What comes from elsewhere, or has
to be joined, is brought to a far finer grid (1 nm where the tile is not huge), so that the measures see
the file and not the rounding; only what lies off the 1 µm grid, and within ``SNAP`` of an edge of the page,
is taken to lie on that edge.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Layer
from batik_vector.certificate.report import Place
from batik_vector.errors import GeometryError
from batik_vector.geometry.edge_snap import snapped
from batik_vector.geometry.regions import without_repeats
from batik_vector.tiling.torus.torus import Steps, Window, clip_areas, polygons_of, split_at
from batik_vector.tiling.welding.weld import meeting, welded
from batik_vector.units import STEPS_PER_MM, on_grid
from batik_vector.values import frozen

SNAP = 0.002
"""How near (mm) to an edge of the page a vertex of a foreign file counts as lying on it: files keep two
decimals of a pixel, which is off by up to 0.0013 mm."""

FINEST = 1000
"""Parts of a grid step in which foreign files are measured: 1 nm."""

MOST_STEPS = 10**9
"""Sides of a tile in steps beyond which products of coordinates leave 64 bits."""


Borders = frozenset[tuple[str, int, int, int]]
"""What runs or ends along the seam on purpose: see :class:`~batik_vector.artwork.Artwork`."""


@frozen
class Frame:
    """The page and its lattice in steps; ``per_mm`` steps are a millimetre.

    ``exact`` says that every coordinate of the artwork lies on the 1 µm grid; steps may be finer.
    """

    cell: Cell
    per_mm: int
    exact: bool

    @property
    def window(self) -> Window:
        """The page."""
        return Window(0, 0, self.cell.columns, self.cell.rows)

    def mm(self, x: float, y: float) -> Place:
        """Return a place given in steps, anywhere on the torus, as one on the page in mm."""
        x, y = self.on_page(x, y)
        return x / self.per_mm, y / self.per_mm

    def on_page(self, x: float, y: float) -> tuple[float, float]:
        """Return the translate of a place (steps) that lies on the page; one on its rim stays there."""
        (ax, ay), (bx, by) = self.cell.lattice
        if bx == 0:
            x, y = _into(x, y, ax, ay)
            y, x = _into(y, x, by, bx)
            return x, y
        y, x = _into(y, x, by, bx)
        return _into(x, y, ax, ay)

    def canonical(self, points: Steps) -> Steps:
        """Return points of the page's rim (steps, shape (n, 2)) so that equal places are equal."""
        points = points.copy()
        (ax, ay), (bx, by) = self.cell.lattice
        for axis, side, slip in ((0, ax, ay), (1, by, bx)) if bx == 0 else ((1, by, bx), (0, ax, ay)):
            far = points[:, axis] >= side
            points[far, axis] -= side
            points[far, 1 - axis] -= slip
            points[:, 1 - axis] %= by if axis == 0 else ax
        return points


def _into(value: float, other: float, side: int, slip: int) -> tuple[float, float]:
    if 0 <= value <= side:
        return value, other
    turns = value // side
    return value - turns * side, other - turns * slip


@frozen(eq=False)
class Edges:
    """Directed straight edges in steps: from ``begin`` to ``end``, shape (n, 2), of line ``owner``.

    ``turn_begin`` and ``turn_end`` are how far (radians, not negative) the way turns at either end;
    infinite where it ends there, and nothing tells how it would have turned.
    """

    begin: Steps
    end: Steps
    owner: NDArray[np.intp]
    turn_begin: NDArray[np.float64]
    turn_end: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.owner)

    def only(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Edges:
        """Return some of the edges."""
        return Edges(
            self.begin[which],
            self.end[which],
            self.owner[which],
            self.turn_begin[which],
            self.turn_end[which],
        )


def joined(parts: Sequence[Edges]) -> Edges:
    """Return edges of several kinds as one."""
    return Edges(*(np.concatenate([getattr(part, each.name) for part in parts]) for each in fields(Edges)))


@frozen(eq=False)
class InkDrawing:
    """What the page shows of one ink.

    ``marks`` are its areas one by one, ``overlaps`` the pairs of them that lie over one another; ``areas``
    is what they cover together, in polygons that touch in points at most, ``joined`` where any had to be.
    ``rings`` are the edges of these; ``strokes`` those of its lines, cut at the page's edges, with what
    lies on any of these.
    """

    ink: Ink
    marks: Geometries
    overlaps: NDArray[np.intp]
    joined: bool
    areas: Geometries
    rings: Edges
    strokes: Edges


@frozen(eq=False)
class Drawing:
    """A tile as it is measured."""

    frame: Frame
    inks: tuple[InkDrawing, ...]

    def __iter__(self) -> Iterator[InkDrawing]:
        return iter(self.inks)


def drawing(artwork: Artwork) -> Drawing:
    """Return what the page shows of an artwork, which need not be in the normal form.

    Layers of one ink name count as one. Invalid rings are mended; what lies beyond the page is left out.

    Raises:
        GeometryError: where a coordinate is not finite.
    """
    for layer in artwork.layers:
        coords = shapely.get_coordinates(np.concatenate([layer.areas, layer.lines]))
        if not np.isfinite(coords).all():
            raise GeometryError(f'ink "{layer.ink.name}": a coordinate is not finite')
    marks = [part for layer in artwork.layers for part in (layer.areas, layer.lines)]
    exact = all(np.array_equal(on_grid(xy), xy) for xy in map(shapely.get_coordinates, marks))
    if exact:
        tile = _drawn(artwork, Frame(artwork.cell, STEPS_PER_MM, True))
        # Joining areas moves crossings onto the grid, and may pull a crossing of the seam along.
        if not any(ink.joined for ink in tile):
            return tile
    return _drawn(artwork, _fine_frame(artwork.cell, exact))


def _drawn(artwork: Artwork, frame: Frame) -> Drawing:
    names = dict.fromkeys(layer.ink.name for layer in artwork.layers)
    layers = [[layer for layer in artwork.layers if layer.ink.name == name] for name in names]
    return Drawing(frame, tuple(_ink_drawing(mine, frame) for mine in layers))


def _fine_frame(cell: Cell, exact: bool) -> Frame:
    """Return a page on the finest grid on which its coordinates may be multiplied."""
    finer = FINEST
    while finer > 1 and max(cell.columns, cell.rows) * finer > MOST_STEPS:
        finer //= 10
    fine = Cell(cell.columns * finer, cell.rows * finer, cell.drop, cell.axis)
    return Frame(fine, STEPS_PER_MM * finer, exact)


def _ink_drawing(layers: list[Layer], frame: Frame) -> InkDrawing:
    marks = _marks(np.concatenate([layer.areas for layer in layers]), frame)
    pairs = meeting(marks)
    a, b = pairs.T
    overlaps = pairs[shapely.relate_pattern(marks[a], marks[b], "T********")] if len(pairs) else pairs
    beside = len(pairs) and shapely.relate_pattern(marks[a], marks[b], "F***1****").any()
    join = bool(len(overlaps) or beside)
    areas = welded(marks)[0] if join else marks
    strokes = _strokes(np.concatenate([layer.lines for layer in layers]), frame)
    return InkDrawing(layers[0].ink, marks, overlaps, join, areas, ring_edges(areas), strokes)


def _marks(areas: Geometries, frame: Frame) -> Geometries:
    """Return areas (mm) as valid polygons in whole steps, cut to the page."""
    steps = _sound(areas, frame)
    bounds = shapely.bounds(steps).reshape(-1, 4)
    if (bounds[:, :2] >= 0).all() and (
        bounds[:, 2:] <= np.array([frame.cell.columns, frame.cell.rows])
    ).all():
        return steps
    steps = shapely.get_parts(_cropped(steps, frame))
    return clip_areas(steps, np.zeros(len(steps), np.intp), frame.window)[0]


def _sound(areas: Geometries, frame: Frame) -> Geometries:
    """Return areas (mm) as valid polygons in whole steps."""
    if not len(areas):
        return areas
    steps = _in_steps(areas, frame)
    sound = shapely.is_valid(steps)
    if not sound.all() or (shapely.get_type_id(steps) != shapely.GeometryType.POLYGON).any():
        steps[~sound] = shapely.set_precision(shapely.make_valid(steps[~sound]), 1.0)
        steps, _ = polygons_of(steps, np.zeros(len(steps), np.intp))
    return np.asarray(steps[shapely.area(steps) > 0], dtype=object)


def uncut(artwork: Artwork, ink: str, frame: Frame) -> Geometries:
    """Return all areas of an ink as valid polygons in steps, also those beyond the page."""
    return _sound(np.concatenate([layer.areas for layer in artwork.layers if layer.ink.name == ink]), frame)


def _cropped(areas: Geometries, frame: Frame) -> Geometries:
    """Leave out what lies far beyond the page, where edges are too long for whole numbers.

    A margin of a tenth of the page stays, so that nothing that is seen is moved.
    """
    bounds = shapely.bounds(areas)
    if not len(areas) or np.abs(bounds).max() <= MOST_STEPS:
        return areas
    x, y = frame.cell.columns / 10, frame.cell.rows / 10
    rim = shapely.box(-x, -y, frame.cell.columns + x, frame.cell.rows + y)
    return np.asarray(shapely.intersection(areas, rim, grid_size=1.0), dtype=object)


def _in_steps(marks: Geometries, frame: Frame) -> Geometries:
    """Return marks in whole steps, what all but lies on an edge of the page on it."""
    marks = np.array(shapely.force_2d(marks), dtype=object)
    xy = np.rint(shapely.get_coordinates(marks) * frame.per_mm)
    if frame.exact:
        return np.asarray(shapely.set_coordinates(marks, xy), dtype=object)
    parts = shapely.get_parts(marks)
    areas = shapely.get_type_id(parts) == shapely.GeometryType.POLYGON
    chains = shapely.get_rings(parts) if areas.all() else parts
    offsets = np.append(0, np.cumsum(shapely.get_num_coordinates(chains)))
    xy = snapped(xy, offsets, (frame.cell.columns, frame.cell.rows), SNAP * frame.per_mm)
    return without_repeats(np.asarray(shapely.set_coordinates(marks, xy), dtype=object))


def ring_edges(areas: Geometries) -> Edges:
    """Return the edges of polygons, the covered side on their left."""
    rings = shapely.get_rings(shapely.orient_polygons(areas)) if len(areas) else areas
    coords, owner = shapely.get_coordinates(rings, return_index=True)
    return edges(coords.astype(np.int64), np.searchsorted(owner, np.arange(len(rings) + 1)))


def _strokes(lines: Geometries, frame: Frame) -> Edges:
    """Return the edges of lines (mm) within the closed page."""
    parts = shapely.get_parts(lines)
    steps = _cropped(_in_steps(parts, frame), frame) if len(parts) else parts
    steps = shapely.get_parts(steps)
    coords, owner = shapely.get_coordinates(steps, return_index=True)
    offsets = np.searchsorted(owner, np.arange(len(steps) + 1))
    if not len(coords):
        return edges(np.empty((0, 2), np.int64), np.zeros(1, np.int64))
    window = frame.window
    found = edges(*split_at(coords.astype(np.int64), offsets, window))
    middle = found.begin + found.end
    inside = (middle >= 0).all(axis=1) & (middle <= 2 * np.array([window.right, window.top])).all(axis=1)
    return found.only(inside & (found.begin != found.end).any(axis=1))


def repeats(edges: Edges, frame: Frame, axis: int, reach: float) -> list[tuple[NDArray[np.intp], Steps]]:
    """Return the edges within ``reach`` steps of the left (axis 0) or lower edge of the page, to be repeated.

    Each item is rows of the edges, and the lattice's translation that carries them beyond the opposite
    edge. With a drop there are two, since a translate of the page stands over two of its edges.
    """
    rows = np.flatnonzero(np.minimum(edges.begin[:, axis], edges.end[:, axis]) <= reach)
    if not len(rows):
        return []
    shift, other = (np.array(frame.cell.lattice[each], np.int64) for each in (axis, 1 - axis))
    return [(rows, each) for each in ([shift, shift - other] if shift[1 - axis] else [shift])]


def edges(coords: Steps, offsets: NDArray[np.int64]) -> Edges:
    """Return the edges of polylines; those whose last vertex repeats the first turn there too."""
    if len(coords) < 2:
        none = np.empty((0, 2), np.int64)
        return Edges(none, none, np.empty(0, np.intp), np.empty(0), np.empty(0))
    inside = np.ones(len(coords) - 1, bool)
    inside[offsets[1:-1] - 1] = False
    begin, end = coords[:-1][inside], coords[1:][inside]
    counts = np.diff(offsets) - 1
    owner = np.repeat(np.arange(len(counts)), counts)
    step = (end - begin).astype(np.float64)
    heading = np.arctan2(step[:, 1], step[:, 0])
    after = np.arange(1, len(owner) + 1)
    some = counts > 0
    last = np.cumsum(counts)[some] - 1
    first = last - counts[some] + 1
    closed = (coords[offsets[:-1]] == coords[offsets[1:] - 1]).all(axis=1)[some]
    after[last] = np.where(closed, first, last)
    turn = np.abs((heading[after] - heading + np.pi) % (2 * np.pi) - np.pi)
    turn[last[~closed]] = np.inf
    before = np.full(len(owner), np.inf)
    goes_on = np.flatnonzero(np.isfinite(turn))
    before[after[goes_on]] = turn[goes_on]
    return Edges(begin, end, owner, before, turn)
