"""Stock: what is cut out of one sheet, and what of it each kind of stroke is."""

from __future__ import annotations

from dataclasses import field, replace
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Ink, Page
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Outlines, nothing
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.choices import Inks
from batik_vector.processes.cutting.overlays import without_hairs
from batik_vector.processes.cutting.pieces import laid_out
from batik_vector.processes.cutting.regions import regions_of
from batik_vector.processes.cutting.shared import as_seen, shared
from batik_vector.processes.cutting.told import Told
from batik_vector.processes.prepared import whole_page
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

TOOL = "cut"
"""What the one tool is called that cuts all inks."""
COLOUR = "#ff0000"
"""The colour by which many laser programs know a cut."""
HAIRLINE = 0.1
"""How broad in mm a cut is shown that has no kerf."""


@frozen(eq=False)
class Stock:
    """What is cut out of one sheet: polygons that do not overlap, and edges within them that are cut too."""

    ink: Ink
    regions: Geometries
    edges: Outlines = field(default_factory=nothing)
    bodies: int = 0
    """How many lines became areas."""


def stocks_of(page: Page, told: Told) -> list[Stock]:
    """Return what a page asks to be cut, for each sheet."""
    layers = [(plate, areas, lines) for plate, areas, lines in whole_page(page) if not plate.guide]
    made = [regions_of(areas, lines, plate.ink, told.lines) for plate, areas, lines in layers]
    if told.inks is Inks.APART:
        return [
            Stock(_shown(plate.ink, told.kerf), without_hairs(regions), bodies=bodies)
            for (plate, _, _), (regions, bodies) in zip(layers, made, strict=True)
        ]
    regions, edges = shared([without_hairs(each) for each in as_seen([regions for regions, _ in made])])
    ink = layers[0][0].ink if len(layers) == 1 else Ink(TOOL, COLOUR)
    return [Stock(_shown(ink, told.kerf), regions, edges, sum(bodies for _, bodies in made))]


def _shown(ink: Ink, kerf: int) -> Ink:
    """Return an ink whose lines are as broad as the cut."""
    return replace(ink, width=kerf / STEPS_PER_MM or HAIRLINE)


def nested(stock: Stock, told: Told) -> tuple[Stock, dict[str, Any]]:
    """Return what lies on the sheet that is asked for, and what there is to say of the sheets.

    Raises:
        GeometryError: where a piece is larger than a sheet, or more sheets are needed than one.
    """
    if told.sheet is None or not len(stock.regions):
        return stock, {}
    width, height = told.sheet
    found = laid_out(stock.regions, stock.edges, told.sheet, told.gap, told.quarters, told.inset)
    if found is None:
        raise GeometryError(
            f"sheet = {_size(width, height)}, expected at least {_room(stock, told.gap + 2 * told.inset)}"
        )
    sheets, pieces = found
    number = told.sheet_number or 1
    if told.sheet_number is None and len(sheets) > 1:
        raise GeometryError(
            f"sheet = {_size(width, height)}, expected one that holds all pieces: they fill {len(sheets)}; "
            f"sheet_number = 1 to {len(sheets)} in outputs of their own writes them, or take a higher sheet"
        )
    if number > len(sheets):
        raise GeometryError(f"sheet_number = {number}, expected at most {len(sheets)}: no more are filled")
    regions, edges = sheets[number - 1]
    used = -told.inset + float(shapely.bounds(shapely.multipolygons(regions))[3]) + told.gap / 2
    facts = {
        "sheets": len(sheets),
        "pieces": pieces[number - 1],
        "height_used_mm": round(used / STEPS_PER_MM, 3),
        "covered": round(float(shapely.area(regions).sum()) / ((width - 2 * told.inset) * used), 4),
        "covered_before": round(_covered(stock.regions), 4),
    }
    return replace(stock, regions=regions, edges=edges), facts


def _covered(regions: Geometries) -> float:
    left, low, right, high = shapely.total_bounds(regions).tolist()
    around: float = (right - left) * (high - low)
    return float(shapely.area(regions).sum()) / around


def _room(stock: Stock, gap: int) -> str:
    """Return the sheet on which the largest piece would fit."""
    bounds = shapely.bounds(stock.regions)
    sides = np.sort(np.stack([bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1]], axis=1), axis=1)
    broad, tall = (np.ceil((sides.max(axis=0) + gap) / STEPS_PER_MM) + 1).astype(int).tolist()
    return f"{tall} x {broad} mm for its largest piece"


def _size(width: int, height: int) -> str:
    return f"{width / STEPS_PER_MM:g} x {height / STEPS_PER_MM:g} mm"
