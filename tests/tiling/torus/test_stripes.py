"""Stripes: lines that close on the torus to the bit, whatever the winding and the drop."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, violations
from batik_vector.compiling.compiler import inspect
from batik_vector.errors import GeometryError, RecipeError
from batik_vector.geometry.curves import Curve, Parametric, Segment, Spiral, Wave
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.tiling.cloth.field import repeated
from batik_vector.tiling.layouts import Stripes
from batik_vector.tiling.symmetry.repeats import Cut, TileSpec
from batik_vector.tiling.torus.stripes import Courses, courses

quick = settings(
    max_examples=60, deadline=None, derandomize=True, phases=[Phase.explicit, Phase.reuse, Phase.generate]
)

side = st.integers(20_000, 60_000).map(lambda steps: steps / 1000)
tiles = st.builds(
    TileSpec,
    size=st.tuples(side, side),
    repeat=st.sampled_from(["grid", "half-drop", "brick", "drop 1/3", "brick 2/5"]),
    cut=st.sampled_from(list(Cut)),
)
windings = st.tuples(st.integers(-4, 4), st.integers(-4, 4)).filter(lambda pq: math.gcd(*pq) == 1)
lines = st.one_of(
    st.just(Segment()), st.builds(Wave, st.integers(1, 3), st.floats(0, 0.3), st.floats(-180, 180))
)
grounds = st.builds(
    lambda count, winding, links, creep: Stripes(count=count, winding=winding, links=links, creep=creep),
    st.integers(1, 5),
    windings,
    st.one_of(st.none(), st.integers(1, 4)),
    st.integers(-2, 2),
)
origins = st.tuples(st.floats(-50, 50), st.floats(-50, 50))


def ground(
    tile: TileSpec,
    layout: Stripes,
    curve: Curve,
    at: tuple[float, float] | None = None,
    treatment: Treatment = Treatment.LINE,
    scale: float = 10.0,
    width: float = 0.5,
) -> Artwork:
    return compile_recipe(
        Recipe(
            motif={"m": Rosette(elements=(Element(curve=curve, treatment=treatment),))},
            place=(Placement(motif="m", layout=layout, scale=scale, at=at),),
            tile=tile,
            tolerance=0.05,
            ink={"wax": InkSpec(width=width)},
        )
    )


def vector_of(tile: TileSpec, winding: tuple[int, int]) -> np.ndarray:
    a, b = np.array(tile.unit().lattice)
    return np.asarray(winding[0] * a + winding[1] * b)


@quick
@given(tiles, grounds, lines, origins)
def test_no_line_ends_anywhere_on_the_torus(
    tile: TileSpec, layout: Stripes, curve: Curve, at: tuple[float, float]
) -> None:
    artwork = ground(tile, layout, curve, at)
    assert violations(artwork) == []
    cell = artwork.cell
    (ax, ay), (bx, by) = cell.lattice
    drawn = artwork.layers[0].lines
    steps = np.rint(shapely.get_coordinates([shapely.get_point(drawn, k) for k in (0, -1)]) * 1000)
    # Lines may close in the middle of the tile, but none ends there.
    closed = np.tile(shapely.is_closed(drawn), 2)
    ends = steps[~closed].astype(np.int64)
    inside = (ends > 0).all(axis=1) & (ends[:, 0] < cell.columns) & (ends[:, 1] < cell.rows)
    assert not inside.any()
    # On the torus every end is that of an even number of lines.
    i = np.floor_divide(ends[:, 0], ax) if bx == 0 else np.zeros(len(ends), np.int64)
    ends = ends - i[:, None] * np.array([ax, ay])
    j = np.floor_divide(ends[:, 1], by)
    ends = ends - j[:, None] * np.array([bx, by])
    ends[:, 0] %= ax
    ends[:, 1] %= by
    _, times = np.unique(ends, axis=0, return_counts=True)
    assert (times % 2 == 0).all()


@quick
@given(tiles, grounds, origins)
def test_straight_lines_are_as_long_as_they_are_to_go(
    tile: TileSpec, layout: Stripes, at: tuple[float, float]
) -> None:
    drawn = ground(tile, layout, Segment(), at).layers[0].lines
    units = tile.cell().columns * tile.cell().rows / (tile.unit().columns * tile.unit().rows)
    length = float(np.hypot(*vector_of(tile, layout.winding))) / 1000
    lines = layout.count or 12
    assert shapely.length(drawn).sum() == pytest.approx(lines * units * length, rel=1e-3)


@pytest.mark.parametrize("repeat", ["grid", "half-drop", "brick 1/3"])
@pytest.mark.parametrize("winding", [(1, 0), (0, 1), (1, 1), (2, -1), (3, 2)])
def test_bands_weld_into_endless_ones_without_a_seam(repeat: str, winding: tuple[int, int]) -> None:
    tile = TileSpec(size=(45, 36), repeat=repeat)
    artwork = ground(tile, Stripes(count=1, winding=winding), Segment(), treatment=Treatment.STROKE, width=2)
    assert inspect(artwork)["seam"] == []
    areas = artwork.layers[0].areas
    units = artwork.cell.width * artwork.cell.height / (45 * 36)
    length = float(np.hypot(*vector_of(tile, winding))) / 1000
    # As broad as the pen all along: no gap where it closes, no bulge where its ends lap over.
    assert shapely.area(areas).sum() == pytest.approx(units * length * 2, rel=1e-3)
    assert shapely.get_num_interior_rings(areas).sum() == 0
    field = repeated(artwork, 2, 2)
    assert violations(field) == []
    corners = shapely.get_num_coordinates(field.layers[0].areas)
    # A straight band across the field has a vertex where a joint left one, and few of them.
    assert corners.mean() < 40


@quick
@given(tiles, grounds)
def test_lines_are_evenly_spaced(tile: TileSpec, layout: Stripes) -> None:
    found = courses(layout, tile.unit().lattice, (0, 0), 10.0)
    vector = np.array(found.vector, float)
    normal = np.array([-vector[1], vector[0]]) / np.hypot(*vector)
    (ax, ay), (bx, by) = tile.unit().lattice
    between = abs(ax * by - ay * bx) / np.hypot(*vector)
    heights = np.sort((found.starts @ normal) % between)
    gaps = np.diff(np.append(heights, heights[0] + between))
    lines = layout.count or 12
    assert gaps == pytest.approx(np.full(lines, between / lines), abs=2.0)


@pytest.mark.parametrize("vector", [(30_000, 10_001), (10_001, 30_000), (20_000, 20_001), (-7, 40_003)])
@pytest.mark.parametrize("links", [1, 3, 7])
def test_ends_on_a_half_step_are_rounded_alike(vector: tuple[int, int], links: int) -> None:
    # To even, as floats are rounded, 0.5 and 10001.5 would fall apart.
    for axis in (0, 1):
        height = 0.5 / 1000 * math.hypot(*vector) / vector[1 - axis]
        found = Courses(vector, np.zeros((1, 2), np.int64), np.ones(1, np.int64), links, 1.0)
        line = np.array([shapely.LineString([(0, height), (0.3, height), (1, height)])], dtype=object)
        (joined,) = found.lines(line)
        steps = np.rint(shapely.get_coordinates(joined) * 1000)
        assert len(steps) == 2 * links + 2
        # The last stretch goes over the first again.
        assert (steps[-2:] - steps[:2] == vector).all()


def test_links_keep_their_shape_unless_they_are_counted() -> None:
    lattice = TileSpec(size=(97, 50)).unit().lattice
    assert courses(Stripes(winding=(1, 0)), lattice, (0, 0), 10.0).links == 10
    assert courses(Stripes(winding=(0, 1)), lattice, (0, 0), 10.0).links == 5
    assert courses(Stripes(links=3), lattice, (0, 0), 10.0).links == 3
    assert courses(Stripes(), lattice, (0, 0), 500.0).links == 1


def test_chains_of_beads_have_every_bead_once() -> None:
    # The bead lies in the middle of its link.
    bead = Parametric(x=((0, 0.5, 0.0), (1, 0.2, 0.0)), y=((1, 0.2, -90.0),))
    artwork = ground(TileSpec(size=(60, 40)), Stripes(count=4), bead, treatment=Treatment.AREA)
    areas = artwork.layers[0].areas
    assert shapely.area(areas).sum() == pytest.approx(24 * math.pi * 4, rel=0.04)
    whole = shapely.area(repeated(artwork, 2, 1).layers[0].areas) > 0.95 * math.pi * 4
    assert whole.sum() > 30


def test_every_other_line_is_flipped() -> None:
    found = courses(Stripes(count=4, flip=True), ((60_000, 0), (0, 40_000)), (0, 0), 10.0)
    assert found.sides.tolist() == [1, -1, 1, -1]
    with pytest.raises(GeometryError, match="only when they are even"):
        Stripes(count=3, flip=True)


@pytest.mark.parametrize(
    ("winding", "near"), [((2, 0), r"\[1, 0\]"), ((4, -6), r"\[2, -3\]"), ((0, 0), r"\[1, 0\]")]
)
def test_lines_over_themselves_are_refused(winding: tuple[int, int], near: str) -> None:
    with pytest.raises(GeometryError, match=f"common factor, such as {near}"):
        Stripes(winding=winding)


def test_a_line_that_does_not_close_is_told() -> None:
    # What does not run from end to end may end where it likes.
    ground(TileSpec(size=(40, 40)), Stripes(), Spiral(revolutions=0.6, radius=0.9))
    slope = Element(curve=Segment(math.hypot(1, 0.5)), turn=math.degrees(math.atan(0.5)))
    recipe = Recipe(
        motif={"m": Rosette(elements=(slope,))},
        place=(Placement(motif="m", layout=Stripes(), scale=10),),
        tile=TileSpec(size=(40, 40)),
    )
    with pytest.raises(RecipeError, match=r"begins at y = 0 and ends at y = 0\.5"):
        compile_recipe(recipe)
