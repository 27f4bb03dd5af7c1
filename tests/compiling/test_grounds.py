"""Grounds in recipes: tosses that nest, lines beneath a gap, and what is drawn in the end."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest
import shapely

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, Geometries, Ink, violations
from batik_vector.compiling.compiler import inspect
from batik_vector.compiling.placements import Placed, place
from batik_vector.geometry.curves import Circle, Segment, Superellipse
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.recipe.reading.builder import built
from batik_vector.recipe.reading.validator import validated
from batik_vector.tiling.cloth.field import repeated
from batik_vector.tiling.layouts import Clear, Lattice, Layout, Stripes, Toss
from batik_vector.tiling.symmetry.repeats import TileSpec
from batik_vector.tiling.welding.congruent import polygons

LEAF = Rosette(elements=(Element(curve=Superellipse(a=1.0, b=1.3, length=6, width=2.4)),))
DOT = Rosette(elements=(Element(curve=Circle(1.0)),))
RING = Rosette(elements=(Element(curve=Circle(1.6), treatment=Treatment.STROKE),))
LINE = Rosette(elements=(Element(curve=Segment(), treatment=Treatment.STROKE),))
INKS = {
    "leaf": InkSpec(colour="#f4efe2"),
    "dot": InkSpec(colour="#a86f3a"),
    "ring": InkSpec(colour="#1d2f5f", width=0.8),
}


def laid(motif: str | tuple[str, ...], layout: Layout, **more: object) -> Placement:
    ink = motif if isinstance(motif, str) else motif[0]
    more = {"scale": 1.0, "ink": ink if ink in INKS else "ring", **more}
    return Placement(motif=motif, layout=layout, **more)  # type: ignore[arg-type]


def recipe(*places: Placement, repeat: str = "grid", seed: int = 1) -> Recipe:
    return Recipe(
        motif={"leaf": LEAF, "dot": DOT, "ring": RING, "line": LINE},
        place=places,
        tile=TileSpec(size=(48, 48), repeat=repeat),
        tolerance=0.05,
        ink=INKS,
        seed=seed,
    )


def marks(artwork: Artwork) -> Geometries:
    """All whole marks of a field of tiles, filled."""
    field = repeated(artwork, 3, 3)
    areas = np.concatenate([layer.areas for layer in field.layers])
    filled = np.asarray(shapely.polygons(shapely.get_exterior_ring(areas)), dtype=object)
    width, height = field.cell.width, field.cell.height
    bounds = shapely.bounds(filled)
    inside = (bounds > 0).all(axis=1) & (bounds[:, 2] < width) & (bounds[:, 3] < height)
    return filled[inside]


def least_gap(shapes: Geometries) -> float:
    i, j = shapely.STRtree(shapes).query(shapes, predicate="dwithin", distance=6.0)
    apart = shapely.distance(shapes[i], shapes[j])[i < j]
    return float(apart.min())


@pytest.mark.parametrize("repeat", ["grid", "half-drop", "brick 1/3", "p4g", "pgg", "p2"])
def test_what_is_drawn_keeps_the_distance_across_every_seam(repeat: str) -> None:
    heroes = laid("leaf", Toss(count=1, distance=2.5, size=(0.8, 1.2)))
    fillers = laid(("dot", "ring"), Toss(distance=1.5, tries=200))
    artwork = compile_recipe(recipe(heroes, fillers, repeat=repeat))
    assert violations(artwork) == []
    assert inspect(artwork)["seam"] == []
    found = marks(artwork)
    assert len(found) > 50
    assert least_gap(found) >= 1.5


def test_an_earlier_toss_may_be_fallen_upon_where_the_recipe_says_so() -> None:
    heroes = laid("leaf", Toss(count=8, distance=1))
    apart, over = (
        compile_recipe(recipe(heroes, laid("dot", Toss(distance=1, clear=clear))))
        for clear in (Clear.TOSSED, Clear.NONE)
    )

    def covered(artwork: Artwork) -> float:
        leaves, dots = (shapely.union_all(layer.areas) for layer in artwork.layers)
        return float(shapely.area(shapely.intersection(leaves, dots)))

    assert covered(apart) == 0
    assert covered(over) > 1


def test_what_was_set_by_hand_is_kept_clear_of_where_all_is() -> None:
    row = laid("leaf", Lattice(columns=2, rows=3))
    artwork = compile_recipe(recipe(row, laid("dot", Toss(distance=1.2, clear=Clear.ALL))))
    assert least_gap(marks(artwork)) >= 1.2


def test_the_gap_of_a_toss_does_not_cut_the_toss_beneath() -> None:
    heroes = laid("leaf", Toss(count=6, distance=1))
    fillers = laid("dot", Toss(distance=1), gap=2.0)
    leaves = compile_recipe(recipe(heroes, fillers)).layers[0]
    alone = compile_recipe(recipe(heroes)).layers[0]
    assert shapely.area(leaves.areas).sum() == pytest.approx(shapely.area(alone.areas).sum(), abs=1e-6)


def test_a_cut_beyond_the_body_keeps_others_away() -> None:
    haloed = Rosette(elements=(Element(curve=Circle(1.0), gap=3.0),))
    one = Recipe(
        motif={"m": haloed},
        place=(Placement(motif="m", layout=Toss(distance=0.5), scale=1),),
        tile=TileSpec(size=(48, 48)),
        tolerance=0.05,
    )
    assert least_gap(marks(compile_recipe(one))) >= 3.0


def toss_of(one: Recipe) -> Placed:
    inks = {name: Ink(name, spec.colour, spec.width) for name, spec in one.ink.items()}
    return place(one.place[0], one, one.tiling.unit(), inks, one.limit)


def test_the_report_of_a_toss_is_at_hand() -> None:
    placed = toss_of(recipe(laid(("leaf", "dot"), Toss(count=9, weights=(1, 2)))))
    assert placed.tossed
    report = placed.tossed.report
    assert report.motifs == ("leaf", "dot")
    assert report.counts == (3, 6)
    drawn = sum(float(shapely.area(polygons(sheet.areas)).sum()) for sheet in placed.sheets)
    assert report.covers == pytest.approx(drawn / 48**2, rel=0.02)


def covers(*places: Placement, seed: int = 1) -> shapely.Geometry:
    return shapely.union_all(compile_recipe(recipe(*places, seed=seed)).layers[0].areas)


def test_two_tosses_do_not_fall_alike_unless_they_have_one_seed() -> None:
    loose, bound = (laid("dot", Toss(count=5, clear=Clear.NONE, seed=seed)) for seed in (None, 7))
    assert shapely.area(covers(loose, loose)) > 1.5 * shapely.area(covers(loose))
    assert shapely.equals(covers(bound, bound), covers(bound))


def test_the_recipes_seed_moves_every_toss() -> None:
    dots = laid("dot", Toss(count=5))
    assert not shapely.equals(covers(dots, seed=1), covers(dots, seed=2))


def test_lines_beneath_a_gap_end_where_it_begins() -> None:
    lines = laid("line", Stripes(count=12, winding=(1, 1)), scale=10.0)
    leaf = laid("leaf", Lattice(columns=1, rows=1), gap=2.0)
    artwork = compile_recipe(recipe(lines, leaf))
    leaves, rules = artwork.layers
    assert shapely.distance(shapely.union_all(leaves.areas), shapely.union_all(rules.areas)) >= 1.94
    assert inspect(artwork)["seam"] == []


TEXT = """
[motif.a]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 1.0 } }]
[motif.b]
kind = "rosette"
elements = [{ curve = { kind = "wave", amplitude = 0.1 }, treatment = "stroke" }]
[[place]]
motif = ["a", "b"]
scale = "1 mm"
layout = { kind = "toss", count = 3, turns = [0, 90], size = [0.5, 1], weights = [2, 1], clear = "all" }
[[place]]
motif = "b"
scale = "1 cm"
layout = { kind = "stripes", count = 3, winding = [1, -1] }
[[place]]
motif = ["a"]
scale = "1 mm"
layout = { kind = "rosette", group = "c5", shift = [3, 0] }
[tile]
size = ["40 mm", "40 mm"]
"""


def test_recipes_say_it_all_and_both_readers_agree() -> None:
    one = read_recipe(TEXT)
    assert one.place[0].motifs == ("a", "b")
    assert one.place[2].motifs == ("a",)
    data = tomllib.loads(TEXT)
    slow, faults = validated(data, Recipe)
    assert faults == []
    assert built(Recipe, data) == slow
    assert violations(compile_recipe(one)) == []
