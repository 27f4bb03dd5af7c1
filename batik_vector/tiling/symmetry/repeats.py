"""The repeat: from the half-drop, brick, drop, mirror or group that is asked for to a cell on the grid."""

from __future__ import annotations

import enum
import functools
import re
from fractions import Fraction
from typing import Annotated

from batik_vector.artwork import Cell, DropAxis
from batik_vector.errors import Fault, GeometryError, RecipeError, nearest
from batik_vector.fields import Between, Length, Says, Text, check, shown
from batik_vector.tiling.symmetry.groups import GROUP_PATTERN, GROUPS, Group, Kind, group, group_names
from batik_vector.tiling.symmetry.machine_fit import Fit, per_cent, repeats_to_fill
from batik_vector.tiling.symmetry.orbits import TRIVIAL, Orbit, Shift
from batik_vector.tiling.symmetry.spread import Frame, Spread, orbit_of, shapes_of
from batik_vector.units import format_mm, to_steps
from batik_vector.values import frozen

_DROP = r"^(drop|brick)\s+(\d{1,3})\s*/\s*(\d{1,3})$"
_NAMED = {
    "grid": (Fraction(0), DropAxis.COLUMN),
    "half-drop": (Fraction(1, 2), DropAxis.COLUMN),
    "brick": (Fraction(1, 2), DropAxis.ROW),
}
KEPT_ORBITS = 64
"""How many orbits a repeat remembers."""

MIRRORS = {"mirror": ("pmm", 2, 2), "mirror-x": ("pm", 2, 1), "mirror-y": ("p11m", 1, 2)}
"""Repeats that reflect the unit at its edges: the group, and the units across and up its rectangle."""

MAX_DENOMINATOR = 60
DROPS = '"grid", "half-drop", "brick", "drop p/q" or "brick p/q"'
REPEATS = (
    '"grid", "half-drop", "brick", "drop p/q", "brick p/q", "mirror", "mirror-x", "mirror-y" '
    'or a wallpaper group such as "p4m"'
)
REPEAT_PATTERN = (
    r"^\s*(grid|half-drop|brick|(drop|brick)\s+\d{1,3}\s*/\s*\d{1,3}|mirror(-[xy])?)\s*$|" + GROUP_PATTERN
)
"""For editors; :func:`repeat_of` is what decides."""


class Cut(enum.StrEnum):
    """Which piece of the field becomes the tile."""

    RECTANGLE = "rectangle"
    """The smallest rectangle that repeats straight: q units for a drop of p/q."""
    UNIT = "unit"
    """One unit, to be repeated with its drop."""


@frozen
class Repeat:
    """How units stand to one another.

    Attributes:
        drop: of the neighbours along ``axis``.
        axis: which neighbours drop.
        group: the symmetry of the repeat, where it has one.
        across: units side by side in the rectangle that repeats, beside those of the drop.
        up: units one above another in it.
    """

    drop: Fraction = Fraction(0)
    axis: DropAxis = DropAxis.COLUMN
    group: Group | None = None
    across: int = 1
    up: int = 1

    @property
    def mirrored(self) -> bool:
        """Whether the unit is reflected at its edges."""
        return (self.across, self.up) != (1, 1)

    @property
    def kind(self) -> Kind:
        """What it asks of the cell's shape."""
        return self.group.kind if self.group else Kind.ANY


def parse_repeat(text: str) -> tuple[Fraction, DropAxis]:
    """Return a drop and its axis: ``"drop 1/3"`` → (1/3, column).

    Raises:
        GeometryError: saying what was expected.
    """
    words = text.strip().lower()
    if words in _NAMED:
        return _NAMED[words]
    match = re.match(_DROP, words)
    if match is None:
        raise GeometryError(f'repeat "{text}": expected {DROPS}')
    p, q = int(match[2]), int(match[3])
    if q == 0 or q > MAX_DENOMINATOR:
        raise GeometryError(f'repeat "{text}": expected a drop p/q with q from 1 to {MAX_DENOMINATOR}')
    return Fraction(p, q) % 1, DropAxis.COLUMN if match[1] == "drop" else DropAxis.ROW


