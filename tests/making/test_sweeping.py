"""Sweeps: the same bytes however they went, nothing made twice, and a sheet that shows all."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import pikepdf
import pytest
from click.testing import Result
from PIL import Image

from batik_vector import sweep
from batik_vector.command.cli import cli
from batik_vector.command.sweeps import SHEET_FORMATS
from batik_vector.errors import RecipeError
from batik_vector.making import sheets
from tests.calling import runner
from tests.thorough import examples, long

RECIPE = """
title = "Dots"
[ink.wax]
[motif.dot]
kind = "rosette"
elements = [ { curve = { kind = "circle", radius = 1 }, count = 3, radius = 2 } ]
[[place]]
motif = "dot"
width = "20 mm"
[tile]
size = ["40 mm", "40 mm"]
"""


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("dots.toml").write_text(RECIPE)
    return tmp_path


def called(*words: str) -> Result:
    return runner().invoke(cli, ["sweep", "dots.toml", *words])


def good(*words: str) -> str:
    result = called(*words)
    assert result.exit_code == 0, result.stderr
    return result.stderr


def held(folder: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def test_every_combination_is_a_file_whose_name_says_it(desk: Path) -> None:
    assert "6 variants made" in good("--vary", "elements.count=3,4,5", "--vary", "place.width=10mm:20mm:2")
    names = sorted(path.name for path in Path("dots-sweep").glob("*.svg"))
    assert names == [f"dots_count-{count}_width-{width}-mm.svg" for count in (3, 4, 5) for width in (10, 20)]
    recompiled = runner().invoke(cli, ["compile", "dots-sweep/" + names[0], "-o", "again"])
    assert recompiled.exit_code == 0
    assert (Path("again") / names[0]).read_bytes() == (Path("dots-sweep") / names[0]).read_bytes()


def test_on_several_cores_and_taken_up_again_the_bytes_are_the_same(desk: Path) -> None:
    asked = ("--vary", "elements.count=3:8:6", "-f", "svg,dxf", "--sheet")
    good(*asked, "-o", "one")
    good(*asked, "-o", "two", "-j", "2")
    assert held("one") == held("two")
    lines = Path("two/dots-sweep.jsonl").read_bytes().splitlines(keepends=True)
    # As a kill leaves it: half a line, a file that is not noted, and one whose bytes are others.
    Path("two/dots-sweep.jsonl").write_bytes(b"".join(lines[:3]) + lines[3][:40])
    Path("two/dots_count-4.svg").write_bytes(b"spoilt")
    assert "4 variants made, 2 were there" in good(*asked, "-o", "two")
    assert held("one") == held("two")
    assert "0 variants made, 6 were there" in good(*asked, "-o", "two")


def test_another_recipe_is_made_anew(desk: Path) -> None:
    asked = ("--vary", "elements.count=3,4")
    good(*asked)
    Path("dots.toml").write_text(RECIPE.replace("radius = 2", "radius = 2.5"))
    assert "2 variants made" in good(*asked)
    assert len(Path("dots-sweep/dots-sweep.jsonl").read_text().splitlines()) == 2


def test_what_cannot_be_made_is_told_at_the_end_and_keeps_back_nothing(desk: Path) -> None:
    asked = ("--vary", "elements.count=3,0,4")
    missing = called(*asked)
    assert missing.exit_code == 2
    assert "dots_count-0: --vary elements.count=0: motif.dot.elements[0].count: 0, expected" in missing.stderr
    assert "2 variants made, 1 could not be made" in missing.stderr
    assert Path("dots-sweep/dots_count-4.svg").exists()
    report = json.loads(called(*asked, "--json").stdout)
    assert [each["name"] for each in report["failed"]] == ["dots_count-0"]
    assert [each["files"] for each in report["made"]] == [["dots_count-3.svg"], ["dots_count-4.svg"]]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ("--vary", "motif.dot.elements[0].cuont=3,4"),
            '--vary motif.dot.elements[0].cuont: motif.dot.elements[0]: unknown key "cuont": did you mean',
        ),
        (("--vary", "tilt.size=3,4"), '--vary tilt.size: unknown key "tilt": did you mean "tile"?'),
        (
            ("--vary", "kind=3,4"),
            "--vary kind: may be any of motif.dot.kind, motif.dot.elements[0].curve.kind",
        ),
        (("--vary", "place[9].turn=1,2"), "--vary place[9].turn: place[9]: no such place in the list"),
        (("--vary", "elements.count=3:8:-2"), "--vary elements.count=3:8:-2: expected START:STOP:COUNT"),
        (("--vary", "elements.radius=1:inf:3"), "--vary elements.radius=1:inf:3: expected START:STOP:COUNT"),
        (("--vary", "elements.radius=1:2:3:lg"), "expected START:STOP:COUNT, numbers and a whole COUNT"),
        (("--vary", "elements.count=,"), "--vary elements.count=,: expected values between the commas"),
        (
            ("--vary", "elements.count=3,4", "--vary", "dot.elements.count=5,6"),
            "--vary dot.elements.count: is varied twice, as elements.count too",
        ),
        (("--vary", "elements.count=-3,-2"), "expected 1 to 1000"),
        (("--vary", "elements.count=1:2000:2000"), "expected 1 to 1000"),
        (("--vary", "seed=0:1:100000", "--vary", "elements.count=1:1000:1000"), "100,000,000 variants"),
        ((), "nothing is varied"),
        (
            ("--vary", "elements.count=3,4", "--sheet", "--paper", "A44"),
            'unknown paper "A44": did you mean "A4"?',
        ),
        (("--vary", "elements.count=3,4", "--sheet", "--sheet-format", "jpg"), "jpg"),
        (("--vary", "elements.count=3,4", "-o", "dots.toml"), "is a file, expected a folder"),
    ],
)
def test_wrong_calls_are_told_and_write_nothing(desk: Path, words: tuple[str, ...], told: str) -> None:
    result = called(*words)
    assert result.exit_code == 2, result.stderr
    assert told in result.stderr
    if "--set" not in words:
        assert "--set" not in result.stderr
    assert sorted(os.listdir()) == ["dots.toml"]


@pytest.mark.parametrize("key", ["elements.cuont", "elements.count"])
def test_what_is_wrong_with_a_key_is_told_once(desk: Path, key: str) -> None:
    result = called("--vary", f"{key}=-7,-7.5,-7")
    assert result.stderr.count("\n") == (1 if key == "elements.cuont" else 2)
    assert (
        runner()
        .invoke(cli, ["compile", "dots.toml", "--set", f"{key}=-7"])
        .stderr.startswith(f"batik-vector: error: --set {key}=-7: ")
    )


def test_a_dry_run_writes_nothing(desk: Path) -> None:
    assert "1,000 variants; nothing is written" in good("--vary", "elements.count=1:1000:1000", "--dry-run")
    assert sorted(os.listdir()) == ["dots.toml"]


def test_a_sheet_shows_every_variant_on_as_many_pages_as_it_takes(desk: Path) -> None:
    good(
        "--vary",
        "elements.count=1:100:100",
        "--sheet",
        "--sheet-format",
        ",".join(SHEET_FORMATS),
        "--paper",
        "A5",
    )
    drawn = sorted(Path("dots-sweep").glob("dots-sheet-*.svg"))
    namespace = "{http://www.w3.org/2000/svg}"
    pictures = [len(ET.parse(path).getroot().findall(f"{namespace}svg")) for path in drawn]
    assert sum(pictures) == 100
    with pikepdf.open("dots-sweep/dots-sheet.pdf") as pdf:
        assert len(pdf.pages) == len(drawn) > 1
        width, height = (float(side) * 25.4 / 72 for side in list(pdf.pages[0].mediabox)[2:])
        assert (round(width), round(height)) == sheets.PAPERS["A5"]
    with Image.open("dots-sweep/dots-sheet-1.png") as picture:
        assert picture.size[0] == round(148 / 25.4 * sheets.DPI)
        assert len(picture.convert("L").getcolors() or ()) > 3
    assert SHEET_FORMATS == sheets.FORMATS


@pytest.mark.parametrize("count", [1, 2, 7, 20, 42, 200])
@pytest.mark.parametrize("shape", [0.2, 0.7, 1.0, 1.7])
def test_pictures_stay_on_the_page_and_apart(count: int, shape: float) -> None:
    for paper, size in sheets.PAPERS.items():
        page = sheets.plan(count, shape, 2, paper)
        width, height = page.width, page.height
        assert sorted((width, height)) == sorted(size)
        across = 2 * page.margin + page.columns * page.breadth + (page.columns - 1) * page.gap
        up = 2 * page.margin + page.head + page.rows * page.pitch - page.gap
        assert across <= width + 1e-6
        assert up <= height + 1e-6
        assert page.gap >= 3
        assert page.breadth >= 20


@pytest.mark.parametrize(
    ("count", "columns", "lying"),
    [(8, 4, True), (10, 0, True), (20, 5, False), (3, 0, False), (1000, 0, False)],
)
def test_a_page_lies_on_its_side_where_pictures_are_larger_so(count: int, columns: int, lying: bool) -> None:
    page = sheets.plan(count, 1.0, 2, "A4", columns)
    assert (page.width > page.height) == lying
    assert not columns or page.columns == columns
    assert page.each >= count or count == 1000


@long
def test_killed_at_any_moment_it_goes_on_to_the_same_bytes(desk: Path) -> None:
    asked = ("--vary", "elements.count=3:40:38")
    good(*asked, "-o", "whole")
    command = [sys.executable, "-m", "batik_vector", "sweep", "dots.toml", *asked, "-o", "killed", "-j", "2"]
    for turn in range(examples(2, 12)):
        begun = subprocess.Popen(command, stderr=subprocess.DEVNULL)
        time.sleep(0.9 + 0.12 * turn)
        begun.send_signal(signal.SIGKILL)
        begun.wait()
    time.sleep(0.5)
    assert (
        not [name for name in os.listdir("killed") if not name.startswith("dots")]
        if Path("killed").exists()
        else True
    )
    good(*asked, "-o", "killed")
    assert held("whole") == held("killed")


def test_many_recipes_are_compiled_on_several_cores_by_a_pattern(desk: Path) -> None:
    for name in ("a1", "a2", "b1"):
        Path(f"{name}.toml").write_text(RECIPE.replace("Dots", name))
    Path("a3.toml").write_text(RECIPE.replace('width = "20 mm"', 'width = "20 mm"\nscale = 3'))
    result = runner().invoke(cli, ["compile", "a?.toml", "b1.toml", "-o", "one"])
    assert result.exit_code == 2  # a3 is wrong, and nothing is written
    Path("a3.toml").unlink()
    for workers in ("1", "2"):
        result = runner().invoke(
            cli, ["compile", "a?.toml", "b1.toml", "-o", workers, "-j", workers, "--json"]
        )
        assert result.exit_code == 0, result.stderr
        assert len(json.loads(result.stdout)["recipes"]) == 3
    assert held("1") == held("2")
    assert sorted(held("1")) == ["a1.svg", "a2.svg", "b1.svg"]
    missing = runner().invoke(cli, ["compile", "c*.toml"])
    assert "c*.toml: no such file" in missing.stderr
    assert missing.exit_code == 2


def test_in_python_variants_come_one_by_one_with_their_errors(desk: Path) -> None:
    found = list(sweep("dots.toml", {"elements.count": [3, 0], "place.width": "10mm:20mm:2"}))
    assert found[0].changes == ("elements.count=3", "place.width=10 mm")
    assert [each.artwork is not None for each in found] == [True, True, False, False]
    assert "0, expected 1 to 1000" in str(found[2].error)
    assert found[1].artwork is not None
    (areas,) = (layer.areas for layer in found[1].artwork.layers)
    assert areas.tolist()
    assert found[1].recipe is not None
    assert len(list(sweep(found[1].recipe, {"elements.radius": "1:3"}, sample=5))) == 5
    with pytest.raises(RecipeError, match="nothing is varied"):
        sweep("dots.toml", {})


def test_variants_are_saved_in_the_library_when_asked(desk: Path) -> None:
    result = runner().invoke(
        cli, ["--library", "l.db", "sweep", "dots.toml", "--vary", "elements.count=3,4", "--into-library"]
    )
    assert result.exit_code == 0, result.stderr
    compiled = runner().invoke(cli, ["--library", "l.db", "compile", "library:dots_count-4", "-o", "again"])
    assert compiled.exit_code == 0, compiled.stderr
    assert Path("again/dots_count-4.svg").read_bytes() == Path("dots-sweep/dots_count-4.svg").read_bytes()
