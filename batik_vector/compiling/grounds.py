"""Placements that fill the repeat, tossed or in stripes: what is free, and where their copies come to lie."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import shapely

from batik_vector.artwork import Cell, Geometries, Ink, Overlap
from batik_vector.errors import GeometryError
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.sampling import Array
from batik_vector.recipe.figures import Figure, draw, size_of
from batik_vector.recipe.motif import MOTIFS, Motif, Treatment
from batik_vector.recipe.motifs.composing import Banded
from batik_vector.recipe.placement import Mirror, Placement
from batik_vector.tiling.layouts import Clear, Scattered, Stripes
from batik_vector.tiling.symmetry.orbits import Orbit
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.torus.torus import Lattice
from batik_vector.tiling.welding.congruent import polygons
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.units import GRID_MM, STEPS_PER_MM, to_steps
from batik_vector.values import frozen

# How grounds are laid is imported once a recipe has one.
if TYPE_CHECKING:
    from batik_vector.tiling.torus.stripes import Courses
    from batik_vector.tiling.tossing.marks import Field
    from batik_vector.tiling.tossing.toss import Tossed

BODY_SHARE, FINEST_BODY, COARSEST_BODY = 0.003, 0.005, 0.1
"""Tolerance of the outlines of tossed marks: a share of a mark's breadth, within two bounds in mm."""

ROUGH = 0.01
"""Tolerance of the drawing that measures a mark, as a share of the motif's size."""

NEXT_SEED = 7919
"""By how much the seeds of one toss and the next differ."""


@frozen
class Ground:
    """What a ground is laid on.

    ``middle`` of the repeat in mm; ``tolerance`` in mm; ``tossed`` all that earlier tosses put down,
    ``sheets`` all that earlier placements did; ``seed`` the recipe's.
    """

    lattice: Lattice
    middle: tuple[float, float]
    orbit: Orbit
    inks: Mapping[str, Ink]
    tolerance: float
    seed: int
    tossed: Sequence[Tossed]
    sheets: Sequence[Sheet]


def lattice_of(unit: Cell, orbit: Orbit) -> Lattice:
    """Return the translations on which a ground closes, in grid steps.

    Raises:
        GeometryError: in a border, which repeats in one direction only.
    """
    if not orbit.periods:
        return unit.lattice
    if len(orbit.periods) == 1:
        raise GeometryError("tosses, packs and stripes fill a tile: expected another layout in a border")
    a, b = ((to_steps(x), to_steps(y)) for x, y in orbit.periods)
    return a, b


def flip(mirror: Mirror, about: tuple[float, float] = (0.0, 0.0)) -> Affine:
    """Return the map that changes sides about a point."""
    x, y = about
    by = {Mirror.ACROSS: Affine.mirror(90), Mirror.DOWN: Affine.mirror(0), Mirror.BOTH: Affine.turn(180)}
    return Affine.translation((x, y)) @ by[mirror] @ Affine.translation((-x, -y))


def _flipped(lattice: Lattice, mirror: Mirror | None) -> Lattice:
    """Return the mirror image of a lattice, its first vector along x or its second along y."""
    if mirror in (None, Mirror.BOTH):
        return lattice
    (ax, ay), (bx, by) = lattice
    return ((ax, -ay % by), (0, by)) if bx == 0 else ((ax, 0), (-bx % ax, by))


