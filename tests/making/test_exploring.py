"""Random variations: always the same for a seed, what is locked stays, and all of them hold."""

from __future__ import annotations

import random
import tomllib
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector import certify, compile_recipe, load_recipe
from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.command.cli import cli
from batik_vector.errors import RecipeError
from batik_vector.fields import Between
from batik_vector.making.exploring import Floor, Knob, knobs
from tests.calling import runner

SAMPLES = Path(__file__).parents[2] / "samples"
STAR = """
title = "Stars"
[ink.wax]
[motif.star]
kind = "rosette"
elements = [
  { curve = { kind = "superellipse", a = 0.9, b = 1.5, width = 0.4 }, count = 4, radius = 1, turn = 45 },
  { curve = { kind = "circle", radius = 0.4 } },
]
[[place]]
motif = "star"
width = "30 mm"
[tile]
size = ["40 mm", "40 mm"]
"""


def keys(text: str, **asked: list[str]) -> list[tuple[str, ...]]:
    return [knob.keys for knob in knobs(tomllib.loads(text), **asked)]


def test_numbers_of_motifs_move_and_what_is_alike_moves_together() -> None:
    one = "motif.star.elements[0].curve"
    element = "motif.star.elements[0]"
    assert keys(STAR) == [
        *((f"{one}.{name}",) for name in ("a", "b", "width")),
        *((f"{element}.{name}",) for name in ("count", "radius")),
        ("motif.star.elements[1].curve.radius",),
    ]
    twice = STAR.replace("radius = 0.4", "radius = 1.0")
    assert ("motif.star.elements[0].radius", "motif.star.elements[1].curve.radius") not in keys(twice)
    leaves = (SAMPLES / "four-square.toml").read_text(encoding="utf-8")
    assert ("motif.under.elements[0].curve.b", "motif.under.elements[1].curve.b") in keys(leaves)


def test_what_is_locked_stays_and_angles_move_when_asked() -> None:
    assert keys(STAR, only=["turn"]) == [("motif.star.elements[0].turn",)]
    assert not any("curve" in key for found in keys(STAR, locked=["curve.*"]) for key in found)
    with pytest.raises(RecipeError, match=r"--lock cout fits no number of the recipe"):
        keys(STAR, locked=["cout"])


@settings(max_examples=100, deadline=None)
@given(st.integers(1, 60), st.floats(0.01, 1), st.integers(0, 10**6), st.booleans())
def test_numbers_move_within_bounds(value: int, reach: float, seed: int, useful: bool) -> None:
    bounds = (2, 30) if useful and 2 <= value <= 30 else None
    knob = Knob((("motif", "m", "n"),), value, True, Between(1, 64), bounds, False)
    moved = knob.moved(random.Random(seed), reach)
    low, high = bounds or (1, 64)
    assert isinstance(moved, int)
    assert low <= moved <= high
    assert moved != value or value in (low, high)


def tile(*areas: shapely.Polygon) -> Artwork:
    layer = Layer(Ink("wax", "#000000"), np.array(areas, dtype=object), np.empty(0, dtype=object))
    return Artwork("t", Cell(100_000, 100_000), (layer,), "#ffffff", 0.02)


@pytest.mark.parametrize(
    ("areas", "lack"),
    [
        ([shapely.box(10, 10, 60, 60)], ""),
        ([shapely.box(10, 10, 30, 30)], "covers 4%"),
        ([shapely.box(1, 1, 99, 99)], "covers 96%"),
        ([shapely.box(2 * i, 10, 2 * i + 0.3, 90) for i in range(5, 48)], "narrower than 0.4 mm"),
        (
            [shapely.box(10, 10, 60, 60), *(shapely.box(70 + i, 70, 70.5 + i, 70.5) for i in range(9))],
            "scraps",
        ),
    ],
)
def test_the_floor_says_what_a_tile_lacks(areas: list[shapely.Polygon], lack: str) -> None:
    floor = Floor(covers=(0.1, 0.9)) if "narrower" in lack else Floor()
    assert (lack in floor.fault(tile(*areas))) if lack else floor.fault(tile(*areas)) == ""


def test_variations_are_the_same_for_a_seed_on_any_number_of_cores_and_all_hold(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("star.toml").write_text(STAR)
    for name, *more in (("a", "-j", "1"), ("b", "-j", "2"), ("c", "--seed", "1")):
        call = [
            "random",
            "star.toml",
            "-n",
            "4",
            "--lock",
            "count",
            "--sheet",
            "--sheet-format",
            "svg",
            "-o",
            name,
            *more,
        ]
        result = runner().invoke(cli, call)
        assert result.exit_code == 0, result.stderr
    held = [{path.name: path.read_bytes() for path in Path(each).iterdir()} for each in "abc"]
    assert held[0] == held[1] != held[2]
    drawn = sorted(Path("a").glob("star_random-0-?.svg"))
    assert len(drawn) == 4
    for path in drawn:
        recipe = load_recipe(path)
        assert recipe.motif["star"].elements[0].count == 4  # type: ignore[union-attr]
        artwork = compile_recipe(recipe)
        assert certify(artwork).passed
        assert Floor().fault(artwork) == ""


def test_where_too_few_hold_the_reason_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("star.toml").write_text(STAR)
    for option in ("--least=nan", "--least=inf", "--reach=nan"):
        result = runner().invoke(cli, ["random", "star.toml", "-n", "2", option])
        assert result.exit_code == 2
        assert f"{option[8:]} is no number that is finite" in result.stderr
    result = runner().invoke(cli, ["random", "star.toml", "-n", "2", "--least", "30"])
    assert result.exit_code == 2
    assert (
        "of 24 variations 0 hold, expected 2: most often 100% of wax is narrower than 30 mm" in result.stderr
    )
    assert not Path("star-random").exists()
