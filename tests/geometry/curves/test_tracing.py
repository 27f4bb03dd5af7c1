"""Curves of one's own are traced as they run: closed by a straight edge, never led across a jump."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector import Element, InkSpec, Placement, Recipe, Rosette, TileSpec, compile_recipe, violations
from batik_vector.errors import GeometryError, RecipeError
from batik_vector.geometry.curves import Curve, FunctionCurve, Polygon, Rose, Star, Superellipse, trace
from batik_vector.tiling.layouts import (
    Free,
    Julian,
    Layout,
    MapSpec,
    Ring,
    RosetteLayout,
    Single,
    Spot,
    System,
)
from batik_vector.values import frozen
from tests.thorough import examples, long


@frozen
class Half(Curve):
    """Half a circle, which the chord closes."""

    part: float = 0.5

    def at(self, t: np.ndarray) -> np.ndarray:
        angle = 2 * np.pi * self.part * t
        return np.column_stack([np.cos(angle), np.sin(angle)])


ALONE = Single()


def recipe_of(curve: Curve, layout: Layout = ALONE, **element: Any) -> Recipe:
    motif = Rosette(elements=(Element(curve=curve, **element),))
    place = Placement(motif="m", layout=layout, width=100.0)
    return Recipe(
        motif={"m": motif}, place=(place,), tile=TileSpec(size=(200.0, 200.0)), ink={"wax": InkSpec()}
    )


def corners(areas: np.ndarray) -> list[int]:
    return [int(count) - 1 for count in shapely.get_num_coordinates(shapely.get_rings(areas))]


# Closing


@pytest.mark.parametrize("tolerance", [1e-4, 1e-2, 0.3, 5.0])
def test_a_curve_that_does_not_close_itself_is_closed_by_a_straight_edge(tolerance: float) -> None:
    traced = trace(Half(), tolerance)
    (ring,) = traced.rings
    assert np.array_equal(ring, traced.strands[0])
    assert np.array_equal(ring[0], ring[-1])
    assert ring[0].tolist() == [1.0, 0.0]
    assert ring[-2] == pytest.approx([-1.0, 0.0])
    on_chord = np.abs(ring[:, 1]) < 1e-9
    assert on_chord.sum() == 3, "a vertex within the straight edge"
    assert shapely.Polygon(ring).area == pytest.approx(math.pi / 2, abs=math.pi * min(tolerance, 0.1))


def test_the_straight_edge_reaches_the_artwork() -> None:
    areas = compile_recipe(recipe_of(Half())).layers[0].areas
    assert shapely.area(areas).sum() == pytest.approx(math.pi / 2 * 50**2, rel=1e-3)
    floor = shapely.get_coordinates(areas)[:, 1].min()
    assert (shapely.get_coordinates(areas[:1])[:-1, 1] == floor).sum() == 2


@pytest.mark.parametrize("gap", [1e-3, 1e-5, 1e-8, 1e-10, 1e-14])
@pytest.mark.parametrize("treatment", ["area", "line", "stroke", "both"])
def test_ends_that_all_but_meet_make_a_clean_mark(gap: float, treatment: str) -> None:
    recipe = recipe_of(Half(1 - gap), treatment=treatment)
    artwork = compile_recipe(recipe)
    assert violations(artwork) == []
    for area in artwork.layers[0].areas:
        assert treatment == "stroke" or area.area == pytest.approx(math.pi * 50**2, rel=2e-3)


@long
@settings(max_examples=examples(20, 500))
@given(st.floats(0.02, 0.98), st.floats(1e-4, 0.3))
def test_any_part_of_a_circle_has_the_area_of_its_segment(part: float, tolerance: float) -> None:
    angle = 2 * math.pi * part
    (ring,) = trace(Half(part), tolerance).rings
    assert shapely.Polygon(ring).area == pytest.approx(
        abs(angle - math.sin(angle)) / 2, abs=tolerance * angle
    )


def test_an_open_curve_stays_open() -> None:
    @frozen
    class Arc(Half):
        closed: ClassVar[bool] = False

    traced = trace(Arc(), 1e-3)
    assert traced.rings == []
    assert not np.array_equal(traced.strands[0][0], traced.strands[0][-1])


# Straight edges


STRAIGHT: list[tuple[Curve, int]] = [
    (Polygon(3), 3),
    (Polygon(4), 4),
    (Polygon(5), 5),
    (Polygon(17), 17),
    (Star(5), 10),
    (Star(2), 4),
    (Star(3, 1, 0.5), 3),
    (Star(4, 1, math.sqrt(0.5)), 4),
    (Superellipse(2, 2, 1, 0.3), 4),
]


@pytest.mark.parametrize("tolerance", [1e-5, 1e-2, 0.5, 20.0])
@pytest.mark.parametrize(("curve", "sides"), STRAIGHT, ids=str)
def test_a_figure_of_straight_sides_has_its_corners_and_no_more(
    curve: Curve, sides: int, tolerance: float
) -> None:
    traced = trace(curve, tolerance)
    assert [len(ring) - 1 for ring in traced.rings] == [sides]
    assert [len(strand) - 1 for strand in traced.strands] == [sides]


def spiralled(t: np.ndarray, begin: float) -> np.ndarray:
    """Round the unit square, from anywhere on its edge."""
    side = ((t + begin) % 1) * 4
    x, y = [0, 1, 1, 0, 0], [0, 0, 1, 1, 0]
    return np.column_stack([np.interp(side, range(5), x), np.interp(side, range(5), y)])


@pytest.mark.parametrize("begin", [0.0, 0.1, 0.25, 0.6, 0.99])
def test_no_vertex_stays_where_a_curve_begins_within_an_edge(begin: float) -> None:
    stops = sorted({round((k / 4 - begin) % 1, 9) for k in range(4)} - {0.0})
    curve = FunctionCurve(lambda t: spiralled(t, begin), tuple(stops))
    traced = trace(curve, 1e-3)
    assert len(traced.rings[0]) == len(traced.strands[0]) == 5
    assert shapely.Polygon(traced.rings[0]).area == pytest.approx(1)


def test_a_rest_on_the_way_costs_no_corner() -> None:
    def at(t: np.ndarray) -> np.ndarray:
        return spiralled(np.interp(t, [0, 0.2, 0.4, 1], [0, 0.25, 0.25, 1]), 0.0)

    (ring,) = trace(FunctionCurve(at, (0.2, 0.4, 0.6, 0.8)), 1e-3).rings
    assert len(ring) == 5
    assert shapely.Polygon(ring).area == pytest.approx(1)


LAYOUTS: list[Layout] = [
    Ring(count=7, radius=3.0),
    RosetteLayout(group="D6", shift=(6.0, 1.6)),
    Free(spots=(Spot(turn=33.0), Spot(matrix=(1.0, 0.4, -0.2, 0.7, 3.0, 0.1)))),
    System(
        maps=(MapSpec(pre=Spot(shift=(0.5, 0.2), turn=11.0, scale=0.4)), MapSpec(post=Spot(shift=(-3, 0))))
    ),
]


@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: type(layout).__name__)
@pytest.mark.parametrize("sides", [3, 4, 5])
def test_copies_of_a_polygon_have_as_many_vertices_as_it_has_corners(sides: int, layout: Layout) -> None:
    areas = compile_recipe(recipe_of(Polygon(sides), layout, spin=7.0)).layers[0].areas
    assert set(corners(areas)) == {sides}


@pytest.mark.parametrize("treatment", ["line", "both"])
def test_outlines_of_polygons_have_as_many_vertices_too(treatment: str) -> None:
    (layer,) = compile_recipe(recipe_of(Polygon(4), treatment=treatment, contours=3)).layers
    assert set(shapely.get_num_coordinates(layer.lines) - 1) == {4}
    assert set(corners(layer.areas)) <= {4}


def test_a_map_that_bends_gives_straight_edges_the_vertices_they_need() -> None:
    bend = Julian(power=4, dist=1.5, level=1)
    coarse, fine = (
        compile_recipe(replace(recipe_of(Polygon(4), bend), tolerance=tolerance)).layers[0].areas
        for tolerance in (0.02, 0.002)
    )
    assert min(corners(coarse)) > 8
    apart = [shapely.hausdorff_distance(*pair, densify=0.05) for pair in zip(coarse, fine, strict=True)]
    assert max(apart) < 0.025


def test_the_chord_that_closes_a_curve_is_bent_like_any_other_edge() -> None:
    bend = Julian(power=4, dist=1.5, level=1)
    by_hand = FunctionCurve(
        lambda t: np.where(
            t[:, None] < 0.5,
            Half().at(np.minimum(2 * t, 1.0)),
            np.column_stack([np.interp(t, [0.5, 1], [-1, 1]), 0 * t]),
        ),
        (0.5,),
    )
    ours, known = (
        shapely.area(compile_recipe(recipe_of(c, bend)).layers[0].areas) for c in (Half(), by_hand)
    )
    assert np.sort(ours) == pytest.approx(np.sort(known), rel=1e-3)


# What is refused


def circle(t: np.ndarray) -> np.ndarray:
    return np.column_stack([np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)])


Function = Callable[[np.ndarray], Any]

REFUSED: dict[str, tuple[Function, str]] = {
    "one jump": (
        lambda t: circle(t) + np.where(t > 1 / 3, 0.01, 0)[:, None],
        r"jumps from .* at t = 0\.333333",
    ),
    "there and back": (lambda t: circle(t) + np.where((t > 0.3) & (t < 0.6), 5, 0)[:, None], "jumps from"),
    "two pieces": (lambda t: circle(2 * t % 1) + np.where(t >= 0.5, 3, 0)[:, None], "jumps from"),
    "a jump along the line": (lambda t: np.column_stack([t + (t > 0.7), 0 * t]), "jumps from"),
    "axes the wrong way round": (lambda t: circle(t).T, r"returns shape \(2, \d+\) .* expected \(\d+, 2\)"),
    "three axes": (lambda t: np.column_stack([circle(t), t]), r"returns shape \(\d+, 3\)"),
    "one point": (lambda t: np.array([1.0, 2.0]), r"returns shape \(2,\)"),
    "complex": (lambda t: np.exp(2j * np.pi * t), "returns complex128, expected an array of real numbers"),
    "text": (lambda t: [["a", "b"]] * len(t), "returns list, expected an array of real numbers"),
    "nothing": (lambda t: None, "returns NoneType, expected an array of real numbers"),
    "ragged": (lambda t: [[1.0, 2.0], [3.0]], "returns rows of different lengths"),
    "infinite": (lambda t: circle(t) / (t - 0.5)[:, None], "is not finite at t = 0.5"),
    "no number": (lambda t: np.where(t[:, None] > 0.8, np.nan, circle(t)), "is not finite at t = 0.8"),
    "always the same": (lambda t: np.ones((len(t), 2)), "the same point for every t"),
}


@pytest.mark.filterwarnings("ignore:(divide by zero|invalid value):RuntimeWarning")
@pytest.mark.parametrize(("function", "words"), REFUSED.values(), ids=REFUSED)
@pytest.mark.parametrize("closed", [True, False])
def test_what_is_no_curve_is_refused_in_the_name_of_its_class(
    function: Function, words: str, closed: bool
) -> None:
    with pytest.raises(GeometryError, match=f"^FunctionCurve: at\\(t\\) .*{words}"):
        trace(FunctionCurve(function, closed=closed), 1e-3)


def test_a_recipe_names_the_class_and_the_key() -> None:
    @frozen
    class Torn(Curve):
        def at(self, t: np.ndarray) -> np.ndarray:
            return circle(t) + (t > 0.5)[:, None]

    with pytest.raises(RecipeError, match=r"place\[0\].*Torn: at\(t\) jumps"):
        compile_recipe(recipe_of(Torn()))


@pytest.mark.parametrize("stops", [(0.7, 0.3), (0.2, 0.2), (0.5, 1.5), (-0.1,), (0.0,)])
def test_stops_out_of_order_are_refused(stops: tuple[float, ...]) -> None:
    with pytest.raises(GeometryError, match=r"FunctionCurve: its breaks .* expected ascending numbers"):
        trace(FunctionCurve(circle, stops), 1e-3)


def test_a_curve_that_does_not_say_how_it_runs_is_refused() -> None:
    with pytest.raises(GeometryError, match=r"Curve says nowhere how it runs: expected a method at\(t\)"):
        trace(Curve(), 1e-3)


@pytest.mark.parametrize("power", [0.02, 0.1, 0.5])
def test_what_is_steep_is_no_jump(power: float) -> None:
    """From 0 to half its height within the first float behind 0.5, and yet a curve."""
    rise = FunctionCurve(
        lambda t: np.column_stack([t, np.sign(t - 0.5) * np.abs(t - 0.5) ** power]), (0.5,), closed=False
    )
    assert np.ptp(trace(rise, 1e-3).strands[0][:, 1]) == pytest.approx(2 * 0.5**power)


def test_lists_and_whole_numbers_are_taken_for_points() -> None:
    assert len(trace(FunctionCurve(lambda t: circle(t).tolist()), 1e-3).rings) == 1
    steps = FunctionCurve(lambda t: np.column_stack([t, 0 * t]).astype(int) * 1, closed=False)
    with pytest.raises(GeometryError, match="jumps"):
        trace(steps, 1e-3)


def test_what_a_curve_keeps_for_itself_is_not_written_to() -> None:
    kept: dict[int, np.ndarray] = {}

    def at(t: np.ndarray) -> np.ndarray:
        kept[len(t)] = half = Half().at(t)
        half.flags.writeable = False
        return half

    assert len(trace(FunctionCurve(at), 1e-3).rings) == 1
    assert len(trace(FunctionCurve(at), lambda points: np.full(len(points), 1e-3)).rings) == 1


def test_petals_meet_in_the_middle_and_bound_a_ring_each() -> None:
    traced = trace(Rose(3), 1e-3)
    assert all(np.array_equal(ring[0], ring[-1]) and not ring[0].any() for ring in traced.rings)


def test_a_curve_that_runs_back_over_itself_bounds_nothing() -> None:
    there_and_back = FunctionCurve(lambda t: np.column_stack([np.minimum(t, 1 - t), 0 * t]), (0.5,))
    traced = trace(there_and_back, 1e-3)
    assert traced.rings == []
    assert traced.strands[0].tolist() == [[0, 0], [0.5, 0], [0, 0]]
