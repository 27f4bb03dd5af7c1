"""The free ground filled with marks (*isen-isen*): round all that is placed already, over the seam too."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely

from batik_vector.artwork import Geometries, Ink
from batik_vector.errors import GeometryError, RecipeError, TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.fills.insets import whole
from batik_vector.geometry.fills.periodic import Group, Period, closing
from batik_vector.geometry.fills.symmetric import settled_marks, spread
from batik_vector.geometry.maps.affine import Affine, unit_turn
from batik_vector.geometry.nearness import on_lines, pairs_within
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Array
from batik_vector.recipe.fills import Fill, Room
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.symmetry.orbits import Orbit
from batik_vector.tiling.symmetry.repeats import TileSpec
from batik_vector.tiling.symmetry.spread import Spread
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.torus.torus import Lattice, Window, as_steps, clip_areas, to_mm, to_step_grid, wrap
from batik_vector.tiling.welding.congruent import polygons
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.units import GRID_MM, STEPS_PER_MM, format_mm

MOST_ASLANT = 0.05
"""By how much rows may be drawn apart or aslant to close on the repeat."""

ROUNDING = 2 * GRID_MM
"""What is kept of a margin for moves onto the grid: that of a mark, and that of what it keeps from."""

MOST_TRIED = 2_000
"""Points of outlines, about, that tell whether what is placed keeps a group."""

LEAST_OFF = 0.05
"""How far outlines may at least lie from their images, in mm: curves are flattened and copies rounded."""


class Given(NamedTuple):
    """What a ground hangs on: the lattice in grid steps, the inks by name, ``tolerance`` in mm.

    ``orbit`` is that of the group which marks keep, with its region, if what is placed keeps it or the ground
    asks for it; None where translations are all.
    """

    lattice: Lattice
    inks: Mapping[str, Ink]
    tolerance: float
    seed: int
    limit: int
    orbit: Orbit | None = None


def kept_orbit(placement: Placement, tiling: TileSpec) -> Orbit | None:
    """Return the orbit of the group that the marks of a ground may keep; None where translations are all.

    It is the tile's own where none is asked for and its region is known. Rows at an angle keep to none.
    """
    if _told(placement).basis():
        return None
    try:
        orbit = tiling.orbit(placement.symmetry, spread=Spread.CUT)
    except GeometryError:
        if placement.symmetry:
            raise
        return None
    return orbit if len(orbit.operations) > 1 else None


def free_ground(placement: Placement, sheets: Sequence[Sheet], given: Given) -> Sheet:
    """Return the marks that fill what sheets leave free of a repeat.

    Args:
        placement: of the ground, with its fill.
        sheets: all that has been placed.
        given: what else it hangs on.

    Raises:
        GeometryError: where nothing has room, or rows do not close on the repeat.
        TooLargeError: where the marks are far too many.
    """
    fill, ink = _told(placement), _ink(placement, given.inks)
    marks = _laid(placement, fill, sheets, given)
    if not len(marks):
        raise GeometryError(
            f'fill_with.margin = {fill.margin:g}: no mark of "{fill.kind}" has room in what is free of the '
            "repeat, expected a smaller margin or smaller marks"
        )
    count = int(shapely.get_num_coordinates(marks).sum())
    if count > given.limit:
        raise TooLargeError(
            f"fill_with.spacing = {fill.spacing:g}: {count:,} vertices, past the limit of {given.limit:,}: "
            "expected a larger spacing"
        )
    return Sheet(f"ground.{fill.kind}", ink, oriented(polygonal(marks)), whole=fill.whole)


def _laid(placement: Placement, fill: Fill, sheets: Sequence[Sheet], given: Given) -> Geometries:
    """Return the marks of a ground, each once in the repeat."""
    lattice = np.array(given.lattice, float) / STEPS_PER_MM
    aslant = _aslant(fill, lattice)
    # No way becomes shorter than by the least factor of the map.
    least = float(np.linalg.svd(aslant, compute_uv=False).min())
    inner = replace(fill, margin=fill.margin / least + ROUNDING)
    rings = fill.basis() is None and _follows_rings(fill)
    pad = float(np.diag(lattice).min()) / 2 if rings else 4 * fill.spacing + 2 * fill.margin
    group = None if given.orbit is None else _group(given.orbit)
    pad += 0.0 if group is None else _beyond(group.region, lattice)
    free, taken = _free(sheets, given, lattice, pad)
    if group and not (placement.symmetry or _keep(group, free, Period(lattice, pad), given.tolerance)):
        group = None
    if not len(free):
        return free
    period = Period(lattice, pad, group)
    back: Array = np.asarray(np.linalg.inv(aslant), np.float64)
    room = Room(
        whole(_linear(free, back)),
        np.zeros((len(free), 2)),
        1,
        given.tolerance,
        given.seed,
        None if fill.basis() else period,
    )
    try:
        marks = _linear(inner.lay(room)[0], aslant)
    except TooLargeError as error:
        raise TooLargeError(f"fill_with.{error}") from None
    if group is not None and given.orbit is not None:
        return _imaged(marks, fill, given.orbit, period, taken)
    return _once(marks, fill, given.lattice, period)


def _told(placement: Placement) -> Fill:
    assert placement.fill_with is not None
    return placement.fill_with


def _ink(placement: Placement, inks: Mapping[str, Ink]) -> Ink:
    name = _told(placement).ink or placement.ink or (next(iter(inks)) if len(inks) == 1 else "")
    if not name:
        raise RecipeError(f"no ink is named, and the recipe has several: expected one of {', '.join(inks)}")
    return inks[name]


def _follows_rings(fill: Fill) -> bool:
    return str(getattr(fill, "follow", "contour")) == "contour" and fill.kind != "herangan"


def _stamped(fill: Fill) -> bool:
    """Return whether its marks are one shape set down at places that keep their distance already."""
    return "follow" in fill.__dataclass_fields__ and fill.whole


def _aslant(fill: Fill, lattice: Array) -> Array:
    """Return the map that brings the rows of a fill so that they close on the repeat, shape (2, 2)."""
    rows = fill.basis()
    if rows is None:
        return np.eye(2)
    turn = unit_turn(float(getattr(fill, "angle", 0.0)))
    z = np.array([complex(*row) for row in rows]) * turn
    found = closing(np.column_stack([z.real, z.imag]), lattice)
    if not np.abs(found - np.eye(2)).max() <= MOST_ASLANT:
        sides = " × ".join(format_mm(side) for side in np.diag(lattice).tolist())
        raise GeometryError(
            f"fill_with.spacing = {fill.spacing:g}: rows so far apart do not close on the repeat of {sides} "
            f"mm within {100 * MOST_ASLANT:g} %: expected a smaller spacing, or another angle"
        )
    return found


def _group(orbit: Orbit) -> Group:
    """Return the group of an orbit that has a region, in mm."""
    assert orbit.region is not None
    return Group(orbit.operations, shapely.Polygon(np.array(orbit.region.corners) / STEPS_PER_MM))


def _keep(group: Group, free: Geometries, period: Period, tolerance: float) -> bool:
    """Return whether the outlines of what is free lie on themselves under the operations of a group."""
    outlines = np.asarray(shapely.boundary(free), dtype=object)
    points = shapely.get_coordinates(outlines)
    points = points[period.owns(points)]
    points = points[:: max(1, len(points) // MOST_TRIED)]
    if not len(points):
        return True
    images = np.concatenate([period.home(each.at(points)) for each in group.operations[1:]])
    return bool(on_lines(images, outlines, max(LEAST_OFF, 4 * tolerance)).all())


def _beyond(region: shapely.Polygon, lattice: Array) -> float:
    """Return how far a region reaches out of the window of a repeat, in mm."""
    low_x, low_y, high_x, high_y = region.bounds
    wide, tall = np.diag(lattice).tolist()
    return float(max(-low_x, -low_y, high_x - wide, high_y - tall, 0.0))


def _free(sheets: Sequence[Sheet], given: Given, lattice: Array, pad: float) -> tuple[Geometries, Geometries]:
    """Return what is free of the window of a repeat and ``pad`` mm round it, and what is not, in mm."""
    shapes = [polygons(sheet.areas) for sheet in sheets if sheet.ink is not None]
    shapes += [
        np.asarray(shapely.buffer(sheet.lines, sheet.ink.width / 2, quad_segs=16), dtype=object)
        for sheet in sheets
        if sheet.ink is not None and len(sheet.lines)
    ]
    taken = polygonal(overlay.valid(as_steps(np.concatenate([np.empty(0, dtype=object), *shapes]))))
    reach = round(pad * STEPS_PER_MM)
    (ax, _), (_, by) = given.lattice
    window = Window(-reach, -reach, ax + reach, by + reach)
    there, _ = wrap(taken, np.arange(len(taken)), given.lattice, window)
    work.spend(float(shapely.get_num_coordinates(there).sum()))
    left = shapely.difference(window.box, shapely.union_all(there))
    parts = np.asarray(shapely.get_parts(left), dtype=object)
    return oriented(to_mm(parts[shapely.area(parts) > 1.0])), to_mm(there)


def _linear(marks: Geometries, rows: Array) -> Geometries:
    if not len(marks):
        return marks
    (a, b), (c, d) = rows.tolist()
    return Affine(a, b, c, d).apply(marks)


def _imaged(marks: Geometries, fill: Fill, orbit: Orbit, period: Period, taken: Geometries) -> Geometries:
    """Return all images of marks laid in the region of a group; of what has no room somewhere, none."""
    if not len(marks):
        return marks
    if not fill.whole:
        # Bands are drawn beyond the region too, so that nothing needs to be carried in from other repeats.
        return replace(orbit, periods=()).mirrored(marks)
    if not _stamped(fill):
        marks = marks[settled_marks(marks, fill.bare, period)]
    images, owner = spread(marks, period)
    near, _ = pairs_within(images, taken, fill.margin)
    stays = np.ones(len(marks), bool)
    stays[owner[near]] = False
    return images[stays[owner]]


def _once(marks: Geometries, fill: Fill, lattice: Lattice, period: Period) -> Geometries:
    """Return of marks one of all those that the lattice joins."""
    if not len(marks):
        return marks
    if not fill.basis():
        if not _follows_rings(fill):
            return marks
        if _stamped(fill):
            return marks[period.apart(shapely.get_coordinates(shapely.centroid(marks)), fill.bare)]
        return marks[period.clear(marks, fill.bare)]
    if fill.whole:
        return marks[period.owns(shapely.get_coordinates(shapely.centroid(marks)))]
    steps = polygonal(to_step_grid(marks))
    window = Window(0, 0, lattice[0][0], lattice[1][1])
    pieces, _ = clip_areas(steps, np.zeros(len(steps), np.intp), window)
    return to_mm(polygonal(pieces))
