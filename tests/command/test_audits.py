"""``batik-vector check --machine``: reports for people and machines, profiles of one's own, pointers."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import Result

from batik_vector.command.cli import cli
from batik_vector.recipe.loading import load_recipe
from tests.calling import runner

RECIPE = """[motif.bars]
kind = "path"
d = "M-8 -8H-0.1V8H-8Z M0.1 -8H8V8H0.1Z"

[ink.wax]
colour = "#f4efe2"

[[place]]
motif = "bars"
ink = "wax"
layout = { kind = "single" }
scale = "1 mm"

[tile]
size = ["40 mm", "40 mm"]
"""
"""Two bars, 0.2 mm apart in the middle of the tile."""


@pytest.fixture
def recipe(tmp_path: Path) -> Path:
    """The recipe in a folder of its own."""
    path = tmp_path / "bars.toml"
    path.write_text(RECIPE)
    return path


def _check(*words: str | Path) -> Result:
    return runner().invoke(cli, ["check", *map(str, words)])


def test_what_a_machine_fails_at_is_told_with_its_place(recipe: Path) -> None:
    done = _check(recipe, "--machine", "canting")
    assert done.exit_code == 1
    assert "1 narrow gaps of ink wax" in done.stdout
    assert "at 20.00, 20.00 mm: bare ground only 0.2 mm wide over 16 mm, the least is 1 mm" in done.stdout
    assert "FAILED: 1 findings for canting" in done.stdout


def test_without_a_machine_nothing_of_it_is_told(recipe: Path) -> None:
    done = _check(recipe, "--json")
    assert done.exit_code == 0
    assert "audit" not in json.loads(done.stdout)["recipes"][0]


def test_machines_read_all_of_it(recipe: Path) -> None:
    report = json.loads(_check(recipe, "--machine", "canting", "--json").stdout)["recipes"][0]
    assert not report["passed"]
    assert report["certificate"]["passed"]
    audit = report["audit"]
    assert audit["measured"] == ["sliver", "line", "gap", "hole"]
    (finding,) = audit["findings"]
    assert finding["where_mm"] == pytest.approx([20, 20], abs=0.01)
    assert (finding["kind"], finding["ink"], finding["value"], finding["limit"]) == ("gap", "wax", 0.2, 1.0)
    assert [group["count"] for group in audit["groups"]] == [1]


def test_a_profile_of_ones_own_sets_other_limits(recipe: Path) -> None:
    mine = recipe.with_name("mine.toml")
    mine.write_text('base = "canting"\n[limits]\nnarrowest_gap = "0.15 mm"\n')
    assert _check(recipe, "--machine", mine).exit_code == 0


def test_a_wrong_word_in_a_profile_is_told_with_its_line_and_the_right_one(recipe: Path) -> None:
    mine = recipe.with_name("mine.toml")
    mine.write_text('base = "canting"\n\n[limits]\nnarowest_gap = "0.15 mm"\n')
    done = _check(recipe, "--machine", mine)
    assert done.exit_code == 2
    assert 'mine.toml:4: limits: unknown key "narowest_gap": did you mean "narrowest_gap"?' in done.stderr


def test_a_limit_of_nought_is_refused_with_what_would_do(recipe: Path) -> None:
    mine = recipe.with_name("mine.toml")
    mine.write_text('[limits]\nnarrowest_line = "0 mm"\n')
    done = _check(recipe, "--machine", mine)
    assert done.exit_code == 2
    assert "mine.toml:2: limits.narrowest_line" in done.stderr
    assert "0.001" in done.stderr


def test_pointers_show_the_places(recipe: Path) -> None:
    assert _check(recipe, "--machine", "canting", "--pointers", recipe.parent / "out").exit_code == 1
    drawn = (recipe.parent / "out" / "bars-check.svg").read_text()
    assert "check" in drawn
    assert load_recipe(recipe.parent / "out" / "bars-check.svg").tile is not None


def test_a_stranger_s_drawing_is_held_to_a_machine(tmp_path: Path) -> None:
    drawing = tmp_path / "bar.svg"
    drawing.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="50mm" viewBox="0 0 50 50">'
        '<rect x="10" y="20" width="30" height="0.3" fill="#123456"/></svg>'
    )
    done = _check(drawing, "--machine", "canting")
    assert done.exit_code == 1
    assert "a mark 0.3 mm wide and 30 mm long, the least is 1 mm" in done.stdout


def test_a_cloth_has_to_fit_the_machine_and_not_the_screen(recipe: Path) -> None:
    recipe.write_text(RECIPE + '[yardage]\nwidth = "700 mm"\nlength = "900 mm"\n')
    done = _check(recipe, "--machine", "laser")
    assert "700 × 900 mm are drawn, and the machine reaches 600 × 400 mm" in done.stdout
    assert "are drawn, and" not in _check(recipe, "--machine", "rotary-screen").stdout


def test_of_a_cut_file_the_pattern_is_held_to_the_machine(recipe: Path) -> None:
    recipe.write_text(RECIPE.replace("0.1", "2"))
    cut = ["--process", "cut blade_offset=0.25 overcut=1 tabs=2", "-o", str(recipe.parent)]
    assert runner().invoke(cli, ["compile", str(recipe), *cut]).exit_code == 0
    told = _check(recipe.with_suffix(".svg"), "--machine", "vinyl-cutter")
    # Its contours are open where tabs hold, and drawn again where they are cut past their start.
    assert told.exit_code == 0, told.output
    assert "the tile that it was made of was measured" in told.stdout
