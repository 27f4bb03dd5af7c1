"""A cloth of given size shows the infinite field, whole and welded, whatever the pieces it comes in."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, DropAxis, Ink, Layer, Overlap, violations
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import GeometryError, RecipeError, TooLargeError
from batik_vector.recipe.model import Recipe
from batik_vector.tiling.cloth.field import collected
from batik_vector.tiling.cloth.spec import Align, Edge, YardageSpec
from batik_vector.tiling.cloth.yardage import Yardage, compile_yardage
from batik_vector.tiling.torus.torus import clip_areas, clip_lines, to_step_grid, wrap
from batik_vector.tiling.welding.duplicates import drawn_once
from tests.recipes import recipes
from tests.thorough import examples

Shapes = NDArray[np.object_]


def shapes(*some: shapely.Geometry) -> Shapes:
    out = np.empty(len(some), object)
    out[:] = some
    return np.asarray(shapely.transform(shapely.orient_polygons(out), lambda xy: np.rint(xy * 1000) / 1000))


def tile(
    *areas: shapely.Geometry,
    size: tuple[int, int] = (40_000, 40_000),
    lines: tuple[shapely.Geometry, ...] = (),
    names: tuple[str, ...] = (),
    **cell: Any,
) -> Artwork:
    """A tile in one ink, 40 mm square unless told otherwise."""
    layer = Layer(Ink("wax", "#ffffff"), shapes(*areas), shapes(*lines), names)
    return Artwork("t", Cell(*size, **cell), (layer,))


def disc(x: float, y: float, radius: float) -> shapely.Polygon:
    return shapely.Point(x, y).buffer(radius)


def cloth(artwork: Artwork, width: float, length: float, piece: int = 10**6, **spec: Any) -> Yardage:
    return compile_yardage(artwork, YardageSpec(width=width, length=length, **spec), piece=piece)


def drawn(artwork: Artwork, width: float, length: float, **spec: Any) -> Layer:
    found = collected(cloth(artwork, width, length, **spec))
    assert violations(found) == []
    return found.layers[0]


def naive(artwork: Artwork, page: Yardage) -> dict[str, tuple[Shapes, Shapes]]:
    """The tile's pieces side by side, each cut to the window by itself; in steps from the page's origin."""
    window, lattice = page.filling.window, artwork.cell.lattice
    found = {}
    for layer in artwork.layers:
        areas, names = wrap(to_step_grid(layer.areas), np.arange(len(layer.areas)), lattice, window)
        lines, others = wrap(to_step_grid(layer.lines), np.arange(len(layer.lines)), lattice, window)
        # Cutting may bring lines together that ran a hair apart.
        lines, _ = drawn_once(*clip_lines(lines, others, window))
        found[layer.ink.name] = clip_areas(areas, names, window)[0], lines
    return found


def difference(a: Shapes, b: Shapes) -> float:
    """Area of the symmetric difference, summed over pairs so that no union rounds anything."""
    i, j = shapely.STRtree(a).query(b, predicate="intersects") if len(a) and len(b) else ([], [])
    common = float(shapely.area(shapely.intersection(a[j], b[i])).sum()) if len(i) else 0.0
    return float(shapely.area(a).sum() + shapely.area(b).sum()) - 2 * common


def as_steps(marks: Shapes, origin: tuple[int, int]) -> Shapes:
    return (
        np.asarray(shapely.transform(marks, lambda xy: np.rint(xy * 1000) - origin)) if len(marks) else marks
    )


def overlapping(artwork: Artwork) -> float:
    """Return in mm² what areas that may not lie on one another have in common."""
    layers = [layer.areas for layer in artwork.layers if layer.ink.overlap != Overlap.OVERLAY]
    return float(sum(shapely.area(each).sum() - shapely.union_all(each).area for each in layers))


specs = st.builds(
    YardageSpec,
    width=st.integers(5_000, 90_000).map(lambda steps: steps / 1000),
    length=st.integers(5_000, 90_000).map(lambda steps: steps / 1000),
    edge=st.sampled_from([Edge.TRIM, Edge.BLEED]),
    bleed=st.sampled_from([0.0, 3.7]),
    align=st.sampled_from(list(Align)),
    phase=st.tuples(st.floats(-30, 30), st.floats(-30, 30)),
)


@settings(
    max_examples=examples(12, 50),
    deadline=None,
    derandomize=True,
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
    suppress_health_check=list(HealthCheck),
)
@given(recipes(), specs, st.sampled_from([40, 3000, 10**6]))
def test_any_cloth_is_the_field(recipe: Recipe, spec: YardageSpec, piece: int) -> None:
    try:
        artwork = compile_recipe(recipe)
    except RecipeError as error:
        assume("nothing is left" not in str(error))
        raise
    page = compile_yardage(artwork, spec, piece=piece)
    found = collected(page)
    # Where the cloth's edge cuts a mark its corner is rounded, and may come over a neighbour by half a step.
    assert [each for each in violations(found) if "overlap" not in each or overlapping(found) > 1e-4] == []
    expected = naive(artwork, page)
    for layer in found.layers:
        areas, lines = expected.pop(layer.ink.name)
        mine = as_steps(layer.areas, page.origin)
        if layer.ink.overlap == Overlap.OVERLAY:
            apart = shapely.symmetric_difference(shapely.union_all(mine), shapely.union_all(areas))
            # Joining may round where areas of one ink cross one another.
            assert apart.area / 1e6 < 1e-3
        else:
            # Where a seam is gone so is its vertex, if it lies by less than a step beside the edge.
            assert abs(difference(mine, areas)) / 1e6 < 1e-4
        length = float(shapely.length(lines).sum()) / 1000
        assert float(shapely.length(layer.lines).sum()) == pytest.approx(length, abs=1e-6)
    assert all(len(areas) + len(lines) == 0 for areas, lines in expected.values())


BARS = tile(shapely.box(0, 10, 40, 20))
DISCS = tile(disc(20, 20, 8), names=("flower.core",))
CORNERS = tile(
    *(shapely.intersection(disc(x, y, 8), shapely.box(0, 0, 40, 40)) for x in (0, 40) for y in (0, 40)),
    names=("flower.core",) * 4,
)


def test_an_endless_bar_has_four_corners() -> None:
    layer = drawn(BARS, 1000, 1000)
    assert len(layer.areas) == 25
    assert shapely.get_num_coordinates(layer.areas).tolist() == [5] * 25
    assert shapely.bounds(layer.areas[0]).tolist() == [0, 10, 1000, 20]


def test_a_mark_that_seams_divide_is_whole_and_has_its_own_vertices_only() -> None:
    layer = drawn(CORNERS, 100, 100)
    whole = [area for area in layer.areas if area.area > 199]
    assert len(layer.areas) == 9
    assert len(whole) == 4
    once = shapely.get_coordinates(CORNERS.layers[0].areas)
    corners = {(x % 40, y % 40) for x, y in np.rint(once * 1000) / 1000}
    for area in whole:
        vertices = np.rint(shapely.get_coordinates(area) * 1000) / 1000
        assert {(round(x % 40, 3) % 40, round(y % 40, 3) % 40) for x, y in vertices} <= corners


def test_a_trellis_is_one_area_with_holes_and_comes_in_pieces() -> None:
    holes = [shapely.box(x + 2, y + 2, x + 18, y + 18) for x in (0, 20) for y in (0, 20)]
    trellis = tile(shapely.difference(shapely.box(0, 0, 40, 40), shapely.union_all(holes)))
    layer = drawn(trellis, 400, 400)
    assert len(layer.areas) == 1
    assert len(layer.areas[0].interiors) == 400
    assert layer.areas[0].area == pytest.approx(400 * (400 - 256))
    pieces = list(cloth(trellis, 400, 400, piece=100).areas(0))
    assert len(pieces) > 10
    assert [piece.unfinished for piece in pieces] == [True] * (len(pieces) - 1) + [False]
    assert max(len(piece.points) for piece in pieces) < 200


def test_pieces_stay_small_however_long_the_cloth() -> None:
    for edge in Edge:
        for page in (cloth(DISCS, 200, 4000, piece=500, edge=edge), cloth(BARS, 100, 9000, piece=500)):
            assert max(len(piece.points) for piece in page.areas(0)) < 1000


def test_squares_that_touch_at_corners_stay_apart() -> None:
    board = tile(shapely.box(0, 0, 20, 20), shapely.box(20, 20, 40, 40))
    assert len(drawn(board, 160, 160).areas) == 32
    assert len(drawn(board, 160, 160, phase=(7, 3)).areas) == 16 * 2 + 8 + 1


@pytest.mark.parametrize("blunt", [False, True])
def test_what_closes_across_a_seam_and_touches_itself_is_a_hole(blunt: bool) -> None:
    """A ring round (0, 20) whose right limb is pinched to a point; the seam x = 0 parts it in three.

    The point of the limb's upper half meets the point of the lower, or an edge of it.
    """
    upper = shapely.Polygon([(0, 26), (6, 26), (9, 20), (12, 26), (12, 32), (0, 32)])
    tip = [(6, 20), (12, 20)] if blunt else [(9, 20)]
    lower = shapely.Polygon([(0, 14), (6, 14), *tip, (12, 14), (12, 8), (0, 8)])
    left = shapely.difference(shapely.box(28, 8, 40, 32), shapely.box(34, 14, 40, 26))
    layer = drawn(tile(upper, lower, left), 40, 40, phase=(20, 0))
    (ring,) = layer.areas
    assert len(ring.interiors) == 1
    assert ring.exterior.intersection(ring.interiors[0]).coords[:] == [(29, 20)]


def test_holes_that_touch_are_two() -> None:
    holes = shapely.union_all([shapely.box(-10, 10, 0, 20), shapely.box(0, 20, 10, 30)])
    cut = [shapely.affinity.translate(holes, dx) for dx in (0, 40)]
    board = tile(shapely.difference(shapely.box(0, 0, 40, 40), shapely.union_all(cut)))
    layer = drawn(board, 120, 40, phase=(20, 0))
    assert len(layer.areas) == 1
    assert len(layer.areas[0].interiors) == 6


@pytest.mark.parametrize("axis", list(DropAxis))
def test_drops_are_followed(axis: DropAxis) -> None:
    dropped = tile(disc(20, 20, 8), size=(40_000, 40_000), drop=Fraction(1, 4), axis=axis)
    page = cloth(dropped, 170, 170, phase=(5, 9))
    middles = shapely.get_coordinates(shapely.centroid(collected(page).layers[0].areas))
    full = middles[np.isclose(shapely.area(collected(page).layers[0].areas), disc(0, 0, 8).area, atol=0.1)]
    along, across = (0, 1) if axis == DropAxis.COLUMN else (1, 0)
    column = np.rint((full[:, along] - 20 - (5, 9)[along]) / 40)
    assert np.allclose((full[:, across] - 20 - (5, 9)[across] - 10 * column) % 40 % 39.999, 0, atol=0.01)
    assert len(full) >= 12


def test_whole_edges_cut_no_mark_and_leave_out_whole_motifs() -> None:
    petals = [disc(20 + 6 * np.cos(a), 20 + 6 * np.sin(a), 2) for a in np.arange(6) * np.pi / 3]
    names = ("flower.core", *["flower.petal"] * 6, "seed.dot")
    flowers = tile(disc(20, 20, 3), *petals, disc(2, 2, 1), names=names)
    cut = drawn(flowers, 106, 106)
    layer = drawn(flowers, 106, 106, edge="whole")
    sizes = sorted(set(np.round(shapely.area(flowers.layers[0].areas), 3)))
    assert len(set(np.round(shapely.area(cut.areas), 3))) > len(sizes)
    assert sorted(set(np.round(shapely.area(layer.areas), 3))) == sizes
    counts = {name: layer.area_names.count(name) for name in set(layer.area_names)}
    # At 106 mm petals of the third row of flowers are cut, but not their cores, nor the dots at 82 mm.
    assert counts == {"flower.core": 4, "flower.petal": 24, "seed.dot": 9}


@pytest.mark.parametrize(
    ("size", "ring", "petals"),
    [
        # A core too far from its petals for their own size; copies closer to each other than to their cores;
        # and petals far apart.
        (32, 10, 8),
        (28, 10, 8),
        (64, 16, 5),
    ],
)
def test_whole_edges_keep_petals_and_core_together(size: int, ring: float, petals: int) -> None:
    angles = np.arange(petals) * 2 * np.pi / petals
    discs = [disc(9 + ring * np.cos(a), 11 + ring * np.sin(a), 3) for a in angles]
    flower = tile(disc(9, 11, 4), *discs, size=(size * 1000,) * 2, names=("fl.core", *["fl.petal"] * petals))
    layer = drawn(flower, 150, 150, edge="whole")
    counts = [layer.area_names.count(name) for name in ("fl.core", "fl.petal")]
    assert counts[0] > 0
    assert counts[1] == petals * counts[0]


def test_whole_edges_keep_a_core_without_counts_by_its_distance() -> None:
    angles = np.arange(8) * np.pi / 4
    petals = [disc(16 + 10 * np.cos(a), 16 + 10 * np.sin(a), 3) for a in angles]
    # Three cores tell nothing of eight petals.
    cores = [disc(16, 16, 4), disc(16, 20.6, 0.4), disc(16, 11.4, 0.4)]
    names = ("fl.petal",) * 8 + ("fl.core",) * 3
    layer = drawn(tile(*petals, *cores, size=(40_000, 40_000), names=names), 150, 90, edge="whole")
    assert layer.area_names.count("fl.petal") * 3 == layer.area_names.count("fl.core") * 8


def test_whole_edges_still_cut_what_is_endless() -> None:
    layer = drawn(BARS, 100, 55, edge="whole")
    assert shapely.bounds(layer.areas).tolist() == [[0, 10, 100, 20], [0, 50, 100, 55]]


def test_bleed_reaches_beyond_the_printed_area() -> None:
    page = cloth(BARS, 100, 55, edge="bleed", bleed=3)
    found = collected(page)
    assert (page.bleed, page.margins.left, page.margins.top) == (3.0, 3000, 3000)
    assert violations(found) == []
    assert shapely.total_bounds(found.layers[0].areas).tolist() == [-3, 10, 103, 58]


def test_a_cloth_without_length_is_one_repeat_long() -> None:
    page = compile_yardage(BARS, YardageSpec(width=70))
    assert (page.cell.width, page.cell.height) == (70, 40)
    dropped = replace(BARS, cell=Cell(40_000, 40_000, Fraction(1, 2), DropAxis.ROW))
    assert compile_yardage(dropped, YardageSpec(width=70)).cell.height == 80


def test_the_centre_of_the_cloth_is_the_centre_of_a_tile() -> None:
    layer = drawn(DISCS, 100, 60, align="centre")
    middles = shapely.get_coordinates(shapely.centroid(layer.areas[shapely.area(layer.areas) > 200]))
    assert [50, 30] in np.round(middles, 3).tolist()


def test_endless_lines_run_through_and_crossing_ones_go_straight_on() -> None:
    wave = shapely.LineString([(0, 10), (20, 14), (40, 10)])
    ends = [((0, 20), (20, 30)), ((20, 30), (40, 20)), ((0, 20), (20, 10)), ((20, 10), (40, 20))]
    lines = tile(lines=(wave, *map(shapely.LineString, ends)))
    named = replace(lines.layers[0], line_names=("wave", "cross", "cross", "cross", "cross"))
    layer = drawn(replace(lines, layers=(named,)), 400, 40)
    waves = [line for line, name in zip(layer.lines, layer.line_names, strict=True) if name == "wave"]
    assert len(waves) == 1
    assert waves[0].bounds == (0, 10, 400, 14)
    assert len(waves[0].coords) == 21
    crosses = [line for line, name in zip(layer.lines, layer.line_names, strict=True) if name == "cross"]
    # Two lines over each of nine seams, and the halves at both ends.
    assert len(crosses) == 2 * 9 + 4
    assert {len(line.coords) for line in crosses} == {2}


def test_a_straight_line_over_many_repeats_has_two_ends() -> None:
    layer = drawn(tile(lines=(shapely.LineString([(0, 10), (40, 10)]),)), 400, 40)
    assert [list(line.coords) for line in layer.lines] == [[(0, 10), (400, 10)]]


def test_lines_come_in_pieces_too() -> None:
    lines = tile(lines=tuple(shapely.LineString([(0, y), (20, y + 0.5), (40, y)]) for y in range(1, 39)))
    page = cloth(lines, 300, 300, piece=200)
    pieces = list(page.lines(0))
    assert len(pieces) > 10
    assert violations(collected(page)) == []
    assert sum(len(piece) for piece in pieces) == len(collected(cloth(lines, 300, 300)).layers[0].lines)


@dataclass
class Frame:
    layers: tuple[Layer, ...]
    window: tuple[float, float, float, float]
    shape: shapely.Polygon


def framed(inner: shapely.Polygon, ink: str = "wax", apart: float = 0.0) -> Frame:
    """A border round a shape; at rounded corners it may stand apart from it by less than the tolerance."""
    away = shapely.intersection(shapely.box(*inner.bounds), inner.buffer(apart, join_style="mitre"))
    band = shapely.difference(shapely.box(0, 0, 200, 160), away)
    layer = Layer(Ink(ink, "#ffffff"), shapes(band), area_names=("border",))
    return Frame((layer,), inner.bounds, shapes(inner)[0])


@pytest.mark.parametrize(("radius", "apart"), [(0.0, 0.0), (15.0, 0.0), (15.0, 0.01)])
def test_borders_of_one_ink_are_welded_with_the_field(radius: float, apart: float) -> None:
    inner = shapely.box(30 + radius, 30 + radius, 170 - radius, 130 - radius).buffer(radius)
    spec = YardageSpec(width=200, length=160)
    # The lowest and the highest bar end at rounded corners.
    found = collected(compile_yardage(BARS, replace(spec, phase=(0, -5)), frame=framed(inner, "wax", apart)))
    assert violations(found) == []
    assert len(found.layers[0].areas) == 1
    assert len(found.layers[0].areas[0].interiors) == 4
    bars = shapely.union_all([shapely.box(30, 35 + 40 * k, 170, 45 + 40 * k) for k in range(3)])
    expected = 200 * 160 - inner.area + shapely.intersection(bars, inner).area
    assert found.layers[0].areas[0].area == pytest.approx(expected, abs=1)
    kept = collected(compile_yardage(BARS, spec, frame=framed(inner, "soga"), inks=["soga", "wax"]))
    assert [layer.ink.name for layer in kept.layers] == ["soga", "wax"]
    assert len(kept.layers[1].areas) == 3
    assert shapely.difference(kept.layers[1].areas, inner.buffer(0.01)).tolist() == [shapely.Polygon()] * 3


def test_a_cloth_of_borders_alone() -> None:
    bare = Artwork("t", Cell(200_000, 160_000), ())
    frame = framed(shapely.box(30, 30, 170, 130))
    found = collected(compile_yardage(bare, YardageSpec(width=200, length=160), frame=frame))
    assert [layer.areas[0].area for layer in found.layers] == [200 * 160 - 140 * 100]


def test_a_cloth_too_large_is_refused_with_its_estimate() -> None:
    spec = YardageSpec(width=1500, length=100_000)
    with pytest.raises(
        TooLargeError, match=r"about [\d,]+ vertices .*past the limit of 1,000: .* mm at most"
    ):
        compile_yardage(DISCS, replace(spec, limit=1000))


def test_what_makes_no_cloth_is_refused() -> None:
    with pytest.raises(GeometryError, match="width = 0"):
        YardageSpec(width=0)
    with pytest.raises(GeometryError, match="expected one of"):
        YardageSpec(width=100, edge="straight")  # type: ignore[arg-type]
    with pytest.raises(GeometryError, match="the tile has a bleed of 2 mm"):
        cloth(replace(DISCS, bleed=2.0), 100, 100)
    frame = Frame((), (60, 10, 50, 90), shapely.box(50, 10, 60, 90))
    with pytest.raises(GeometryError, match="leave no room"):
        compile_yardage(DISCS, YardageSpec(width=100, length=100), frame=frame)


def test_progress_is_told_band_by_band() -> None:
    told: list[str] = []
    spec = YardageSpec(width=200, length=2000)
    page = compile_yardage(DISCS, spec, piece=500, progress=told.append)
    list(page.areas(0))
    assert len(told) > 5
    assert told[-1] == "wax 100%"
