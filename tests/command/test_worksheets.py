"""The work sheet: each step with its picture, on pages to print."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pikepdf
import pytest

from batik_vector.command.cli import cli
from batik_vector.command.worksheets import SHEET_FORMATS
from batik_vector.making.sheets import FORMATS
from tests.calling import runner

SAMPLE = Path(__file__).parents[2] / "samples" / "wax-javanese.toml"


def test_the_steps_of_a_dyeing_are_on_the_sheet(tmp_path: Path) -> None:
    args = ["worksheet", str(SAMPLE), "-o", str(tmp_path), "-f", "svg", "-f", "pdf", "--json"]
    done = runner().invoke(cli, args)
    assert done.exit_code == 0, done.stderr
    (told,) = json.loads(done.stdout)["recipes"]
    assert [Path(each).name for each in told["files"]] == [
        "wax-javanese-worksheet.svg",
        "wax-javanese-worksheet.pdf",
    ]
    words = re.findall(r"<text[^>]*>([^<]*)</text>", (tmp_path / "wax-javanese-worksheet.svg").read_text())
    steps = [each for each in words if re.match(r"\d [a-z]+:|bath:|lorod", each)]
    assert steps == [
        "1 nglowong: soft wax",
        "2 nembok: strong wax",
        "bath: indigo",
        "3 ngerok: scrape off",
        "4 mbironi: strong wax",
        "bath: soga",
        "lorod: boil all wax out",
    ]
    assert "baths: indigo #27407a, then soga #9a5a30, on cloth #f4efe2" in words
    assert any(re.fullmatch(r"klowong 1\.6 mm: \d\.\d\d m", each) for each in words)
    with pikepdf.open(tmp_path / "wax-javanese-worksheet.pdf") as document:
        assert len(document.pages) == 1


def test_formats_are_the_sheets() -> None:
    assert SHEET_FORMATS == FORMATS


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (["--process", "plot"], '--process plot: "plot", expected wax'),
        (["--process", "wax removal=add-only"], "wax that stays on keeps one of them from its bath"),
        (["--paper", "A7"], 'unknown paper "A7": expected one of A0'),
        (["--set", "cloth.baths=['indgo']"], 'unknown bath "indgo": did you mean "indigo"?'),
    ],
)
def test_what_cannot_be_drawn_is_told_and_nothing_written(
    args: list[str], words: str, tmp_path: Path
) -> None:
    done = runner().invoke(cli, ["worksheet", str(SAMPLE), "-o", str(tmp_path / "out"), *args])
    assert done.exit_code == 2
    assert words in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_recipe_without_baths_is_told_what_to_write(tmp_path: Path) -> None:
    sample = SAMPLE.parent / "kawung.toml"
    done = runner().invoke(cli, ["worksheet", str(sample), "-o", str(tmp_path)])
    assert done.exit_code == 2
    assert "expected a recipe with baths: write [[bath]] tables" in done.stderr
