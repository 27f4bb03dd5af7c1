"""What a notebook is told where it lacks what sliders need."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from batik_vector import compile_recipe, load_recipe
from batik_vector.errors import MissingLibraryError
from batik_vector.notebook import interact

ROOT = Path(__file__).resolve().parent.parent


def test_a_recipe_shows_its_tile() -> None:
    recipe = load_recipe(ROOT / "samples" / "kawung.toml")
    assert recipe._repr_svg_() == compile_recipe(recipe)._repr_svg_()
    borders = load_recipe(ROOT / "samples" / "border-p11m.toml")
    assert replace(borders, tile=None, place=())._repr_svg_() is None


def test_without_ipywidgets_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    with pytest.raises(MissingLibraryError, match=r"pip install 'batik-vector\[notebook\]'"):
        interact("library:sample/kawung")
