"""Every tile is seamless, whatever the recipe: opposite edges are equal bits, and the torus has no origin."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import shapely
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, Layer, Overlap, violations
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import RecipeError
from batik_vector.recipe.model import Recipe
from batik_vector.tiling.cloth.field import repeated
from batik_vector.tiling.symmetry.repeats import MIRRORS, Cut
from batik_vector.tiling.symmetry.spread import Spread
from tests.recipes import recipes
from tests.thorough import examples, long

many = settings(
    max_examples=examples(30, 500),
    deadline=None,
    derandomize=True,
    # A recipe that fails is small enough to be read as it is; making it smaller takes minutes.
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


TOO_MUCH = ("more than fits", "past the limit")
"""In what a recipe is told whose work is refused."""
NO_TILE = (
    "nothing is left",
    "nothing that could be tossed",
    " fit at a distance",
    " fits between",
    " keeps no distance",
)


def compiled(recipe: Recipe) -> Artwork:
    try:
        return compile_recipe(recipe)
    except RecipeError as error:
        # Everything may lie under a mark that only cuts, a toss find no room or nothing to toss, or the work
        # be more than a compile may do.
        assume(not any(words in str(error) for words in (*NO_TILE, *TOO_MUCH)))
        raise


def crossings(layer: Layer, axis: int, value: float, length: float) -> set[float]:
    """Where the borders of areas meet a cell edge, by intersecting with the edge itself."""
    ends = [(value, 0.0), (value, length)] if axis == 0 else [(0.0, value), (length, value)]
    if not len(layer.areas):
        return set()
    near = layer.areas[shapely.STRtree(layer.areas).query(shapely.LineString(ends), predicate="intersects")]
    covered = shapely.union_all(shapely.intersection(near, shapely.LineString(ends)))
    stretches = [part for part in shapely.get_parts(shapely.line_merge(covered)) if part.length > 0]
    found = [float(p[1 - axis]) for part in stretches for p in (part.coords[0], part.coords[-1])]
    return {p for p in found if 0 < p < length}


def twins(values: set[float], shift: float, length: float) -> set[float]:
    moved = {round((value + shift) * 1000) % round(length * 1000) for value in values}
    return {steps / 1000 for steps in moved} - {0.0}


@long
@many
@given(recipes())
def test_opposite_edges_are_bit_identical_and_the_artwork_is_in_normal_form(recipe: Recipe) -> None:
    artwork = compiled(recipe)
    assert violations(artwork) == []
    cell = artwork.cell
    (_, slip_y), (slip_x, _) = cell.lattice
    # Marks that a symmetry's region cuts may end along the seam itself, with nothing beyond.
    bordered = {(ink, axis) for ink, axis, low, high in artwork.borders if low < high}
    for layer in artwork.layers:
        if (layer.ink.name, 0) not in bordered:
            left, right = (crossings(layer, 0, x, cell.height) for x in (0.0, cell.width))
            assert twins(left, slip_y / 1000, cell.height) - {slip_y / 1000} == right - {slip_y / 1000}
        if (layer.ink.name, 1) not in bordered:
            low, high = (crossings(layer, 1, y, cell.width) for y in (0.0, cell.height))
            assert twins(low, slip_x / 1000, cell.width) - {slip_x / 1000} == high - {slip_x / 1000}
        if not cuts(recipe):
            assert_line_ends_meet(layer, cell)


def cuts(recipe: Recipe) -> bool:
    """Whether any mark cuts another: a line may then end exactly where it meets the seam."""
    parts = [element for motif in recipe.motif.values() for element in motif.parts()]
    return (
        any(e.gap is not None or e.treatment == "cut" for e in parts)
        or any(ink.overlap == "knockout" for ink in recipe.ink.values())
        or any(p.gap is not None or p.region == Spread.CUT for p in recipe.place)
        or recipe.tiling.repeat in MIRRORS
    )


def _off_the_edge(line: shapely.LineString, axis: int) -> list[tuple[float, ...]]:
    """Where a line ends without running along an edge, or turns off from one."""
    points = list(line.coords)
    found = []
    for number, point in enumerate(points):
        beside = points[max(number - 1, 0) : number] + points[number + 1 : number + 2]
        along = [other[axis] == point[axis] for other in beside]
        if not line.is_closed and number in (0, len(points) - 1):
            found += [point] * (not any(along))
        elif len(along) == 2 and along[0] != along[1]:
            found.append(point)
    return found


def assert_line_ends_meet(layer: Layer, cell: Cell) -> None:
    """Lines leave by an edge where others come in by the opposite one.

    Places and not their numbers are compared: two lines may share the stretch next to the seam on one
    side, where it is drawn once.
    """
    (_, slip_y), (slip_x, _) = cell.lattice
    size = round(cell.width * 1000), round(cell.height * 1000)
    for axis, slip in ((0, slip_y), (1, slip_x)):
        # A stretch along an edge is drawn on one side only, and so are its ends; where a line turns off from
        # one, the line that goes on beyond the seam begins.
        ends = [point for line in layer.lines for point in _off_the_edge(line, axis)]
        here = [round(p[1 - axis] * 1000) for p in ends if p[axis] == 0]
        there = [round(p[1 - axis] * 1000) for p in ends if round(p[axis] * 1000) == size[axis]]
        inner = size[1 - axis]
        edge = {0, inner, slip % inner}
        assert {(y + slip) % inner for y in here} - edge == {y % inner for y in there} - edge


def rolled(field: Artwork, cell: Cell, offset: tuple[float, float]) -> list[NDArray[np.object_]]:
    """Cut a field at an offset (plain floats, no grid) and move the four pieces back into the cell."""
    width, height = cell.width, cell.height
    dx, dy = offset
    window = shapely.box(dx, dy, dx + width, dy + height)
    out = []
    for layer in field.layers:
        cut = shapely.intersection(layer.areas, window)
        pieces = []
        for i in (0, 1):
            for j in (0, 1):
                quarter = shapely.box(i * width, j * height, (i + 1) * width, (j + 1) * height)
                part = shapely.intersection(cut, quarter)
                part = shapely.transform(part, partial(np.add, [-i * width, -j * height]))
                pieces.append(part[~shapely.is_empty(part)])
        out.append(np.concatenate(pieces))
    return out


def difference(a: NDArray[np.object_], b: NDArray[np.object_]) -> float:
    """Area of the symmetric difference, summed over pairs so that no union rounds anything."""
    i, j = shapely.STRtree(a).query(b, predicate="intersects") if len(a) and len(b) else ([], [])
    common = float(shapely.area(shapely.intersection(a[j], b[i])).sum()) if len(i) else 0.0
    return float(shapely.area(a).sum() + shapely.area(b).sum()) - 2 * common


def welded(recipe: Recipe) -> Recipe:
    """The recipe as a rectangle in which no ink lies over itself, so that areas can be added up."""
    inks = {name: replace(ink, overlap=Overlap.WELD) for name, ink in recipe.ink.items()}
    return replace(recipe, ink=inks, tile=replace(recipe.tiling, cut=Cut.RECTANGLE))


@long
@settings(many, max_examples=examples(40, 150))
@given(recipes(), st.floats(0.01, 0.99), st.floats(0.01, 0.99))
def test_the_field_cut_elsewhere_is_the_tile(recipe: Recipe, u: float, v: float) -> None:
    artwork = compiled(welded(recipe))
    field = repeated(artwork, 2, 2)
    assert violations(field) == []
    again = rolled(field, artwork.cell, (u * artwork.cell.width, v * artwork.cell.height))
    for layer, areas in zip(artwork.layers, again, strict=True):
        assert abs(difference(layer.areas, areas)) < 1e-6


@long
@settings(many, max_examples=examples(25, 100))
@given(recipes(), st.integers(1, 14_000), st.integers(1, 14_000))
def test_moving_every_placement_moves_the_drawing_and_nothing_else(recipe: Recipe, dx: int, dy: int) -> None:
    straight = welded(recipe)
    moved = replace(
        straight,
        place=tuple(
            replace(p, phase=(p.phase[0] + dx / 1000, p.phase[1] + dy / 1000)) for p in straight.place
        ),
    )
    first, second = compiled(straight), compiled(moved)
    for a, b in zip(first.layers, second.layers, strict=True):
        # Every edge may be rounded by a step or two, also those of marks that were cut away.
        rounding = 0.004 * float(shapely.length(a.areas).sum()) + 1e-4 * first.cell.width * first.cell.height
        assert abs(shapely.area(a.areas).sum() - shapely.area(b.areas).sum()) <= rounding
