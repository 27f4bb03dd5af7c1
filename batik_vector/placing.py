"""One placement, from its motif to sheets of marks in millimetres on cloth."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from batik_vector.artwork import Cell, Geometries, Ink, Overlap
from batik_vector.errors import GeometryError, RecipeError, TooLargeError, UnknownNameError, blame
from batik_vector.geometry.ifs import distinct
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.sampling import Array, Points
from batik_vector.grounds import Ground, lattice_of, scattered, striped
from batik_vector.model import Recipe
from batik_vector.motif import Element, Figure, Motif, Treatment, draw
from batik_vector.placement import Placement
from batik_vector.tiling.layouts import Bend, Stripes, Toss
from batik_vector.tiling.orbits import TRIVIAL, Orbit
from batik_vector.tiling.stack import Sheet, quad_segs
from batik_vector.tiling.toss import Tossed
from batik_vector.units import GRID_MM

COARSE = 2e-3
"""Tolerance of the first drawing, in motif units: enough to measure it and to foretell its size."""

GRID_SHARE = 1.5 * GRID_MM
"""What is kept of the tolerance for the moves that vertices make onto the grid."""

SOURCE_SHARE = 0.2
"""Share of the tolerance that the source of a bent image may use; the bending itself has the rest."""


@dataclass(frozen=True)
class Placed:
    """The sheets of a placement, bottom first, how many vertices they have, and the toss where it is one."""

    sheets: list[Sheet]
    vertices: int
    tossed: Tossed | None = None


def place(
    placement: Placement,
    recipe: Recipe,
    unit: Cell,
    inks: Mapping[str, Ink],
    limit: int,
    orbit: Orbit = TRIVIAL,
    before: Sequence[Placed] = (),
) -> Placed:
    """Draw a placement's motif, set it out, bring it to millimetres and multiply it by its symmetry.

    Args:
        placement: what is set where.
        recipe: whose motifs and tolerance hold.
        unit: the repeat's unit, for layouts that fill it and for the default place.
        inks: by name.
        limit: vertices past which the work is refused before it is begun.
        orbit: under which symmetries all copies are drawn.
        before: what earlier placements have put down, which a toss keeps clear of.

    Raises:
        GeometryError, RecipeError: in the words of what cannot be drawn.
    """
    if isinstance(placement.layout, Toss | Stripes):
        return _ground(placement, recipe, unit, inks, limit, orbit, before)
    motif = _known(recipe.motif, placement.motifs[0], "motif")
    rough = draw(motif, COARSE)
    with blame("layout"):
        images = placement.layout.images((1.0, 1.0))
    times = len(orbit.operations)
    _refuse_past(limit, rough, images, times)
    with blame("layout"):
        scale = placement.scale or _scale(placement, rough, images)
        cell = unit.width / orbit.base.a, unit.height / orbit.base.d
        images = placement.layout.images((cell[0] / scale, cell[1] / scale))
    _refuse_past(limit, rough, images, times, COARSE * scale / recipe.tolerance)
    finest = max(recipe.tolerance - GRID_SHARE, recipe.tolerance / 2) / max(orbit.base.stretch, 1.0)
    tolerance = finest / scale
    with blame("layout"):
        figures, copies = _set_out(motif, images, tolerance)
    spread = [_copied(figure, copies) for figure in figures]
    if placement.width and placement.layout.spreads:
        # Measured again on the fine drawing: the coarse one is a little narrower.
        scale = placement.width / _extent(spread)
    at = placement.at or orbit.middle or (cell[0] / 2, cell[1] / 2)
    on_cloth = orbit.base @ Affine.translation(at) @ Affine.turn(placement.turn) @ Affine.scale(scale)
    if orbit.is_trivial or orbit.region:
        drawn = [_copied(figure, [on_cloth]) for figure in spread]
        drawn = [replace(f, areas=orbit.mirrored(f.areas), lines=orbit.mirrored(f.lines)) for f in drawn]
    else:
        maps = orbit.images([on_cloth @ copy for copy in copies], _marks_of(figures), tolerance)
        drawn = [_copied(figure, maps) for figure in figures]
    return _placed({placement.motifs[0]: drawn}, placement, inks, recipe.tolerance)


def _placed(
    drawn: Mapping[str, list[Figure]],
    placement: Placement,
    inks: Mapping[str, Ink],
    tolerance: float,
    tossed: Tossed | None = None,
) -> Placed:
    """Return the sheets of all motifs of a placement, whose figures are in mm."""
    named = {name: replace(placement, motif=name) for name in drawn}
    sheets = [sheet for name, own in named.items() for sheet in _bare(drawn[name], own, inks, tolerance)]
    for name, own in named.items():
        for figure in drawn[name]:
            sheets += _sheets(figure, own, inks, tolerance)
    marks = np.concatenate([part for sheet in sheets for part in (sheet.areas, sheet.lines)])
    return Placed(sheets, int(shapely.get_num_coordinates(marks).sum()), tossed)


def _ground(
    placement: Placement,
    recipe: Recipe,
    unit: Cell,
    inks: Mapping[str, Ink],
    limit: int,
    orbit: Orbit,
    before: Sequence[Placed],
) -> Placed:
    """Do the work of :func:`place` for a layout that fills the repeat."""
    motifs = {name: _known(recipe.motif, name, "motif") for name in placement.motifs}
    rough = {name: draw(motif, COARSE) for name, motif in motifs.items()}
    scale = placement.scale or (placement.width or 1.0) / max(_extent(each) for each in rough.values())
    finest = max(recipe.tolerance - GRID_SHARE, recipe.tolerance / 2)
    finer, times = COARSE * scale / finest, len(orbit.operations)
    tossed, drawn = None, {}
    with blame("layout"):
        tosses = [each.tossed for each in before if each.tossed]
        sheets = [sheet for each in before for sheet in each.sheets]
        ground = Ground(lattice_of(unit, orbit), orbit, inks, recipe.tolerance, recipe.seed, tosses, sheets)
        if isinstance(placement.layout, Toss):
            tossed = scattered(placement, placement.layout, motifs, scale, ground)
            for (name, motif), copies in zip(motifs.items(), tossed.copies, strict=True):
                if copies:
                    _refuse_past(limit, rough[name], copies, times, finer)
                    figures, copies = _set_out(motif, copies, finest)
                    drawn[name] = [_multiplied(figure, copies, orbit) for figure in figures]
        elif isinstance(placement.layout, Stripes):
            lines = striped(placement, placement.layout, scale, unit, ground)
            for name, motif in motifs.items():
                copies = [IDENTITY] * (len(lines.starts) * lines.links)
                _refuse_past(limit, rough[name], copies, times, finer)
                for figure in _shown(draw(motif, finest / lines.stretch)):
                    figure = replace(figure, areas=lines.areas(figure.areas), lines=lines.lines(figure.lines))
                    drawn.setdefault(name, []).append(_multiplied(figure, [IDENTITY], orbit))
    return _placed(drawn, placement, inks, recipe.tolerance, tossed)


def _multiplied(figure: Figure, copies: list[Affine], orbit: Orbit) -> Figure:
    """Return copies of a figure, in mm, and their images under the symmetry."""
    if orbit.region is None:
        return _copied(figure, [operation @ copy for operation in orbit.operations for copy in copies])
    figure = _copied(figure, copies)
    return replace(figure, areas=orbit.mirrored(figure.areas), lines=orbit.mirrored(figure.lines))


def _refuse_past(
    limit: int, rough: list[Figure], images: list[Affine] | Bend, times: int, finer: float = 1.0
) -> None:
    """Raise where ``times`` drawings, ``finer`` times as fine as the rough one, would pass the limit."""
    count = images.system.image_count() if isinstance(images, Bend) else len(images)
    vertices = _estimate(rough, count * times, finer)
    if vertices > limit:
        raise TooLargeError(
            f"about {_human(vertices)} vertices, past the limit of {limit:,}: lower the level or the counts, "
            "allow a larger tolerance, or raise the recipe's limit"
        )


def _known(catalogue: Mapping[str, Motif], name: str, what: str) -> Motif:
    if name not in catalogue:
        raise UnknownNameError(name, list(catalogue), what)
    return catalogue[name]


def _scale(placement: Placement, rough: list[Figure], images: list[Affine] | Bend) -> float:
    if placement.width is None:
        raise RecipeError("a placement needs a width or a scale")
    if not placement.layout.spreads:
        return placement.width / _extent(rough)
    if isinstance(images, Bend):
        return placement.width / _extent(_bent(rough, images, COARSE))
    return placement.width / _extent([_copied(figure, images) for figure in _hulls(rough)])


def _hulls(figures: list[Figure]) -> list[Figure]:
    """Return one figure that reaches as far as all of them together, with few vertices."""
    everything = np.concatenate([np.concatenate([figure.areas, figure.lines]) for figure in figures])
    hull = shapely.convex_hull(shapely.geometrycollections(everything))
    return [Figure(figures[0].element, np.array([hull], dtype=object), np.empty(0, dtype=object))]


def _extent(figures: list[Figure]) -> float:
    """Return the breadth of figures in their own units."""
    low, high = math.inf, -math.inf
    for figure in figures:
        for marks in (figure.areas, figure.lines):
            if len(marks):
                bounds = shapely.total_bounds(marks)
                low, high = min(low, float(bounds[0])), max(high, float(bounds[2]))
    if not high > low:
        raise GeometryError("the motif has no breadth to scale: give a scale instead of a width")
    return high - low


def _estimate(rough: list[Figure], count: int, finer: float) -> int:
    """Foretell the vertices of the fine drawing: they grow with the root of the tolerance's ratio."""
    drawn = sum(int(shapely.get_num_coordinates(np.concatenate([f.areas, f.lines])).sum()) for f in rough)
    return int(drawn * max(1.0, math.sqrt(finer))) * count


