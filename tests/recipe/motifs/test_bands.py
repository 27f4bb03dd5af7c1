"""Bands and squares: they lie side by side without a gap, at any angle that closes, and repeat."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, violations
from batik_vector.certificate import certify
from batik_vector.errors import RecipeError
from batik_vector.recipe.figures import draw
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.motif import MOTIFS
from batik_vector.recipe.motifs.lereng import Lereng
from batik_vector.recipe.motifs.rows import ROWS, Row
from tests.thorough import examples, long

BAND = """
[motif.band]
kind = "{kind}"
{keys}
[ink.wax]
colour = "#f4efe2"
[[place]]
motif = "band"
scale = "{scale:.3f} mm"
layout = {{ kind = "stripes", fit = true, {layout} }}
[tile]
size = ["{width:.3f} mm", "{height:.3f} mm"]
repeat = "{repeat}"
"""
HALF = 'rows = [{ kind = "line", height = 0.4 }, { kind = "space", height = 0.4 }]'


def tile(
    kind: str = "lereng",
    keys: str = HALF,
    layout: str = "angle = 45",
    size: tuple[float, float] = (80.0, 80.0),
    scale: float = 14.0,
    repeat: str = "grid",
) -> Artwork:
    width, height = size
    return compile_recipe(
        read_recipe(
            BAND.format(
                kind=kind, keys=keys, layout=layout, scale=scale, width=width, height=height, repeat=repeat
            )
        )
    )


def told(artwork: Artwork) -> dict[str, float]:
    (report,) = artwork.facts["stripes"]
    found: dict[str, float] = report
    return found


@long
@settings(max_examples=examples(3, 100), deadline=None)
@given(
    st.tuples(st.floats(50, 160), st.floats(50, 160)),
    st.floats(-90, 90),
    st.floats(8, 30),
    st.sampled_from(["grid", "half-drop", "brick"]),
    st.booleans(),
)
def test_bands_that_fit_leave_no_gap_and_do_not_overlap(
    size: tuple[float, float], angle: float, scale: float, repeat: str, flip: bool
) -> None:
    layout = f"angle = {angle:.2f}, flip = {str(flip).lower()}"
    artwork = tile(layout=layout, size=size, scale=scale, repeat=repeat)
    assert violations(artwork) == []
    # One half of each band is waxed, and no two bands lie on one another: one half of the tile is.
    (layer,) = artwork.layers
    cell = artwork.cell.width * artwork.cell.height
    assert shapely.area(layer.areas).sum() == pytest.approx(cell / 2, rel=1e-3)
    report = told(artwork)
    assert report["distance"] * report["lines"] <= math.hypot(*size) + 1e-3


@pytest.mark.parametrize(
    ("size", "asked", "angle"),
    [((80, 80), 45, 45.0), ((80, 80), -45, -45.0), ((120, 90), 36.87, 36.87), ((120, 90), 90, 90.0)],
)
def test_an_angle_that_closes_is_kept(size: tuple[float, float], asked: float, angle: float) -> None:
    assert told(tile(layout=f"angle = {asked}", size=size))["angle"] == pytest.approx(angle, abs=0.01)


def test_the_nearest_angle_is_told() -> None:
    report = told(tile(layout="angle = 40", size=(100.0, 70.0)))
    assert report["asked"] == 40
    # On 100 × 70 mm lines run at atan(70·q / 100·p).
    assert abs(report["angle"] - 40) < 6
    ratio = math.tan(math.radians(report["angle"])) * 100 / 70
    assert any(abs(ratio * p - round(ratio * p)) < 2e-3 for p in range(1, 13))


def test_links_keep_the_shape_of_the_band() -> None:
    report = told(tile("parang", "", "angle = 45", (160.0, 160.0), 16.0))
    parang = MOTIFS["parang"]()
    assert report["link"] == pytest.approx(report["distance"] / parang.across, rel=0.12)
    assert report["stretch"] == pytest.approx(report["link"] * parang.across / report["distance"], rel=1e-3)


@pytest.mark.parametrize("kind", ["parang", "miao-band", "pucuk-rebung"])
def test_a_tile_of_bands_has_a_clean_seam(kind: str) -> None:
    artwork = tile(kind, "", "winding = [1, 1]", (36.0, 36.0), 14.0)
    assert violations(artwork) == []
    assert certify(artwork).passed


@pytest.mark.parametrize("kind", ["parang", "lereng", "miao-band"])
def test_a_band_stays_within_its_breadth(kind: str) -> None:
    made = MOTIFS[kind]()
    for figure in draw(made, 1e-3):
        _, low, _, high = shapely.total_bounds(figure.areas).tolist()
        # The lozenges of parang stand on the band's upper edge.
        edge = 1.3 if kind == "parang" else 1.0
        assert max(-low, high) <= edge * made.across / 2 + 1e-6, figure.element.name


def test_parang_is_its_own_image_under_a_half_turn() -> None:
    for figure in draw(MOTIFS["parang"](), 1e-3):
        if figure.element.name in ("blade", "spine"):
            shape = shapely.union_all(figure.areas)
            turned = shapely.transform(shape, lambda xy: np.array([1.0, 0.0]) - xy)
            assert shapely.symmetric_difference(shape, turned).area < 1e-3 * shape.area


@pytest.mark.parametrize("kind", [kind for kind in ROWS if kind != "space"])
def test_rows_of_any_measure_draw_something_valid_in_their_room(kind: str) -> None:
    for height, count, full, weight in (
        (0.1, 4, 0.8, 0.07),
        (0.01, 1, 0.1, 0.02),
        (0.01, 6, 1.0, 0.1),
        (4.0, 1, 1.0, 0.2),
        (0.6, 2, 1.0, 0.05),
    ):
        row = Row(kind=kind, height=height, count=count, full=full, weight=weight)
        (figure,) = draw(Lereng(rows=(row,)), 2e-2 * min(height, 1 / count))
        assert len(figure.areas)
        assert shapely.is_valid(figure.areas).all()
        if weight < 0.1:
            _, low, _, high = shapely.total_bounds(figure.areas).tolist()
            assert max(-low, high) <= 0.62 * height, (kind, height, count)


LATTICE = """
[motif.round]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 0.3 } }]
[motif.square]
kind = "rosette"
elements = [{ curve = { kind = "polygon", sides = 4, radius = 0.3 } }]
[ink.wax]
colour = "#f4efe2"
[[place]]
motif = ["round", "square"]
scale = "10 mm"
layout = { kind = "lattice", columns = 1, rows = 4, stagger = true }
[tile]
size = ["20 mm", "40 mm"]
"""


def test_a_lattice_deals_its_places_out_row_by_row() -> None:
    layers = compile_recipe(read_recipe(LATTICE)).layers
    marks = [mark for layer in layers for mark in layer.areas]
    rounds = {round(mark.centroid.y) for mark in marks if len(mark.exterior.coords) > 12}
    squares = {round(mark.centroid.y) for mark in marks if len(mark.exterior.coords) <= 6}
    assert (rounds, squares) == ({5, 25}, {15, 35})


def test_motifs_that_do_not_come_out_even_on_a_lattice_are_refused() -> None:
    with pytest.raises(RecipeError, match="do not come out even on 3 places"):
        read_recipe(LATTICE.replace("rows = 4, stagger = true", "rows = 3"))


SQUARES = ("kawung", "truntum", "ceplok", "jlamprang", "nitik")


@pytest.mark.parametrize("kind", SQUARES)
def test_squares_repeat_with_the_symmetry_of_a_square(kind: str) -> None:
    made = MOTIFS[kind](**{"steps": 16} if kind == "nitik" else {})
    for figure in draw(made, 5e-4):
        shape = shapely.union_all(figure.areas)
        shifts = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)]
        field = shapely.union_all([affinity.translate(shape, *by) for by in shifts])
        window = shapely.box(-0.5, -0.5, 0.5, 0.5)
        tiled = shapely.intersection(field, window)
        # A quarter turn changes warp and weft: the ground of a nitik has mirrors alone.
        turn = [-1, 0, 0, 1, 0, 0] if kind == "nitik" else [0, -1, 1, 0, 0, 0]
        turned = affinity.affine_transform(tiled, turn)
        off = shapely.symmetric_difference(tiled, turned).area
        assert off < 4e-3 * max(tiled.length, 1e-3), figure.element.name


def test_bands_of_a_cloud_lie_within_one_another_and_narrow() -> None:
    figures = draw(MOTIFS["mega-mendung"](), 1e-3)
    shapes = [shapely.Polygon(figure.areas[0]) for figure in figures]
    for outer, inner in itertools.pairwise(shapes):
        assert shapely.covers(shapely.buffer(outer, 1e-3), inner)
    apart = [outer.exterior.distance(shapely.boundary(inner)) for outer, inner in itertools.pairwise(shapes)]
    assert apart == sorted(apart, reverse=True)
