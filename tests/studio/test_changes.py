from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
import shapely

from batik_vector import Artwork, Flower, compile_recipe
from batik_vector.errors import RecipeError
from batik_vector.studio.changes import (
    duplicated,
    pasted,
    renamed,
    reset,
    scaled,
    turned,
    variations,
)
from batik_vector.studio.drafts import Draft
from batik_vector.studio.mirroring import mirrored
from tests.studio.test_drafts import FLOWER
from tests.studio.text.test_rewriting import comments
from tests.thorough import slow

SAMPLES = Path(__file__).parents[2] / "samples"


def compiled(draft: Draft) -> Artwork:
    return compile_recipe(replace(draft.recipe, tolerance=0.1))


def painted(artwork: Artwork) -> dict[str, shapely.Geometry]:
    return {layer.ink.name: shapely.union_all(layer.areas) for layer in artwork.layers}


def apart(one: shapely.Geometry, other: shapely.Geometry) -> float:
    return float(shapely.area(shapely.symmetric_difference(one, other)) / shapely.area(one))


@pytest.mark.parametrize(
    ("name", "upright"),
    [
        ("group-p4g", True),
        ("group-p4g", False),
        pytest.param("lasem-bird", False, marks=slow),
        ("trellis", True),
    ],
)
def test_a_design_is_mirrored_and_mirrored_back(name: str, upright: bool) -> None:
    draft = Draft.read(SAMPLES / f"{name}.toml")
    other = mirrored(draft, upright=upright)
    assert comments(other.text) == comments(draft.text)
    before, after = compiled(draft), compiled(other)
    width, height = before.cell.width, before.cell.height
    flip, move = ((-1, 1), (width, 0)) if upright else ((1, -1), (0, height))
    most = 1e-2 if name == "lasem-bird" else 1e-3  # rows of a ground begin where its region does
    for ink, areas in painted(before).items():
        image = shapely.transform(areas, lambda points: points * flip + move)
        assert apart(image, painted(after)[ink]) < most
    if name != "lasem-bird":
        again = painted(compiled(mirrored(other, upright=upright)))
        for ink, areas in painted(before).items():
            assert apart(areas, again[ink]) < 1e-3


def test_a_drop_falls_the_other_way_when_it_is_mirrored() -> None:
    draft = Draft(FLOWER).with_value("tile.repeat", "drop 1/3")
    assert mirrored(draft).value("tile.repeat") == "drop 2/3"
    assert mirrored(draft, "place[0]").value("tile.repeat") == "drop 1/3"


SIDED = """
title = "Sided"
tolerance = "0.1 mm"
[motif.a]
kind = "rosette"
elements = [
  { curve = { kind = "superellipse", a = 1, b = 1, length = 6, width = 2 }, radius = 3 },
  { curve = { kind = "circle", radius = 1 }, radius = 4, turn = 40 },
]
[ink.wax]
[[place]]
motif = "a"
scale = "1 mm"
layout = LAYOUT
[[place]]
motif = "a"
scale = "0.5 mm"
layout = { kind = "toss", distance = "2 mm", count = 6 }
[tile]
size = ["60 mm", "40 mm"]
repeat = "REPEAT"
"""
LAYOUTS = {
    "toss": '{ kind = "toss", distance = "2 mm", count = 5 }',
    "bent": '{ kind = "julian" }',
    "stripes": '{ kind = "stripes", count = 2, flip = true, winding = [1, 1] }',
    "lattice": '{ kind = "lattice", columns = 3, rows = 2, turn = 20 }',
}


@pytest.mark.parametrize("upright", [True, False], ids=["across", "down"])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_kind_of_placement_is_mirrored(layout: str, upright: bool) -> None:
    draft = Draft(SIDED.replace("LAYOUT", LAYOUTS[layout]).replace("REPEAT", "grid"))
    other = mirrored(draft, upright=upright)
    flip, move = ((-1, 1), (60, 0)) if upright else ((1, -1), (0, 40))
    before, after = (painted(compiled(each))["wax"] for each in (draft, other))
    assert apart(shapely.transform(before, lambda points: points * flip + move), after) < 1e-3
    assert apart(before, after) > 0.1
    assert mirrored(other, upright=upright).recipe.place == draft.recipe.place


def test_mirrored_both_ways_is_turned_by_half_a_turn() -> None:
    draft = Draft(SIDED.replace("LAYOUT", LAYOUTS["toss"]).replace("REPEAT", "drop 1/3"))
    both = mirrored(mirrored(draft), upright=False)
    assert both.value("place[0].mirror") == "both"
    assert both.value("tile.repeat") == "drop 1/3"
    assert mirrored(mirrored(both), upright=False).recipe.place == draft.recipe.place


def test_a_placement_that_is_none_is_told() -> None:
    with pytest.raises(RecipeError, match="no placement"):
        mirrored(Draft(FLOWER), "motif.a")


def test_placements_are_turned_each_about_its_own_place() -> None:
    draft = turned(Draft(FLOWER), 30)
    assert draft.value("place[0].turn") == 30
    assert turned(draft, -30).value("place[0].turn") == 0
    assert turned(draft, 340).value("place[0].turn") == 10
    tossed = Draft.read(SAMPLES / "toss-leaves.toml")
    assert turned(tossed, 30).faults == ()


