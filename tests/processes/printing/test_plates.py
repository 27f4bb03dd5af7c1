"""Plates from a recipe to files, by the command that a print studio types."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from PIL import Image

from batik_vector import Artwork, load_recipe
from batik_vector.artwork import Cell, Ink, Layer
from batik_vector.certificate import certify
from batik_vector.command.cli import cli
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import GeometryError
from batik_vector.importing.svg import read_svg
from batik_vector.machines import Machine
from batik_vector.processes.printing.options import MisregisterProcess, SeparateProcess
from tests.calling import runner
from tests.export.drawings import geometries, line

RECIPE = """
title = "Plates"

[tile]
size = ["20 mm", "20 mm"]

[cloth]
colour = "#ffffff"

[ink."straw/1"]
colour = "#e8d070"

[ink.indigo]
colour = "#1d2f5f"
overlap = "knockout"

[ink.lines]
colour = "#a03020"
width = "0.8 mm"

[motif.dot]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 1 }, count = 1 }]

[motif.ring]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 1 }, count = 1, treatment = "stroke" }]

[[place]]
motif = "dot"
scale = 6
ink = "straw/1"

[[place]]
motif = "dot"
scale = 3
at = [10, 15]
ink = "indigo"

[[place]]
motif = "ring"
scale = 4
at = [0, 0]
ink = "lines"
"""
ENDS = ("straw-1", "indigo", "lines")


@pytest.fixture
def recipe(tmp_path: Path) -> Path:
    place = tmp_path / "p.toml"
    place.write_text(RECIPE)
    return place


def call(recipe: Path, *args: str) -> tuple[int, dict[str, Any], str]:
    done = runner().invoke(cli, ["compile", str(recipe), "-o", str(recipe.parent / "out"), "--json", *args])
    return done.exit_code, json.loads(done.stdout), done.stderr


def test_a_file_for_each_ink_in_every_format(recipe: Path) -> None:
    code, report, _ = call(recipe, "-f", "svg,pdf,png,tiff", "--process", "separate", "--dpi", "254")
    assert code == 0
    names = {Path(each["path"]).name for each in report["recipes"][0]["files"]}
    assert names == {f"p-{end}.{suffix}" for end in ENDS for suffix in ("svg", "pdf", "png", "tiff")}
    whole = compile_recipe(load_recipe(recipe))
    for layer, end in zip(whole.layers, ENDS, strict=True):
        out = recipe.parent / "out" / f"p-{end}"
        (plate,) = read_svg(out.with_suffix(".svg")).artwork.layers
        assert (plate.ink.name, plate.ink.colour) == (layer.ink.name, "#000000")
        want = float(shapely.area(layer.areas).sum()) or np.pi * 8 * 0.8
        assert shapely.area(plate.areas).sum() == pytest.approx(want, rel=2e-3)
        tiff, png = (Image.open(out.with_suffix(suffix)) for suffix in (".tiff", ".png"))
        assert (tiff.size, tiff.mode, png.mode) == ((200, 200), "1", "1")
        assert np.array_equal(np.asarray(tiff), np.asarray(png))
        assert 400 * (1 - np.asarray(tiff).mean()) == pytest.approx(want, rel=0.02)


def test_tiff_alone_is_separated_and_its_recipe_comes_back(recipe: Path) -> None:
    code, report, _ = call(recipe, "-f", "tiff")
    assert (code, len(report["recipes"][0]["files"])) == (0, 3)
    code, report, _ = call(recipe.parent / "out" / "p-indigo.tiff", "-f", "svg")
    assert (code, report["recipes"][0]["title"]) == (0, "Plates")


def test_plates_have_their_traps(recipe: Path) -> None:
    for process in (["trap width=0.3mm"], ["trap width=0.3mm", "separate"]):
        asked = [word for each in process for word in ("--process", each)]
        code, report, _ = call(recipe, "-f", "tiff", *asked)
        files = report["recipes"][0]["files"]
        assert (code, [Path(each["path"]).name for each in files]) == (0, [f"p-{end}.tiff" for end in ENDS])
        assert files[0]["process"]["trap"]["gains"][0]["ink"] == "straw/1"
        straw = next(
            each for each in compile_recipe(load_recipe(recipe)).layers if each.ink.name == "straw/1"
        )
        covers = float(shapely.area(straw.areas).sum()) / 400
        assert covers + 0.005 < files[0]["process"]["separate"]["covers"] < covers + 0.03


def test_the_half_of_a_line_across_the_edge_is_on_the_other_one() -> None:
    # Along the tile's left edge, with its twin cut away.
    layer = Layer(Ink("line", "#000000", 2.0), lines=geometries(line((0, 0), (0, 10))))
    tile = Artwork("edge", Cell(10_000, 10_000), (layer,))
    done = SeparateProcess().apply(tile, Machine())
    assert isinstance(done, Artwork)
    covered = shapely.union_all(done.layers[0].areas)
    assert covered.equals(shapely.union_all([shapely.box(0, 0, 1, 10), shapely.box(9, 0, 10, 10)]))
    assert certify(done).passed


MARKED = """
[[output]]
format = "tiff"
dpi = 254
marks = true

