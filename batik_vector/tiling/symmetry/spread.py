"""From a wallpaper group and a repeat to the orbit that a placement is multiplied by.

Which groups a repeat admits is decided exactly, in fractions of its rectangle: the linear part of every
operation must bring the translations of the repeat and of the group together onto themselves.
"""

from __future__ import annotations

import enum
import functools
import math
from collections.abc import Callable
from fractions import Fraction

from batik_vector.artwork import Cell, DropAxis
from batik_vector.errors import GeometryError
from batik_vector.geometry.maps.affine import Affine
from batik_vector.tiling.symmetry.groups import GROUPS, Group, Kind, Operation, Pair, multiplied, whole_cells
from batik_vector.tiling.symmetry.orbits import Orbit, Region, Shift
from batik_vector.units import STEPS_PER_MM, format_mm, to_steps
from batik_vector.values import frozen

HALF = Fraction(1, 2)


class Spread(enum.StrEnum):
    """What of a placement its symmetry spreads over the cloth."""

    FREE = "free"
    """Every mark whole, wherever ``at`` sets it; images may lie over one another. A mark that lies on a
    mirror or a centre of rotation and has that symmetry itself is drawn once."""
    CENTRE = "centre"
    """As free, but ``at`` is measured from the middle of the fundamental region, which no mirror and no
    centre of rotation touches."""
    CUT = "cut"
    """As centre, and every mark is cut to the fundamental region, as a kaleidoscope shows it: the halves of
    a mark meet along the mirrors."""


@frozen
class Frame:
    """A repeat, as its symmetries see it.

    Attributes:
        cell: the repeat on cloth, with its drop.
        kinds: the shapes that its rectangle has, before it is stretched.
        stretch: by how much width and height are drawn out on cloth.
    """

    cell: Cell
    kinds: frozenset[Kind]
    stretch: tuple[float, float] = (1.0, 1.0)


def shapes_of(cell: Cell) -> frozenset[Kind]:
    """Return which kinds of group the rectangle of a cell admits; a grid step off √3 is near enough."""
    whole = cell.rectangle
    kinds = {Kind.ANY}
    if whole.columns == whole.rows:
        kinds.add(Kind.SQUARE)
    if abs(whole.rows - math.sqrt(3) * whole.columns) <= 1:
        kinds.add(Kind.HEXAGONAL)
    return frozenset(kinds)


def lattice_of(cell: Cell) -> tuple[Pair, Pair]:
    """Return the two translations of a cell, in fractions of its rectangle."""
    q = cell.drop.denominator
    if cell.axis == DropAxis.COLUMN:
        return (Fraction(1, q), cell.drop), (Fraction(0), Fraction(1))
    return (Fraction(1), Fraction(0)), (cell.drop, Fraction(1, q))


def modulo(cell: Cell) -> Callable[[Pair], Pair]:
    """Return what brings a translation, in fractions of the rectangle, to its representative."""
    (ax, ay), (bx, by) = lattice_of(cell)

    def by_columns(point: Pair) -> Pair:
        times = point[0] // ax
        return point[0] - times * ax, (point[1] - times * ay) % 1

    def by_rows(point: Pair) -> Pair:
        times = point[1] // by
        return (point[0] - times * bx) % 1, point[1] - times * by

    return by_columns if cell.axis == DropAxis.COLUMN else by_rows


def _any_size(drop: Fraction, axis: DropAxis) -> Cell:
    """Return a cell with a drop: fractions do not depend on its size."""
    return Cell(drop.denominator, drop.denominator, drop, axis)


@functools.lru_cache(maxsize=1024)
def translations(group: Group, drop: Fraction, axis: DropAxis) -> frozenset[Pair]:
    """Return the translations of a group and of a drop together, modulo the rectangle."""
    steps = lattice_of(_any_size(drop, axis))
    found: set[Pair] = set(group.translations)
    fresh = found
    while fresh:
        moved = {whole_cells((x + dx, y + dy)) for x, y in fresh for dx, dy in steps}
        fresh = moved - found
        found = found | fresh
    return frozenset(found)


@functools.lru_cache(maxsize=1024)
def _operations(group: Group, drop: Fraction, axis: DropAxis) -> tuple[Operation, ...]:
    """Return a group's operations, one of each class modulo the lattice of a drop."""
    return multiplied(group.generators, modulo(_any_size(drop, axis)))


@functools.lru_cache(maxsize=1024)
def _admits(group: Group, drop: Fraction, axis: DropAxis) -> bool:
    """Whether linear parts bring the translations of group and drop onto themselves."""
    together = translations(group, drop, axis)
    sides = {(Fraction(1), Fraction(0)), (Fraction(0), Fraction(1))}
    return all(
        whole_cells(each.turned(move)) in together for each in group.generators for move in together | sides
    )


