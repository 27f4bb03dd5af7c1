"""Placements under symmetry: the right images, drawn once, welded along mirrors, the ground kept bare."""

from __future__ import annotations

import random
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Overlap, violations
from batik_vector.compiling.compiler import compile_recipe, inspect
from batik_vector.errors import RecipeError
from batik_vector.geometry.curves import Circle, Spiral, Superellipse
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Flower, Rosette, Treatment
from batik_vector.tiling.cloth.field import repeated
from batik_vector.tiling.layouts import Julian, Lattice, Layout, Single
from batik_vector.tiling.symmetry.groups import GROUPS, Group, group
from batik_vector.tiling.symmetry.machine_fit import Fit
from batik_vector.tiling.symmetry.repeats import MIRRORS, TileSpec
from batik_vector.tiling.symmetry.spread import Spread

LEAF = Element(curve=Superellipse(0.5, 3, 1.0, 0.4), name="leaf", ink="wax")
DOT = Element(curve=Circle(0.25), radius=0.9, turn=50, name="dot", ink="wax")
TENDRIL = Element(
    curve=Spiral(revolutions=1.5, radius=0.7), turn=20, radius=0.8, treatment=Treatment.STROKE, ink="indigo"
)
COMMA = Rosette(elements=(LEAF, DOT, TENDRIL))
INKS = {"indigo": InkSpec(width=1.2), "wax": InkSpec()}
every = pytest.mark.parametrize("name", GROUPS)


def tile(repeat: str, width: float = 60.0, **more: Any) -> TileSpec:
    kind = group(repeat).kind if repeat in GROUPS else None
    ratio = (kind.ratio if kind else None) or 0.8
    return TileSpec(size=(width, round(width * ratio, 3)), repeat=repeat, **more)


def compiled(spec: TileSpec, *placements: Placement, motif: Any = COMMA, overlap: str = "weld") -> Artwork:
    inks = {name: replace(ink, overlap=Overlap(overlap)) for name, ink in INKS.items()}
    return compile_recipe(Recipe(motif={"m": motif}, place=placements, tile=spec, ink=inks))


def asymmetry(artwork: Artwork, known: Group, phase: tuple[float, float] = (0.0, 0.0)) -> int:
    """Return how many of some hundred places and their images differ in ink, borders left out."""
    width, height = artwork.cell.width, artwork.cell.height
    chance = random.Random(1)
    places = np.array([(chance.random() * width, chance.random() * height) for _ in range(300)])
    differ = 0
    for layer in artwork.layers:
        tree = shapely.STRtree(layer.areas)
        edges = shapely.STRtree(shapely.boundary(layer.areas))
        here, clear = inked(tree, edges, places)
        for each in known.operations[1:]:
            shares = (places - phase) / [width, height]
            linear = np.array([[each.a, each.b], [each.c, each.d]], float)
            shares = shares @ linear.T + np.array(each.shift, float)
            images = (shares * [width, height] + phase) % [width, height]
            there, clear_there = inked(tree, edges, images)
            differ += int(((here != there) & clear & clear_there).sum())
    return differ


def inked(tree: shapely.STRtree, edges: shapely.STRtree, places: Any) -> tuple[Any, Any]:
    points = shapely.points(places)
    inside, clear = np.zeros(len(points), bool), np.ones(len(points), bool)
    inside[tree.query(points, predicate="within")[0]] = True
    clear[edges.query(points, predicate="dwithin", distance=0.01)[0]] = False
    return inside, clear


@every
@pytest.mark.parametrize("spread", Spread)
def test_the_drawing_has_the_symmetry_that_was_asked_for(name: str, spread: Spread) -> None:
    at = (13.0, 7.3) if spread == Spread.FREE else None
    placement = Placement(motif="m", scale=14.0, turn=17, region=spread, at=at, phase=(3.0, -2.0))
    artwork = compiled(tile(name), placement)
    assert violations(artwork) == []
    assert inspect(artwork)["seam"] == []
    assert asymmetry(artwork, GROUPS[name], (3.0, -2.0)) == 0
    if name not in ("p1", "p6m"):
        # The test can fail: without the phase the places differ.
        assert asymmetry(artwork, GROUPS["p6m"] if "6" in name else GROUPS["p4m"]) > 0


