"""A tile is the same to the bit whatever was compiled before: knobs of samples, turned at random."""

from __future__ import annotations

import random
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
import shapely

from batik_vector import compile_recipe, load_recipe
from batik_vector.artwork import Artwork
from batik_vector.compiling import placements
from batik_vector.errors import BatikError
from batik_vector.geometry import work
from batik_vector.making.exploring import candidates, knobs
from batik_vector.recipe import figures
from tests.budgets import cold
from tests.thorough import examples

SAMPLES = Path(__file__).resolve().parents[3] / "samples"
DRAWN = (figures._copied, figures._alone, figures._told)
TOLERANCE = "tolerance='0.5 mm'"


@pytest.fixture(autouse=True)
def forgotten() -> Iterator[None]:
    cold()
    yield
    cold()


def told(recipe: str, changes: tuple[str, ...]) -> tuple[object, ...]:
    """Return all that a tile shows, to the bit, and what it cost; or the words by which it is refused."""
    read = load_recipe(SAMPLES / f"{recipe}.toml", (*changes, TOLERANCE))
    # What drawing costs is counted when it is done: here it is done each time.
    for forget in (placements._kept.clear, *(each.cache_clear for each in DRAWN)):
        forget()
    with work.account():
        try:
            artwork = compile_recipe(read)
        except BatikError as error:
            return (str(error),)
        spent = work.counted()
    return *shown(artwork), [float(f"{each:.9g}") for each in spent or ()]


def shown(artwork: Artwork) -> list[object]:
    marks = [(layer.areas, layer.lines) for layer in artwork.layers]
    names = [(layer.ink, layer.area_names, layer.line_names) for layer in artwork.layers]
    return [names, [[b"".join(shapely.to_wkb(each)) for each in both] for both in marks], artwork.borders]


@pytest.mark.parametrize("recipe", ["four-square", "group-p4g", "kawung"])
def test_knobs_turned_at_random_show_what_a_fresh_start_shows(recipe: str) -> None:
    tables = tomllib.loads((SAMPLES / f"{recipe}.toml").read_text(encoding="utf-8"))
    moving = knobs(tables)
    chance = random.Random(recipe)
    steps = []
    for variant in candidates(moving, recipe, seed=chance.randrange(100), reach=0.3):
        # One thing after another, and now and then back to what was.
        steps.append(tuple(chance.sample(variant.changes, 1)))
        if len(steps) == examples(3, 30):
            break
    steps += [steps[0], ()]
    warm = [told(recipe, each) for each in steps]
    for step, before in zip(steps, warm, strict=True):
        cold()
        assert told(recipe, step) == before
