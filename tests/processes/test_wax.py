"""Wax plates from a recipe to files, by the command that a workshop types."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import shapely

from batik_vector.command.cli import cli
from batik_vector.importing.svg import read_svg
from tests.calling import runner
from tests.recipe.test_dyeing import BATHS, DESIGN

DOTS = """
[[place]]
motif = "dot"
scale = 1
at = [11, 0]
ink = "brown"
[[place]]
motif = "dot"
scale = 0.5
at = [0, 5]
ink = "blue"
"""
INKS = '[ink.brown]\nbaths = ["soga"]\n[ink.blue]\nbaths = ["indigo"]\n[ink.cotton]\nbaths = []\n'
OUTPUT = '[[output]]\nformat = "svg"\nprocess = { kind = "wax" }\n'


ALL = '[[output]]\nformat = "svg"\nname = "all"\nprocess = { kind = "wax", plate = "all" }\n'


@pytest.fixture
def recipe(tmp_path: Path) -> Path:
    place = tmp_path / "dots.toml"
    design = DESIGN.replace(', ink = "cotton"', "").replace("scale = 1", 'scale = 1\nink = "cotton"')
    place.write_text(BATHS + INKS + design + DOTS)
    return place


def compiled(recipe: Path, *args: str) -> dict[str, dict[str, object]]:
    """Compile into a folder beside a recipe; return what is reported of each file by its name."""
    done = runner().invoke(cli, ["compile", str(recipe), "-o", str(recipe.parent / "out"), "--json", *args])
    assert done.exit_code == 0, done.stderr
    files = json.loads(done.stdout)["recipes"][0]["files"]
    assert {path.name for path in (recipe.parent / "out").iterdir()} >= {
        Path(each["path"]).name for each in files
    }
    return {Path(each["path"]).name: each for each in files}


def test_a_file_for_each_plate(recipe: Path) -> None:
    files = compiled(recipe, "--process", "wax", "-f", "svg")
    assert list(files) == [
        "dots-1-nglowong.svg",
        "dots-2-nembok.svg",
        "dots-3-ngerok.svg",
        "dots-4-mbironi.svg",
    ]
    wax = files["dots-1-nglowong.svg"]["process"]["wax"]  # type: ignore[index]
    assert "wax that stays on keeps one of them from its bath" in wax["add_only"]
    for name, told in files.items():
        page = read_svg(recipe.parent / "out" / name, "grid").artwork
        (layer,) = page.layers
        (plate,) = told["process"]["wax"]["plates"]  # type: ignore[index]
        assert layer.ink.name == plate["plate"] == Path(name).stem.removeprefix("dots-")
        assert float(shapely.area(layer.areas).sum()) == pytest.approx(plate["area_mm2"], abs=1e-3)
    checked = runner().invoke(cli, ["check", *(str(recipe.parent / "out" / name) for name in files)])
    assert checked.exit_code == 0, checked.stderr + checked.stdout
    assert "differs" not in checked.stderr + checked.stdout


def test_plates_of_an_output_and_a_file_as_recipe(recipe: Path) -> None:
    recipe.write_text(recipe.read_text() + OUTPUT + ALL)
    assert list(compiled(recipe))[4] == "dots-all.svg"
    again = compiled(
        recipe.parent / "out" / "dots-2-nembok.svg", "-f", "dxf", "--process", "wax plate=nembok"
    )
    assert list(again) == ["dots-2-nembok.dxf"] or list(again) == ["dots.dxf"]


def test_one_plate_is_named_and_goes_on_to_a_wax_pen(recipe: Path) -> None:
    called = [
        "--process",
        "wax plate=nembok",
        "--process",
        "plot hatch.kind=concentric width=1.2",
        "-f",
        "svg",
    ]
    (told,) = compiled(recipe, *called).values()
    assert told["process"]["plot"]["drawn_mm"] > 0  # type: ignore[index]
    assert told["process"]["wax"]["plates"][0]["plate"] == "2-nembok"  # type: ignore[index]


def test_several_processes_are_divided_too(recipe: Path) -> None:
    files = compiled(recipe, "--process", "wax", "--process", "plot", "-f", "hpgl")
    assert list(files)[3] == "dots-4-mbironi.hpgl"


def test_plates_of_baths_that_add(recipe: Path) -> None:
    recipe.write_text(recipe.read_text().replace('["soga"]', '["indigo", "soga"]'))
    files = compiled(recipe, "--process", "wax removal=add-only", "-f", "svg")
    assert list(files) == ["dots-1-before-indigo.svg", "dots-2-before-soga.svg"]
    words = (
        runner().invoke(cli, ["compile", str(recipe), "-o", str(recipe.parent), "--process", "wax"]).stderr
    )
    assert "  1-nembok: 0.5 cm² in 1 piece, 12.5% of the cloth\n" in words


def test_a_refused_plate_writes_nothing(recipe: Path) -> None:
    out = recipe.parent / "out"
    done = runner().invoke(cli, ["compile", str(recipe), "-o", str(out), "--process", "wax removal=add-only"])
    assert done.exit_code == 2
    assert "wax that stays on keeps one of them from its bath" in done.stderr
    assert not out.exists()