@every
def test_a_rectangle_holds_the_copies_that_the_table_says(name: str) -> None:
    small = Rosette(elements=(replace(LEAF, ink=""), replace(DOT, curve=Circle(0.3), ink="")))
    artwork = compiled(
        tile(name), Placement(motif="m", scale=1.0, turn=17, region=Spread.CENTRE, ink="wax"), motif=small
    )
    whole = repeated(artwork, 2, 2).layers[0]
    alone = compiled(tile("p1"), Placement(motif="m", scale=1.0, turn=17, ink="wax"), motif=small).layers[0]
    area, once = shapely.area(whole.areas).sum() / 4, shapely.area(alone.areas).sum()
    assert area / once == pytest.approx(GROUPS[name].copies, rel=1e-3)


@pytest.mark.parametrize(
    ("repeat", "at", "flowers"),
    [
        ("p4m", (0.0, 0.0), 1),
        ("p4m", (30.0, 30.0), 1),
        ("p4m", (30.0, 0.0), 2),
        ("p4m", (10.0, 0.0), 4),
        ("p6m", (0.0, 0.0), 2),
        ("p6m", (30.0, 0.0), 6),
        ("p2", (0.0, 24.0), 1),
        ("cm", (0.0, 11.0), 2),
        ("pg", (0.0, 11.0), 2),
    ],
)
def test_a_flower_on_a_mirror_or_a_centre_is_drawn_once(
    repeat: str, at: tuple[float, float], flowers: int
) -> None:
    # Twelve-fold with mirrors, as every place of every group would have it.
    dots = Rosette(elements=(Element(curve=Circle(0.1), count=12, radius=1.0, ink="wax"),))
    artwork = compiled(tile(repeat), Placement(motif="m", scale=5.0, at=at), motif=dots, overlap="overlay")
    whole = repeated(artwork, 2, 2).layers[0].areas
    discs = shapely.area(whole).sum() / (np.pi * 0.25)
    assert discs / 4 == pytest.approx(12 * flowers, rel=0.1)


def test_coinciding_images_at_the_edges_of_the_cell_are_drawn_once_whatever_the_phase() -> None:
    dot = Rosette(elements=(Element(curve=Circle(1.0), ink="wax"),))
    for phase in [(0.0, 0.0), (1e-9, -1e-9), (30.0, 30.0), (59.9999, 17.0)]:
        placement = Placement(motif="m", scale=2.0, at=(0.0, 0.0), phase=phase)
        artwork = compiled(tile("p4m"), placement, motif=dot, overlap="overlay")
        assert shapely.area(artwork.layers[0].areas).sum() == pytest.approx(4 * np.pi, rel=0.02)


@pytest.mark.parametrize("name", [*GROUPS, *MIRRORS])
def test_what_covers_the_region_covers_the_cloth_without_a_slit(name: str) -> None:
    disc = Rosette(elements=(Element(curve=Circle(1.0), ink="wax"),))
    chance = random.Random(7)
    for _ in range(5):
        # Odd numbers of steps, a little stretch, any phase.
        width = chance.randrange(30_001, 60_000, 2) / 1000
        height = tile(name, width).size[1] * (1 + 0.015 * (chance.random() - 0.5))
        phase = (50 * chance.random(), 50 * chance.random())
        spec = TileSpec(size=(width, round(height, 3)), repeat=name)
        ground = Placement(motif="m", scale=60.0, region=Spread.CUT, phase=phase)
        areas = compiled(spec, ground, motif=disc).layers[0].areas
        assert len(areas) == 1
        # Slits between pieces would be a step wide and as long as an edge; overlays leave specks of less.
        assert shapely.area(areas[0]) == pytest.approx(spec.cell().width * spec.cell().height, abs=1e-9)


@pytest.mark.parametrize(
    ("repeat", "cell"), [("mirror", (60, 48)), ("mirror-x", (60, 24)), ("mirror-y", (30, 48))]
)
def test_a_mirror_repeat_reflects_the_unit_at_its_edges(repeat: str, cell: tuple[int, int]) -> None:
    spec = TileSpec(size=(30.0, 24.0), repeat=repeat)
    artwork = compiled(spec, Placement(motif="m", scale=14.0, turn=30))
    assert (artwork.cell.width, artwork.cell.height) == cell
    assert asymmetry(artwork, group(MIRRORS[repeat][0])) == 0
    # The unit itself is the plain one, cut at the edges that mirror.
    plain = compiled(TileSpec(size=(60.0, 48.0)), Placement(motif="m", scale=14.0, turn=30, at=(15.0, 12.0)))
    inner = shapely.box(6, 6, 24, 18)
    for one, other in zip(artwork.layers, plain.layers, strict=True):
        mine, its = (shapely.intersection(shapely.union_all(each.areas), inner) for each in (one, other))
        assert shapely.symmetric_difference(mine, its).area < 1e-3 * its.area


