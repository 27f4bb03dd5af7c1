"""Every sample compiles to a sound, seamless tile in every format, and has its picture beside it."""

from __future__ import annotations

import functools
import tomllib
from pathlib import Path

import pytest

from batik_vector import Recipe, certify, compile_cloth, compile_recipe
from batik_vector.artwork import Artwork, violations
from batik_vector.certificate.symmetry.finder import found_group
from batik_vector.compiling.compiler import inspect
from batik_vector.export import FORMATS, render
from batik_vector.export.options import PngOptions, TiffOptions
from batik_vector.tiling.cloth.field import collected, repeated
from batik_vector.tiling.cloth.yardage import Yardage
from tests.thorough import rarely, some
from tests.tiling.test_seamless import assert_line_ends_meet, crossings, cuts, difference, rolled, twins
from tools import golden

FOLDER = Path(__file__).resolve().parent.parent / "samples"
PATHS = {path.stem: path for path in golden.samples()}
SAMPLES = sorted(PATHS)


@functools.cache
def recipe_of(name: str) -> Recipe:
    return golden.recipe_of(PATHS[name])


def says_of(table: str) -> list[str]:
    """Return the samples that have a table, as their text tells: to read them all takes seconds."""
    return [name for name in SAMPLES if table in tables_of(PATHS[name])]


def tables_of(path: Path) -> set[str]:
    """Return the names of a recipe's tables."""
    if path.suffix == ".py":
        return {name for name in ("tile", "yardage") if getattr(recipe_of(path.stem), name)}
    return set(tomllib.loads(path.read_text(encoding="utf-8")))


TILES = says_of("tile")
CLOTHS = says_of("yardage")

COPIES = {
    "p1": 1,
    "p2": 2,
    "pm": 2,
    "pg": 2,
    "cm": 4,
    "pmm": 4,
    "pmg": 4,
    "pgg": 4,
    "cmm": 8,
    "p4": 4,
    "p4m": 8,
    "p4g": 8,
    "p3": 6,
    "p3m1": 12,
    "p31m": 12,
    "p6": 12,
    "p6m": 24,
}
"""Copies of an asymmetric motif in the rectangular cell of each wallpaper group."""
FRIEZES = ("p1", "p11g", "p11m", "p1m1", "p2", "p2mg", "p2mm")

PAPER = {
    "four-square",
    *(f"figure-{number:02}" for number in (5, 6, 7, 8, 9)),
    *(f"figure-14{letter}" for letter in "abcd"),
}


@functools.cache
def compiled(name: str) -> Artwork:
    return compile_recipe(recipe_of(name))


@functools.cache
def cloth(name: str) -> Yardage:
    return compile_cloth(recipe_of(name))


def test_the_papers_figures_and_six_designs_more_are_there() -> None:
    assert set(SAMPLES) >= PAPER
    assert len(set(SAMPLES) - PAPER) >= 6


# For the whole module, so that one test after the other is done for a sample: it is compiled once.
in_turn = functools.partial(pytest.mark.parametrize, "name", scope="module")


@in_turn(rarely(TILES, 6))
def test_the_tile_is_sound_and_its_opposite_edges_are_bit_identical(name: str) -> None:
    artwork = compiled(name)
    assert violations(artwork) == []
    assert inspect(artwork)["seam"] == []
    recipe = recipe_of(name)
    cell = artwork.cell
    (_, slip_y), (slip_x, _) = cell.lattice
    for layer in artwork.layers:
        left, right = (crossings(layer, 0, x, cell.height) for x in (0.0, cell.width))
        assert twins(left, slip_y / 1000, cell.height) == right
        low, high = (crossings(layer, 1, y, cell.width) for y in (0.0, cell.height))
        assert twins(low, slip_x / 1000, cell.width) == high
        if not cuts(recipe):
            assert_line_ends_meet(layer, cell)


@in_turn(rarely(some(TILES, 3), 3))
def test_the_field_cut_elsewhere_is_the_tile(name: str) -> None:
    artwork = compiled(name)
    field = repeated(artwork, 2, 2)
    assert violations(field) == []
    again = rolled(field, artwork.cell, (0.3719 * artwork.cell.width, 0.6173 * artwork.cell.height))
    for layer, areas in zip(artwork.layers, again, strict=True):
        assert abs(difference(layer.areas, areas)) < 1e-6


@in_turn(rarely(TILES, 6))
def test_the_certificate_passes(name: str) -> None:
    certificate = certify(compiled(name), symmetry=False)
    assert certificate.passed, certificate.faults


@pytest.mark.parametrize("asked", rarely(list(COPIES), 4))
def test_the_group_in_the_drawing_is_the_one_asked_for(asked: str) -> None:
    artwork = compiled(f"group-{asked}")
    found = found_group(artwork.layers, artwork.cell)
    # More copies than these, or another name, would be a symmetry that nobody asked for.
    assert (found.name, found.copies) == (asked, COPIES[asked])


@in_turn(rarely(CLOTHS, 6))
def test_the_cloth_is_sound(name: str) -> None:
    page = cloth(name)
    assert violations(collected(page)) == []


def test_there_is_a_border_of_every_frieze_that_closes_a_rectangle() -> None:
    for frieze in FRIEZES:
        recipe = recipe_of(f"border-{frieze}")
        assert any(border.frieze == frieze and len(border.sides) == 4 for border in recipe.border)


@in_turn(rarely(SAMPLES, 6))
def test_every_format_is_written(name: str) -> None:
    """Each sample in two formats in turn; the programs they are for open all that matter in tests/clients."""
    page = compiled(name) if name in TILES else cloth(name)
    formats, turn = sorted(FORMATS), SAMPLES.index(name)
    for format_ in (formats[turn % len(formats)], formats[(turn * 3 + 1) % len(formats)]):
        coarse = {"png": PngOptions(dpi=15), "tiff": TiffOptions(dpi=15)}
        # A palette is short: it has the colours alone.
        least = {"gpl": 50, "ase": 50, "tiff": 500}.get(format_, 1000)
        assert len(render(page, format_, coarse.get(format_))) > least


@pytest.mark.parametrize("name", SAMPLES)
def test_the_sample_has_its_picture_and_stands_on_its_page(name: str) -> None:
    assert (FOLDER / f"{name}.png").stat().st_size > 2000
    pages = [path.name for path in FOLDER.glob("*.md") if f"({name}.png)" in path.read_text(encoding="utf-8")]
    assert len(pages) == 1
    assert (pages == ["FIGURES.md"]) == name.startswith(("figure-", "fractal-"))


@pytest.mark.parametrize("name", SAMPLES)
def test_the_recipe_opens_with_what_it_shows(name: str) -> None:
    begin = '"""' if PATHS[name].suffix == ".py" else "# "
    assert PATHS[name].read_text(encoding="utf-8").startswith(begin)
