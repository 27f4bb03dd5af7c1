"""Trap: where two inks meet the one spreads under the other, so that no cloth shows between them.

Screens never register exactly. An ink that spreads is printed a little beyond the edge that is seen, within
the other ink alone: bare cloth stays bare. On a tile traps go on across the seam.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Page
from batik_vector.artwork.overdyeing import linear
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Outlines, of_polygons, to_polygons
from batik_vector.geometry.regions import oriented
from batik_vector.machines import Machine
from batik_vector.processes.options import TrapProcess
from batik_vector.processes.trapping.choices import By, Covered
from batik_vector.processes.trapping.covered import CoveredMark, covered_marks
from batik_vector.processes.trapping.enclosed import enclosed, winding
from batik_vector.processes.trapping.joining import grown, seam_borders
from batik_vector.processes.trapping.linking import linked
from batik_vector.processes.trapping.meeting import meetings, with_corners
from batik_vector.processes.trapping.remaining import remaining
from batik_vector.processes.trapping.spreading import SAG, Spread, broadened, moved, repeats, spread
from batik_vector.units import STEPS_PER_MM, format_mm

PART = 4
"""Traps as broad as a quarter of the tile would meet their own repeats."""


def apply(page: Page, spec: TrapProcess, machine: Machine) -> Artwork:
    """Return a tile with traps: areas of each ink with what they spread under others.

    Raises:
        GeometryError: where the page is no tile, or a trap would cover a mark, with the value that would do.
    """
    if not isinstance(page, Artwork) or page.bleed:
        raise GeometryError(
            'kind = "trap", expected a tile, and before any other process: traps are the tile\'s, and repeat '
            "with it"
        )
    side = min(page.cell.width, page.cell.height)
    if spec.width * PART > side:
        raise GeometryError(
            f"width = {format_mm(spec.width)} mm, expected at most {format_mm(side / PART)}: a quarter of "
            "the tile"
        )
    width, cell = spec.width * STEPS_PER_MM, page.cell
    pairs = spreads_under([layer.ink for layer in page.layers], spec.by)
    whole = [_outlines(layer.areas) for layer in page.layers]
    begun = enclosed(whole, pairs, cell, width, SAG)
    left = [
        remaining(outlines, done, layer.area_names)
        for outlines, done, layer in zip(begun.layers, begun.done, page.layers, strict=True)
    ]
    drawn = [to_polygons(each.areas) for each in left]
    areas = _with_corners(drawn)
    found, facts = _traps(areas, [layer.ink for layer in page.layers], cell, spec, begun.lengths)
    layers, gains = list(page.layers), list[dict[str, Any]]()
    borders = page.borders
    for number, traps in enumerate(found):
        layer, outlines = page.layers[number], begun.layers[number]
        if len(traps):
            made, names = left[number].with_all(*grown(areas[number], drawn[number], traps, cell))
            layers[number] = replace(layer, areas=_in_mm(made), area_names=names)
            borders = frozenset(each for each in borders if each[0] != layer.ink.name)
            borders |= seam_borders(layer.ink.name, made, cell)
        elif outlines is not whole[number]:
            layers[number] = replace(layer, areas=to_polygons(outlines, STEPS_PER_MM))
        if layers[number] is not layer:
            more = float(shapely.area(layers[number].areas).sum() - shapely.area(layer.areas).sum())
            gains.append({"ink": layer.ink.name, "area_mm2": round(more, 3)})
    done = (*page.provenance.processes, str(spec))
    return replace(
        page,
        layers=tuple(layers),
        borders=borders,
        provenance=replace(page.provenance, processes=done),
        facts={"trap": {"width_mm": spec.width, "by": str(spec.by.value), **facts, "gains": gains}},
    )


def _outlines(areas: Geometries) -> Outlines:
    """Return areas in steps, outer rings anticlockwise and holes clockwise."""
    found = of_polygons(areas, float(STEPS_PER_MM))
    if winding(found).all():
        return found
    return of_polygons(oriented(areas), float(STEPS_PER_MM))


def _in_mm(areas: Geometries) -> Geometries:
    return np.asarray(shapely.transform(areas, lambda xy: xy / STEPS_PER_MM), dtype=object)


def _with_corners(drawn: Sequence[Geometries]) -> list[Geometries]:
    """Return areas with corners where others have them, but those that would be torn by it."""
    made = [to_polygons(each) for each in with_corners([of_polygons(each) for each in drawn])]
    return [
        np.where(shapely.is_valid(more), more, each) if len(each) else each
        for more, each in zip(made, drawn, strict=True)
    ]


def spreads_under(inks: Sequence[Ink], by: By) -> list[tuple[int, int]]:
    """Return which inks spread under which others, by their numbers; of equally light ones the lower does."""
    light = [_lightness(each.colour) if by is By.LIGHTNESS else 0.0 for each in inks]
    order = sorted(range(len(inks)), key=lambda number: (-light[number], number))
    return [(one, other) for k, one in enumerate(order) for other in order[k + 1 :]]


def _lightness(colour: str) -> float:
    """Return the luminance of a colour on screen, 0 to 1, by which the lightness of CIE 1976 goes."""
    red, green, blue = linear(colour)
    return round(0.2126729 * red + 0.7151522 * green + 0.0721750 * blue, 6)


def _traps(
    areas: list[Geometries],
    inks: Sequence[Ink],
    cell: Cell,
    spec: TrapProcess,
    begun: Mapping[tuple[int, int], float],
) -> tuple[list[Geometries], dict[str, Any]]:
    """Return what each ink gains, and what there is to say of it; ``begun`` has lengths that are done."""
    width = spec.width * STEPS_PER_MM
    meet = meetings([of_polygons(each) for each in areas], cell)
    gains = [[np.empty(0, dtype=object)] for _ in areas]
    under: list[list[Spread]] = [[] for _ in areas]
    pairs = list[dict[str, Any]]()
    for one, other in spreads_under(inks, spec.by):
        lines = meet.lines[(meet.left == one) & (meet.right == other)]
        length = float(shapely.length(lines).sum()) + begun.get((one, other), 0.0)
        if length:
            long = round(length / STEPS_PER_MM, 2)
            pairs.append({"ink": inks[one].name, "under": inks[other].name, "length_mm": long})
        if not len(lines):
            continue
        lines = linked(lines, cell)
        bands = broadened(lines, width)
        which, shifts = repeats(bands, cell)
        traps = spread(moved(lines[which], shifts), moved(bands[which], shifts), areas[other], which, shifts)
        gains[one].append(traps.areas)
        under[other].append(traps)
    covered = [
        (inks[number].name, mark)
        for number, each in enumerate(under)
        if each
        for mark in covered_marks(areas[number], _all(each), cell)
    ]
    if covered and spec.covered is Covered.REFUSE:
        raise _too_broad(covered, spec)
    return [np.concatenate(each) for each in gains], {"pairs": pairs, "covered": len(covered)}


def _all(each: Sequence[Spread]) -> Spread:
    return Spread(
        np.concatenate([traps.areas for traps in each]), np.concatenate([traps.owner for traps in each])
    )


def _too_broad(covered: Sequence[tuple[str, CoveredMark]], spec: TrapProcess) -> GeometryError:
    """Return what is wrong with a trap that covers marks whole, and what would do."""
    ink, mark = min(covered, key=lambda each: each[1].breadth)
    x, y = mark.x / STEPS_PER_MM, mark.y / STEPS_PER_MM
    most = int(mark.breadth - 5) // 10 * 10 / STEPS_PER_MM
    would = f"at most {format_mm(most)}" if most >= 0.01 else 'covered = "accept"'
    others = f" and {len(covered) - 1:,} more" if len(covered) > 1 else ""
    return GeometryError(
        f'width = {format_mm(spec.width)} mm, expected {would}: the mark of ink "{ink}" at '
        f'({x:.3f}, {y:.3f}) mm{others} would be covered whole; covered = "accept" traps it so'
    )
