"""What a compilation may spend, counted and not timed: reading, drawing, placing, and all of it together.

A row of the table is what was measured when it was written, and 1.3 times as much is allowed. A test that
fails says what was spent. One that warns spends so much less that its row guards nothing: lower it.
The tile's own work stands in tests/tiling/test_budget.py, the writers' in tests/export/test_budget.py.
"""

from __future__ import annotations

import typing
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from batik_vector import fields
from batik_vector.artwork import Artwork, Ink
from batik_vector.compiling import placements
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.compiling.placements import place
from batik_vector.export import write_artwork
from batik_vector.fields import fitting
from batik_vector.geometry.curves import CURVES, Curve, trace
from batik_vector.geometry.curves.base import Outlined
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.recipe import figures
from batik_vector.recipe.loading import load_recipe, read_recipe
from batik_vector.recipe.model import Placement, Recipe
from batik_vector.recipe.motif import Flower, Motif
from batik_vector.recipe.reading import field_types
from batik_vector.tiling.layouts import Julian, Lattice, Layout, Ring
from batik_vector.tiling.symmetry.repeats import TileSpec
from tests.budgets import (
    CLUSTER,
    DISC,
    Budgets,
    LooseBudgetWarning,
    cold,
    counted,
    elements,
    peak_bytes,
    rows_of,
    steps_run,
)

BUDGETS = Budgets(
    {
        # Reading samples/four-square.toml.
        "types resolved from annotations, first reading": 67,
        "steps of our code for each placement read": 124,
        # Points of a curve evaluated for each vertex drawn: a polyline seven times as dense is thinned, and
        # each of its chords was probed in three places, in rounds.
        "evaluations per vertex, superellipse": 59,
        "evaluations per vertex, rose": 31,  # of one arc, which stands for all
        "evaluations per vertex, petal": 52,
        "evaluations per vertex, hypocycloid": 12,
        "evaluations per vertex, circle": 72,
        "evaluations per vertex, blade": 90,
        "evaluations per vertex, butterfly": 81,
        "evaluations per vertex, polygon": 154,  # of four vertices, where there were eight
        "evaluations per vertex, star": 38,
        "evaluations per vertex, polar": 70,
        "evaluations per vertex, parametric": 84,
        "evaluations per vertex, spiral": 58,
        "evaluations per vertex, segment": 81,
        "evaluations per vertex, wave": 50,
        "evaluations per vertex, fourier": 88,
        "evaluations per vertex, attractor": 115,
        "evaluations per vertex, bent layout": 23,
        # Placing ten thousand copies; then the images of a symmetry, of which the same are sorted out.
        "shapely calls for a placement": 63,
        "steps of our code for each image of a symmetry": 1.5,
        # Where two copies or four are one another's images on the grid, each such group is landed by itself.
        "shapely calls for each copy, two turned alike": 5.75,
        # Compiling samples/four-square.toml.
        "curves traced, cold": 12,
        "shapely calls, cold": 788,
        "shapely calls, a petal longer": 312,
        "shapely calls, the same recipe again": 81,
        # What Python and NumPy hold at most, at 10^5 vertices.
        "bytes per vertex, compiling": 36,
        "bytes per vertex, compiling a net": 102,
        "bytes per vertex, writing SVG": 42,
        "bytes per vertex, writing PDF": 46,
        "bytes per vertex, writing DXF": 90,  # up to a million are brought into order together
    }
)
pytestmark = pytest.mark.filterwarnings("always::tests.budgets.LooseBudgetWarning")

FORETOLD = 16
"""Calls by which the work of many shapes is foretold, where that of a few need not be."""

SAMPLE = Path(__file__).resolve().parents[2] / "samples" / "four-square.toml"
CURVE_AT = [
    (home, "at")
    for home in dict.fromkeys(home for curve in CURVES.values() for home in curve.__mro__)
    if "at" in vars(home) and home is not Curve
]
TRACED, SET_DOWN = (figures, "trace"), (placements, "set_down")


@pytest.fixture(autouse=True)
def _cold() -> None:
    cold()


def sample(*settings: str) -> Recipe:
    return load_recipe(SAMPLE, settings)


def test_a_budget_fails_where_more_is_spent_and_tells_where_it_is_idle() -> None:
    table = Budgets({"calls": 100})
    table.hold("calls", 130)
    with pytest.raises(AssertionError, match="calls: 131 spent, 130 allowed, 100 when the row was written"):
        table.hold("calls", 131)
    with pytest.warns(LooseBudgetWarning, match="calls: 69 spent, the row says 100"):
        table.hold("calls", 69)


# Reading


