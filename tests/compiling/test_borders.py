"""Borders close: whatever the frieze and the corner, a band round a cloth has no open end and no joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from numpy.typing import NDArray

from batik_vector.artwork import violations
from batik_vector.compiling.borders import compile_borders
from batik_vector.compiling.compiler import compile_cloth
from batik_vector.errors import RecipeError
from batik_vector.geometry.curves import Circle, Superellipse
from batik_vector.recipe.border import BorderSpec, ClothSide, Corner, Ends, RailSpec
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.model import Placement, Recipe
from batik_vector.recipe.motif import Element
from batik_vector.tiling.cloth.field import collected
from batik_vector.tiling.symmetry.friezes import FRIEZES
from tests.frames import (
    CLOTH,
    DEPTH,
    HEIGHT,
    LINE,
    PERIOD,
    RINGS,
    WIDTH,
    artwork,
    border,
    frames,
    many,
    recipe,
    sound,
)
from tests.thorough import examples, long


def wave_of(name: str) -> Placement:
    # Its crests stand on the upright mirrors, which p2mg has at a quarter of the period.
    return Placement(motif="m", scale=1, at=(PERIOD / 4 if name == "p2mg" else 0, 9))


@pytest.mark.parametrize("corner", ["mitre", "bend"])
@pytest.mark.parametrize("name", FRIEZES)
def test_a_wave_under_every_frieze_closes_to_rings(name: str, corner: str) -> None:
    done = compile_borders([border(wave_of(name), frieze=name, corner=corner)], recipe(), CLOTH)
    layer = sound(done)
    assert len(layer.areas) == RINGS[name]
    for ring in layer.areas:
        assert len(ring.interiors) == 1
        hole = shapely.Polygon(ring.interiors[0])
        assert hole.contains(done.shape.buffer(-1))
        assert ring.area == pytest.approx(2 * (ring.exterior.length + hole.length) / 2, rel=0.03)


@pytest.mark.parametrize("corner", ["mitre", "bend"])
@pytest.mark.parametrize("name", FRIEZES)
def test_a_line_under_every_frieze_closes(name: str, corner: str) -> None:
    layer = sound(compile_borders([border(wave_of(name), frieze=name, corner=corner)], recipe(LINE), CLOTH))
    assert len(layer.lines) == RINGS[name]
    assert shapely.is_closed(layer.lines).all()
    assert set(layer.line_names) == {"m.wave"}


@pytest.mark.parametrize("corner", Corner)
def test_rails_are_closed_rings_without_a_joint(corner: Corner) -> None:
    rails = (RailSpec(at=2, width=2), RailSpec(at=30, width=1.5))
    done = compile_borders([border(rails=rails, corner=corner, place=(), limit=10)], recipe(), CLOTH)
    layer = sound(done)
    assert layer.area_names == ("rail", "rail")
    assert [len(area.interiors) for area in layer.areas] == [1, 1]
    if corner != Corner.BEND:
        assert shapely.get_num_coordinates(layer.areas).tolist() == [10, 10]
    outer = max(layer.areas, key=lambda area: float(area.area))
    assert outer.bounds == (1, 1, WIDTH - 1, HEIGHT - 1)


def turned(
    areas: NDArray[np.object_], around: tuple[float, float], matrix: list[list[int]]
) -> shapely.Geometry:
    middle = np.array(around) / 2
    return shapely.union_all(
        shapely.transform(
            areas, lambda xy: np.rint(((xy - middle) @ np.array(matrix) + middle) * 1000) / 1000
        )
    )


HALF_TURN, QUARTER, UPRIGHT, DIAGONAL = (
    [[-1, 0], [0, -1]],
    [[0, 1], [-1, 0]],
    [[-1, 0], [0, 1]],
    [[0, 1], [1, 0]],
)


@pytest.mark.parametrize(
    ("corner", "facing", "size", "symmetries"),
    [
        ("mitre", "turn", (400, 320), [HALF_TURN]),
        ("mitre", "turn", (400, 400), [HALF_TURN, DIAGONAL]),
        ("bend", "turn", (400, 320), [HALF_TURN]),
        ("bend", "turn", (400, 400), [HALF_TURN, QUARTER]),
        ("motif", "turn", (392, 312), [HALF_TURN]),
        ("motif", "turn", (392, 392), [HALF_TURN, QUARTER]),
    ],
)
def test_frames_have_the_symmetry_of_their_corners(
    corner: str, facing: str, size: tuple[int, int], symmetries: list[list[list[int]]]
) -> None:
    leaf = Element(curve=Superellipse(a=1, b=1.5, length=9, width=4), spin=30)
    place = (Placement(motif="m", scale=1, at=(13, 14)),)
    squares = place if corner == "motif" else ()
    cloth = (0.0, 0.0, float(size[0]), float(size[1]))
    done = compile_borders(
        [border(*place, corner=corner, corner_place=squares, facing=facing)], recipe(leaf), cloth
    )
    areas = sound(done, cloth).areas
    whole = shapely.union_all(areas)
    # A bend rounds its arcs to the grid, and may do so differently in every corner.
    allowed = 0.002 * float(shapely.length(areas).sum()) if corner == "bend" else 1e-9
    for matrix in symmetries:
        assert whole.symmetric_difference(turned(areas, size, matrix)).area <= allowed


def test_mirrored_sides_are_mirror_images() -> None:
    leaf = Element(curve=Superellipse(a=1, b=1.5, length=9, width=4), spin=30)
    place = (Placement(motif="m", scale=1, at=(13, 14)),)
    done = compile_borders(
        [border(*place, corner="motif", corner_place=place, facing="mirror", frieze="p1m1")],
        recipe(leaf),
        (0, 0, 392, 312),
    )
    areas = sound(done, (0, 0, 392, 312)).areas
    for matrix in (UPRIGHT, HALF_TURN):
        assert shapely.union_all(areas).symmetric_difference(turned(areas, (392, 312), matrix)).area < 1e-9


@long
@settings(many, max_examples=examples(15, 60))
@given(frames())
def test_every_border_is_in_normal_form_and_keeps_to_its_band(
    frame: tuple[Recipe, list[BorderSpec], tuple[float, float, float, float]],
) -> None:
    drawn, made, cloth = frame
    done = compile_borders(made, drawn, cloth)
    assert violations(artwork(done, cloth)) == []
    core = done.shape.buffer(-0.3)
    for layer in done.layers:
        assert not shapely.intersects(layer.areas, core).any()
        assert not shapely.intersects(layer.lines, core).any()
    taken = sum(spec.size[1] + spec.gap for spec in made)
    for number, side in enumerate((ClothSide.LEFT, ClothSide.BOTTOM)):
        assert done.window[number] == pytest.approx(taken if side in made[0].sides else 0, abs=0.003)


def test_nested_borders_of_one_ink_leave_no_hairline_where_they_meet() -> None:
    outer = border(place=(), rails=(RailSpec(at=DEPTH - 1, width=2),))
    inner = border(place=(), size=(20, 10), rails=(RailSpec(at=1, width=2),), corner="motif", limit=10)
    assert len(sound(compile_borders([outer, inner], recipe(), CLOTH)).areas) == 1
    apart = replace(outer, gap=1.0)
    assert len(sound(compile_borders([apart, inner], recipe(), CLOTH)).areas) == 2


def test_two_bands_run_from_edge_to_edge() -> None:
    spec = border(sides=("bottom", "top"), size=(40, 30))
    layer = sound(compile_borders([spec], recipe(), (0, 0, 413, 300)), (0, 0, 413, 300))
    assert [area.bounds[0::2] for area in layer.areas] == [(0, 413), (0, 413)]
    done = compile_borders([spec], recipe(), (0, 0, 413, 300))
    assert done.window == (0, 30, 413, 270)
    assert [(fit.side, fit.periods) for fit in done.fits] == [("bottom", 10), ("top", 10)]
    assert done.fits[0].stretch == pytest.approx(413 / 400)
    trimmed = compile_borders([replace(spec, ends=Ends.TRIM)], recipe(), (0, 0, 413, 300))
    assert [fit.stretch for fit in trimmed.fits] == [1, 1]


def test_what_is_left_of_the_cloth() -> None:
    done = compile_borders(
        [border(corner="bend", radius=25, gap=5, sides=tuple(ClothSide))], recipe(), (10, 20, 410, 340)
    )
    assert done.window == (51, 61, 369, 299)
    assert done.shape.bounds == done.window
    box = shapely.box(*done.window)
    # Four corners of 20 mm radius are off.
    assert box.area - done.shape.area == pytest.approx((4 - np.pi) * 20**2, rel=0.02)
    assert compile_borders([border()], recipe(), CLOTH).shape.equals(
        shapely.box(36, 36, WIDTH - 36, HEIGHT - 36)
    )


def test_the_work_grows_with_the_length_of_the_frame_and_not_its_square() -> None:
    counts = []
    for times in (1, 8):
        cloth = (0.0, 0.0, WIDTH * times, HEIGHT * times)
        counts.append(artwork(compile_borders([border()], recipe(), cloth), cloth).vertex_count)
    assert counts[1] < 9 * counts[0]


@pytest.mark.parametrize(
    ("words", "fields", "cloth"),
    [
        (
            "the right side, 328 mm, holds 8.20 periods of 40 mm: .* stretched by 2.5%, .* 320 or 360 mm",
            {"limit": 1, "corner": "motif"},
            (190, 400),
        ),
        ("the bottom side is 70 mm long, its corners alone take 72 mm", {}, (70, 400)),
        ("a depth of 36 mm leaves nothing of 400 × 60 mm", {"sides": ("bottom", "top")}, (400, 60)),
        (
            "bottom side is 400 mm long, its corners alone take 632",
            {"corner": "bend", "radius": 280},
            (400, 400),
        ),
    ],
)
def test_what_does_not_fit_is_refused_in_words(
    words: str, fields: dict[str, object], cloth: tuple[float, float]
) -> None:
    with pytest.raises(RecipeError, match=rf"^border\[0\]: .*{words}"):
        compile_borders([border(**fields)], recipe(), (0, 0, *cloth))


def test_square_corners_are_refused_within_round_ones() -> None:
    bent = border(corner="bend", radius=30)
    with pytest.raises(
        RecipeError,
        match=r'over the lower left corner, .* 30 mm radius: expected corner = "bend" with .* 20 mm',
    ):
        compile_borders([bent, border(size=(20, 10))], recipe(), CLOTH)
    with pytest.raises(RecipeError, match=r"30 mm radius: expected a radius of at least 20 mm$"):
        compile_borders([bent, border(size=(20, 10), corner="bend", radius=5)], recipe(), CLOTH)
    with pytest.raises(RecipeError, match=r"expected sides to name both bottom and left, and corner = "):
        compile_borders([bent, border(size=(20, 10), sides=("bottom",))], recipe(), CLOTH)
    inner = border(Placement(motif="m", scale=0.5, at=(0, 5)), size=(20, 10), corner="bend")
    layer = sound(compile_borders([bent, inner], recipe(), CLOTH))
    assert all(len(area.interiors) == 1 for area in layer.areas)


@pytest.mark.parametrize("corner", Corner)
def test_far_too_many_periods_are_refused_before_they_are_laid(
    monkeypatch: pytest.MonkeyPatch, corner: Corner
) -> None:
    monkeypatch.setattr("batik_vector.tiling.borders.sides.spans", None)
    tiny = border(Placement(motif="m", scale=0.001, at=(0.05, 0.05)), size=(0.1, 0.1), corner=corner)
    words = r"^border\[0\]: about 800,000 periods of 0.1 mm make about [\d,]+ vertices, past the limit of"
    with pytest.raises(RecipeError, match=words):
        compile_borders([tiny], replace(recipe(), limit=700_000), (0, 0, 20_000, 20_000))


def test_faults_name_their_placement() -> None:
    with pytest.raises(RecipeError, match=r'border\[0\].place\[0\]: unknown motif "n"'):
        compile_borders([border(Placement(motif="n", scale=1))], recipe(), CLOTH)
    with pytest.raises(RecipeError, match=r'border\[0\]: unknown ink "wx": did you mean "wax"'):
        compile_borders([border(rails=(RailSpec(at=2, ink="wx"),))], recipe(), CLOTH)
    with pytest.raises(RecipeError, match=r"border\[0\]: about .* vertices, past the limit"):
        compile_borders([border()], replace(recipe(), limit=1000), CLOTH)


def test_a_placement_may_leave_the_friezes_symmetry_out() -> None:
    dot = Element(curve=Circle(2))
    places = [Placement(motif="m", scale=1, at=(10, 9), symmetry=symmetry) for symmetry in ("", "p1")]
    cloth = (0, 0, 392, 312)
    frames = [border(place, frieze="p2mm", corner="motif") for place in places]
    counts = [len(sound(compile_borders([frame], recipe(dot), cloth), cloth).areas) for frame in frames]
    assert counts[0] == 4 * counts[1]


DOTTED = """
[ink.wax]
colour = "#7d9cc0"
[motif.dot]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 0.6 } }]
[[place]]
motif = "dot"
scale = "1 mm"
layout = { kind = "lattice", columns = 12, rows = 14, stagger = true }
[tile]
size = ["42 mm", "44 mm"]
repeat = "half-drop"
[yardage]
width = "300 mm"
length = "240 mm"
phase = ["%s mm", "%s mm"]
[[border]]
size = ["34 mm", "46 mm"]
corner = "bend"
radius = "40 mm"
rails = [{ at = "44.8 mm", width = "2.4 mm", ink = "wax" }]
"""


@pytest.mark.parametrize("phase", [(0, 0), (0.4, 0.3), (0.9, 0.1), (1.3, 1.7), (2.1, 0.8), (2.9, 2.4)])
def test_marks_of_the_field_weld_to_a_rail_where_it_begins_to_bend(phase: tuple[float, float]) -> None:
    assert violations(collected(compile_cloth(read_recipe(DOTTED % phase)))) == []
