"""Counterchange: where a placement lies over what is drawn beneath in its ink, figure and ground trade inks.

What lies beneath and what lies above are each settled on the torus of the repeat, in grid steps; the ink is
then drawn where one of them is and the other is not. So every crossing is one place, and no seam shows.
Woods, "The geometrical basis of pattern design, part IV: counterchange symmetry in plane patterns", 1936.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Geometries, Ink, Overlap
from batik_vector.errors import GeometryError
from batik_vector.geometry import work
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.torus.torus import Lattice, Window, clip_areas, to_mm, to_step_grid, wrap
from batik_vector.tiling.welding.congruent import polygons
from batik_vector.tiling.welding.growth import grown
from batik_vector.tiling.welding.sheets import Sheet


def traded(below: Sequence[Sheet], own: Sequence[Sheet], lattice: Lattice, tolerance: float) -> list[Sheet]:
    """Return sheets, bottom first, in which a placement has traded inks with what lies beneath it.

    Args:
        below: what earlier placements have put down.
        own: what the placement puts down.
        lattice: on which all repeats, in grid steps.
        tolerance: in mm, for the round corners of gaps.

    Raises:
        GeometryError: where nothing beneath has an ink of the placement's, or one that keeps its marks apart.
    """
    inks = {sheet.ink.name: sheet.ink for sheet in own if sheet.ink is not None and len(sheet.areas)}
    lower, upper = list(below), list(own)
    traded_any = False
    for ink in inks.values():
        if not any(
            sheet.ink is not None and sheet.ink.name == ink.name and len(sheet.areas) for sheet in below
        ):
            continue
        if ink.overlap == Overlap.OVERLAY:
            raise GeometryError(
                f'counterchange: ink "{ink.name}" has overlap = "overlay", which keeps its marks apart: '
                'expected "weld" or "knockout"'
            )
        traded_any = True
        both = [_settled(sheets, ink, lattice, tolerance) for sheets in (lower, upper)]
        areas = _either(*both)
        first = next(number for number, sheet in enumerate(upper) if _draws(sheet, ink))
        gaps = any(sheet.gap is not None for sheet in (*lower, *upper) if _draws(sheet, ink))
        over = 0.0 if gaps or ink.overlap == Overlap.KNOCKOUT else None
        lower = [_without_areas(sheet) if _draws(sheet, ink) else sheet for sheet in lower]
        name = upper[first].name
        upper = [_without_areas(sheet) if _draws(sheet, ink) else sheet for sheet in upper]
        upper.insert(first, Sheet(name, ink, areas, gap=over))
    if not traded_any:
        named = ", ".join(f'"{name}"' for name in inks)
        raise GeometryError(
            f"counterchange: nothing beneath is drawn in {named or 'any ink'} to trade with: expected a "
            "placement with areas of that ink before it"
        )
    # What is cut out of the motif is no part of its figure; it cuts nothing else.
    return lower + [sheet for sheet in upper if sheet.ink is not None]


def _draws(sheet: Sheet, ink: Ink) -> bool:
    return sheet.ink is not None and sheet.ink.name == ink.name and len(sheet.areas) > 0


def _without_areas(sheet: Sheet) -> Sheet:
    nothing = np.empty(0, dtype=object)
    return replace(sheet, areas=nothing, cutter=nothing, gap=sheet.gap if len(sheet.lines) else None)


def _settled(sheets: Sequence[Sheet], ink: Ink, lattice: Lattice, tolerance: float) -> shapely.Geometry:
    """Return what sheets leave of an ink's areas, in the window of a lattice, in grid steps."""
    found: shapely.Geometry = shapely.Polygon()
    for sheet in sheets:
        if _draws(sheet, ink):
            found = overlay.united(
                [np.array([found, _region(polygons(sheet.areas), lattice)], dtype=object)]
            )[0]
        elif sheet.gap is not None and not shapely.is_empty(found):
            shapes = polygons(sheet.cutter) if len(sheet.cutter) else polygons(sheet.areas)
            away = grown(shapes, sheet.gap, tolerance) if sheet.gap else shapes
            found = overlay.less(_one(found), _one(_region(away, lattice)))[0]
    return found


def _region(areas: Geometries, lattice: Lattice) -> shapely.Geometry:
    """Return what areas (mm) and their translates cover of the window of a lattice, in grid steps."""
    window = Window(0, 0, lattice[0][0], lattice[1][1])
    steps = polygonal(to_step_grid(areas))
    there, _ = wrap(steps, np.arange(len(steps)), lattice, window)
    pieces, _ = clip_areas(there, np.zeros(len(there), np.intp), window)
    return overlay.united([pieces])[0] if len(pieces) else shapely.Polygon()


def _either(one: shapely.Geometry, other: shapely.Geometry) -> Geometries:
    """Return in mm what lies in one of two regions, in grid steps, and not in the other."""
    both = shapely.get_num_coordinates(np.array([one, other], dtype=object))
    work.spend(float(both.sum()))
    made = shapely.symmetric_difference(one, other)
    work.spend_on_union(np.array([one, other], dtype=object), _one(made))
    rounded = shapely.transform(made, lambda xy: np.floor(xy + 0.5))
    if not shapely.is_valid(rounded):
        rounded = shapely.symmetric_difference(one, other, grid_size=1.0)
    parts = np.asarray(shapely.get_parts(rounded), dtype=object)
    return oriented(to_mm(parts[shapely.area(parts) > 0]))


def _one(shape: shapely.Geometry) -> Geometries:
    return np.array([shape], dtype=object)