def test_annotations_are_resolved_once_and_only_those_a_recipe_needs() -> None:
    for cache in (field_types.members, fields.hint_of, fitting._quick):
        cache.cache_clear()
    with counted([(typing, "get_type_hints")]) as first:
        sample()
    with counted([(typing, "get_type_hints")]) as again:
        sample()
    BUDGETS.hold("types resolved from annotations, first reading", first.calls())
    assert again.calls() == 0


def test_reading_goes_with_the_length_of_a_recipe() -> None:
    text = SAMPLE.read_text(encoding="utf-8")
    # Each is another, for what is read again is remembered.
    layout = 'layout = {{ kind = "lattice", rows = {} }}'
    more = f'[[place]]\nmotif = "knot"\n{layout}\nscale = "60 mm"\nink = "wax"\n'
    read_recipe(text)
    cold()
    once = steps_run(partial(read_recipe, text))
    for count in (10, 100):
        places = "".join(more.format(count + number) for number in range(count))
        longer = text.replace("[tile]", places + "[tile]")
        cold()
        spent = steps_run(partial(read_recipe, longer)) - once
        BUDGETS.hold("steps of our code for each placement read", spent / count)


# Drawing


@pytest.mark.parametrize("name", [name for name, cls in CURVES.items() if not issubclass(cls, Outlined)])
def test_a_curve_is_evaluated_a_few_times_for_each_vertex(name: str) -> None:
    with counted(CURVE_AT, elements) as work:
        traced = trace(CURVES[name](), 1e-3)
    vertices = sum(len(strand) for strand in traced.strands)
    BUDGETS.hold(f"evaluations per vertex, {name}", work.given() / vertices)


def test_a_bent_layout_evaluates_its_map_a_few_times_for_each_vertex() -> None:
    bent = Placement(motif="m", layout=Julian(dist=4 * 0.618, level=1), scale=40.0)
    recipe = Recipe(motif={"m": Flower()}, place=(bent,), tile=TileSpec(size=(320.0, 320.0)), tolerance=0.02)
    with counted([(FlameMap, "core")], lambda flame, z, *rest: z.size) as work:
        artwork = compile_recipe(recipe)
    BUDGETS.hold("evaluations per vertex, bent layout", work.given() / artwork.vertex_count)


def test_each_curve_is_traced_once_and_a_recipe_that_is_unchanged_draws_nothing() -> None:
    recipe = sample()
    with counted([TRACED]) as work:
        compile_recipe(recipe)
    BUDGETS.hold("curves traced, cold", work.calls())
    with counted([TRACED, SET_DOWN]) as work:
        compile_recipe(sample())
    assert work.calls() == 0


@pytest.mark.parametrize(
    ("setting", "curves", "placements"),
    [
        ("motif.flower.petal.length=0.97", 1, 1),
        ("motif.flower.pistil.length=0.75", 1, 1),
        ("motif.bud.core.length=0.2", 1, 1),
        ("place[0].turn=1", 0, 1),
        ("place[2].at=['3 mm', '0 mm']", 0, 1),
        ("ink.wax.colour='#fff'", 0, 5),
        ("ink.wax.width='1.5 mm'", 0, 5),
        ("tile.repeat='half-drop'", 0, 5),
        ("title='the same'", 0, 0),
    ],
)
def test_who_turns_one_knob_draws_again_what_hangs_on_it(setting: str, curves: int, placements: int) -> None:
    compile_recipe(sample())
    with counted([TRACED, SET_DOWN]) as work:
        compile_recipe(sample(setting))
    assert work.calls("trace") <= curves
    assert work.calls("set_down") <= placements


def test_deeper_levels_of_a_layout_evaluate_no_more_points_of_a_curve() -> None:
    spent = []
    for level in (1, 4):
        cold()
        spread = Placement(motif="m", layout=Julian(level=level), scale=59.0)
        recipe = Recipe(motif={"m": Flower()}, place=(spread,), tile=TileSpec(size=(960.0, 960.0)))
        with counted(CURVE_AT, elements) as work:
            compile_recipe(recipe)
        spent.append(work.given())
    assert spent[0] == spent[1] > 0


# Placing


def placed(layout: Callable[[int], Layout], side: int, **more: object) -> Callable[[], object]:
    """Return what places a motif by a layout of side × side copies."""
    recipe = rows_of(side, side, CLUSTER)
    placement = Placement(motif="m0", layout=layout(side), scale=2.0, **more)  # type: ignore[arg-type]
    orbit = recipe.tiling.orbit(placement.symmetry, placement.phase, placement.spread)
    inks = {"wax": Ink("wax", "#ffffff")}

    def again() -> object:
        cold()
        return place(placement, recipe, recipe.tiling.unit(), inks, 10**9, orbit)

    return again


def lattice(side: int) -> Layout:
    return Lattice(columns=side, rows=side)


