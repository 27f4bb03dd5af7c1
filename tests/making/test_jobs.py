"""Which files a call makes of which piece, and what it reports."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pikepdf
import pytest

from batik_vector.errors import RecipeError, TooLargeError
from batik_vector.making.jobs import Job, planned, read_jobs
from batik_vector.making.pages import piece_of
from batik_vector.making.running import run
from batik_vector.processes.spec import ProcessSpec
from batik_vector.recipe.outputs import Piece
from tests.export.readers import svg_layers

TILE = """
title = "Dots"
[ink.wax]
[motif.dot]
kind = "rosette"
elements = [ { curve = { kind = "circle", radius = 1 } } ]
[[place]]
motif = "dot"
width = "20 mm"
[tile]
size = ["40 mm", "40 mm"]
"""
CLOTH = '[yardage]\nwidth = "200 mm"\nlength = "300 mm"\nselvedge = "10 mm"\n'
BORDER = """
[[border]]
frieze = "p1m1"
size = ["20 mm", "10 mm"]
place = [ { motif = "dot", width = "8 mm", at = ["10 mm", "5 mm"] } ]
"""


def outputs(*tables: str) -> str:
    return "".join(f"[[output]]\n{table}\n" for table in tables)


def jobs(folder: Path, text: str, formats: tuple[str, ...] = (), name: str = "dots.toml") -> list[Job]:
    (folder / name).write_text(text, encoding="utf-8")
    return planned(read_jobs([str(folder / name)]), folder / "out", formats)


def quiet(_stage: str) -> None:
    pass


def made(folder: Path, text: str, formats: tuple[str, ...] = ()) -> dict[str, Any]:
    (job,) = jobs(folder, text, formats)
    report = run(job, quiet)
    json.dumps(report)
    return report


def test_a_recipe_with_yardage_makes_cloth(tmp_path: Path) -> None:
    report = made(tmp_path, TILE + CLOTH, ("svg", "pdf", "dxf", "png"))
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "dots.dxf",
        "dots.pdf",
        "dots.png",
        "dots.svg",
    ]
    assert [file["size_mm"] for file in report["files"]] == [[220, 300]] * 4
    assert report["cell_mm"] == [40, 40]
    assert report["yardage"] == {
        "size_mm": [200, 300],
        "page_mm": [220, 300],
        "vertices_about": report["yardage"]["vertices_about"],
        "inks": ["wax"],
    }
    assert report["yardage"]["vertices_about"] == round(report["vertices"] * 200 * 300 / 1600)
    layer = svg_layers((tmp_path / "out" / "dots.svg").read_bytes())["1 wax"]
    assert len(layer) == 5 * 8
    for file in report["files"]:
        assert (tmp_path / "out" / Path(file["path"]).name).stat().st_size == file["bytes"]


def test_both_pieces_have_names_of_their_own(tmp_path: Path) -> None:
    text = TILE + CLOTH + outputs('format = "svg"', 'format = "svg"\npiece = "tile"', 'format = "dxf"')
    (job,) = jobs(tmp_path, text)
    assert [path.name for path, _ in job.files] == ["dots.svg", "dots-tile.svg", "dots.dxf"]
    assert [piece_of(job.recipe, output) for _, output in job.files] == [
        Piece.YARDAGE,
        Piece.TILE,
        Piece.YARDAGE,
    ]
    report = run(job, quiet)
    assert [file["size_mm"] for file in report["files"]] == [[220, 300], [40, 40], [220, 300]]


def test_a_compiled_tile_is_called_after_its_recipe(tmp_path: Path) -> None:
    text = TILE + CLOTH + outputs('format = "svg"\npiece = "tile"')
    run(jobs(tmp_path, text)[0], quiet)
    (again,) = planned(read_jobs([str(tmp_path / "out" / "dots-tile.svg")]), tmp_path / "two", ["dxf"])
    assert [path.name for path, _ in again.files] == ["dots.dxf"]


def test_without_yardage_nothing_has_changed(tmp_path: Path) -> None:
    text = TILE + outputs('format = "svg"\npiece = "tile"\nrepeat = [3, 2]')
    report = made(tmp_path, text)
    assert [(Path(f["path"]).name, f["size_mm"]) for f in report["files"]] == [("dots.svg", [120, 80])]
    assert "yardage" not in report


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            TILE + outputs('format = "svg"\npiece = "yardage"'),
            r"dots.toml:\d+: output\[0\].piece: asks for the yardage, and the recipe has none",
        ),
        (
            TILE + CLOTH + outputs('format = "svg"\nrepeat = [2, 2]'),
            r'output\[0\].repeat: repeats the tile.*expected piece = "tile"',
        ),
        (
            TILE + CLOTH + outputs('format = "pdf"\nbleed = "3 mm"'),
            r"output\[0\].bleed: is the tile's: expected yardage.bleed",
        ),
        (
            TILE.split("[[place]]")[0] + CLOTH + BORDER + outputs('format = "svg"\npiece = "tile"'),
            r"output\[0\].piece: asks for the tile, and the recipe has borders alone",
        ),
    ],
)
def test_outputs_that_ask_for_what_is_not_there(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(RecipeError, match=words):
        jobs(tmp_path, text)
    assert not (tmp_path / "out").exists()


def test_unknown_pieces_name_the_known(tmp_path: Path) -> None:
    with pytest.raises(RecipeError, match="tile"):
        jobs(tmp_path, TILE + outputs('format = "svg"\npiece = "tiles"'))


def test_borders_alone_make_a_cloth(tmp_path: Path) -> None:
    report = made(tmp_path, TILE.split("[[place]]")[0] + CLOTH + BORDER)
    assert report["title"] == "Dots"
    assert report["files"][0]["size_mm"] == [220, 300]
    assert len(svg_layers((tmp_path / "out" / "dots.svg").read_bytes())["1 wax"])


def test_a_cloth_too_large_is_refused_at_its_key(tmp_path: Path) -> None:
    text = TILE + CLOTH.replace('"300 mm"', '"200 m"').replace('"200 mm"', '"20 m"')
    text = text.replace("[ink.wax]", "tolerance = 0.002\n[ink.wax]").replace(
        '["40 mm", "40 mm"]', '["21 mm", "21 mm"]'
    )
    with pytest.raises(RecipeError, match=r"yardage: the cloth would have about [\d,]+ vertices") as caught:
        made(tmp_path, text)
    assert isinstance(caught.value.__cause__, RecipeError | TooLargeError)
    assert not (tmp_path / "out").exists()


def test_a_failure_while_writing_leaves_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (job,) = jobs(tmp_path, TILE + CLOTH + outputs('format = "svg"', 'format = "png"\ndpi = 2400'))
    with pytest.raises(RecipeError, match="pixels"):
        run(job, quiet)
    assert not (tmp_path / "out").exists()
    (tmp_path / "out").mkdir()
    with pytest.raises(RecipeError):
        run(job, quiet)
    assert list((tmp_path / "out").iterdir()) == []


def test_a_page_in_larger_units_is_warned_of(tmp_path: Path) -> None:
    report = made(tmp_path, TILE + CLOTH.replace('"300 mm"', '"11 m"'), ("pdf", "svg"))
    assert [words for words in report["warnings"] if "UserUnit" in words] == [
        "dots.pdf: over 5.08 m long, and so in units of 3 points (UserUnit): a program that passes this over "
        'shows it 3 times too small; pages = "tile" divides it over several'
    ]
    with pikepdf.open(tmp_path / "out" / "dots.pdf") as opened:
        assert float(opened.pages[0].UserUnit) == 3


def test_inks_whose_cmyk_is_reckoned_are_warned_of(tmp_path: Path) -> None:
    (job,) = jobs(tmp_path, TILE + outputs('format = "pdf"\ninks = "spot"\nalternate = "cmyk"'))
    (words,) = [words for words in run(job, quiet)["warnings"] if "CMYK" in words]
    assert words.startswith('dots.pdf: CMYK of ink "wax" is reckoned from the colour on screen')


def test_tiles_of_broken_pixels_are_warned_of(tmp_path: Path) -> None:
    for dpi, text, expected in (
        (100, TILE, True),
        (127, TILE, False),
        (100, TILE + CLOTH, False),
    ):
        (job,) = jobs(tmp_path, text + outputs(f'format = "png"\ndpi = {dpi}'))
        report = run(job, quiet)
        assert any("pixels" in words for words in report["warnings"]) == expected


def test_what_is_told_while_a_cloth_is_drawn(tmp_path: Path) -> None:
    (job,) = jobs(tmp_path, TILE + CLOTH)
    told: list[str] = []
    run(job, told.append)
    assert told[:3] == ["placing dot", "cutting the tile", "writing dots.svg"]
    assert told[3:] == ["wax 100%"]


def test_stretch_is_reported(tmp_path: Path) -> None:
    text = TILE.replace('"40 mm"]', '"40 mm"]\nfit = { width = "121 mm" }')
    assert made(tmp_path, text)["stretch_percent"][0] == pytest.approx(0.833, abs=0.01)


TILED = """
format = "hpgl"
machine = "hp7475a"
pages = "tile"
overlap = "5 mm"
page = "30 x 30 mm"
"""


def test_a_drawing_too_large_becomes_a_file_for_each_sheet(tmp_path: Path) -> None:
    report = made(tmp_path, TILE + outputs(TILED, 'format = "svg"'))
    names = [f"dots-p{column}x{row}.hpgl" for row in (1, 2) for column in (1, 2)]
    assert [Path(each["path"]).name for each in report["files"]] == [*names, "dots.svg"]
    assert {path.name for path in (tmp_path / "out").iterdir()} == {*names, "dots.svg"}


def test_what_is_divided_goes_through_its_processes_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []
    apply = ProcessSpec._applied

    def counted(self: ProcessSpec, *of: Any) -> Any:
        calls.append(self)
        return apply(self, *of)

    monkeypatch.setattr(ProcessSpec, "_applied", counted)
    report = made(tmp_path, TILE + outputs(TILED + 'process = { kind = "plot" }\n'))
    assert len(calls) == 1
    assert ["process" in each for each in report["files"]] == [True] * 4


def test_a_drawing_too_large_for_its_machine_is_refused_with_its_place(tmp_path: Path) -> None:
    words = r'dots.toml:12: output\[0\]: the drawing is 40 x 40 mm, .*pages = "tile"'
    with pytest.raises(RecipeError, match=words):
        made(tmp_path, TILE + outputs('format = "hpgl"\npage = "30 x 30 mm"'))
    assert not (tmp_path / "out").exists()