[[output]]
format = "tiff"
name = "plain"
dpi = 254

[[output]]
format = "pdf"
marks = true
process = { kind = "separate" }
"""


def test_plates_of_a_tile_have_marks_and_the_name_of_their_ink(recipe: Path) -> None:
    recipe.write_text(RECIPE + MARKED)
    code, report, _ = call(recipe)
    assert code == 0
    files = {Path(each["path"]).name: each for each in report["recipes"][0]["files"]}
    assert files["p-indigo.tiff"]["size_mm"] == files["p-lines.tiff"]["size_mm"] == [120, 84.5]
    out = recipe.parent / "out"
    marked = [~np.asarray(Image.open(out / f"p-{end}.tiff")) for end in ENDS]
    plain = [~np.asarray(Image.open(out / f"p-plain-{end}.tiff")) for end in ENDS]
    # The tile is where its trim marks say, and as it is without them, lines broad and on both edges.
    for one, other in zip(marked, plain, strict=True):
        assert (one[140:340, 140:340] == other).all()
    # Crosses, trim marks, the bar and the title stand on every plate, and its own patch on each alone.
    common = marked[0] & marked[1] & marked[2]
    assert common.sum() > 3000
    for one in marked:
        own = one & ~common
        own[140:340, 140:340] = False
        assert 60 * 60 < own.sum() < 60 * 60 + 1500
    own = [one[480:] & ~common[480:] for one in marked]
    assert not (own[0] & own[1] | own[1] & own[2] | own[0] & own[2]).any()
    assert (out / "p-indigo.pdf").exists()


def test_marked_plates_as_drawings_are_checked_within_their_marks(recipe: Path) -> None:
    tables = '[[output]]\nformat = "svg"\nmarks = true\n'
    plates = tables + 'name = "plate"\nprocess = { kind = "separate" }\n'
    recipe.write_text(RECIPE + tables + plates)
    code, report, _ = call(recipe)
    assert code == 0
    assert {tuple(each["size_mm"]) for each in report["recipes"][0]["files"]} == {(120, 84.5)}
    drawings = sorted((recipe.parent / "out").glob("*.svg"))
    assert len(drawings) == 1 + len(ENDS)
    assert runner().invoke(cli, ["check", *map(str, drawings)]).exit_code == 0
    # A mark that the recipe does not make is told, for all that the printer's marks stand round it.
    text = drawings[0].read_text(encoding="utf-8")
    drawings[0].write_text(text.replace('<path d="M', '<path d="M55 55h2v2h-2zM', 1), encoding="utf-8")
    told = runner().invoke(cli, ["check", str(drawings[0])])
    assert told.exit_code == 1
    assert "the file and the recipe differ in 4 mm²" in told.output


def test_lines_on_a_plate_of_a_cloth_are_areas(recipe: Path) -> None:
    recipe.write_text(RECIPE + '\n[yardage]\nwidth = "40 mm"\nlength = "40 mm"\nmarks = true\n')
    code, _, _ = call(recipe, "-f", "svg", "--process", "separate ink=lines")
    assert code == 0
    found = read_svg(recipe.parent / "out" / "p.svg").artwork
    (plate,) = (each for each in found.layers if each.ink.name == "lines")
    assert not len(plate.lines)
    # Of a ring for each tile, as broad as the ink.
    covered = shapely.area(shapely.union_all(plate.areas))
    assert covered == pytest.approx(4 * np.pi * 8 * 0.8, rel=0.02)


def test_pixels_that_are_not_whole_are_told(recipe: Path) -> None:
    _, report, _ = call(recipe, "-f", "tiff,png", "--process", "separate", "--dpi", "150")
    words = report["recipes"][0]["warnings"]
    assert [each.split(":")[0] for each in words] == ["p.tiff", "p.png", "p.png"]
    assert "118.11 pixels" in words[0]
    assert "whole pixels in a metre, 5,906 for 150 dpi" in words[2]
    _, report, _ = call(recipe, "-f", "png,tiff", "--process", "separate", "--dpi", "254")
    assert report["recipes"][0]["warnings"] == []


@pytest.mark.parametrize(
    ("process", "words"),
    [
        ("separate ink=indgo", 'process.ink: unknown ink "indgo": did you mean "indigo"?'),
        ("separate colour=red", 'unknown colour "red"'),
        ("misregister by=30mm", "expected 0 to 20 mm"),
        ("misregister shifts.indgo=[0.1,0]", 'did you mean "indigo"?'),
        ("misregister seed=2 shifts.indigo=[0.1,0]", "nothing to chance"),
    ],
)
def test_what_is_wrong_is_told_and_nothing_written(recipe: Path, process: str, words: str) -> None:
    done = runner().invoke(
        cli, ["compile", str(recipe), "-o", str(recipe.parent / "out"), "-f", "svg", "--process", process]
    )
    assert (done.exit_code, words in done.stderr, done.stderr.count("\n")) == (2, True, 1), done.stderr
    assert not (recipe.parent / "out").exists()


def two_inks(gap: float = 0.0, frame: float = 4.0) -> Artwork:
    """A square of one ink that is cut out of another, which frames it on bare cloth."""
    around = shapely.box(6 - frame, 6 - frame, 14 + frame, 14 + frame)
    light = geometries(shapely.difference(around, shapely.box(6, 6, 14, 14)))
    dark = geometries(shapely.box(6 - gap, 6 - gap, 14 + gap, 14 + gap))
    return Artwork(
        "two",
        Cell(20_000, 20_000),
        (Layer(Ink("light", "#e8d070"), light), Layer(Ink("dark", "#1d2f5f"), dark)),
    )


def off(artwork: Artwork, **keys: Any) -> Artwork:
    done = MisregisterProcess(**keys).apply(artwork, Machine())
    assert isinstance(done, Artwork)
    return done


def test_ink_out_of_register_bares_what_a_trap_covers() -> None:
    bare = off(two_inks(), shifts={"dark": (0.3, 0.1)}).facts["misregister"]["bare_mm2"]
    # A strip on the left and one below, but for the corner that both have.
    assert bare == pytest.approx(8 * 0.3 + 8 * 0.1 - 0.3 * 0.1, abs=1e-3)
    # A narrow frame, but broader than the ink is off, keeps bare cloth apart all the same.
    thin = off(two_inks(frame=0.8), shifts={"dark": (0.3, 0.1)}).facts["misregister"]["bare_mm2"]
    assert thin == pytest.approx(bare, abs=1e-3)
    assert off(two_inks(0.3), shifts={"dark": (0.3, 0.1)}).facts["misregister"]["bare_mm2"] == 0


def test_what_is_out_of_register_is_not_asked_for_its_group(recipe: Path) -> None:
    recipe.write_text(RECIPE.replace("[tile]", '[tile]\nrepeat = "pmm"'))
    code, _, _ = call(recipe, "-f", "svg", "--process", "misregister by=0.4mm")
    assert code == 0
    checked = runner().invoke(cli, ["check", str(recipe.parent / "out" / "p.svg")])
    assert "pmm is not kept by misregister, and is not asked of it any more" in checked.output
    assert checked.exit_code == 0, checked.output


def test_seeds_give_directions_and_the_first_ink_stays() -> None:
    vectors = [off(two_inks(), by=0.4, seed=seed).facts["misregister"]["shifts_mm"] for seed in (0, 0, 1)]
    assert vectors[0] == vectors[1] != vectors[2]
    assert vectors[0]["light"] == [0, 0]
    assert np.hypot(*vectors[0]["dark"]) == pytest.approx(0.4, abs=1e-3)


def test_a_shifted_tile_is_a_tile_and_loses_nothing() -> None:
    whole = compile_recipe_of(RECIPE)
    done = off(whole, shifts={"indigo": (3.1, 4.6), "lines": (-1.2, 0.7)})
    assert certify(done).passed
    for before, after in zip(whole.layers[:2], done.layers[:2], strict=True):
        assert shapely.area(after.areas).sum() == pytest.approx(shapely.area(before.areas).sum(), abs=0.02)


def compile_recipe_of(text: str) -> Artwork:
    from batik_vector.recipe.loading import read_recipe

    return compile_recipe(read_recipe(text))


def test_a_plate_that_is_none_is_refused() -> None:
    with pytest.raises(GeometryError, match="the page has no ink"):
        SeparateProcess().apply(Artwork("", Cell(10, 10), ()), Machine())
