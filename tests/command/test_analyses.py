"""The command ``analyse``: what it prints, what it refuses, and how it ends."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from batik_vector.command.cli import cli
from tests.analysis.drawings import SAMPLES, TABLE_2, bare_svg, flower
from tests.calling import runner

FIRST = str(SAMPLES / "figure-15-1.toml")


def test_a_recipe_is_told_of_in_words() -> None:
    done = runner().invoke(cli, ["analyse", FIRST])
    assert done.exit_code == 0
    assert done.stderr == ""
    lines = done.stdout.splitlines()
    assert lines[0] == f"{FIRST}: Figure 15, flower 1"
    assert lines[1] == f"  {TABLE_2[1]}"
    for words in (
        "D8, rotation and reflection",
        "8 curved petals that reach 42 mm",
        "box dimension 1.",
        "nodes",
    ):
        assert words in done.stdout, words


def test_several_make_a_table_in_the_papers_columns(tmp_path: Path) -> None:
    drawing = tmp_path / "two.svg"
    drawing.write_bytes(bare_svg(flower(2)))
    done = runner().invoke(cli, ["analyse", FIRST, str(drawing), str(tmp_path / "none.svg")])
    assert done.exit_code == 2
    table = done.stdout.splitlines()[-4:]
    assert table[0].split() == ["elements", "relation", "symmetry", "layers", "petal", "petals", "pistils"]
    assert table[1].split()[1:] == TABLE_2[1].split(", ")
    assert table[2].split()[1:] == TABLE_2[2].split(", ")
    assert table[3].split() == [str(tmp_path / "none.svg"), "error"]


def test_machines_get_all_of_it() -> None:
    done = runner().invoke(cli, ["analyse", FIRST, "--json"])
    (facts,) = json.loads(done.stdout)["recipes"]
    assert facts["recipe"] == FIRST
    assert facts["analysed"] == "recipe"
    assert ", ".join(facts["row"].values()) == TABLE_2[1]
    assert facts["pistils_per_petal"] == [1.0]
    assert facts["symmetry"]["order"] == 8
    assert 0 < facts["covers"] < 1


def test_set_changes_a_recipe_and_no_drawing(tmp_path: Path) -> None:
    done = runner().invoke(cli, ["analyse", FIRST, "--set", "place[0].scale='40 mm'", "--json"])
    assert json.loads(done.stdout)["recipes"][0]["reach_mm"] == pytest.approx(40, abs=0.01)
    drawing = tmp_path / "one.svg"
    drawing.write_bytes(bare_svg(flower(1)))
    refused = runner().invoke(cli, ["analyse", str(drawing), "--set", "seed=3"])
    assert refused.exit_code == 2
    assert "is measured as it is drawn, which --set seed=3 cannot change: give its recipe" in refused.stderr


def test_a_drawing_without_a_flower_is_told_with_what_was_found(tmp_path: Path) -> None:
    drawing = tmp_path / "bars.svg"
    bars = "".join(f'<rect x="{x}" y="2" width="2" height="16"/>' for x in range(2, 20, 4))
    drawing.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">{bars}</svg>'
    )
    done = runner().invoke(cli, ["analyse", str(drawing)])
    assert done.exit_code == 1
    assert "cannot be judged as a flower: 5 marks of 1 shape" in done.stdout
    assert "1, translation, " in done.stdout


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<svg", "is no SVG"),
        (
            '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9"/>',
            "nothing is drawn",
        ),
    ],
)
def test_what_cannot_be_read_ends_with_a_message(tmp_path: Path, text: str, words: str) -> None:
    drawing = tmp_path / "broken.svg"
    drawing.write_text(text)
    done = runner().invoke(cli, ["analyse", str(drawing)])
    assert done.exit_code == 2
    assert words in done.stderr, done.stderr