@functools.lru_cache(maxsize=64)
def repeat_of(text: str) -> Repeat:
    """Return the repeat that a recipe's word names: a drop, a mirror, or any name of a group.

    Raises:
        GeometryError: with the nearest word, or all of them.
    """
    words = text.strip().lower()
    if words in MIRRORS:
        name, across, up = MIRRORS[words]
        return Repeat(group=group(name), across=across, up=up)
    if words in _NAMED or re.match(_DROP, words):
        drop, axis = parse_repeat(text)
        return Repeat(drop, axis)
    try:
        return Repeat(group=group(words))
    except RecipeError:
        near = nearest(text, [*_NAMED, *MIRRORS, *group_names()])
        hint = f'did you mean "{near}"?' if near else f"expected {REPEATS}"
        raise GeometryError(f"repeat {shown(text)}: {hint}") from None


def _checked_repeat(text: str) -> str:
    repeat_of(text)
    return text


@frozen(kw_only=True)
class TileSpec:
    """The repeat: the size of its unit, how units stand to one another, and what is cut out as the tile.

    A group or a mirror repeat gives the symmetry of every placement that names none. A group takes the size
    as its rectangle: p4, p4m and p4g want a square, those of three- and six-fold turns √3 times the width as
    height. What is a little off, or fitted to a machine, is stretched, and the stretch reported.
    """

    size: Annotated[
        tuple[Annotated[Length, Between(0.1, 20_000)], Annotated[Length, Between(0.1, 20_000)]],
        Says(
            "width and height of the unit; a drop p/q rounds the side it divides to q µm",
            called="width, height",
        ),
    ]
    repeat: Annotated[
        str, Text(_checked_repeat, REPEATS, REPEAT_PATTERN), Says(f"how units stand: {REPEATS}")
    ] = "grid"
    cut: Annotated[Cut, Says("the rectangle that repeats straight, or one unit")] = Cut.RECTANGLE
    fit: Annotated[Fit | None, Says("machine whose repeat a whole number of rectangles fills")] = None

    def __post_init__(self) -> None:
        check(self)
        if self._repeat.mirrored and self.cut == Cut.UNIT:
            raise GeometryError(
                f'cut = "unit" leaves the half of a {self.repeat} repeat: expected "rectangle"'
            )
        self._check_shape()
        self._measured  # noqa: B018  (raises where the repeat fits no machine)

    @functools.cached_property
    def _repeat(self) -> Repeat:
        return repeat_of(self.repeat)

    def _check_shape(self) -> None:
        """Raise where the size is farther from what the group asks for than it may be stretched."""
        limit = self.fit.limit if self.fit else Fit().limit
        high = self._ideal[1]
        stretch = self.size[1] / high
        if abs(stretch - 1) * 100 <= limit:
            return
        asks = "a square" if self._repeat.kind == Kind.SQUARE else "√3 times the width as height"
        words = (
            f"{self.repeat} asks for {asks}, expected {format_mm(high)} mm and not "
            f"{format_mm(self.size[1])} mm, a stretch by {per_cent(stretch)} past the limit of {limit:g} %"
        )
        raise RecipeError([Fault(words, "size[1]")])

    @property
    def _ideal(self) -> tuple[float, float]:
        """Width and height of the unit in mm before any stretch."""
        width, height = self.size
        ratio = self._repeat.kind.ratio
        return width, height if ratio is None else ratio * width

    @property
    def _units(self) -> tuple[int, int]:
        """How many units wide and high the rectangle that repeats straight is."""
        repeat = self._repeat
        drops = (
            (repeat.drop.denominator, 1) if repeat.axis == DropAxis.COLUMN else (1, repeat.drop.denominator)
        )
        return repeat.across * drops[0], repeat.up * drops[1]

    @functools.cached_property
    def _measured(self) -> tuple[float, float]:
        """Width and height of the unit on cloth in mm, fitted to the machine."""
        width, height = self.size
        fit = self.fit
        if fit is None or (fit.width is None and fit.height is None):
            return width, height
        (wide, high), (across, up) = self._ideal, self._units
        if fit.width is not None:
            count = repeats_to_fill(fit.width, wide * across, across, fit.limit, "width")
            width = fit.width / (count * across)
        if fit.height is not None:
            count = repeats_to_fill(fit.height, high * up, up, fit.limit, "height")
            height = fit.height / (count * up)
        if self._repeat.kind != Kind.ANY:
            # A side left free follows the other, so that the group stays true.
            if fit.width is None:
                width = wide * height / high
            if fit.height is None:
                height = high * width / wide
        return width, height

    @property
    def stretch(self) -> tuple[float, float]:
        """By how much the drawing is drawn out across and along the cloth: 1.0 where it is not."""
        unit, (wide, high) = self.unit(), self._ideal
        true = self._repeat.kind == Kind.ANY
        fit = self.fit or Fit()
        return (
            1.0 if true and fit.width is None else unit.width / wide,
            1.0 if true and fit.height is None else unit.height / high,
        )

    def unit(self) -> Cell:
        """Return the unit on the grid.

        A drop must land on whole grid steps: the side it divides is rounded to a multiple of q µm, which
        moves it by less than 0.03 mm for the finest drop allowed.
        """
        drop, axis = self._repeat.drop, self._repeat.axis
        columns, rows = map(to_steps, self._measured)
        q = drop.denominator
        if axis == DropAxis.COLUMN:
            rows = max(round(rows / q), 1) * q
        else:
            columns = max(round(columns / q), 1) * q
        return Cell(columns, rows, drop, axis)

    def repeating(self) -> Cell:
        """Return the cell on whose lattice everything placed repeats: the unit, or its mirrored rectangle."""
        unit, repeat = self.unit(), self._repeat
        return Cell(unit.columns * repeat.across, unit.rows * repeat.up, unit.drop, unit.axis)

    def cell(self) -> Cell:
        """Return the cell that the tile fills."""
        return self.repeating().rectangle if self.cut == Cut.RECTANGLE else self.unit()

    def orbit(self, symmetry: str = "", phase: Shift = (0.0, 0.0), spread: Spread | None = None) -> Orbit:
        """Return the orbit of a placement.

        Args:
            symmetry: name of a group; the tile's own when left out.
            phase: where its origin lies, in mm before any stretch.
            spread: what is multiplied; in a mirror repeat the unit is cut at its edges, elsewhere marks are
                free.

        Raises:
            UnknownNameError: for a group that is none.
            GeometryError: for one that the repeat does not admit.
        """
        asked = symmetry, phase, spread
        found = self._orbits.get(asked)
        if found is None:
            found = self._orbit(symmetry, phase, spread)
            if len(self._orbits) >= KEPT_ORBITS:
                self._orbits.clear()
            self._orbits[asked] = found
        return found

    @functools.cached_property
    def _orbits(self) -> dict[tuple[str, Shift, Spread | None], Orbit]:
        """What was asked for before: a recipe asks for each as it is read, and as it is compiled."""
        return {}

    def _orbit(self, symmetry: str, phase: Shift, spread: Spread | None) -> Orbit:
        own = not symmetry and self._repeat.mirrored
        spread = spread or (Spread.CUT if own else Spread.FREE)
        chosen = group(symmetry) if symmetry else self._repeat.group or GROUPS["p1"]
        if (
            chosen.name == "p1"
            and spread == Spread.FREE
            and phase == (0.0, 0.0)
            and self.stretch == (1.0, 1.0)
        ):
            return TRIVIAL
        return orbit_of(chosen, self._frame, phase, spread, at_corner=own)

    @functools.cached_property
    def _frame(self) -> Frame:
        kind = self._repeat.kind
        if kind != Kind.ANY:
            return Frame(self.repeating(), frozenset({Kind.ANY, kind}), self.stretch)
        (wide, high), (across, up) = self._ideal, self._units
        whole = Cell(to_steps(wide * across), to_steps(high * up))
        return Frame(self.repeating(), shapes_of(whole), self.stretch)
