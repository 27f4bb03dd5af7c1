"""Borders round a cloth: from the recipe's tables to layers, in millimetres on cloth.

One period of each band is drawn and solved as a tile is; :mod:`batik_vector.tiling.borders.sides` lays it
along the sides and closes it at the corners. What leaves is in the normal form of
:mod:`batik_vector.artwork`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Cell, Geometries, Ink, Layer, Overlap
from batik_vector.compiling.placements import place
from batik_vector.errors import GeometryError, RecipeError, TooLargeError, UnknownNameError, blame
from batik_vector.geometry.regions import oriented
from batik_vector.recipe.border import BorderSpec, Corner, Ends, RailSpec
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.borders.bands import Band, Marks, solved, together
from batik_vector.tiling.borders.joints import closed
from batik_vector.tiling.borders.sides import (
    CORNER_NAMES,
    SIDES,
    Course,
    Measures,
    bent_round,
    corner_square,
    inner_shape,
    mitred_round,
    sides_of,
    straight,
    turned_corners,
)
from batik_vector.tiling.symmetry.friezes import orbit
from batik_vector.tiling.symmetry.orbits import TRIVIAL, Orbit
from batik_vector.tiling.torus.torus import Window, to_mm
from batik_vector.tiling.welding.growth import quad_segs
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.units import STEPS_PER_MM, format_mm, to_steps
from batik_vector.values import frozen

Box = tuple[float, float, float, float]
"""Left, bottom, right and top in mm on cloth."""

BEND_SHARE = 0.5
"""Share of the tolerance that bending a band round its corners may use; its drawing has the rest."""


@frozen
class SideFit:
    """How a border fits a side of the cloth.

    ``periods`` is how many it holds, counted with the corner at its end; ``stretch`` the factor on the period
    that is farthest from 1.
    """

    border: int
    side: str
    periods: float
    stretch: float


@frozen(eq=False)
class Bordered:
    """Borders on the cloth, and what they leave of it.

    Attributes:
        layers: in the normal form, one for every ink that draws something, in the recipe's order.
        window: the rectangle within the borders (mm), for the field or another border.
        shape: what is bare within them (mm, on the grid): the window, its corners rounded where a border
            bends. Borders may touch its edges and never cross them by more than the tolerance.
        fits: for every border, outermost first, and every side that it lies along.
    """

    layers: tuple[Layer, ...]
    window: Box
    shape: shapely.Polygon
    fits: tuple[SideFit, ...]


@frozen
class _Room:
    """What is left of the cloth, in grid steps: a window, and how far each of its corners is rounded."""

    window: Window
    radii: tuple[int, int, int, int] = (0, 0, 0, 0)


def compile_borders(borders: Sequence[BorderSpec], recipe: Recipe, window: Box) -> Bordered:
    """Compile the borders along the edges of a window of the cloth.

    Args:
        borders: the outermost first.
        recipe: whose motifs, inks, tolerance and limit hold.
        window: the cloth, or the part of it that the outermost border goes round.

    Raises:
        RecipeError: naming the key at fault, where a border does not fit or cannot be drawn.
    """
    inks = {name: spec.named(name) for name, spec in recipe.ink.items()}
    room = _Room(Window(*(to_steps(value) for value in window)))
    maker = _Maker(recipe, inks)
    fits: list[SideFit] = []
    for number, border in enumerate(borders):
        with blame(f"border[{number}]"):
            courses = maker.draw(border, room)
            room = _within(border, room)
        fits += [SideFit(number, c.side.name, c.periods, c.stretch) for c in courses]
    segments = quad_segs(max(room.radii) / STEPS_PER_MM, recipe.tolerance)
    shape = inner_shape(room.window, room.radii, segments)
    left, bottom, right, top = (value / STEPS_PER_MM for value in room.window.box.bounds)
    return Bordered(
        maker.layers(), (left, bottom, right, top), to_mm(np.array([shape], dtype=object))[0], tuple(fits)
    )


def _within(border: BorderSpec, room: _Room) -> _Room:
    """Return what a border leaves of its room."""
    taken = border.depth + to_steps(border.gap)
    left, bottom, right, top = (
        taken if side in border.sides else 0 for side in ("left", "bottom", "right", "top")
    )
    w = room.window
    inner = Window(w.left + left, w.bottom + bottom, w.right - right, w.top - top)
    if inner.left >= inner.right or inner.bottom >= inner.top:
        size = [format_mm(side / STEPS_PER_MM) for side in (w.right - w.left, w.top - w.bottom)]
        raise GeometryError(
            f"a depth of {format_mm(border.size[1])} mm leaves nothing of {size[0]} × {size[1]} mm: "
            "expected a larger cloth or a smaller depth"
        )
    turned = turned_corners(border.sides)
    radii = [0, 0, 0, 0]
    for corner in range(4):
        if corner in turned and border.corner == Corner.BEND:
            radii[corner] = max(_radius(border, room) - taken, 0)
    return _Room(inner, (radii[0], radii[1], radii[2], radii[3]))


def _radius(border: BorderSpec, room: _Room) -> int:
    """Return the radius of a bent border's outer edge, in grid steps."""
    if border.radius is None:
        # Within another bend it keeps to the same centre, if that leaves it enough to bend round.
        return max(border.depth + border.depth // 2, *room.radii)
    return to_steps(border.radius) + border.depth


class _Maker:
    """Draws borders one after another, counts their vertices, and collects their marks by ink."""

    def __init__(self, recipe: Recipe, inks: Mapping[str, Ink]) -> None:
        self.recipe, self.inks = recipe, inks
        self.marks: dict[str, list[Marks]] = {name: [] for name in inks}
        self.names: dict[str, int] = {}
        self.spent = 0

    def draw(self, border: BorderSpec, room: _Room) -> list[Course]:
        """Draw a border into its room; return where its periods came to lie."""
        corners = turned_corners(border.sides)
        radius = _radius(border, room) if border.corner == Corner.BEND else 0
        _refuse_round_room(border, room, corners, radius)
        tolerance = self.recipe.tolerance
        if corners and border.corner == Corner.BEND:
            # The outer edge is drawn out more than the middle, and its chords with it.
            tolerance *= (1 - BEND_SHARE) * (radius - border.depth / 2) / radius
        bands = self._bands(border, max(tolerance, 0.002))
        self._foresee(border, room.window, sum(band.marks.vertices for band in bands))
        courses = _courses(border, room.window, corners, radius)
        copies = sum(len(course.spans) + len(course.arc) for course in courses)
        self._spend(sum(band.marks.vertices for band in bands) * copies)
        bending = self.recipe.tolerance * BEND_SHARE * STEPS_PER_MM
        for band in bands:
            self.marks[band.ink.name] += [course.laid(band, radius, bending) for course in courses]
        if corners and border.corner == Corner.MOTIF:
            self._corner_squares(border, room.window, corners)
        return courses

    def layers(self) -> tuple[Layer, ...]:
        """Return what has been drawn."""
        names = list(self.names)
        found = []
        for name, ink in self.inks.items():
            marks = closed(together(self.marks[name]), ink.overlap != Overlap.OVERLAY)
            areas = oriented(marks.areas) if len(marks.areas) else marks.areas
            area_names = tuple(map(names.__getitem__, marks.area_codes))
            line_names = tuple(map(names.__getitem__, marks.line_codes))
            found.append(Layer(ink, to_mm(areas), to_mm(marks.lines), area_names, line_names))
        return tuple(layer for layer in found if len(layer.areas) or len(layer.lines))

    def _bands(self, border: BorderSpec, tolerance: float) -> list[Band]:
        recipe = replace(self.recipe, tolerance=tolerance)
        unit = Cell(border.period, border.depth)
        group = orbit(border.frieze, unit.width, unit.height)
        rails = [self._rail(rail, _strip(rail, unit.width)) for rail in border.rails]
        sheets = rails + self._sheets(border.place, "place", recipe, unit, group)
        box = (border.period, border.depth)
        found = solved(sheets, list(self.inks.values()), box, True, recipe.tolerance, self._code)
        return [Band(ink, marks, *box) for ink, marks in found]

    def _corner_squares(self, border: BorderSpec, window: Window, corners: frozenset[int]) -> None:
        unit = Cell(border.depth, border.depth)
        rails = [self._rail(rail, _elbow(rail, unit.width)) for rail in border.rails]
        sheets = rails + self._sheets(border.corner_place, "corner_place", self.recipe, unit, TRIVIAL)
        box = (border.depth, border.depth)
        found = solved(sheets, list(self.inks.values()), box, False, self.recipe.tolerance, self._code)
        for ink, marks in found:
            for corner in sorted(corners):
                self._spend(marks.vertices)
                to = corner_square(window, corner, border.facing)
                self.marks[ink.name].append(marks.moved(to))

    def _sheets(
        self, placements: Sequence[Placement], key: str, recipe: Recipe, unit: Cell, group: Orbit
    ) -> list[Sheet]:
        sheets: list[Sheet] = []
        for number, placement in enumerate(placements):
            with blame(f"{key}[{number}]"):
                own = replace(group, operations=group.operations[:1]) if placement.symmetry else group
                placed = place(placement, recipe, unit, self.inks, recipe.limit - self.spent, own)
                self._spend(placed.vertices)
            sheets += placed.sheets
        return sheets

    def _rail(self, rail: RailSpec, area: shapely.Polygon) -> Sheet:
        if not rail.ink and len(self.inks) > 1:
            raise RecipeError(f"rails: no ink is named: expected one of {', '.join(self.inks)}")
        if rail.ink and rail.ink not in self.inks:
            raise UnknownNameError(rail.ink, list(self.inks), "ink")
        ink = self.inks[rail.ink] if rail.ink else next(iter(self.inks.values()))
        areas: Geometries = np.array([area], dtype=object)
        return Sheet("rail", ink, areas, gap=0.0 if ink.overlap == Overlap.KNOCKOUT else None)

    def _foresee(self, border: BorderSpec, window: Window, vertices: int) -> None:
        """Raise before a border of far too many periods is laid, of so many vertices each."""
        sides = sides_of(window, border.sides, "turn")
        periods = sum(side.length for side in sides) // border.period
        # An empty period is laid as well.
        count = self.spent + periods * max(vertices, 1)
        if count > self.recipe.limit:
            raise TooLargeError(
                f"about {periods:,} periods of {format_mm(border.size[0])} mm make about {count:,} vertices, "
                f"past the limit of {self.recipe.limit:,}: expected longer periods, a larger tolerance, or a "
                "higher limit of the recipe"
            )

    def _spend(self, vertices: int) -> None:
        self.spent += vertices
        if self.spent > self.recipe.limit:
            raise TooLargeError(
                f"about {self.spent:,} vertices, past the limit of {self.recipe.limit:,}: expected longer "
                "periods, a larger tolerance, or a higher limit of the recipe"
            )

    def _code(self, name: str) -> int:
        return self.names.setdefault(name, len(self.names))


def _refuse_round_room(border: BorderSpec, room: _Room, corners: frozenset[int], radius: int) -> None:
    """Raise where a border would run over the bend of the one outside it."""
    for side, ends in SIDES.items():
        for corner in ends:
            need = room.radii[corner]
            if side not in border.sides or radius * (corner in corners) >= need:
                continue
            inner = max(math.ceil((need - border.depth) / STEPS_PER_MM), 0)
            words = f'corner = "bend" with a radius of at least {inner} mm'
            if corner not in corners:
                both = " and ".join(name for name, joined in SIDES.items() if corner in joined)
                words = f"sides to name both {both}, and {words}"
            elif border.corner == Corner.BEND:
                words = f"a radius of at least {inner} mm"
            raise GeometryError(
                f"it would run over the {CORNER_NAMES[corner]} corner, which the border outside it "
                f"bends round with {format_mm(need / STEPS_PER_MM)} mm radius: expected {words}"
            )


def _courses(border: BorderSpec, window: Window, corners: frozenset[int], radius: int) -> list[Course]:
    measures = Measures(
        border.period, border.depth, to_steps(border.phase), border.ends == Ends.WHOLE, border.limit / 100
    )
    if corners and border.corner == Corner.MITRE:
        return mitred_round(sides_of(window, border.sides, "mitre"), corners, measures)
    if corners and border.corner == Corner.BEND:
        return bent_round(sides_of(window, border.sides, "turn"), corners, radius, measures)
    return straight(sides_of(window, border.sides, border.facing), corners, measures)


def _strip(rail: RailSpec, length: float) -> shapely.Polygon:
    return shapely.box(0, rail.at - rail.width / 2, length, rail.at + rail.width / 2)


def _elbow(rail: RailSpec, side: float) -> shapely.Polygon:
    """Return a rule that runs round the lower left corner within its square."""
    a, b = rail.at - rail.width / 2, rail.at + rail.width / 2
    return shapely.Polygon([(a, a), (side, a), (side, b), (b, b), (b, side), (a, side)])
