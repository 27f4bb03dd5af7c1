"""One placement, from its motif to sheets of marks in millimetres on cloth."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from batik_vector.artwork import Cell, Geometries, Ink
from batik_vector.compiling.bends import SOURCE_SHARE, Source, bent
from batik_vector.compiling.copies import Laid, Look, set_down, sized
from batik_vector.compiling.fills import Work, filled, has_fills
from batik_vector.compiling.grounds import Ground, flip, lattice_of, scattered, striped
from batik_vector.errors import GeometryError, RecipeError, TooLargeError, UnknownNameError, blame
from batik_vector.geometry import work
from batik_vector.geometry.ifs import distinct
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import ONE, Affines
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.figures import Figure, draw, size_of
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.motif import Motif, Treatment
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.layouts import Bend, FreeGround, Scattered, Share, Stripes
from batik_vector.tiling.symmetry.orbits import TRIVIAL, Orbit
from batik_vector.tiling.welding.congruent import vertex_count
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.units import GRID_MM
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.tiling.torus.stripes import StripesReport
    from batik_vector.tiling.tossing.toss import Tossed

KEPT_PLACEMENTS, KEPT_VERTICES = 32, 50_000
"""How many placements are remembered, and how large they may be."""

COARSE = 2e-3
"""Tolerance of the first drawing, as a share of the motif's size: enough to measure it and to foretell its
vertices."""

RUNGS = (0.5, 0.545, 0.595, 0.648, 0.707, 0.771, 0.841, 0.917)
"""Eight tolerances in each doubling: a twelfth finer than asked at most, with a 25th more vertices."""

FEW_CONTOURS = 100
"""Contours of a motif that may be drawn a hundred times as fine before the drawing's size is known."""

GRID_SHARE = 1.5 * GRID_MM
"""What is kept of the tolerance for moves onto the grid: 0.71 steps of a vertex, and as much of a copy."""


@frozen
class Placed:
    """The sheets of a placement, bottom first, how many vertices they have, its toss and its fitted lines."""

    sheets: list[Sheet]
    vertices: int
    tossed: Tossed | None = None
    fitted: StripesReport | None = None


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
    if isinstance(placement.layout, FreeGround):
        return _free_ground(placement, recipe, inks, limit, before)
    if isinstance(placement.layout, Scattered | Stripes):
        return _ground(placement, recipe, unit, inks, limit, orbit, before)
    if len(placement.motifs) > 1:
        return _dealt(placement, recipe, unit, inks, limit, orbit)
    motif = _known(recipe.motif, placement.motifs[0], "motif")
    seed = recipe.seed if has_fills(motif, placement) else 0
    key = placement, motif, unit, tuple(inks.values()), recipe.tolerance, orbit, seed
    # What is built in Python may hold lists, and is then drawn anew each time.
    keeps = _hashable(key)
    kept = _kept.get(key) if keeps else None
    if kept is None or kept.foretold > limit:
        kept = _Kept(*_drawn(placement, motif, recipe.tolerance, unit, inks, limit, orbit, seed))
        if keeps and kept.placed.vertices <= KEPT_VERTICES:
            _kept[key] = kept
            while len(_kept) > KEPT_PLACEMENTS:
                del _kept[next(iter(_kept))]
    return kept.placed


def _dealt(
    placement: Placement, recipe: Recipe, unit: Cell, inks: Mapping[str, Ink], limit: int, orbit: Orbit
) -> Placed:
    """Do the work of :func:`place` for several motifs that take the places of a layout in turn."""
    sheets: list[Sheet] = []
    vertices, among = 0, len(placement.motifs)
    for first, name in enumerate(placement.motifs):
        share = Share(layout=placement.layout, first=first, among=among)
        part = place(
            replace(placement, motif=name, layout=share), recipe, unit, inks, limit - vertices, orbit
        )
        sheets += part.sheets
        vertices += part.vertices
    return Placed(sheets, vertices)