@pytest.mark.parametrize("name", ["trellis", "kawung"])
def test_a_design_scaled_is_the_same_larger(name: str) -> None:
    draft = Draft.read(SAMPLES / f"{name}.toml")
    before, after = compiled(draft), compile_recipe(replace(scaled(draft, 2).recipe, tolerance=0.2))
    assert after.cell.width == pytest.approx(2 * before.cell.width, rel=1e-4)
    for ink, areas in painted(before).items():
        share = shapely.area(areas) / (before.cell.width * before.cell.height)
        other = shapely.area(painted(after)[ink]) / (after.cell.width * after.cell.height)
        assert other == pytest.approx(share, rel=0.03)
    assert compiled(scaled(scaled(draft, 2), 0.5)).cell == before.cell


def test_one_placement_is_scaled_alone() -> None:
    draft = scaled(Draft(FLOWER), 0.5, "place[0]")
    assert draft.value("place[0].width") == "14 cm"
    assert draft.value("tile.size") == ["300 mm", 300]
    for factor in (0, -1, float("nan"), 1e9):
        with pytest.raises(RecipeError, match=r"expected 0\.001 to 1000"):
            scaled(draft, factor)


def test_a_reset_flower_is_the_papers() -> None:
    draft = Draft.read(SAMPLES / "four-square.toml")
    flower = reset(draft, "motif.flower").recipe.motif["flower"]
    paper = Draft(FLOWER.replace("petal = { count = 8 }", "")).recipe.motif["a"]
    assert isinstance(flower, Flower)
    assert isinstance(paper, Flower)
    assert [(part.name, part.count, part.curve) for part in flower.parts()] == [
        (part.name, part.count, part.curve) for part in paper.parts()
    ]
    kept = reset(draft.locking("motif.flower.petal"), "motif.flower")
    assert kept.value("motif.flower.petal.count") == 4
    for path in ("motif", "place", "place[0]", "tile", "motif.under.elements[0]", "ink.wax", "nothing"):
        assert reset(draft, path).faults == (), path


def test_members_are_doubled_beside_themselves() -> None:
    draft = Draft.read(SAMPLES / "four-square.toml")
    more, path = duplicated(draft, "place[1]")
    assert path == "place[2]"
    assert more.tables["place"][1] == more.tables["place"][2] == draft.tables["place"][1]
    more, path = duplicated(draft, "ink.light")
    assert (path, list(more.tables["ink"])) == ("ink.light-2", ["light", "light-2", "wax"])
    more, path = duplicated(draft, "motif.flower")
    assert more.tables["motif"]["flower-2"] == draft.tables["motif"]["flower"]
    more, path = duplicated(draft, "motif.under.elements[0]")
    assert len(more.recipe.motif["under"].parts()) == 5
    with pytest.raises(RecipeError, match="nothing stands there"):
        duplicated(draft, "motif.rose")


def test_a_variation_is_the_same_for_a_seed_and_leaves_alone_what_is_locked() -> None:
    draft = Draft.read(SAMPLES / "four-square.toml").locking("motif.flower").locking("motif.bud.core.length")
    one, other = next(variations(draft, 7)), next(variations(draft, 8))
    assert one == next(variations(draft, 7))
    assert one.text != other.text != draft.text
    some = [each for each, _ in zip(variations(draft, 3, reach=1.0), range(3), strict=False)]
    assert len({each.text for each in some}) == 3
    for each in some:
        assert each.value("motif.flower") == draft.value("motif.flower")
        assert each.value("motif.bud.core.length") == draft.value("motif.bud.core.length")
        assert each.value("place") == draft.value("place")
        assert comments(each.text) == comments(draft.text)
    with pytest.raises(RecipeError, match="all are locked"):
        next(variations(draft.locking("motif"), 1))


def test_what_is_copied_can_be_pasted_elsewhere() -> None:
    source = Draft.read(SAMPLES / "four-square.toml")
    draft, paths = pasted(Draft(FLOWER), source.copied("motif.bud") + source.copied("ink.light"))
    assert paths == ("motif.bud", "ink.light")
    assert draft.faults == ()
    twice, paths = pasted(
        draft, source.copied("motif.bud") + '[[place]]\nmotif = "bud"\nwidth = 20\nink = "wax"\n'
    )
    assert paths == ("motif.bud-2", "place[1]")
    assert twice.value("place[1].motif") == "bud-2"
    assert twice.faults == ()
    whole, paths = pasted(draft, source.copied())
    assert (whole.text, paths) == (source.text, ())
    for text in ("", "no toml ["):
        with pytest.raises(RecipeError):
            pasted(draft, text)


def test_a_name_is_changed_wherever_it_is_used() -> None:
    draft = Draft.read(SAMPLES / "four-square.toml")
    other = renamed(renamed(draft, "motif.flower", "a rose"), "ink.light", "sky")
    assert other.faults == ()
    assert comments(other.text) == comments(draft.text)
    assert list(other.tables["motif"]) == ["under", "a rose", "beads", "knot", "bud"]
    assert list(other.tables["ink"]) == ["sky", "wax"]
    assert other.value("place[1].motif") == "a rose"
    before, after = painted(compiled(draft)), painted(compiled(other))
    assert apart(before["light"], after["sky"]) == 0
    for path, name in (("motif.flower", "under"), ("motif.rose", "x"), ("tile", "x"), ("ink.wax", " ")):
        with pytest.raises(RecipeError):
            renamed(draft, path, name)
    assert renamed(draft, "ink.wax", "wax") is draft
