"""The sweep of all bounds (`python -m tools.bounds`) reaches every numeric key that the schema has."""

from __future__ import annotations

import random

import pytest

from batik_vector.errors import RecipeError
from batik_vector.recipe.loading import read_recipe
from tests.thorough import examples, long
from tools.numeric_keys import keys, recipe_with

KEYS = {str(key): key for key in keys()}
SHARED = (
    "Beak.length",
    "Growth.count",
    "hatch.spiral.spacing",
    "process.cut.kerf",
    "curve.fourier.points[*][*]",
)
STEP = examples(40, 1)


def test_the_keys_are_those_of_every_room() -> None:
    assert set(SHARED) <= set(KEYS)


@long
@pytest.mark.parametrize("recipe", ["four-square", "kawung"])
@pytest.mark.parametrize("name", [*SHARED, *list(KEYS)[::STEP]])
def test_a_sample_takes_each(recipe: str, name: str) -> None:
    """What is refused is refused for its value or what stands beside it, not for a key that is not there."""
    key = KEYS[name]
    text = recipe_with(recipe, key, next(iter(key.values(0))), random.Random(0))
    assert f"{key.name} = " in text
    assert not any(words in refusal(text) for words in ("unknown", "missing"))


def refusal(text: str) -> str:
    """Return in what words a recipe is refused."""
    try:
        read_recipe(text)
    except RecipeError as error:
        return str(error)
    return ""
