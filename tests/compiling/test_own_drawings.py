"""Drawings of one's own are motifs like any other: seamless in every group, as large as they were drawn."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from batik_vector import Element, InkSpec, Placement, Recipe, Rosette, TileSpec, certify, compile_recipe
from batik_vector.artwork import Artwork, violations
from batik_vector.errors import RecipeError
from batik_vector.geometry.curves import Curve, PathCurve, PointsCurve, YAxis
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.regions import FillRule
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.motif import PathMotif
from batik_vector.tiling.symmetry.groups import GROUPS
from batik_vector.tiling.symmetry.repeats import Cut
from tests.thorough import examples, long
from tests.tiling.test_seamless import crossings, twins

Segments = list[tuple[str, list[tuple[float, float]]]]

places = st.tuples(*[st.integers(-16, 16).map(lambda n: n / 2)] * 2)
segments = st.one_of(
    st.tuples(st.just("L"), st.lists(places, min_size=1, max_size=1)),
    st.tuples(st.just("Q"), st.lists(places, min_size=2, max_size=2)),
    st.tuples(st.just("C"), st.lists(places, min_size=3, max_size=3)),
)
subpaths = st.tuples(places, st.lists(segments, min_size=2, max_size=5))
HERE = st.floats(0, 1)
PAST, NEXT = slice(None, -1), slice(1, None)


def data(drawn: list[tuple[tuple[float, float], Segments]]) -> str:
    text = ""
    for begin, parts in drawn:
        text += "M{:g} {:g}".format(*begin)
        text += "".join(letter + " ".join(f"{x:g},{y:g}" for x, y in ends) for letter, ends in parts) + "Z"
    return text


def region(drawn: list[tuple[tuple[float, float], Segments]], pieces: int = 300) -> shapely.Geometry:
    """What the paths cover by the even-odd rule: faces from whose inside a ray leaves by an odd count."""
    rings = []
    for begin, parts in drawn:
        ring = [begin]
        for letter, ends in parts:
            control = np.array([ring[-1], *ends])[:, None] + np.zeros((1, pieces, 1))
            t = np.linspace(0, 1, pieces)[:, None]
            while len(control) > 1:
                control = control[:-1] * (1 - t) + control[1:] * t
            ring += ends if letter == "L" else [tuple(p) for p in control[0, 1:].tolist()]
        rings.append(np.array([*ring, begin]))
    lines = shapely.union_all([shapely.LineString(ring) for ring in rings])
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))
    (x0, y0), (x1, y1) = (np.concatenate([ring[part] for ring in rings]).T for part in (PAST, NEXT))
    x, y = shapely.get_coordinates(shapely.point_on_surface(faces)).T[:, :, None]
    crossed = (y0 <= y) != (y1 <= y)
    with np.errstate(divide="ignore", invalid="ignore"):
        right = x0 + (y - y0) * (x1 - x0) / (y1 - y0) > x
    return shapely.union_all(faces[(crossed & right).sum(axis=1) % 2 == 1])


def covered(shape: shapely.Geometry, on_cloth: Affine, recipe: Recipe, artwork: Artwork) -> shapely.Geometry:
    """All images of a shape under the group, welded and cut to the tile."""
    orbit = recipe.tiling.orbit()
    cell = shapely.box(0, 0, artwork.cell.width, artwork.cell.height)
    sides = ((artwork.cell.width, 0.0), (0.0, artwork.cell.height))
    one, other = (np.array(period) for period in orbit.periods or sides)
    shifts = [Affine.translation(one * i + other * j) for i in range(-7, 8) for j in range(-7, 8)]
    images = [shift @ operation @ on_cloth for operation in orbit.operations for shift in shifts]
    found = Affines.of(images).apply(shapely.get_parts(shape))
    near = found[shapely.intersects(found, cell)]
    try:
        return shapely.intersection(shapely.union_all(near, grid_size=1e-7), cell, grid_size=1e-7)
    except shapely.errors.GEOSException:
        # On a grid as fine as that GEOS misses an edge now and then; on none it does not.
        return shapely.intersection(shapely.union_all(near), cell)


@long
@settings(
    max_examples=examples(5, 300),
    deadline=None,
    derandomize=True,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
@given(
    st.lists(subpaths, min_size=1, max_size=3),
    st.sampled_from(sorted(GROUPS)),
    st.floats(0.5, 2.0),
    st.floats(-180, 180),
    HERE,
    HERE,
    st.sampled_from(YAxis),
    places,
)
def test_any_path_in_any_group_is_seamless_and_as_large_as_it_was_drawn(
    drawn: list[tuple[tuple[float, float], Segments]],
    group: str,
    scale: float,
    turn: float,
    u: float,
    v: float,
    y: YAxis,
    centre: tuple[float, float],
) -> None:
    shape = region(drawn)
    assume(shapely.area(shape) > 1)
    ratio = GROUPS[group].kind.ratio or 1.3
    # Off the seam by what no sum of halves makes up: ink that ends along it has no twin to meet.
    at = (u * 60.0 + 0.0137, v * 60.0 * ratio + 0.0291)
    recipe = Recipe(
        motif={"own": PathMotif(d=data(drawn), y=y, centre=centre, fill=FillRule.EVENODD)},
        place=(Placement(motif="own", scale=scale, turn=turn, at=at),),
        ink={"wax": InkSpec()},
        tile=TileSpec(size=(60.0, round(60.0 * ratio, 3)), repeat=group, cut=Cut.RECTANGLE),
        tolerance=0.02,
    )
    artwork = compile_recipe(recipe)
    assert violations(artwork) == []
    (layer,) = artwork.layers
    for axis, (size, across) in enumerate(
        [(artwork.cell.width, artwork.cell.height), (artwork.cell.height, artwork.cell.width)]
    ):
        near, far = (crossings(layer, axis, value, across) for value in (0.0, size))
        assert twins(near, 0.0, across) == far
    flip = 1 if y == YAxis.UP else -1
    up = Affine(1, 0, 0, flip, -centre[0], -centre[1] * flip)
    base = recipe.tiling.orbit().base @ Affine.translation(at) @ Affine.turn(turn) @ Affine.scale(scale)
    truth = covered(shape, base @ up, recipe, artwork)
    ours = float(shapely.area(layer.areas).sum())
    # The tolerance, and a step of the grid.
    assert abs(ours - shapely.area(truth)) <= 0.022 * shapely.length(truth) + 0.01


LEAF = "M10 20C12 10 30 5 40 20C30 35 12 30 10 20ZM18 20A4 4 0 1 0 26 20A4 4 0 1 0 18 20Z"
OWN: dict[str, Curve] = {
    "path": PathCurve(LEAF, centre=(25.0, 20.0)),
    "points": PointsCurve(((0, 0), (6, 4), (14, 5), (24, 0), (14, -5), (6, -4)), smooth=True, corners=(0, 3)),
    "function": Curve.from_function(lambda t: (9 + 3 * np.cos(10 * np.pi * t)) * np.exp(2j * np.pi * t)),
    "geometry": Element.from_geometry(
        shapely.Point(0, 0).buffer(12).difference(shapely.box(-4, -4, 4, 4))
    ).curve,
}


@pytest.mark.parametrize("repeat", ["half-drop", "brick", "p4g"])
@pytest.mark.parametrize("kind", OWN)
def test_every_kind_of_own_drawing_holds_in_three_repeats(kind: str, repeat: str) -> None:
    recipe = Recipe(
        motif={"own": Rosette(elements=(Element(curve=OWN[kind], name="own", gap=0.5),))},
        place=(Placement(motif="own", scale=0.9, turn=17.0, at=(-9.0, 14.0)),),
        ink={"wax": InkSpec()},
        tile=TileSpec(size=(60.0, 60.0), repeat=repeat),
    )
    artwork = compile_recipe(recipe)
    assert violations(artwork) == []
    certificate = certify(artwork)
    assert certificate.passed, certificate.faults
    assert certificate.worst.crossings > 0


def test_the_shortest_recipe_of_ones_own_is_three_lines() -> None:
    text = (
        '[motif.leaf]\nkind = "path"\n'
        f'd = "{LEAF}"\n'
        '[ink.wax]\n[[place]]\nmotif = "leaf"\nwidth = "24 mm"\n[tile]\nsize = ["40 mm", "40 mm"]\n'
    )
    (layer,) = compile_recipe(read_recipe(text)).layers
    left, low, right, high = shapely.total_bounds(layer.areas)
    assert right - left == pytest.approx(24, abs=0.02)
    assert ((left + right) / 2, (low + high) / 2) == pytest.approx((20, 20), abs=0.02), "in the middle"
    (leaf,) = layer.areas
    assert len(leaf.interiors) == 1
    assert leaf.interiors[0].minimum_clearance > 0
    assert shapely.Polygon(leaf.interiors[0]).area == pytest.approx(
        math.pi * 3.2**2, abs=2 * math.pi * 3.2 * 0.02
    )


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3, 2e4])
def test_a_drawing_of_any_size_is_drawn_as_finely(size: float) -> None:
    almond = [(10, 20), (12, 10), (30, 5), (40, 20), (30, 35), (12, 30), (10, 20)]
    numbers = [f"{x * size:g} {y * size:g}" for x, y in almond]
    curve = PathCurve(f"M{numbers[0]}C{' '.join(numbers[1:])}Z", centre=(25 * size, 20 * size))
    for motif in (
        Rosette(elements=(Element(curve=curve),)),
        PathMotif(d=curve.d),
    ):
        recipe = Recipe(
            motif={"leaf": motif},
            place=(Placement(motif="leaf", width=24.0),),
            ink={"wax": InkSpec()},
            tile=TileSpec(size=(40.0, 40.0)),
        )
        assert 38 < compile_recipe(recipe).vertex_count < 60


def test_a_path_that_crosses_itself_too_often_is_refused_by_its_name() -> None:
    rng = np.random.default_rng(5)
    knot = "M0 0" + "".join(f"L{x:.2f} {y:.2f}" for x, y in rng.normal(size=(9000, 2))) + "Z"
    recipe = Recipe(
        motif={"knot": Rosette(elements=(Element(curve=PathCurve(knot), name="knot"),))},
        place=(Placement(motif="knot", width=24.0),),
        ink={"wax": InkSpec()},
        tile=TileSpec(size=(40.0, 40.0)),
    )
    with pytest.raises(RecipeError, match=r'element "knot" \(path\): shapes of about'):
        compile_recipe(recipe)
