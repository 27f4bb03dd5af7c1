"""Crackle: what came into the cloth through cracks of the wax.

Cracks lie where the cloth was waxed, which is where lighter colours show than the dye's. There the dye takes
their place: they are cut out of what was waxed, exactly, and are areas of the dye's ink, or the ground's own.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, Geometries, Page
from batik_vector.artwork.overdyeing import linear
from batik_vector.errors import GeometryError, TooLargeError, unknown_name
from batik_vector.geometry.arrangement import arranged
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.regions import oriented
from batik_vector.machines import Machine
from batik_vector.processes.bodies import repeated_into
from batik_vector.processes.handwork.network import Network, count_of, grown, widths
from batik_vector.processes.handwork.options import CLOTH, CrackleProcess
from batik_vector.processes.handwork.ribbons import ribbons
from batik_vector.processes.handwork.tiles import covered, tile_of, with_areas
from batik_vector.processes.handwork.waver import Wave, Waver
from batik_vector.units import STEPS_PER_MM, format_mm

MOST = 40_000
"""Cracks past which a tile is not cracked."""
FEWEST = 4
"""Pieces that fit into a tile at least."""
WORN = 0.5
"""By how much of its breadth a crack is worn more here than there, about."""
BURST = 1.6
"""How many times broader a crack is where it begins and ends on another: wax breaks off in corners."""
CRUMB = 0.08
"""mm of breadth, on average, below which what is left between cracks and edges is dyed, too."""
BESIDE, TRIES = 0.08, 24
"""mm within which no crack should run along the tile's edge, and places that are tried for the network: a
strip of wax so thin would be left there."""


def apply(page: Page, spec: CrackleProcess, machine: Machine) -> Artwork:
    """Return a tile with cracks.

    Raises:
        GeometryError: where the page is no tile, there is no such ink, or there would be too many cracks.
    """
    tile = tile_of(page, spec)
    dye, wax = _inks(tile, spec)
    _refuse(tile.cell, spec)
    size = spec.density * STEPS_PER_MM
    network = grown(tile.cell, size, spec.seed, spec.direction, spec.along)
    cracks = _clear_of_edges(bodies(network, tile.cell, spec), tile.cell, spec.seed)
    cracks = repeated_into(tile.cell, cracks)
    drawn = covered(tile)
    made = arranged([*drawn, cracks], (0, 0, tile.cell.columns, tile.cell.rows))
    top = np.full(len(made.faces), -1, np.intp)
    for number, over in enumerate(made.covered[:-1]):
        top[over] = number
    waxed = np.isin(top, sorted(wax))
    dyed = waxed & made.covered[-1]
    dyed |= _crumbs(made.faces, waxed & ~dyed, top, tile.cell)
    areas = {}
    for number, over in enumerate(made.covered[:-1]):
        now = over & ~dyed | (dyed if number == dye else False)
        if (now != over).any():
            areas[number] = oriented(made.region(np.asarray(now, bool)))
    facts = _facts(network, made.faces, waxed, dyed, tile.cell)
    names = [layer.ink.name for layer in tile.layers]
    facts |= {"dye": CLOTH if dye < 0 else names[dye]}
    return with_areas(tile, areas, spec, facts)


def _inks(tile: Artwork, spec: CrackleProcess) -> tuple[int, set[int]]:
    """Return which ink the dye is and which were waxed, by their numbers; bare cloth is -1.

    Raises:
        GeometryError: where there is no ink of a name, or nothing can have been waxed.
    """
    names = [layer.ink.name for layer in tile.layers]
    # An ink may have the name that bare cloth has: then it is meant.
    number = {CLOTH: -1} | {name: k for k, name in enumerate(names)}
    if spec.dye and spec.dye not in number:
        raise GeometryError(f"dye = {unknown_name(spec.dye, list(number), 'ink')}")
    for name in spec.wax:
        if name not in number:
            raise GeometryError(f"wax = {unknown_name(name, list(number), 'ink')}")
    light = {-1: _light(tile.cloth)} | {k: _light(each.ink.colour) for k, each in enumerate(tile.layers)}
    dye = number[spec.dye] if spec.dye else min(light, key=lambda k: (light[k], k))
    wax = {number[name] for name in spec.wax} or {k for k in light if k != dye}
    if dye in wax:
        raise GeometryError(f'wax, expected no "{names[dye] if dye >= 0 else CLOTH}": it is the dye')
    if not wax:
        raise GeometryError('kind = "crackle", expected an ink beside the dye: nothing is waxed')
    return dye, wax


def _light(colour: str) -> float:
    red, green, blue = linear(colour)
    return round(0.2126729 * red + 0.7151522 * green + 0.0721750 * blue, 6)


def _refuse(cell: Cell, spec: CrackleProcess) -> None:
    """Raise where a network would be too large, or have next to no pieces."""
    size = spec.density * STEPS_PER_MM
    wanted, said = count_of(cell, size), f"density = {format_mm(spec.density)} mm"
    area = cell.width * cell.height
    if wanted > MOST:
        least = np.ceil(np.sqrt(area / MOST) * 100) / 100
        raise TooLargeError(
            f"{said}, expected at least {format_mm(float(least))}: the tile would have {wanted:,} cracks, "
            f"past {MOST:,}"
        )
    if wanted < FEWEST:
        most = np.floor(np.sqrt(area / FEWEST) * 100) / 100
        raise GeometryError(
            f"{said}, expected at most {format_mm(float(most))}: the tile has no room for more"
        )


def bodies(network: Network, cell: Cell, spec: CrackleProcess) -> Geometries:
    """Return cracks with their breadth, as polygons in steps that overlap where they meet."""
    least, greatest = (each * STEPS_PER_MM for each in spec.width)
    broad = widths(network.age, least, greatest)
    crack = np.repeat(np.arange(len(network)), np.diff(network.offsets))
    wave = Wave(0.5 * spec.density * STEPS_PER_MM, 1.0)
    worn = Waver.drawn(cell, [wave], (spec.seed, 2), numbers=1).at(network.points)[:, 0]
    # On average a crack is as broad as the model has it.
    room = np.minimum(np.minimum(broad - least, greatest - broad), WORN * broad)
    radius = (broad[crack] + room[crack] * worn) / 2
    ends = np.concatenate([network.offsets[:-1], network.offsets[1:] - 1])
    # No broader than what it ends on: that is older.
    radius[ends] = np.minimum(radius[ends] * BURST, greatest / 2)
    return ribbons(network.points, network.offsets, radius, round_ends=False)


def _clear_of_edges(cracks: Geometries, cell: Cell, seed: int) -> Geometries:
    """Return cracks moved to where the least of them runs along the tile's edges, which cut them anyhow."""
    xy, crack = shapely.get_coordinates(cracks, return_index=True)
    points = xy.astype(np.int64)
    same = crack[1:] == crack[:-1]
    begin, way = points[:-1][same], (points[1:] - points[:-1])[same]
    dice = np.random.default_rng([seed, 5])
    moves = np.floor(dice.random((TRIES, 2)) * (cell.columns, cell.rows)).astype(np.int64)
    beside = [_beside_edges(begin + move, way, cell) for move in moves]
    best = moves[int(np.argmin(beside))]
    return np.asarray(shapely.transform(cracks, lambda each: each + best), dtype=object)