def scattered(
    placement: Placement, spec: Scattered, motifs: Mapping[str, Motif], scale: float, ground: Ground
) -> Tossed:
    """Toss or pack the motifs of a placement.

    Args:
        placement: whose gap and inks hold.
        spec: its layout.
        motifs: by name, in the order of the layout's weights.
        scale: mm to one motif unit, for marks of size 1.
        ground: what they fall on.

    Returns:
        The toss; its copies are maps of motif units.
    """
    from batik_vector.tiling.tossing.scatter import Torus, in_steps
    from batik_vector.tiling.tossing.toss import Marks, Tossed, toss

    scale *= spec.size[0]
    drawn = {name: _drawn(motif, scale, ground.tolerance) for name, motif in motifs.items()}
    bodies = [_body(figures, placement, scale, ground.inks) for figures, _ in drawn.values()]
    reach = max(
        _overreach(figures, body, placement, scale, ground.inks)
        for (figures, _), body in zip(drawn.values(), bodies, strict=True)
    )
    reach *= spec.size[1] / spec.size[0]
    slack = max(tolerance for _, tolerance in drawn.values()) + ground.tolerance + GRID_MM
    marks = Marks(tuple(motifs), np.array(bodies, dtype=object), slack, reach)
    base = ground.orbit.base
    # Marks fall behind the mirror, and what has fallen is carried over.
    over = Affine() if placement.mirror is None else flip(placement.mirror, ground.middle)
    linear = np.array([[base.a, base.b], [base.c, base.d]])
    operations = (Affine(),) if ground.orbit.region else ground.orbit.operations
    if placement.mirror is not None:
        linear = linear * [[1, -1], [-1, 1]] if placement.mirror != Mirror.BOTH else linear
        operations = tuple(over @ each @ over for each in operations)
    torus = Torus(
        _flipped(ground.lattice, placement.mirror),
        in_steps(operations, STEPS_PER_MM),
        None if np.array_equal(linear, np.eye(2)) else linear,
    )
    seed = ground.seed + NEXT_SEED * len(ground.tossed)
    (in_grid,) = in_steps((over,), STEPS_PER_MM)
    tossed = toss(spec, marks, torus, _taken(spec, placement, ground, in_grid), seed)
    grown = Affine.scale(scale)
    copies = tuple(over @ copies @ grown for copies in tossed.copies)
    return Tossed(copies, tossed.field, tossed.report, in_grid)


def striped(
    placement: Placement, motif: Motif, spec: Stripes, scale: float, unit: Cell, ground: Ground
) -> tuple[Courses, Affine]:
    """Return where the lines of a placement run, and the map that carries them to their sides.

    Raises:
        GeometryError: where they are to fit a motif that is no band.
    """
    from batik_vector.tiling.torus.stripes import courses

    orbit = ground.orbit
    middle = unit.width / 2 / orbit.base.a, unit.height / 2 / orbit.base.d
    x, y = orbit.base.at(np.array([placement.at or orbit.middle or middle]))[0].tolist()
    if spec.fit and not isinstance(motif, Banded):
        kinds = ", ".join(name for name, kind in MOTIFS.items() if issubclass(kind, Banded))
        raise GeometryError(f"fit = true: the motif is no band and has no breadth, expected one of {kinds}")
    breadth = motif.across if isinstance(motif, Banded) else 0.0
    back = Affine() if placement.mirror is None else flip(placement.mirror, (x, y))
    return courses(spec, _flipped(ground.lattice, placement.mirror), (x, y), scale, breadth), back


def _drawn(motif: Motif, scale: float, tolerance: float) -> tuple[list[Figure], float]:
    """Return a motif, and the tolerance (mm) to which it is drawn."""
    rough = draw(motif, ROUGH * size_of(motif))
    low_x, low_y, high_x, high_y = shapely.total_bounds(
        np.concatenate([part for figure in rough for part in (figure.areas, figure.lines)])
    )
    breadth = math.hypot(high_x - low_x, high_y - low_y) * scale
    fine = min(max(BODY_SHARE * breadth, FINEST_BODY), max(COARSEST_BODY, tolerance))
    return draw(motif, fine / scale), fine


def _pen(figure: Figure, placement: Placement, inks: Mapping[str, Ink]) -> float:
    """Return the breadth of an element's line in mm; 0 where it has none."""
    element = figure.element
    if element.treatment in (Treatment.AREA, Treatment.CUT) or not len(figure.lines):
        return 0.0
    ink = inks.get(element.line_ink or element.ink or placement.ink)
    return ink.width if ink else max(each.width for each in inks.values())


