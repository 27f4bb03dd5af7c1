"""What the copies of one placement draw and cut: a sheet of marks for each element of its motif, in mm.

Whatever copies have in common, bodies of lines too, is made once and then set down.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from batik_vector.artwork import Geometries, Ink, Overlap
from batik_vector.errors import RecipeError, UnknownNameError
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.outlines import Index
from batik_vector.recipe.figures import Figure
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.welding.congruent import Areas, polygons
from batik_vector.tiling.welding.copies_on_grid import Spread, joined, landed, spreads
from batik_vector.tiling.welding.growth import grown
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.values import frozen


@frozen(eq=False)
class Laid:
    """Figures of a motif, bottom first, and the maps that bring them to mm on cloth, one for each copy.

    ``movable`` says whether copies may be moved by part of a grid step.
    """

    figures: list[Figure]
    maps: Affines
    movable: bool = False


@frozen(eq=False)
class Look:
    """What the looks of elements hang on: their placement, the inks by name, and the tolerance in mm."""

    placement: Placement
    inks: Mapping[str, Ink]
    tolerance: float


def sized(figures: list[Figure], maps: Affines) -> list[Figure]:
    """Return the images of figures under maps, those of each map together."""
    areas = _divided(maps, [figure.areas for figure in figures])
    lines = _divided(maps, [figure.lines for figure in figures])
    return [replace(f, areas=a, lines=b) for f, a, b in zip(figures, areas, lines, strict=True)]


def _divided(maps: Affines, parts: list[Geometries]) -> list[Geometries]:
    """Return the images of several arrays of marks, which are made all at once."""
    ends = np.cumsum([len(part) for part in parts])
    if not ends[-1]:
        return parts
    images = maps.apply(np.concatenate(parts)).reshape(len(maps), -1)
    return [part.ravel() for part in np.split(images, ends[:-1], axis=1)]


def set_down(laid: Laid, motif: str, look: Look) -> tuple[list[Sheet], list[Sheet]]:
    """Return the sheets of a motif: the one that keeps the ground bare where there is one, and all others."""
    groups = spreads(
        laid.maps,
        (lambda: [part for f in laid.figures for part in (f.areas, f.lines)]) if laid.movable else None,
    )
    patterns = []
    for spread in groups:
        figures = sized(laid.figures, spread.first)
        bare = _bare(figures, motif, look)
        patterns.append(bare + [sheet for figure in figures for sheet in _sheets(figure, motif, look)])
    shapes = [[polygons(part) for sheet in own for part in (sheet.areas, sheet.cutter)] for own in patterns]
    areas = _areas(groups, shapes)
    lines = _lines(groups, [[sheet.lines for sheet in own] for own in patterns])
    sheets = [
        replace(sheet, areas=areas[2 * i], cutter=areas[2 * i + 1], lines=lines[i])
        for i, sheet in enumerate(patterns[0])
    ]
    return sheets[: len(bare)], sheets[len(bare) :]


def _areas(groups: Sequence[Spread], parts: Sequence[list[Geometries]]) -> list[Areas]:
    """Return all copies of several arrays of polygons, in the copies' order; on the grid where they are.

    Args:
        groups: of copies.
        parts: for each group the arrays, which ``first`` has brought to their size.
    """
    count = [len(part) for part in parts[0]]
    if not any(count):
        return [*parts[0]]
    found = [group.landed(np.concatenate(own)) for group, own in zip(groups, parts, strict=True)]
    on_grid = [each for each in found if each is not None]
    if len(on_grid) < len(found):
        return [*_lines(groups, parts)]
    areas, copy, mark = landed(on_grid)
    areas = areas.reduced()
    return [areas.taken(which) for which in _parted(count, copy, mark)]


def _lines(groups: Sequence[Spread], parts: Sequence[list[Geometries]]) -> list[Geometries]:
    """Return all copies of several arrays of marks, in the order of the copies."""
    if (len(groups) == 1 and groups[0].is_done) or not any(len(part) for part in parts[0]):
        return parts[0]
    found = joined([group.images(np.concatenate(own)) for group, own in zip(groups, parts, strict=True)])
    return [found.geometries[which] for which in _parted([len(p) for p in parts[0]], found.copy, found.mark)]


def _parted(count: Sequence[int], copy: Index, mark: Index) -> list[Index]:
    """Return which images belong to each of several arrays of ``count`` marks, in the order of the copies."""
    part = np.repeat(np.arange(len(count)), count)[mark]
    order = np.lexsort((mark, copy, part))
    return np.split(order, np.cumsum(np.bincount(part, minlength=len(count)))[:-1])


def _sheets(figure: Figure, motif: str, look: Look) -> list[Sheet]:
    """Return what an element (mm) draws: one sheet, or two where its line is a sheet of its own."""
    element = figure.element
    name = ".".join(part for part in (motif, element.name) if part)
    areas, lines = figure.areas, figure.lines
    if element.treatment == Treatment.CUT:
        return [Sheet(name, None, areas, gap=element.gap or 0.0)]
    ink = _ink(element, element.ink or look.placement.ink, look.inks)
    gap = element.gap
    if gap is None and ink.overlap == Overlap.KNOCKOUT:
        gap = 0.0
    if element.treatment == Treatment.AREA:
        return [Sheet(name, ink, areas, gap=gap, whole=element.whole)]
    pen = _ink(element, element.line_ink, look.inks) if element.line_ink else ink
    half = pen.width / 2
    # A line's body reaches beyond the area it goes round, and hides what lies under it too.
    hidden = grown(areas, half, look.tolerance) if gap is not None else areas[:0]
    if element.treatment == Treatment.BOTH:
        over = 0.0 if pen is not ink and pen.overlap == Overlap.KNOCKOUT else None
        return [
            Sheet(name, ink, areas, gap=gap, cutter=hidden, whole=element.whole, margin=half),
            Sheet(f"{name}.line", pen, lines=lines, gap=over, whole=element.whole),
        ]
    if element.treatment == Treatment.LINE:
        return [Sheet(name, ink, lines=lines, gap=gap, cutter=hidden, whole=element.whole)]
    body = grown(lines, half, look.tolerance)
    return [Sheet(name, ink, body, gap=gap, cutter=np.concatenate([body, hidden]), whole=element.whole)]


def _bare(figures: list[Figure], motif: str, look: Look) -> list[Sheet]:
    """Return the sheet that keeps the ground bare round a whole motif, where one is asked for."""
    if look.placement.gap is None:
        return []
    shapes = []
    for figure in figures:
        element, shape = figure.element, [figure.areas]
        if len(figure.lines) and element.treatment not in (Treatment.AREA, Treatment.CUT):
            pen = _ink(element, element.line_ink or element.ink or look.placement.ink, look.inks)
            shape = [grown(part, pen.width / 2, look.tolerance) for part in (figure.areas, figure.lines)]
        shapes += shape
    return [Sheet(motif, None, np.concatenate(shapes), gap=look.placement.gap)]


def _ink(element: Dress, name: str, inks: Mapping[str, Ink]) -> Ink:
    if not name and len(inks) == 1:
        return next(iter(inks.values()))
    if not name:
        raise RecipeError(f"no ink is named, and the recipe has several: expected one of {', '.join(inks)}")
    if name not in inks:
        raise UnknownNameError(name, list(inks), "ink")
    return inks[name]
