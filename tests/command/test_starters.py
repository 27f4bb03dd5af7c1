"""What ``new`` begins with: every starter teaches, compiles at once and is a cloth that can be waxed."""

from __future__ import annotations

import functools
import time
from dataclasses import replace
from pathlib import Path

import pytest
import shapely

from batik_vector import Artwork, certify, compile_cloth, compile_recipe, load_recipe
from batik_vector.artwork import violations
from batik_vector.command.cli import KINDS, cli
from batik_vector.command.starters import STARTERS, summary
from batik_vector.tiling.cloth.field import collected
from tests.calling import runner

THINNEST = 0.8
"""Millimetres: what is thinner is no line that a fine canting draws, but for the very tips of leaves."""
TIPS = 0.025
"""Share of an ink's area that may be such tips."""
LONGEST_SUMMARY = 66
"""Characters that stand beside the longest name in a window of 80."""


@functools.cache
def timed(kind: str) -> tuple[Artwork, float]:
    began = time.process_time()
    artwork = compile_recipe(load_recipe(STARTERS / f"{kind}.toml"))
    return artwork, time.process_time() - began


def compiled(kind: str) -> Artwork:
    return timed(kind)[0]


def test_there_are_ten_and_each_kind_that_was_promised() -> None:
    assert len(KINDS) >= 10
    assert set(KINDS) >= {"flower", "four-square", "half-drop", "rosette"}, "those that came first"
    assert set(KINDS) >= {"kawung", "ceplok", "truntum", "mega-mendung", "toss", "own-drawing"}
    assert set(KINDS) >= {"border", "yardage", "wallpaper"}


@pytest.mark.parametrize("kind", KINDS)
def test_it_compiles_at_once_and_its_certificate_passes(kind: str) -> None:
    artwork, seconds = timed(kind)
    assert seconds < 4, "about one, with room for a slow machine"
    assert violations(artwork) == []
    certificate = certify(artwork, symmetry=False)
    assert certificate.passed, certificate.faults


@pytest.mark.parametrize("kind", KINDS)
def test_it_covers_as_batik_does(kind: str) -> None:
    artwork = compiled(kind)
    ink = shapely.union_all([area for layer in artwork.layers for area in layer.areas])
    # Bands of graded dips leave little to the last one.
    most = 0.9 if kind == "mega-mendung" else 0.7
    assert 0.3 < ink.area / (artwork.cell.width * artwork.cell.height) < most
    assert all(len(layer.lines) == 0 for layer in artwork.layers), "wax has a body"


@pytest.mark.parametrize("kind", KINDS)
def test_no_line_is_thinner_than_a_canting(kind: str) -> None:
    artwork = compiled(kind)
    # A mark that the tile's edge halves is whole on the cloth.
    inside = shapely.box(0, 0, artwork.cell.width, artwork.cell.height).buffer(-2)
    for layer in artwork.layers:
        ink = shapely.simplify(layer.areas, 0.02)
        opened = shapely.buffer(shapely.buffer(ink, -THINNEST / 2, quad_segs=4), THINNEST / 2, quad_segs=4)
        lost = shapely.intersection(shapely.difference(ink, opened), inside)
        kept = shapely.intersection(ink, inside)
        assert shapely.area(lost).sum() <= TIPS * shapely.area(kept).sum(), layer.ink.name


@pytest.mark.parametrize("kind", ["border", "yardage"])
def test_the_cloth_is_sound(kind: str) -> None:
    whole = load_recipe(STARTERS / f"{kind}.toml")
    assert whole.yardage
    recipe = replace(whole, yardage=replace(whole.yardage, width=324.0, length=324.0))
    assert violations(collected(compile_cloth(recipe))) == []


@pytest.mark.parametrize("kind", KINDS)
def test_it_opens_with_a_line_and_says_how_to_vary_it(kind: str) -> None:
    path = STARTERS / f"{kind}.toml"
    assert 20 < len(summary(path)) <= LONGEST_SUMMARY
    text = path.read_text("utf-8")
    assert text.count("#") >= 8, "commented"
    assert len(text.splitlines()) <= 110, "short"


@pytest.mark.parametrize("words", [["new"], ["new", "--list"]])
def test_the_kinds_are_told_in_a_line_each(desk: Path, words: list[str]) -> None:
    result = runner().invoke(cli, words)
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert [line.split()[0] for line in lines] == list(KINDS)
    assert all(len(line) <= 80 for line in lines)
    assert "batik-vector new mine --kind" in result.stderr
    assert list(desk.iterdir()) == []


@pytest.mark.parametrize(
    ("wrong", "right"), [("kawng", "kawung"), ("foursquare", "four-square"), ("Toss", "toss")]
)
def test_a_wrong_kind_gets_the_nearest(desk: Path, wrong: str, right: str) -> None:
    result = runner().invoke(cli, ["new", "mine", "--kind", wrong])
    assert result.exit_code == 2
    assert f'unknown kind "{wrong}": did you mean "{right}"?' in result.stderr
    assert list(desk.iterdir()) == []


@pytest.mark.parametrize(("name", "kind"), [("kawung", "kawung"), ("Toss.toml", "toss"), ("mine", "flower")])
def test_a_name_that_is_a_kind_begins_as_that(desk: Path, name: str, kind: str) -> None:
    assert runner().invoke(cli, ["new", name]).exit_code == 0
    (written,) = desk.iterdir()
    first = written.read_text("utf-8").splitlines()[0]
    assert first == (STARTERS / f"{kind}.toml").read_text("utf-8").splitlines()[0]