def _body(
    figures: Sequence[Figure], placement: Placement, scale: float, inks: Mapping[str, Ink]
) -> shapely.Geometry:
    """Return all that a motif draws, in mm."""
    shapes = []
    for figure in figures:
        if figure.element.treatment != Treatment.CUT:
            shapes += _shapes(figure, scale, _pen(figure, placement, inks) / 2)
    body: shapely.Geometry = shapely.union_all(np.concatenate(shapes)) if shapes else shapely.Polygon()
    # What is drawn may have no body either: an open curve that is filled, say.
    if shapely.is_empty(body):
        raise GeometryError("the motif draws nothing that could be tossed or packed")
    return body


def _shapes(figure: Figure, scale: float, half: float) -> list[Geometries]:
    grown = Affine.scale(scale)
    # Rings that touch may cross by a hair once they are scaled.
    areas = overlay.valid(grown.apply(figure.areas))
    if not half:
        return [areas]
    return [
        np.asarray(shapely.buffer(part, half), dtype=object) for part in (areas, grown.apply(figure.lines))
    ]


def _overreach(
    figures: Sequence[Figure],
    body: shapely.Geometry,
    placement: Placement,
    scale: float,
    inks: Mapping[str, Ink],
) -> float:
    """Return how far beyond its body (mm) a motif cuts what lies beneath, other marks of the toss too."""
    farthest = 0.0
    for figure in figures:
        element = figure.element
        ink = inks.get(element.ink or placement.ink)
        cuts = element.gap is not None or element.treatment == Treatment.CUT
        if not (cuts or (ink and ink.overlap == Overlap.KNOCKOUT)):
            continue
        for shape in _shapes(figure, scale, _pen(figure, placement, inks) / 2):
            rim = shapely.get_coordinates(shapely.buffer(shape, element.gap or 0.0))
            away: Array = np.asarray(shapely.distance(shapely.points(rim), body))
            farthest = max(farthest, float(away.max(initial=0.0)))
    return farthest


def _taken(spec: Scattered, placement: Placement, ground: Ground, over: Affine) -> Field:
    """Return what marks keep clear of: enough larger that the placement's own gap does not cut it.

    ``over`` carries it behind the placement's mirror, where what fell behind the same one is to the bit.
    """
    from batik_vector.tiling.torus.torus import as_steps
    from batik_vector.tiling.tossing.marks import Field

    nothing = Field.of(np.empty(0, dtype=object))
    if spec.clear == Clear.NONE:
        return nothing
    taken = Field.joined([nothing, *(each.field.moved(over @ each.over) for each in ground.tossed)])
    if spec.clear == Clear.ALL:
        merged = _merged(ground.sheets, spec.distance / 2, ground.tolerance)
        taken = Field.of(as_steps(merged)).moved(over)
    wider = max((placement.gap or 0.0) - spec.distance, 0.0) * STEPS_PER_MM
    return taken.grown(wider) if wider else taken


def _merged(sheets: Sequence[Sheet], close: float, tolerance: float) -> Geometries:
    """Return all that sheets draw, with gaps up to twice ``close`` shut, coarsely and never too small."""
    shapes = [polygons(sheet.areas) for sheet in sheets if sheet.ink is not None]
    shapes += [
        np.asarray(shapely.buffer(sheet.lines, sheet.ink.width / 2), dtype=object)
        for sheet in sheets
        if sheet.ink is not None
    ]
    step = max(4 * tolerance, COARSEST_BODY)
    everything = shapely.union_all(np.concatenate([np.empty(0, dtype=object), *shapes]))
    grown = shapely.buffer(shapely.buffer(everything, close + 1.1 * step, quad_segs=4), -close, quad_segs=4)
    parts = np.asarray(shapely.get_parts(shapely.simplify(grown, step)), dtype=object)
    return parts[~shapely.is_empty(parts)]
