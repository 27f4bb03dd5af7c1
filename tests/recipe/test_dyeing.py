"""Baths in a recipe: which colours they give, and what stays as it was written."""

from __future__ import annotations

import pickle
from dataclasses import replace

from batik_vector import compile_recipe
from batik_vector.artwork.overdyeing import overdyed
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.model import InkSpec, Recipe

BATHS = """
[[bath]]
name = "indigo"
colour = "#2b4a8b"
[[bath]]
name = "soga"
colour = "#9a6233"
"""
DESIGN = """
[motif.dot]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 4 }, ink = "cotton" }]
[[place]]
motif = "dot"
scale = 1
[tile]
size = [20, 20]
"""
INKS = '[ink.cotton]\nbaths = []\n[ink.blue]\nbaths = ["indigo"]\n[ink.black]\nbaths = ["soga", "indigo"]\n'


def recipe(inks: str = INKS, cloth: str = "") -> Recipe:
    return read_recipe(BATHS + inks + cloth + DESIGN)


def colours(made: Recipe) -> dict[str, str]:
    return {name: ink.colour for name, ink in made.ink.items()} | {"cloth": made.cloth.colour}


def test_baths_give_colours() -> None:
    both = overdyed("#f4efe2", ["#2b4a8b", "#9a6233"])
    assert colours(recipe()) == {"cotton": "#f4efe2", "blue": "#2b4a8b", "black": both, "cloth": both}


def test_a_colour_that_is_given_holds_for_all_that_sees_the_same() -> None:
    made = recipe(INKS + 'colour = "#151a2e"\n', '[cloth]\nundyed = "#ffffff"\n')
    assert colours(made) == {
        "cotton": "#ffffff",
        "blue": "#2b4a8b",
        "black": "#151a2e",
        "cloth": "#151a2e",
    }


def test_the_ground_may_stay_undyed_or_see_some_baths() -> None:
    inks = INKS.replace('["indigo"]', '["soga"]')
    assert colours(recipe(inks, "[cloth]\nbaths = []\n"))["cloth"] == "#f4efe2"
    assert colours(recipe(inks, '[cloth]\nbaths = ["indigo"]\n'))["cloth"] == "#2b4a8b"


def test_colours_stay_when_a_recipe_is_made_again_from_itself() -> None:
    made = recipe()
    assert colours(replace(made, seed=7)) == colours(made)
    assert colours(pickle.loads(pickle.dumps(made))) == colours(made)


def test_the_artwork_knows_its_baths() -> None:
    page = compile_recipe(recipe())
    assert page.dyeing is not None
    assert page.dyeing.names == ("indigo", "soga")
    assert page.dyeing.listed(page.dyeing.inks["black"]) == ("indigo", "soga")
    assert page.dyeing.ground == {"indigo", "soga"}


def test_without_baths_all_is_as_it_was() -> None:
    made = read_recipe("[ink.cotton]\n" + DESIGN)
    assert colours(made) == {"cotton": "#1a1a1a", "cloth": "#ffffff"}
    assert made.dyeing is None
    assert compile_recipe(made).dyeing is None
    assert InkSpec() == InkSpec(colour="#1a1a1a")