def _hashable(key: tuple[object, ...]) -> bool:
    try:
        hash(key)
    except TypeError:
        return False
    return True


class _Kept(NamedTuple):
    """A placement that was drawn, and how many vertices it was expected to have."""

    foretold: int
    placed: Placed


_kept: dict[tuple[object, ...], _Kept] = {}
"""Who turns one knob need not wait for what hangs on others. The oldest go first."""


def _drawn(
    placement: Placement,
    motif: Motif,
    fineness: float,
    unit: Cell,
    inks: Mapping[str, Ink],
    limit: int,
    orbit: Orbit,
    seed: int,
) -> tuple[int, Placed]:
    """Draw what a placement sets out; return how many vertices were expected with it."""
    layout, cell = placement.layout, (unit.width / orbit.base.a, unit.height / orbit.base.d)
    times = len(orbit.operations)
    finest = max(fineness - GRID_SHARE, fineness / 2) / max(orbit.base.stretch, 1.0)
    with blame("layout"):
        images = layout.images(_in_units(cell, placement.scale or 1.0))
    coarse = _coarse(motif, images, finest, placement.scale or _foreseen(placement, motif, images))
    rough = draw(motif, coarse)
    foretold = _refuse_past(limit, rough, images, times)
    with blame("layout"):
        scale = placement.scale or _scale(placement, rough, images, coarse)
        if not (placement.scale or layout.spreads):
            images = layout.images(_in_units(cell, scale))
    foretold = max(foretold, _refuse_past(limit, rough, images, times, coarse * scale / fineness))
    if isinstance(images, Bend):
        work.spend(foretold, per_vertex=work.PER_BENT_VERTEX)
    with blame("layout"):
        figures, copies = _set_out(motif, images, finest / scale)
    if placement.width and layout.spreads:
        # Measured again on the fine drawing: the coarse one is a little narrower.
        scale = placement.width / _extent(figures, copies)
    at = placement.at or orbit.middle or (cell[0] / 2, cell[1] / 2)
    on_cloth = orbit.base @ Affine.translation(at) @ Affine.turn(placement.turn) @ Affine.scale(scale)
    if placement.mirror is not None:
        on_cloth = on_cloth @ flip(placement.mirror)
    maps = on_cloth @ copies
    fills = Work(placement, inks, fineness, seed, limit, orbit.turns_at(maps[0]))
    shown = filled(figures, placement.motifs[0], motif, maps, times, fills)
    laid = Laid(shown, maps, orbit.is_trivial)
    if orbit.region:
        laid = _mirrored(laid, orbit, finest)
    elif not orbit.is_trivial:
        laid = replace(laid, maps=orbit.images(laid.maps, _marks_of(figures), finest / scale))
    return foretold, _placed({placement.motifs[0]: laid}, placement, inks, fineness)


def _in_units(cell: tuple[float, float], scale: float) -> tuple[float, float]:
    return cell[0] / scale, cell[1] / scale


def _coarse(motif: Motif, images: Affines | Bend, finest: float, scale: float | None) -> float:
    """Return the tolerance of the first drawing: the last one's, if that is known and needs few vertices."""
    coarse = COARSE * size_of(motif)
    if scale is None or isinstance(images, Bend):
        return coarse
    contours = sum(part.count * part.contours for part in motif.parts())
    # What a drawing has of them is known, and none of them stands for more.
    least = coarse if contours > FEW_CONTOURS and not isinstance(motif, Svg) else coarse / 100
    return max(least, _rung(finest / scale / float(images.stretches.max())))


def _foreseen(placement: Placement, motif: Motif, images: Affines | Bend) -> float | None:
    """Return about the scale that a drawing's outlines ask for, so that it need not be drawn twice."""
    single = isinstance(images, Affines) and len(images) == 1
    breadth = motif.breadth if isinstance(motif, Svg) and single else 0.0
    return placement.width / breadth if placement.width and breadth else None


