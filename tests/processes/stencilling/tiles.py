"""Random tiles for stencils, and what hangs together on them, measured apart from the program."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, DropAxis, Geometries, Ink, Layer
from batik_vector.machines import Machine
from batik_vector.processes.options import StencilProcess
from batik_vector.tiling.symmetry.groups import group
from batik_vector.tiling.symmetry.spread import Frame, orbit_of, shapes_of
from batik_vector.tiling.torus.torus import Window, wrap

SIDE = 40
"""Breadth in mm of a random tile."""


def stencilled(tile: Artwork, **told: object) -> Artwork:
    """Return the stencil of a tile."""
    done = StencilProcess(**told).apply(tile, Machine())  # type: ignore[arg-type]
    assert isinstance(done, Artwork)
    return done


def tile_of(marks: list[shapely.Geometry], cell: Cell) -> Artwork:
    """Return a tile that marks, in mm and anywhere, draw in one ink."""
    window = Window(0, 0, cell.columns, cell.rows)
    steps = shapely.transform(np.array(marks, dtype=object), lambda xy: np.rint(xy * 1000))
    copies, _ = wrap(steps, np.arange(len(steps)), cell.lattice, window)
    whole = shapely.union_all(copies, grid_size=1)
    parts = shapely.get_parts(shapely.intersection(whole, window.box, grid_size=1))
    areas = parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON]
    areas = shapely.orient_polygons(areas)
    layer = Layer(Ink("ink", "#000000"), shapely.transform(areas, lambda xy: xy / 1000))
    return Artwork("random", cell, (layer,))


def mark(chance: random.Random) -> shapely.Geometry:
    """Return a ring, a disc, a star or a bar, about (0, 0)."""
    size = chance.uniform(3, 9)
    kind = chance.choice(["ring", "ring", "disc", "star", "bar", "frame"])
    if kind == "disc":
        return shapely.Point(0, 0).buffer(size / 2)
    if kind == "bar":
        return shapely.box(-size * 1.5, -0.8, size * 1.5, 0.8)
    if kind == "frame":
        return shapely.box(-size, -size / 2, size, size / 2).difference(
            shapely.box(-size + 1.5, -size / 2 + 1.4, size - 1.5, size / 2 - 1.4)
        )
    if kind == "star":
        points = chance.randint(4, 8)
        turns = np.arange(2 * points) * np.pi / points
        radii = np.where(np.arange(2 * points) % 2, size * 0.45, size)
        return shapely.Polygon(np.stack([np.cos(turns) * radii, np.sin(turns) * radii], axis=1))
    inner = size - chance.uniform(1.0, 2.0)
    return shapely.Point(0, 0).buffer(size).difference(shapely.Point(0, 0).buffer(inner))


def random_tile(seed: int) -> Artwork:
    """Return a tile of some marks, of which islands and strips of bare cloth are left."""
    chance = random.Random(seed)
    drop = chance.choice([Fraction(0), Fraction(0), Fraction(1, 2), Fraction(1, 4)])
    cell = Cell(SIDE * 1000, SIDE * 1000, drop, chance.choice(list(DropAxis)))
    marks = []
    for _ in range(chance.randint(2, 7)):
        turned = shapely.affinity.rotate(mark(chance), chance.uniform(0, 360), origin=(0, 0))
        marks.append(shapely.affinity.translate(turned, chance.uniform(0, SIDE), chance.uniform(0, SIDE)))
    if chance.random() < 0.25:  # a line round the torus
        y = chance.uniform(0, SIDE)
        marks.append(shapely.LineString([(-5, y), (SIDE + 5, y)]).buffer(0.7, cap_style="flat"))
    return tile_of(marks, cell)


def symmetric_tile(seed: int, name: str) -> Artwork:
    """Return a tile of marks under a wallpaper group."""
    chance = random.Random(seed)
    rows = round(SIDE * 1000 * 3**0.5) if name.startswith(("p3", "p6")) else SIDE * 1000
    cell = Cell(SIDE * 1000, rows)
    orbit = orbit_of(group(name), Frame(cell, shapes_of(cell)))
    marks = []
    for _ in range(chance.randint(1, 2)):
        turned = shapely.affinity.rotate(mark(chance), chance.uniform(0, 360), origin=(0, 0))
        at = chance.uniform(0, SIDE), chance.uniform(0, rows / 1000)
        if chance.random() < 0.4:  # on a centre, where images fall on one another
            at = chance.choice([(0.0, 0.0), (SIDE / 2, 0.0)])
        moved = shapely.affinity.translate(turned, *at)
        marks += [
            shapely.affinity.affine_transform(moved, [m.a, m.b, m.c, m.d, m.e, m.f]) for m in orbit.operations
        ]
    return tile_of(marks, cell)


def openings(stencil: Artwork) -> Geometries:
    """Return what a stencil leaves open, in mm."""
    return np.concatenate([layer.areas for layer in stencil.layers])


def copies(areas: Geometries, cell: Cell, reach: int) -> Geometries:
    """Return areas in so many repeats each way about the tile, in mm."""
    (ax, ay), (bx, by) = cell.lattice
    found = []
    for i in range(-reach - 1, reach + 2):
        for j in range(-reach - 1, reach + 2):
            way = np.array([i * ax + j * bx, i * ay + j * by]) / 1000
            coords = shapely.get_coordinates(areas) + way
            found.append(shapely.set_coordinates(areas.copy(), coords))
    return np.concatenate(found)


def polygons(areas: shapely.Geometry) -> Geometries:
    """Return the polygons among the parts of a geometry."""
    parts = shapely.get_parts(areas)
    return np.asarray(parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON], dtype=object)


def cut_out(areas: Geometries, cell: Cell, across: int, frame: float) -> Geometries:
    """Return the pieces of the sheet in a cut-out of so many tiles about the tile, in a frame or in none."""
    width, height = cell.width, cell.height
    low, high = -(across // 2), across - across // 2
    window = shapely.box(low * width, low * height, high * width, high * height)
    around = copies(areas, cell, across)
    near = around[shapely.intersects(around, window)]
    opened = shapely.union_all(
        polygons(shapely.intersection(shapely.union_all(near, grid_size=1e-3), window))
    )
    sheet = window.buffer(frame, join_style="mitre") if frame else window
    return polygons(shapely.difference(sheet, opened, grid_size=1e-3))


def framed(areas: Geometries, cell: Cell) -> int:
    """Return into how many pieces a cut-out of 3 x 3 tiles in a frame of sheet falls."""
    return len(cut_out(areas, cell, 3, 3.0))


def endless(areas: Geometries, cell: Cell) -> int:
    """Return to how many pieces of 5 x 5 tiles, without a frame, the sheet about the middle one belongs."""
    # Half a tile around it: what is apart may be apart along the tile's edges alone.
    middle = shapely.box(-0.5 * cell.width, -0.5 * cell.height, 1.5 * cell.width, 1.5 * cell.height)
    pieces = cut_out(areas, cell, 5, 0.0)
    return int((shapely.area(shapely.intersection(pieces, middle)) > 1e-5).sum())


def on_torus(areas: Geometries, cell: Cell) -> int:
    """Return into how many pieces the sheet of a torus falls: parts that meet across an edge are one."""
    box = shapely.box(0, 0, cell.width, cell.height)
    parts = polygons(shapely.difference(box, shapely.union_all(areas, grid_size=1e-3), grid_size=1e-3))
    around = copies(parts, cell, 0)
    owner = np.tile(np.arange(len(parts)), len(around) // len(parts))
    one, other = shapely.STRtree(around).query(parts, predicate="intersects")
    shared = shapely.length(shapely.intersection(parts[one], around[other], grid_size=1e-3))
    names = list(range(len(parts)))
    for p, q in zip(one[shared > 5e-4].tolist(), owner[other[shared > 5e-4]].tolist(), strict=True):
        a, b = names[p], names[q]
        names = [a if each == b else each for each in names]
    return len(set(names))


def bridges(tile: Artwork, stencil: Artwork) -> list[Any]:
    """Return what each bridge of a stencil closes, whole."""
    closed = shapely.difference(
        shapely.union_all(openings(tile), grid_size=1e-3),
        shapely.union_all(openings(stencil), grid_size=1e-3),
        grid_size=1e-3,
    )
    parts = polygons(shapely.union_all(copies(polygons(closed), tile.cell, 0), grid_size=1e-3))
    tree = shapely.STRtree(parts)
    (sheet,) = stencil.facts["stencil"]["sheets"]
    places = np.array([shapely.Point(place) for place in sheet["places"]], dtype=object)
    return list(parts[tree.nearest(places)]) if len(places) else []


def without(stencil: Artwork, gone: list[Any]) -> Geometries:
    """Return what a stencil leaves open where bridges are taken away."""
    box = shapely.box(0, 0, stencil.cell.width, stencil.cell.height)
    back = copies(np.array(gone, dtype=object), stencil.cell, 1)
    back = back[shapely.intersects(back, box)]
    whole = shapely.union_all(np.concatenate([openings(stencil), back]), grid_size=1e-3)
    return polygons(shapely.intersection(whole, box, grid_size=1e-3))
