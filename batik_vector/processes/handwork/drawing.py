"""Drawn by hand: outlines waver, and lines swell and taper as a canting is pressed and runs dry.

All places are shifted smoothly (see :mod:`~batik_vector.processes.handwork.waver`), the same on both sides
of the seam. As no two places fall on one another, marks that met still meet, what lay apart still does, and
whatever was so and so broad is a known part of that at least. Lines become areas, whose breadth varies, too.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Layer, Page
from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.arrangement import arranged
from batik_vector.geometry.outlines import MM, Outlines, of_polygons, of_polylines, to_polygons
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.machines import Machine
from batik_vector.processes.bodies import repeated_into
from batik_vector.processes.handwork.corners import cornered, densified
from batik_vector.processes.handwork.options import HandProcess
from batik_vector.processes.handwork.seams import BESIDE, clear_of_seams, held_to_seams
from batik_vector.processes.handwork.strokes import strokes
from batik_vector.processes.handwork.tiles import tile_of, with_areas
from batik_vector.processes.handwork.waver import Wave, Waver
from batik_vector.units import STEPS_PER_MM, format_mm

SWAY = ((1.0, 0.11), (0.36, 0.03))
"""The waves of a hand at full strength: how far bumps stand apart, and their push, over its reach."""
STRAIN = 0.7
"""How much places part at most: nothing comes out narrower than the rest of its breadth."""
FINE = 0.25
"""How far the chords of a bent edge may stand off, over the artwork's tolerance."""
PER_BUMP = 4
"""Chords between two of the narrowest bumps at least: of 270 tiles (random recipes, three seeds each) three
had a sudden turn on the seam with 3, two with 2, none with 4."""
MOST = 1_500_000
"""Corners past which a tile is not drawn by hand."""
SPARE = 2.0
"""Steps by which a place may be narrower than asked before: outlines are rounded to the grid."""

LESS = 8.0
"""Steps by which the way of a spout may be drawn simpler than it is."""
ROUND = 8
"""Chords of a quarter of a round tip."""
ROUNDED = round(math.cos(math.pi / 4 / ROUND), 9)
"""How near these come, over how far their corners are."""


def apply(page: Page, spec: HandProcess, machine: Machine) -> Artwork:
    """Return a tile as a hand draws it, all of it as areas.

    Raises:
        GeometryError: where the page is no tile, or lines are asked to stay broader than they are.
    """
    tile = tile_of(page, spec)
    for layer in tile.layers:
        _refuse_least(layer, spec)
    if not spec.strength or not tile.layers:
        return with_areas(tile, {}, spec, {"strength": spec.strength, "most_mm": 0.0})
    waver = _waver(tile.cell, spec)
    step = _step(spec, tile.tolerance)
    _refuse_corners(tile, spec, step)
    filled = cornered([of_polygons(each.areas, MM) for each in tile.layers], tile.cell)
    drawn = [_bodies(areas, waver, step, spec, tile.cell) for areas in filled]
    # What one mark draws to the tile's edge, all do that have a corner there.
    held = held_to_seams(np.concatenate(drawn), tile.cell, step)
    made = []
    for layer, bodies in zip(tile.layers, drawn, strict=True):
        marks = [clear_of_seams(bodies, tile.cell, held)]
        lines = of_polylines(layer.lines, MM)
        if len(lines):
            marks.append(_strokes(lines, layer.ink.width, waver, spec, step))
        made.append(repeated_into(tile.cell, np.concatenate(marks)))
    arrangement = arranged(made, (0, 0, tile.cell.columns, tile.cell.rows))
    found = {
        number: oriented(arrangement.region(np.asarray(over, bool)))
        for number, over in enumerate(arrangement.covered)
    }
    return with_areas(
        tile,
        found,
        spec,
        _facts([*filled, *(of_polylines(each.lines, MM) for each in tile.layers)], waver, spec),
    )


def _refuse_least(layer: Layer, spec: HandProcess) -> None:
    width = layer.ink.width
    if spec.least is not None and len(layer.lines) and spec.least > width:
        raise GeometryError(
            f"least = {format_mm(spec.least)} mm, expected at most {format_mm(width)}: "
            f'ink "{layer.ink.name}" draws lines no broader'
        )


def _waver(cell: Cell, spec: HandProcess) -> Waver:
    reach = spec.reach * STEPS_PER_MM
    waves = [Wave(far * reach, push * reach * spec.strength) for far, push in SWAY]
    return Waver.drawn(cell, waves, (spec.seed, 3)).eased(STRAIN * spec.strength)


