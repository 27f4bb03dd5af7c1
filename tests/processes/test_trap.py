"""Traps from a recipe to files, by the command that a print studio types."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import shapely

from batik_vector.command.cli import cli
from batik_vector.importing.svg import read_svg
from tests.calling import runner

RECIPE = """
title = "Dots"

[tile]
size = ["20 mm", "20 mm"]

[cloth]
colour = "#ffffff"

[ink.straw]
colour = "#e8d070"

[ink.indigo]
colour = "#1d2f5f"
overlap = "knockout"

[motif.dot]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 1 }, count = 1 }]

[[place]]
motif = "dot"
scale = 6
ink = "straw"

[[place]]
motif = "dot"
scale = SMALL
at = [10, 15]
ink = "indigo"
"""


@pytest.fixture
def recipe(tmp_path: Path) -> Path:
    place = tmp_path / "dots.toml"
    place.write_text(RECIPE.replace("SMALL", "3"))
    return place


def compiled(recipe: Path, *args: str) -> tuple[dict[str, object], str]:
    """Compile into a folder beside a recipe; return what is reported of its first file, and what is told."""
    done = runner().invoke(cli, ["compile", str(recipe), "-o", str(recipe.parent / "out"), "--json", *args])
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stdout)["recipes"][0]["files"][0], done.stderr


def test_a_trapped_tile_passes_its_check_and_tells_what_it_went_through(recipe: Path) -> None:
    file, _ = compiled(recipe, "-f", "svg", "--process", "trap width=0.4mm")
    trap = file["process"]["trap"]  # type: ignore[index]
    (pair,) = trap["pairs"]
    assert (pair["ink"], pair["under"]) == ("straw", "indigo")
    layers = {each.ink.name: shapely.union_all(each.areas) for each in read_svg(file["path"]).artwork.layers}  # type: ignore[arg-type]
    overlap = shapely.intersection(layers["straw"], layers["indigo"])
    assert overlap.area == pytest.approx(trap["gains"][0]["area_mm2"], abs=0.01)
    done = runner().invoke(cli, ["check", str(file["path"])])
    assert done.exit_code == 0, done.stdout + done.stderr
    assert "went through trap width=0.4" in done.stdout + done.stderr


def test_people_are_told_what_spreads(recipe: Path) -> None:
    done = runner().invoke(
        cli, ["compile", str(recipe), "-o", str(recipe.parent), "-f", "svg", "--process", "trap width=0.4mm"]
    )
    assert done.exit_code == 0
    assert "straw spreads 0.4 mm under indigo along" in done.stderr


def test_inks_that_lie_over_one_another_have_nothing_to_trap(recipe: Path) -> None:
    recipe.write_text(recipe.read_text().replace('overlap = "knockout"', ""))
    file, _ = compiled(recipe, "-f", "svg", "--process", "trap")
    assert file["process"]["trap"]["pairs"] == []  # type: ignore[index]


def test_traps_come_before_the_tile_is_repeated_and_filled_into_cloth(recipe: Path) -> None:
    one = pair_of(compiled(recipe, "-f", "svg", "--process", "trap")[0])
    words = '\n[yardage]\nwidth = "50 mm"\nlength = "50 mm"\n'
    words += '\n[[output]]\nformat = "svg"\nprocess = { kind = "trap" }\n'
    recipe.write_text(recipe.read_text() + words)
    cloth, _ = compiled(recipe, "-f", "svg")
    assert pair_of(cloth) == one
    layers = {each.ink.name: shapely.union_all(each.areas) for each in read_svg(cloth["path"]).artwork.layers}  # type: ignore[arg-type]
    overlap = shapely.intersection(layers["straw"], layers["indigo"]).area
    gain = cloth["process"]["trap"]["gains"][0]["area_mm2"]  # type: ignore[index]
    assert overlap / (50 * 50) == pytest.approx(gain / (20 * 20), rel=0.4)


def pair_of(file: dict[str, object]) -> dict[str, object]:
    (pair,) = file["process"]["trap"]["pairs"]  # type: ignore[index]
    return dict(pair)


def test_a_trap_broader_than_a_mark_is_refused_with_what_would_do_and_nothing_is_written(
    recipe: Path,
) -> None:
    recipe.write_text(recipe.read_text().replace("scale = 3", "scale = 0.25"))
    out = recipe.parent / "out"
    args = ["compile", str(recipe), "-o", str(out), "-f", "svg", "--process"]
    done = runner().invoke(cli, [*args, "trap width=0.3mm"])
    assert done.exit_code == 2
    assert 'process.width: 0.3 mm, expected at most 0.23: the mark of ink "indigo" at (' in done.stderr
    assert not out.exists()
    assert runner().invoke(cli, [*args, "trap width=0.23mm"]).exit_code == 0
    assert runner().invoke(cli, [*args, "trap width=0.3mm covered=accept"]).exit_code == 0