def _beside_edges(begin: Steps, way: Steps, cell: Cell) -> int:
    """Return how long the edges are (steps) that run close along an edge of the tile."""
    (ax, ay), (bx, by) = cell.lattice
    middle = begin + way // 2
    # Along a column, or a row, tiles stand in line; beside it they may have slipped.
    x = (middle[:, 0] - middle[:, 1] // by * bx) % ax
    y = (middle[:, 1] - middle[:, 0] // ax * ay) % by
    near = BESIDE * STEPS_PER_MM
    long = np.abs(way)
    upright = (np.minimum(x, ax - x) < near) & (4 * long[:, 0] < long[:, 1])
    level = (np.minimum(y, by - y) < near) & (4 * long[:, 1] < long[:, 0])
    return int(long[upright, 1].sum() + long[level, 0].sum())


def _crumbs(faces: Geometries, left: NDArray[np.bool_], top: Index, cell: Cell) -> NDArray[np.bool_]:
    """Return which faces of what is left are too thin to be seen as pieces of wax."""
    length, area = shapely.length(faces), shapely.area(faces)
    thin = 2 * area < CRUMB * STEPS_PER_MM * length
    x0, y0, x1, y1 = shapely.bounds(faces).T
    # What the tile's edge cuts may be a corner of a large piece.
    within = (x0 > 0) & (y0 > 0) & (x1 < cell.columns) & (y1 < cell.rows)
    return np.asarray(left & thin & within, bool)


def _facts(
    network: Network, faces: Geometries, waxed: NDArray[np.bool_], dyed: NDArray[np.bool_], cell: Cell
) -> dict[str, Any]:
    area = shapely.area(faces) / STEPS_PER_MM**2
    wax = float(area[waxed].sum())
    share = float(area[dyed].sum()) / wax if wax else 0.0
    size = float(np.sqrt(cell.width * cell.height / network.pieces))
    return {
        "cracks": len(network),
        "piece_mm": round(size, 3),
        "waxed_mm2": round(wax, 3),
        "dyed": round(share, 6),
    }