def _human(number: int) -> str:
    return f"{number:,}" if number < 10**9 else f"10^{math.floor(math.log10(number))}"


def _set_out(
    motif: Motif, images: list[Affine] | Bend, tolerance: float
) -> tuple[list[Figure], list[Affine]]:
    """Draw the motif to the tolerance (motif units); return it with its copies, each different.

    A bent motif is all its images in one figure, of which there is one copy.
    """
    if isinstance(images, Bend):
        system, first = images.system, images.first

        def source(points: Points) -> Array:
            return np.asarray(tolerance * SOURCE_SHARE / np.maximum(system.stretch(first.at(points)), 1e-6))

        return _bent(_shown(draw(motif, source)), images, tolerance * (1 - SOURCE_SHARE)), [IDENTITY]
    largest = max(image.stretch for image in images)
    figures = _shown(draw(motif, tolerance / largest))
    return figures, distinct(images, _marks_of(figures), tolerance)


def _marks_of(figures: list[Figure]) -> list[Geometries]:
    return [np.concatenate([figure.areas, figure.lines]) for figure in figures]


def _shown(figures: list[Figure]) -> list[Figure]:
    """Leave out the lines of elements that are filled or cut only, before they are carried anywhere."""
    filled = (Treatment.AREA, Treatment.CUT)
    return [
        replace(figure, lines=figure.lines[:0])
        if figure.element.treatment in filled and len(figure.areas)
        else figure
        for figure in figures
    ]


