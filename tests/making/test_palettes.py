"""Palettes: what is light stays light, equal colours stay equal, and wrong names are told."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest

from batik_vector import load_recipe
from batik_vector.errors import RecipeError
from batik_vector.making.palettes import PALETTES, lightness, palette_axis, recoloured
from batik_vector.making.variants import parse_axis, variants

SAMPLES = Path(__file__).parents[2] / "samples"


@pytest.mark.parametrize("sample", ["four-square", "kawung", "traced-leaf", "group-p4g"])
@pytest.mark.parametrize("palette", PALETTES)
def test_light_stays_light(sample: str, palette: str) -> None:
    path = SAMPLES / f"{sample}.toml"
    before = load_recipe(path)
    after = load_recipe(path, recoloured(before, palette))
    old = [before.cloth.colour, *(ink.colour for ink in before.ink.values())]
    new = [after.cloth.colour, *(ink.colour for ink in after.ink.values())]
    assert set(new) <= set(PALETTES[palette])
    for (a, x), (b, y) in itertools.combinations(zip(old, new, strict=True), 2):
        assert (lightness(a) < lightness(b)) <= (lightness(x) <= lightness(y))
        assert (a == b) <= (x == y)
    assert {PALETTES[palette][0], PALETTES[palette][-1]} <= set(new)


def test_the_palettes_run_from_light_to_dark() -> None:
    for colours in PALETTES.values():
        found = [lightness(colour) for colour in colours]
        assert found == sorted(found, reverse=True)
        assert len(set(colours)) == 5


def test_an_axis_of_palettes_names_its_variants() -> None:
    recipe = load_recipe(SAMPLES / "kawung.toml")
    axes = [parse_axis("seed=1,2"), palette_axis(recipe, ["sogan", "kelengan", "sogan"])]
    found = list(variants(axes, "kawung"))
    assert [each.name for each in found] == [
        f"kawung_seed-{seed}_palette-{name}" for seed in (1, 2) for name in ("sogan", "kelengan")
    ]
    assert len(palette_axis(recipe, ["all"]).values) == len(PALETTES)
    with pytest.raises(RecipeError, match='unknown palette "sogann": did you mean "sogan"'):
        palette_axis(recipe, ["sogann"])
    with pytest.raises(RecipeError, match="keeps the colours of its drawing"):
        palette_axis(load_recipe(SAMPLES / "lasem-bird.toml"), ["sogan"])
