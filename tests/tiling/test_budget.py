"""What a tile and a cloth may cost, counted and not timed: vertices that go through GEOS, sorts, loops.

Rows are what was measured, as in tests/test_budget.py. What is alike must cost once, however often it
occurs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.work import SAMPLED_VERTICES
from batik_vector.recipe.loading import load_recipe
from batik_vector.recipe.model import Placement, Recipe
from batik_vector.recipe.motif import Flower, Motif
from batik_vector.tiling.cloth.spec import YardageSpec
from batik_vector.tiling.cloth.yardage import compile_yardage
from batik_vector.tiling.layouts import Julian
from batik_vector.tiling.symmetry.repeats import TileSpec
from batik_vector.tiling.welding.duplicates import drawn_once
from tests.budgets import (
    CLUSTER,
    DISC,
    RING_OF_GROUND,
    Budgets,
    Work,
    cold,
    counted,
    elements,
    peak_bytes,
    rows_of,
    steps_run,
)

BUDGETS = Budgets(
    {
        # Vertices that go through GEOS while samples/four-square.toml is compiled, of 13,481 in its tile.
        "four-square: united": 9755,
        "four-square: taken away from": 13368,
        "four-square: clipped": 1909,
        "four-square: grown": 2270,
        "four-square: tested for validity": 18260,
        "four-square: asked whether they meet": 100712,
        # Any number of marks that are cut alike: one mark and one cutter.
        "cut alike: taken away from": 70,
        # A mark on the edge comes by two translates.
        "clipped per vertex of a mark on the edge": 2,
        # Of the layout of four squares at level 4, against level 1: overlaps multiply, what is alike not.
        "level 4 against 1: all through GEOS": 1,
        "level 4 against 1, overlapping: united": 0.18,
        # Discs that all meet make up one net: of a small one every vertex is united once, and some vanish.
        "net: vertices united, per vertex left": 1.6,
        # Sides of squares, each drawn twice, joined end to end; and items in a chain.
        "joining: elements sorted per segment": 9.5,
        "joining: steps of our code": 13,
        "chain: steps of our code for each doubling": 4,
        # What drawing a cloth piece by piece costs, for each piece.
        "marks: steps of our code for a piece": 32,
        "marks on the seam: steps of our code for a piece": 33,
        "trellis: steps of our code for a piece": 13.7,
        "lines: steps of our code for a piece": 35.4,
        "endless lines: steps of our code for a piece": 151,
        # What a cloth sorts, for each point that is drawn; of marks, only those at its edge.
        "marks: elements sorted per point": 0.022,
        "marks on the seam: elements sorted per point": 0.032,
        "trellis: elements sorted per point": 0.51,
        "lines: elements sorted per point": 0.91,
        "endless lines: elements sorted per point": 18.3,
        # What Python and NumPy hold at most, whatever the cloth's length.
        "marks: bytes held per point of a piece": 68,
        "marks on the seam: bytes held per point of a piece": 72,
        "lines: bytes held per point of a piece": 291,
    }
)
pytestmark = pytest.mark.filterwarnings("always::tests.budgets.LooseBudgetWarning")

SAMPLE = Path(__file__).resolve().parents[2] / "samples" / "four-square.toml"
UNITED = (
    "union_all",
    "unary_union",
    "union",
    "coverage_union",
    "coverage_union_all",
    "disjoint_subset_union_all",
)
TAKEN_AWAY = "difference", "symmetric_difference"
CLIPPED = "intersection", "clip_by_rect"
VALID = "is_valid", "is_simple", "is_valid_reason"
MENDED = "make_valid", "set_precision", "node"
MEETING = "intersects", "relate_pattern", "touches", "overlaps", "crosses", "within", "contains", "covers"
DEAR = *UNITED, *TAKEN_AWAY, *CLIPPED, *VALID, *MENDED, *MEETING, "buffer", "line_merge", "polygonize"
"""What costs a hundred times what copying a vertex does."""
SORTS = [(np, name) for name in ("sort", "argsort", "lexsort", "unique", "searchsorted")]


@pytest.fixture(autouse=True)
def _cold() -> None:
    cold()


def compiled(recipe: Recipe) -> tuple[Work, Artwork]:
    """Return the work of a cold compilation, and what it made."""
    cold()
    with counted() as work:
        artwork = compile_recipe(recipe)
    return work, artwork


def test_the_sample_goes_through_geos_about_once() -> None:
    work, artwork = compiled(load_recipe(SAMPLE))
    BUDGETS.hold("four-square: united", work.given(*UNITED))
    BUDGETS.hold("four-square: taken away from", work.given(*TAKEN_AWAY))
    BUDGETS.hold("four-square: clipped", work.given(*CLIPPED))
    BUDGETS.hold("four-square: grown", work.given("buffer"))
    BUDGETS.hold("four-square: tested for validity", work.given(*VALID))
    BUDGETS.hold("four-square: asked whether they meet", work.given(*MEETING))
    assert work.given(*MENDED) <= artwork.vertex_count / 50


# What is alike


@pytest.mark.parametrize(
    "motifs",
    [(DISC,), (CLUSTER,), (DISC, RING_OF_GROUND), (CLUSTER, RING_OF_GROUND)],
    ids=["alone", "overlapping", "cut", "overlapping and cut"],
)
def test_a_thousand_congruent_marks_cost_what_ten_cost(motifs: Sequence[Motif]) -> None:
    few, many = (compiled(rows_of(*size, *motifs)) for size in ((2, 5), (20, 50)))
    assert many[1].vertex_count == 100 * few[1].vertex_count
    for name in DEAR:
        assert many[0].given(name) == few[0].given(name), name
    assert many[0].given(*DEAR) > 0


def test_nothing_is_united_where_nothing_overlaps_nor_clipped_inside_the_tile() -> None:
    work, artwork = compiled(rows_of(20, 20, DISC))
    assert len(artwork.layers[0].areas) == 400
    assert work.given(*UNITED, *TAKEN_AWAY, *CLIPPED, *MENDED, *MEETING, "buffer") == 0
    assert work.given(*VALID) <= 4 * shapely.get_num_coordinates(artwork.layers[0].areas[0])
    # It can fail: these do overlap.
    assert compiled(rows_of(20, 20, DISC, scale=5.3))[0].given(*UNITED) > 0


@pytest.mark.parametrize("columns", [2, 20])
def test_only_what_crosses_the_edge_is_clipped(columns: int) -> None:
    # Every other row is set off by half a step, so that one mark in it lies on the edge.
    work, artwork = compiled(rows_of(columns, 20, DISC, stagger=True))
    corners = shapely.get_num_coordinates(artwork.layers[0].areas).max()
    BUDGETS.hold("clipped per vertex of a mark on the edge", work.given(*CLIPPED) / (10 * corners))


@pytest.mark.parametrize("count", [4, 400])
def test_marks_that_are_cut_alike_are_cut_once(count: int) -> None:
    work, artwork = compiled(rows_of(count // 2, 2, DISC, RING_OF_GROUND))
    assert len(artwork.layers[0].areas) == 2 * count
    assert work.calls(*TAKEN_AWAY) == work.calls("buffer") == 1
    BUDGETS.hold("cut alike: taken away from", work.given(*TAKEN_AWAY))


def levels(shift: float) -> list[tuple[Work, Artwork]]:
    """Return the layout of four squares at level 1 and at level 4, which has 256 flowers on 25 places."""
    found = []
    for level in (1, 4):
        spread = Placement(motif="m", layout=Julian(level=level, shift=(shift, shift)), scale=59.0)
        tile = TileSpec(size=(960.0, 960.0))
        found.append(compiled(Recipe(motif={"m": Flower()}, place=(spread,), tile=tile, tolerance=0.02)))
    return found


def test_a_deep_level_of_a_layout_costs_geos_no_more_than_the_first() -> None:
    (first, small), (deep, large) = levels(4 / 3)
    assert large.vertex_count > 6 * small.vertex_count
    ratio = deep.given(*DEAR) / first.given(*DEAR)
    BUDGETS.hold("level 4 against 1: all through GEOS", ratio)


def test_a_deep_level_whose_flowers_overlap_unites_each_of_them_once() -> None:
    (first, small), (deep, large) = levels(1.1)
    assert large.vertex_count > 6 * small.vertex_count
    ratio = deep.given(*UNITED) / first.given(*UNITED)
    BUDGETS.hold("level 4 against 1, overlapping: united", ratio)
    # Crossings are counted on some pairs before anything is united.
    assert deep.given(*MEETING) <= first.given(*MEETING) + 2 * SAMPLED_VERTICES


def test_a_net_is_united_once() -> None:
    work, artwork = compiled(rows_of(8, 8, DISC, scale=5.3))
    assert len(artwork.layers[0].areas) == 1
    BUDGETS.hold("net: vertices united, per vertex left", work.given(*UNITED) / artwork.vertex_count)


def test_a_large_net_is_not_united_by_geos() -> None:
    work, artwork = compiled(rows_of(32, 32, DISC, scale=5.3))
    assert len(artwork.layers[0].areas) == 1
    assert not work.given(*UNITED)


# Lines


def sides(count: int) -> NDArray[np.object_]:
    """Return the sides of count × count squares, those between two squares twice, in no order."""
    x, y = np.divmod(np.arange(count * count), count)
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)])
    rings = 1000.0 * (np.column_stack([x, y])[:, None] + corners)
    found = np.stack([rings[:, :-1], rings[:, 1:]], axis=2).reshape(-1, 2, 2)
    return np.asarray(shapely.linestrings(np.random.default_rng(1).permutation(found)), dtype=object)


@pytest.mark.parametrize("count", [20, 80])
def test_joining_sorts_each_segment_a_few_times(count: int) -> None:
    lines = sides(count)
    names = np.zeros(len(lines), np.intp)
    with counted(SORTS, elements) as work:
        drawn_once(lines, names)
    BUDGETS.hold("joining: elements sorted per segment", work.given() / len(lines))
    BUDGETS.hold("joining: steps of our code", steps_run(partial(drawn_once, lines, names)))
    with counted() as geos:
        drawn_once(lines, names)
    assert geos.given("line_merge") <= 2 * len(lines)


def test_components_of_a_chain_are_found_in_rounds_that_grow_with_its_logarithm() -> None:
    spent = []
    for power in (6, 14):
        chain = np.random.default_rng(1).permutation(2**power)
        pairs = np.column_stack([chain[:-1], chain[1:]])
        spent.append(steps_run(partial(components, len(chain), pairs)))
    BUDGETS.hold("chain: steps of our code for each doubling", (spent[1] - spent[0]) / 8)


# Cloths


def tile(areas: Sequence[shapely.Geometry] = (), lines: Sequence[shapely.Geometry] = ()) -> Artwork:
    """Return a tile in one ink, 40 mm square."""
    layer = Layer(Ink("wax", "#ffffff"), on_grid(areas), on_grid(lines))
    return Artwork("t", Cell(40_000, 40_000), (layer,))


def on_grid(marks: Sequence[shapely.Geometry]) -> NDArray[np.object_]:
    found = np.empty(len(marks), dtype=object)
    found[:] = marks
    return np.asarray(shapely.transform(shapely.orient_polygons(found), lambda xy: np.rint(xy * 1000) / 1000))


def disc(x: float, y: float, radius: float) -> shapely.Polygon:
    return shapely.Point(x, y).buffer(radius)


CELL = shapely.box(0, 0, 40, 40)
CLOTHS = {
    "marks": tile([disc(20, 20, 8)]),
    "marks on the seam": tile(
        [shapely.intersection(disc(x, y, 8), CELL) for x in (0, 40) for y in (0, 40)] + [disc(20, 20, 5)]
    ),
    "trellis": tile(
        [shapely.difference(CELL, shapely.MultiPolygon([disc(x, y, 8) for x in (10, 30) for y in (10, 30)]))]
    ),
    "lines": tile(lines=[shapely.LineString([(3, y), (20, y + 0.5), (38, y)]) for y in range(1, 39)]),
    "endless lines": tile(lines=[shapely.LineString([(0, y), (20, y + 0.5), (40, y)]) for y in range(1, 39)]),
}
cloths = pytest.mark.parametrize("name", CLOTHS)


def drawn(artwork: Artwork, repeats: int, piece: int = 10**6) -> Callable[[], tuple[int, int]]:
    """Return what draws a cloth and tells how many pieces it came in, and how many points."""

    def draw() -> tuple[int, int]:
        spec = YardageSpec(width=40 * 5 + 13, length=40 * repeats + 7)
        page = compile_yardage(artwork, spec, piece=piece)
        sizes = [len(each.points) for pieces in (page.areas(0), page.lines(0)) for each in pieces]
        return len(sizes), sum(sizes)

    return draw


@cloths
def test_a_longer_cloth_costs_geos_no_more(name: str) -> None:
    spent = []
    for repeats in (4, 32):
        with counted() as work:
            _, points = drawn(CLOTHS[name], repeats)()
        spent.append(work)
        assert points > 4 * repeats
    assert spent[0].calls() == spent[1].calls()
    for each in DEAR:
        assert spent[0].given(each) == spent[1].given(each), each


@cloths
def test_a_cloth_runs_lines_of_code_for_its_pieces_and_not_for_its_marks(name: str) -> None:
    short, long = (drawn(CLOTHS[name], repeats) for repeats in (4, 32))
    # What is worked out once in a process is worked out here.
    long()
    assert steps_run(long) <= steps_run(short) * 1.05
    pieces, _ = drawn(CLOTHS[name], 32, 1000)()
    assert pieces > 5
    more = steps_run(drawn(CLOTHS[name], 32, 1000)) - steps_run(long)
    BUDGETS.hold(f"{name}: steps of our code for a piece", more / pieces)


@cloths
def test_a_cloth_sorts_each_point_a_few_times(name: str) -> None:
    with counted(SORTS, elements) as work:
        _, points = drawn(CLOTHS[name], 32)()
    BUDGETS.hold(f"{name}: elements sorted per point", work.given() / points)


@pytest.mark.parametrize("name", ["marks", "marks on the seam", "lines"])
def test_what_is_held_goes_with_a_piece_and_not_with_the_cloth(name: str) -> None:
    # The first is not counted: it holds what is imported and made once.
    _, short, long = (peak_bytes(drawn(CLOTHS[name], repeats, 2000)) for repeats in (8, 16, 64))
    BUDGETS.hold(f"{name}: bytes held per point of a piece", long / 2000)
    # Four times as long; what its edge cuts is gathered first, and grows with it.
    assert long <= 2 * short