def _mirrored(laid: Laid, orbit: Orbit, crumb: float) -> Laid:
    """Return what the region of an orbit leaves of copies, and all its images, in mm."""
    figures = [
        replace(figure, areas=orbit.mirrored(figure.areas), lines=orbit.mirrored(figure.lines, crumb))
        for figure in sized(laid.figures, laid.maps)
    ]
    return Laid(figures, ONE)


def _placed(
    drawn: Mapping[str, Laid],
    placement: Placement,
    inks: Mapping[str, Ink],
    tolerance: float,
    tossed: Tossed | None = None,
) -> Placed:
    """Return the sheets of all motifs of a placement."""
    look = Look(placement, inks, tolerance)
    parts = [set_down(laid, name, look) for name, laid in drawn.items()]
    sheets = [sheet for bare, _ in parts for sheet in bare] + [sheet for _, own in parts for sheet in own]
    vertices = sum(vertex_count(part) for sheet in sheets for part in (sheet.areas, sheet.lines))
    return Placed(sheets, vertices, tossed)


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
    coarse = {name: COARSE * size_of(motif) for name, motif in motifs.items()}
    rough = {name: draw(motif, coarse[name]) for name, motif in motifs.items()}
    scale = placement.scale or (placement.width or 1.0) / max(_extent(each) for each in rough.values())
    finest = max(recipe.tolerance - GRID_SHARE, recipe.tolerance / 2)
    finer = {name: each * scale / finest for name, each in coarse.items()}
    times = len(orbit.operations)
    tossed, fitted, drawn = None, None, dict[str, Laid]()
    fills = Work(placement, inks, recipe.tolerance, recipe.seed, limit)
    with blame("layout"):
        tosses = [each.tossed for each in before if each.tossed]
        sheets = [sheet for each in before for sheet in each.sheets]
        middle = unit.width / 2, unit.height / 2
        lattice = lattice_of(unit, orbit)
        ground = Ground(lattice, middle, orbit, inks, recipe.tolerance, recipe.seed, tosses, sheets)
        if isinstance(placement.layout, Scattered):
            tossed = scattered(placement, placement.layout, motifs, scale, ground)
            for (name, motif), copies in zip(motifs.items(), tossed.copies, strict=True):
                if copies:
                    _refuse_past(limit, rough[name], copies, times, finer[name])
                    figures, maps = _set_out(motif, copies, finest)
                    shown = filled(figures, name, motif, maps, times, fills)
                    drawn[name] = _multiplied(Laid(shown, maps), orbit, finest)
        elif isinstance(placement.layout, Stripes):
            for name, motif in motifs.items():
                lines, back = striped(placement, motif, placement.layout, scale, unit, ground)
                fitted = lines.report
                _refuse_past(limit, rough[name], len(lines.starts) * lines.links, times, finer[name])
                one = Affines.of([Affine.scale(scale)])
                links = len(lines.starts) * lines.links
                shown = filled(_shown(draw(motif, finest / lines.stretch)), name, motif, one, links, fills)
                figures = [
                    replace(
                        figure,
                        areas=back.apply(lines.areas(figure.areas)),
                        lines=back.apply(lines.lines(figure.lines)),
                    )
                    for figure in shown
                ]
                drawn[name] = _multiplied(Laid(figures, ONE), orbit, finest)
    return replace(_placed(drawn, placement, inks, recipe.tolerance, tossed), fitted=fitted)


def _free_ground(
    placement: Placement, recipe: Recipe, inks: Mapping[str, Ink], limit: int, before: Sequence[Placed]
) -> Placed:
    """Do the work of :func:`place` for marks that fill what is free of the repeat."""
    # Most recipes have none.
    from batik_vector.compiling.free_ground import Given, free_ground, kept_orbit

    lattice = recipe.tiling.repeating().lattice
    kept = kept_orbit(placement, recipe.tiling)
    given = Given(lattice, inks, recipe.tolerance, recipe.seed, limit, kept)
    sheet = free_ground(placement, [sheet for each in before for sheet in each.sheets], given)
    return Placed([sheet], vertex_count(sheet.areas))