def _copied(figure: Figure, images: list[Affine]) -> Figure:
    areas = [image.apply(figure.areas) for image in images]
    lines = [image.apply(figure.lines) for image in images]
    return Figure(figure.element, np.concatenate(areas), np.concatenate(lines))


def _bent(figures: list[Figure], images: Bend, tolerance: float) -> list[Figure]:
    return [
        Figure(
            figure.element,
            images.system.areas(images.first.apply(figure.areas), tolerance)[0],
            images.system.lines(images.first.apply(figure.lines), tolerance)[0],
        )
        for figure in figures
    ]


def _sheets(figure: Figure, placement: Placement, inks: Mapping[str, Ink], tolerance: float) -> list[Sheet]:
    """Return what an element (mm) draws: one sheet, or two where its line is a sheet of its own."""
    element = figure.element
    name = ".".join(part for part in (placement.motifs[0], element.name) if part)
    areas, lines = figure.areas, figure.lines
    if element.treatment == Treatment.CUT:
        return [Sheet(name, None, areas, gap=element.gap or 0.0)]
    ink = _ink(element, element.ink or placement.ink, inks)
    gap = element.gap
    if gap is None and ink.overlap == Overlap.KNOCKOUT:
        gap = 0.0
    if element.treatment == Treatment.AREA:
        return [Sheet(name, ink, areas, gap=gap, whole=element.whole)]
    pen = _ink(element, element.line_ink, inks) if element.line_ink else ink
    half = pen.width / 2
    # A line's body reaches beyond the area it goes round, and hides what lies under it too.
    hidden = _grown(areas, half, tolerance) if gap is not None else areas[:0]
    if element.treatment == Treatment.BOTH:
        over = 0.0 if pen is not ink and pen.overlap == Overlap.KNOCKOUT else None
        return [
            Sheet(name, ink, areas, gap=gap, cutter=hidden, whole=element.whole, margin=half),
            Sheet(f"{name}.line", pen, lines=lines, gap=over, whole=element.whole),
        ]
    if element.treatment == Treatment.LINE:
        return [Sheet(name, ink, lines=lines, gap=gap, cutter=hidden, whole=element.whole)]
    body = _grown(lines, half, tolerance)
    return [Sheet(name, ink, body, gap=gap, cutter=np.concatenate([body, hidden]), whole=element.whole)]


def _bare(
    figures: list[Figure], placement: Placement, inks: Mapping[str, Ink], tolerance: float
) -> list[Sheet]:
    """Return the sheet that keeps the ground bare round a whole motif, where one is asked for."""
    if placement.gap is None:
        return []
    shapes = []
    for figure in figures:
        element, shape = figure.element, [figure.areas]
        if len(figure.lines) and element.treatment not in (Treatment.AREA, Treatment.CUT):
            pen = _ink(element, element.line_ink or element.ink or placement.ink, inks)
            shape = [_grown(part, pen.width / 2, tolerance) for part in (figure.areas, figure.lines)]
        shapes += shape
    return [Sheet(placement.motifs[0], None, np.concatenate(shapes), gap=placement.gap)]


def _grown(marks: Geometries, reach: float, tolerance: float) -> Geometries:
    """Return marks grown by ``reach`` (mm), round at ends and corners."""
    if not len(marks):
        return marks
    return np.asarray(shapely.buffer(marks, reach, quad_segs=quad_segs(reach, tolerance)), dtype=object)


def _ink(element: Element, name: str, inks: Mapping[str, Ink]) -> Ink:
    if not name and len(inks) == 1:
        return next(iter(inks.values()))
    if not name:
        raise RecipeError(f"no ink is named, and the recipe has several: expected one of {', '.join(inks)}")
    if name not in inks:
        raise UnknownNameError(name, list(inks), "ink")
    return inks[name]
