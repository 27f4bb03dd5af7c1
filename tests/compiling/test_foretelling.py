from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from batik_vector import compile_recipe, load_recipe, read_recipe
from batik_vector.compiling.foretelling import foretold

SAMPLES = Path(__file__).parents[2] / "samples"


@pytest.mark.parametrize("name", ["figure-15-4", "dahlia", "lsystem-snake"])
def test_vertices_are_foretold_within_a_factor_of_four(name: str) -> None:
    recipe = replace(load_recipe(SAMPLES / f"{name}.toml"), tolerance=0.15)
    found = compile_recipe(recipe).vertex_count
    assert found / 4 < foretold(recipe).vertices < found * 4


def test_what_takes_longer_is_foretold_to() -> None:
    names = ("figure-15-3", "kawung", "toss-leaves")
    efforts = [foretold(load_recipe(SAMPLES / f"{name}.toml")).effort for name in names]
    assert efforts == sorted(efforts)
    leaves = load_recipe(SAMPLES / "toss-leaves.toml")
    large = load_recipe(SAMPLES / "toss-leaves.toml", ("tile.size=['1200 mm', '1200 mm']",))
    assert foretold(large).effort > 20 * foretold(leaves).effort


def test_what_is_small_is_foretold_too() -> None:
    text = (
        '[motif.a]\nkind = "rosette"\nelements = [{ curve = { kind = "circle", radius = 1 } }]\n[ink.wax]\n'
    )
    recipe = read_recipe(text + '[[place]]\nmotif = "a"\nwidth = "9 mm"\n[tile]\nsize = ["10 mm", "10 mm"]\n')
    whole = foretold(recipe)
    assert whole.vertices > 0