@pytest.mark.parametrize("name", ["p4", "p3m1", "cmm"])
@pytest.mark.parametrize("layout", [Julian(dist=4 * 0.618, level=1), Julian(power=3, dist=3.0)])
@pytest.mark.parametrize("spread", Spread)
def test_layouts_are_multiplied_whether_they_bend_or_not(name: str, layout: Layout, spread: Spread) -> None:
    placement = Placement(motif="m", layout=layout, width=22.0, turn=17, region=spread)
    artwork = compiled(tile(name), placement)
    assert violations(artwork) == []
    assert asymmetry(artwork, GROUPS[name]) == 0


def test_a_bent_layout_with_the_symmetry_of_its_place_is_drawn_once() -> None:
    placement = Placement(motif="m", layout=Julian(dist=4 * 0.618, level=1), width=40.0, ink="wax")
    alone = compiled(tile("p1"), placement, motif=Flower())
    turned = compiled(tile("p4m"), replace(placement, at=(30.0, 30.0)), motif=Flower())
    assert turned.vertex_count == pytest.approx(alone.vertex_count, rel=0.02)


def test_a_ground_of_dots_flows_behind_a_motif_with_a_gap_on_the_torus() -> None:
    dots = Rosette(elements=(Element(curve=Circle(1.0), ink="indigo"),))
    ground = Placement(motif="dots", scale=1.0, layout=Lattice(columns=20, rows=16))
    motif = Placement(motif="m", scale=14.0, at=(1.0, 2.0), gap=1.5, symmetry="p2")
    recipe = Recipe(
        motif={"m": Rosette(elements=(replace(LEAF, treatment=Treatment.STROKE), DOT)), "dots": dots},
        place=(ground, motif),
        tile=TileSpec(size=(60.0, 48.0)),
        ink={"indigo": InkSpec(), "wax": InkSpec(width=1.0)},
    )
    artwork = compile_recipe(recipe)
    low, high = (shapely.union_all(repeated(artwork, 2, 2).layers[i].areas) for i in (0, 1))
    assert shapely.distance(low, high) == pytest.approx(1.5, abs=0.03)
    # What a stroke encloses is bare too.
    leaf = shapely.union_all([shapely.Polygon(part.exterior) for part in shapely.get_parts(high)])
    assert not shapely.intersects(low, leaf)
    bare = compile_recipe(replace(recipe, place=(ground, replace(motif, gap=None))))
    assert shapely.area(bare.layers[0].areas).sum() > shapely.area(artwork.layers[0].areas).sum() + 100


def test_a_gap_cuts_what_is_beneath_and_not_what_is_above_nor_the_motif_itself() -> None:
    disc = Rosette(elements=(Element(curve=Circle(1.0)),))
    low = Placement(motif="m", scale=20.0, ink="indigo", at=(30.0, 24.0))
    high = Placement(motif="m", scale=10.0, ink="wax", at=(30.0, 24.0), gap=2.0)
    spec = TileSpec(size=(60.0, 48.0))
    under = compiled(spec, low, high, motif=disc)
    over = compiled(spec, high, low, motif=disc)
    ring = np.pi * (20**2 - 12**2)
    assert shapely.area(under.layers[0].areas).sum() == pytest.approx(ring, rel=0.005)
    assert shapely.area(under.layers[1].areas).sum() == pytest.approx(np.pi * 100, rel=0.005)
    assert shapely.area(over.layers[0].areas).sum() == pytest.approx(np.pi * 400, rel=0.005)


def test_placements_of_one_tile_have_their_own_symmetry_and_phase() -> None:
    dot = Rosette(elements=(Element(curve=Circle(1.0)),))
    artwork = compiled(
        tile("p4m"),
        Placement(motif="m", scale=1.0, at=(9.0, 4.0), ink="indigo", symmetry="p4", phase=(1.0, 2.0)),
        Placement(motif="m", scale=1.0, at=(9.0, 4.0), ink="wax"),
        motif=dot,
    )
    assert [len(layer.areas) for layer in artwork.layers] == [4, 8]
    turned, mirrored = (replace(artwork, layers=(layer,)) for layer in artwork.layers)
    assert asymmetry(turned, GROUPS["p4"], (1.0, 2.0)) == 0
    assert asymmetry(mirrored, GROUPS["p4m"]) == 0