def staggered(side: int) -> Layout:
    return Lattice(columns=side, rows=side, stagger=True)


@pytest.mark.parametrize("layout", [lattice, staggered])
def test_a_hundred_copies_and_ten_thousand_are_set_down_by_the_same_calls(
    layout: Callable[[int], Layout],
) -> None:
    few, many = placed(layout, 10), placed(layout, 100)
    few()
    with counted() as one:
        few()
    with counted() as other:
        many()
    assert other.calls() == one.calls()
    assert steps_run(many) <= steps_run(few) + 5
    BUDGETS.hold("shapely calls for a placement", other.calls())


def test_images_under_a_symmetry_are_set_down_by_the_same_calls() -> None:
    few, many = placed(lattice, 10, symmetry="p4m"), placed(lattice, 40, symmetry="p4m")
    few()
    with counted() as one:
        few()
    with counted() as other:
        many()
    assert other.calls() == one.calls()
    images = 8 * (40**2 - 10**2)
    BUDGETS.hold(
        "steps of our code for each image of a symmetry", (steps_run(many) - steps_run(few)) / images
    )


# All together


def test_a_compilation_calls_shapely_in_bulk() -> None:
    for what, settings in (
        ("shapely calls, cold", ()),
        ("shapely calls, the same recipe again", ()),
        ("shapely calls, a petal longer", ("motif.flower.petal.length=0.97",)),
    ):
        recipe = sample(*settings)
        with counted() as work:
            compile_recipe(recipe)
        BUDGETS.hold(what, work.calls())


@pytest.mark.parametrize("motifs", [(DISC,), (CLUSTER,), (DISC, CLUSTER)], ids=["discs", "clusters", "both"])
def test_a_page_a_hundred_times_as_large_is_compiled_by_the_same_calls(motifs: tuple[Motif, ...]) -> None:
    calls, steps = [], []
    for side in (4, 40):
        recipe = rows_of(side, side, *motifs)
        compile_recipe(recipe)
        cold()
        with counted() as work:
            artwork = compile_recipe(recipe)
        calls.append(work.calls())
        cold()
        steps.append(steps_run(partial(compile_recipe, recipe)))
    assert calls[0] <= calls[1] <= calls[0] + FORETOLD
    assert len(artwork.layers[0].areas) >= 1600
    assert steps[1] <= steps[0] + 20


def in_a_ring(count: int, turn: float) -> int:
    """Return how many calls of shapely it takes to compile copies in a ring, none of which meet."""
    ring = Placement(motif="m0", layout=Ring(count=count, radius=800.0, turn=turn), scale=0.5)
    recipe = replace(rows_of(100, 100, CLUSTER), place=(ring,))
    compile_recipe(recipe)
    cold()
    with counted() as work:
        artwork = compile_recipe(recipe)
    assert len(artwork.layers[0].areas) == count
    return work.calls()


def test_copies_that_are_all_different_are_compiled_by_the_same_calls() -> None:
    # The bounds of fewer are compared without a tree.
    few = in_a_ring(551, 0.123)
    assert few <= in_a_ring(901, 0.123) <= few + FORETOLD


def test_each_way_of_being_turned_costs_a_few_calls() -> None:
    spent = in_a_ring(900, 0.0) - in_a_ring(100, 0.0)
    BUDGETS.hold("shapely calls for each copy, two turned alike", spent / 800)


# Memory


def held(recipe: Recipe) -> tuple[Artwork, float]:
    """Return an artwork, and how many bytes for each vertex its compilation held at most."""
    compile_recipe(recipe)
    cold()
    made = list[Artwork]()
    peak = peak_bytes(lambda: made.append(compile_recipe(recipe)))
    return made[0], peak / made[0].vertex_count


def test_what_is_held_goes_with_the_vertices(tmp_path: Path) -> None:
    artwork, compiling = held(replace(rows_of(80, 40, DISC), tolerance=0.005))
    assert 100_000 < artwork.vertex_count < 200_000
    BUDGETS.hold("bytes per vertex, compiling", compiling)
    small = compile_recipe(rows_of(1, 1, DISC))
    for format_ in ("svg", "pdf", "dxf"):
        # What is imported and made once is there before.
        write_artwork(small, tmp_path / f"small.{format_}")
        peak = peak_bytes(partial(write_artwork, artwork, tmp_path / f"large.{format_}"))
        BUDGETS.hold(f"bytes per vertex, writing {format_.upper()}", peak / artwork.vertex_count)


def test_what_is_held_while_a_net_is_welded_goes_with_its_vertices() -> None:
    artwork, net = held(rows_of(40, 40, DISC, scale=5.3))
    assert artwork.vertex_count > 40_000
    BUDGETS.hold("bytes per vertex, compiling a net", net)