def _multiplied(laid: Laid, orbit: Orbit, crumb: float) -> Laid:
    """Return copies, in mm, and their images under the symmetry."""
    return _mirrored(laid, orbit, crumb) if orbit.region else replace(laid, maps=orbit.multiplied(laid.maps))


def _refuse_past(
    limit: int, rough: list[Figure], images: Affines | Bend | int, times: int, finer: float = 1.0
) -> int:
    """Return the vertices of ``times`` drawings, ``finer`` times as fine as the rough; raise past a limit."""
    if isinstance(images, int):
        count = images
    else:
        count = images.system.image_count() if isinstance(images, Bend) else len(images)
    vertices = _estimate(rough, count * times, finer)
    if vertices > limit:
        raise TooLargeError(
            f"about {_human(vertices)} vertices, past the limit of {limit:,}: lower the level or the counts, "
            "allow a larger tolerance, or raise the recipe's limit"
        )
    return vertices


def _known(catalogue: Mapping[str, Motif], name: str, what: str) -> Motif:
    if name not in catalogue:
        raise UnknownNameError(name, list(catalogue), what)
    return catalogue[name]


def _scale(placement: Placement, rough: list[Figure], images: Affines | Bend, coarse: float) -> float:
    if placement.width is None:
        raise RecipeError("a placement needs a width or a scale")
    if not placement.layout.spreads:
        return placement.width / _extent(rough)
    if isinstance(images, Bend):
        return placement.width / _extent(bent(rough, images, coarse))
    return placement.width / _extent(rough, images)


def _extent(figures: list[Figure], copies: Affines = ONE) -> float:
    """Return the breadth of copies of figures in their own units."""
    marks = np.concatenate(_marks_of(figures))
    points = shapely.get_coordinates(shapely.convex_hull(shapely.geometrycollections(marks)))
    x = copies.at(points)[:, :, 0] if len(points) else np.zeros((1, 1))
    if not np.ptp(x) > 0:
        raise GeometryError("the motif has no breadth to scale: give a scale instead of a width")
    return float(x.max()) - float(x.min())


def _estimate(rough: list[Figure], count: int, finer: float) -> int:
    """Foretell the vertices of the fine drawing: they grow with the root of the tolerance's ratio."""
    drawn = int(shapely.get_num_coordinates(np.concatenate(_marks_of(rough))).sum())
    return int(drawn * max(1.0, math.sqrt(finer))) * count


def _human(number: int) -> str:
    return f"{number:,}" if number < 10**9 else f"10^{math.floor(math.log10(number))}"


def _set_out(motif: Motif, images: Affines | Bend, tolerance: float) -> tuple[list[Figure], Affines]:
    """Draw the motif to the tolerance (motif units); return it with its copies, each different.

    A bent motif is all its images in one figure, of which there is one copy.
    """
    if isinstance(images, Bend):
        source = Source(images=images, tolerance=tolerance)
        return bent(_shown(draw(motif, source)), images, tolerance * (1 - SOURCE_SHARE)), ONE
    figures = _shown(draw(motif, _rung(tolerance / float(images.stretches.max()))))
    return figures, distinct(images, _marks_of(figures), tolerance)


def _rung(tolerance: float) -> float:
    """Return the next finer of a ladder of tolerances, so that a small change of size need not draw again."""
    share, power = math.frexp(tolerance)
    return math.ldexp(max(rung for rung in RUNGS if rung <= share), power)


def _marks_of(figures: list[Figure]) -> list[Geometries]:
    return [
        np.concatenate([figure.areas, figure.lines]) if len(figure.lines) else figure.areas
        for figure in figures
    ]


def _shown(figures: list[Figure]) -> list[Figure]:
    """Leave out the lines of elements that are filled or cut only, before they are carried anywhere."""
    filled = (Treatment.AREA, Treatment.CUT)
    return [
        replace(figure, lines=figure.lines[:0])
        if figure.element.treatment in filled and len(figure.areas)
        else figure
        for figure in figures
    ]
