"""``import`` and ``export-motif``: what they write, what they say, and what they leave alone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import Result

from batik_vector.command.cli import cli
from tests.calling import runner
from tests.importing.drawings import svg

LEAVES = svg(
    '<path id="leaf" d="M9 5l9 3-6 7z"/><path d="M29 5l9 3-6 7z"/>'
    '<path d="M9 25l9 3-6 7z"/><path d="M29 25l9 3-6 7z"/>',
    'width="40mm" height="40mm" viewBox="0 0 40 40"',
)
RECIPE = """
tile = { size = [40, 40] }
[motif.leaf]
kind = "flower"
[[place]]
motif = "leaf"
width = 30
"""


def call(*args: str) -> Result:
    return runner().invoke(cli, args)


def test_a_tile_becomes_a_recipe_that_compiles(desk: Path) -> None:
    Path("leaves.svg").write_bytes(LEAVES)
    done = call("import", "leaves.svg")
    assert done.exit_code == 0, done.stderr
    assert "symmetry group p1; 4 marks of 1 kind, 1 placed in a unit of 20 × 20 mm (grid)" in done.stderr
    assert "leaves.toml written. Next: batik-vector compile leaves.toml" in done.stderr
    assert call("compile", "leaves.toml", "-o", "out").exit_code == 0
    assert call("check", "leaves.toml").exit_code == 0
    assert sorted(each.name for each in desk.iterdir()) == ["leaves.svg", "leaves.toml", "out"]


def test_the_report_says_what_was_found(desk: Path) -> None:
    Path("leaves.svg").write_bytes(LEAVES)
    done = call("import", "leaves.svg", "-o", "own.toml", "--json")
    (facts,) = json.loads(done.stdout)["recipes"]
    assert facts["recipe"] == "own.toml"
    assert (facts["group"], facts["marks"], facts["motifs"], facts["placed"]) == ("p1", 4, 1, 1)
    assert facts["same"]
    assert facts["inks"][0]["differs_mm2"] < facts["inks"][0]["allowed_mm2"]


def test_long_outlines_lie_beside_the_recipe(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batik_vector.drafting.composing.LONG", 10)
    Path("leaves.svg").write_bytes(LEAVES)
    done = call("import", "leaves.svg")
    assert "leaves.toml and leaves-marks.svg written" in done.stderr
    assert call("compile", "leaves.toml", "-o", "out").exit_code == 0


@pytest.mark.parametrize("there", ["leaves.toml", "leaves-marks.svg"])
def test_nothing_that_is_there_is_replaced(there: str, desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batik_vector.drafting.composing.LONG", 10)
    Path("leaves.svg").write_bytes(LEAVES)
    Path(there).write_text("mine")
    done = call("import", "leaves.svg")
    assert done.exit_code == 2
    assert f"{there} is there already: --force replaces it" in done.stderr
    assert Path(there).read_text() == "mine"
    assert len(list(desk.iterdir())) == 2
    assert call("import", "leaves.svg", "--force").exit_code == 0
    assert Path(there).read_text() != "mine"


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (["import", "none.svg"], "none.svg: no such file"),
        (["import", "leaves.svg", "--repeat", "sideways"], 'repeat "sideways": expected "grid"'),
        (["import", "leaves.svg", "-o", "own.svg"], '"own.svg" is no name of a recipe'),
        (["import", "leaves.svg", "-o", "no/own.toml"], 'there is no folder "no"'),
        (["import", "leaves.svg", "--tolerance", "9"], "9.0 is not in the range 0.002<=x<=5"),
        (["import", "recipe.toml", "-o", "own.toml"], "recipe.toml is a recipe, expected a tile as SVG"),
        (["export-motif", "recipe.toml", "leave"], 'unknown motif "leave": did you mean "leaf"?'),
        (["export-motif", "recipe.toml", "leaf", "-o", "leaf.toml"], '"leaf.toml" is no name of a drawing'),
        (["export-motif", "none.toml", "leaf"], "none.toml: no such file"),
    ],
)
def test_what_cannot_be_is_told(args: list[str], words: str, desk: Path) -> None:
    Path("leaves.svg").write_bytes(LEAVES)
    Path("recipe.toml").write_text(RECIPE)
    done = call(*args)
    assert done.exit_code == 2
    assert words in done.stderr
    assert len(list(desk.iterdir())) == 2


def test_a_motif_is_drawn_and_its_tables_printed(desk: Path) -> None:
    Path("recipe.toml").write_text(RECIPE)
    done = call("export-motif", "recipe.toml", "leaf")
    assert done.exit_code == 0, done.stderr
    assert "leaf.svg written" in done.stderr
    rest = RECIPE.replace('[motif.leaf]\nkind = "flower"\n', done.stdout)
    Path("again.toml").write_text(rest)
    assert call("compile", "again.toml").exit_code == 0
    assert call("export-motif", "recipe.toml", "leaf").exit_code == 2