def _step(spec: HandProcess, tolerance: float) -> float:
    """Return how long a chord may be (steps), where bumps bend a straight edge the most, about.

    It is a part of the narrowest bump at most: else outlines turn suddenly here and there, at the seam too.
    """
    reach = spec.reach * STEPS_PER_MM
    bend = sum(2 * push * spec.strength / (far * far * reach) for far, push in SWAY)
    longest = min(far for far, _ in SWAY) * reach / PER_BUMP
    return min(float(np.sqrt(8 * FINE * tolerance * STEPS_PER_MM / bend)), longest)


def _refuse_corners(tile: Artwork, spec: HandProcess, step: float) -> None:
    """Raise where a tile would have too many corners."""
    length = sum(
        float(shapely.length(each).sum()) for layer in tile.layers for each in (layer.areas, layer.lines)
    )
    total = tile.vertex_count + round(length * STEPS_PER_MM / step)
    if total > MOST:
        raise TooLargeError(
            f"reach = {format_mm(spec.reach)} mm, expected more, or a smaller tile: it would have about "
            f"{total:,} corners, past {MOST:,}"
        )


def _moved(areas: Outlines, waver: Waver, step: float) -> Geometries:
    """Return areas as a hand draws them, in steps."""
    fine = densified(areas, step)
    return to_polygons(replace(fine, points=waver.moved(fine.points)))


def _bodies(areas: Outlines, waver: Waver, step: float, spec: HandProcess, cell: Cell) -> Geometries:
    """Return areas as a hand draws them, and what the spout covers in them."""
    moved = _moved(areas, waver, step)
    if spec.least is None:
        return moved
    return np.concatenate(
        [moved, _spouts(to_polygons(areas), waver, step, spec.least * STEPS_PER_MM / 2, cell)]
    )


def _strokes(lines: Outlines, width: float, waver: Waver, spec: HandProcess, step: float) -> Geometries:
    """Return lines as a hand draws them, as broad as asked where they are drawn to the tile's edge, too.

    They are united: where lines lie close together, their many bends and ends cross one another very often.
    """
    made = strokes(lines, width, waver, spec, step)
    clear = clear_of_seams(made, waver.cell, held_to_seams(made, waver.cell, step))
    if clear is not made:
        made = strokes(lines, width, waver, spec, step, 2.0 * BESIDE)
        clear = clear_of_seams(made, waver.cell, held_to_seams(made, waver.cell, step))
    # What was pushed clear of the edge may have been pushed flat, or over itself.
    good = np.asarray(shapely.is_valid(clear), bool)
    clear = np.concatenate([clear[good], polygonal(shapely.make_valid(clear[~good]))])
    return oriented(polygonal(shapely.union_all(clear, grid_size=1)))


def _spouts(areas: Geometries, waver: Waver, step: float, radius: float, cell: Cell) -> Geometries:
    """Return what a round spout of some radius covers on its way through areas, as these have wavered.

    Wherever it fitted in before it is drawn whole now: no place that was so broad comes out narrower.
    """
    if not len(areas):
        return areas
    margin = int(np.ceil(2 * radius)) + 2
    box = -margin, -margin, cell.columns + margin, cell.rows + margin
    around = repeated_into(cell, areas, margin)
    whole = arranged([around], box)
    welded = whole.region(np.asarray(whole.covered[0], bool))
    ways = shapely.buffer(welded, -max(radius - SPARE, 0.0), quad_segs=ROUND)
    ways = polygonal(shapely.clip_by_rect(np.asarray(ways, dtype=object), 0, 0, cell.columns, cell.rows))
    if not len(ways):
        return ways
    moved = shapely.make_valid(
        _moved(of_polygons(oriented(ways)), waver, step), method="structure", keep_collapsed=False
    )
    moved = polygonal(moved)
    # Chords about round tips come nearer than their corners, and what is left out of a way may be as near.
    most = (radius + LESS + 0.5) / ROUNDED
    broad = shapely.buffer(shapely.simplify(moved, LESS), most, quad_segs=ROUND)
    return oriented(polygonal(shapely.set_precision(broad, 1)))


def _facts(marks: list[Outlines], waver: Waver, spec: HandProcess) -> dict[str, Any]:
    points = np.concatenate([each.points for each in marks])
    far = waver.at(points)
    most = float(np.sqrt((far * far).sum(axis=1).max(initial=0.0))) / STEPS_PER_MM
    return {"strength": spec.strength, "most_mm": round(most, 3)}