def fits(group: Group, frame: Frame) -> bool:
    """Whether a group's operations bring the repeat onto itself."""
    return group.kind in frame.kinds and _admits(group, frame.cell.drop, frame.cell.axis)


def fitting(frame: Frame) -> list[str]:
    """Return the names of the groups that a repeat admits."""
    return [name for name, group in GROUPS.items() if fits(group, frame)]


def check_fits(group: Group, frame: Frame) -> None:
    """Raise where a group does not fit a repeat.

    Raises:
        GeometryError: naming those that do.
    """
    if fits(group, frame):
        return
    whole = frame.cell.rectangle
    size = f"{format_mm(whole.width / frame.stretch[0])} × {format_mm(whole.height / frame.stretch[1])} mm"
    raise GeometryError(
        f"{group.name} does not bring this repeat, whose rectangle is {size}, onto itself: "
        f"expected one of {', '.join(fitting(frame))}"
    )


def orbit_of(
    group: Group,
    frame: Frame,
    phase: Shift = (0.0, 0.0),
    spread: Spread = Spread.FREE,
    at_corner: bool = False,
) -> Orbit:
    """Return the orbit that a group gives on a repeat.

    Args:
        group: in its rectangular cell, which is the rectangle of the repeat.
        frame: the repeat.
        phase: where the group's origin lies, in mm before the stretch.
        spread: what is multiplied.
        at_corner: measure places from the repeat's corner although the region is cut.

    Raises:
        GeometryError: where the group does not fit the repeat, or nothing can be cut.
    """
    check_fits(group, frame)
    whole = frame.cell.rectangle
    # On whole steps, so that edges of the region stay where the grid has them.
    origin = tuple(to_steps(p * s) / STEPS_PER_MM for p, s in zip(phase, frame.stretch, strict=True))
    here = Affine.translation((origin[0], origin[1]))
    operations = _operations(group, frame.cell.drop, frame.cell.axis)
    maps = tuple(_moved(_on_cloth(each, whole), here) for each in operations)
    periods = tuple((x / STEPS_PER_MM, y / STEPS_PER_MM) for x, y in frame.cell.lattice)
    base = here @ Affine.scale(*frame.stretch)
    if spread == Spread.FREE:
        return Orbit(maps, periods, base)
    group = _with_region(group, frame.cell)
    centre = float(group.centre[0]) * whole.width, float(group.centre[1]) * whole.height
    if not at_corner:
        base = here @ Affine.translation(centre) @ Affine.scale(*frame.stretch)
    region = _region(group, whole, (origin[0], origin[1])) if spread == Spread.CUT else None
    return Orbit(maps, periods, base, region, None if at_corner else (0.0, 0.0))


def _on_cloth(operation: Operation, whole: Cell) -> Affine:
    """Return an operation in fractions as a map of millimetres."""
    across = Fraction(whole.columns, whole.rows)
    return Affine(
        float(operation.a),
        float(operation.b * across),
        float(operation.c / across),
        float(operation.d),
        float(operation.e * whole.columns / STEPS_PER_MM),
        float(operation.f * whole.rows / STEPS_PER_MM),
    )


def _moved(operation: Affine, here: Affine) -> Affine:
    return operation if operation.is_identity or here.is_identity else here @ operation @ here.inverse()


def _region(group: Group, whole: Cell, origin: Shift) -> Region:
    corners = [
        (
            float(x * whole.columns) + origin[0] * STEPS_PER_MM,
            float(y * whole.rows) + origin[1] * STEPS_PER_MM,
        )
        for x, y in group.region
    ]
    return Region(tuple(corners), tuple(group.mirrored_edges()))


def _with_region(group: Group, cell: Cell) -> Group:
    """Return the group with the fundamental region that it has on the lattice of a cell.

    Raises:
        GeometryError: where the drop adds translations to a group of reflections, whose region then is
            another group's.
    """
    if translations(group, cell.drop, cell.axis) == group.translations:
        return group
    q = Fraction(1, cell.drop.denominator)
    width, height = (q, Fraction(1)) if cell.axis == DropAxis.COLUMN else (Fraction(1), q)
    if group.name == "p2":
        width, height = (width / 2, height) if cell.axis == DropAxis.COLUMN else (width, height / 2)
    elif group.name != "p1":
        better = " (try cm or cmm)" if q == HALF else ""
        raise GeometryError(
            f"the region of {group.name} is not known for this drop: expected p1 or p2{better}"
        )
    zero = Fraction(0)
    return Group(
        group.name,
        group.orbifold,
        group.others,
        group.kind,
        group.generators,
        ((zero, zero), (width, zero), (width, height), (zero, height)),
    )