def test_a_half_drop_is_a_centred_lattice() -> None:
    spec = TileSpec(size=(40.0, 36.0), repeat="half-drop")
    for name, another in (("p2", "pm"), ("cm", "p2"), ("cmm", "pmg")):
        artwork = compiled(spec, Placement(motif="m", scale=9.0, turn=17, region=Spread.CUT, symmetry=name))
        assert artwork.cell.width == 80
        assert asymmetry(artwork, GROUPS[name]) == 0
        assert asymmetry(artwork, GROUPS[another]) > 0


def test_a_stretch_keeps_line_widths_and_gaps_true() -> None:
    ring = Element(curve=Circle(1.0), treatment=Treatment.STROKE, ink="indigo")
    ground = Element(curve=Circle(1.0), ink="wax")
    spec = TileSpec(size=(60.0, 50.0), fit=Fit(width=640.0, height=500.0, limit=7.0))
    assert spec.stretch == pytest.approx((640 / 11 / 60, 1.0), abs=1e-5)
    thin = compiled(spec, Placement(motif="m", scale=10.0), motif=Rosette(elements=(ring,)))
    low, _, high, _ = shapely.total_bounds(thin.layers[0].areas)
    across = 640 / 11 / 60
    assert high - low == pytest.approx(20 * across + 1.2, abs=0.01)
    (hole,) = shapely.get_rings(thin.layers[0].areas)[1:]
    assert hole.bounds[2] - hole.bounds[0] == pytest.approx(20 * across - 1.2, abs=0.02)
    under = Placement(motif="m", scale=24.0)
    over = replace(under, scale=8.0, gap=2.0)
    cut = compiled(spec, under, over, motif=Rosette(elements=(ground,)), overlap="weld")
    disc, rest = sorted(cut.layers[0].areas, key=shapely.area)
    assert shapely.distance(disc, rest) == pytest.approx(2.0, abs=0.03)


def test_the_stretch_of_a_cell_that_is_a_little_off_is_in_the_drawing() -> None:
    artwork = compiled(
        TileSpec(size=(60.0, 60.3), repeat="p4"), Placement(motif="m", scale=9.0, at=(13.0, 7.0))
    )
    assert (artwork.cell.width, artwork.cell.height) == (60.0, 60.3)
    assert asymmetry(artwork, GROUPS["p4"]) == 0


@pytest.mark.parametrize(
    ("symmetry", "words"), [("p4", "p4 does not"), ("p6", "p6 does not"), ("p5", "unknown group")]
)
def test_a_symmetry_that_does_not_fit_is_refused_with_its_key(symmetry: str, words: str) -> None:
    with pytest.raises(RecipeError) as told:
        compiled(TileSpec(size=(60.0, 48.0)), Placement(motif="m", scale=9.0, symmetry=symmetry))
    assert words in str(told.value)
    if symmetry != "p5":
        assert told.value.faults[0].key == "place[0].symmetry"
        assert "expected one of p1, p2, pm" in str(told.value)


def test_a_lattice_in_a_group_counts_each_place_once() -> None:
    dot = Rosette(elements=(Element(curve=Circle(1.0), ink="wax"),))
    ground = Placement(motif="m", scale=1.0, layout=Lattice(columns=6, rows=6))
    artwork = compiled(tile("p4m"), ground, motif=dot, overlap="overlay")
    assert len(artwork.layers[0].areas) == 36


def test_images_count_in_the_limit() -> None:
    recipe = Recipe(
        motif={"m": Flower()},
        place=(Placement(motif="m", width=9.0, layout=Single(), at=(13.0, 7.0)),),
        tile=tile("p6m"),
        limit=5000,
    )
    with pytest.raises(RecipeError, match="past the limit of 5,000"):
        compile_recipe(recipe)
    compile_recipe(replace(recipe, tile=tile("p1")))


def test_a_mark_that_reaches_over_too_many_repeats_is_refused_before_it_is_cut() -> None:
    placement = Placement(motif="m", scale=10_000.0, region=Spread.CUT)
    with pytest.raises(RecipeError, match=r"place\[0\]: a mark reaches over about [\d,]+ repeats"):
        compiled(TileSpec(size=(1.0, 1.0), repeat="p4m"), placement)
