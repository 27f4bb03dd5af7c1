"""Palettes: what is light stays light, equal colours stay equal, and wrong names are told."""

from __future__ import annotations

import itertools
import json
from dataclasses import replace
from pathlib import Path

import pytest
import shapely
from PIL import Image

from batik_vector import compile_recipe, load_recipe, read_recipe
from batik_vector.command.cli import cli
from batik_vector.errors import RecipeError
from batik_vector.making.palettes import colourway_axis, in_colourway, palette_axis, recoloured
from batik_vector.making.variants import parse_axis, variants
from batik_vector.recipe.palettes import PALETTES, lightness
from tests.calling import runner

SAMPLES = Path(__file__).parents[2] / "samples"


@pytest.mark.parametrize("sample", ["four-square", "kawung", "traced-leaf", "group-p4g"])
@pytest.mark.parametrize("palette", ["kelengan", "tiga-negeri", "solo", "guizhou", "lagoon"])
def test_light_stays_light(sample: str, palette: str) -> None:
    path = SAMPLES / f"{sample}.toml"
    before = load_recipe(path)
    after = load_recipe(path, recoloured(before, palette))
    old = [before.cloth.colour, *(ink.colour for ink in before.ink.values())]
    new = [after.cloth.colour, *(ink.colour for ink in after.ink.values())]
    assert set(new) <= set(PALETTES[palette].colours)
    for (a, x), (b, y) in itertools.combinations(zip(old, new, strict=True), 2):
        assert (lightness(a) < lightness(b)) <= (lightness(x) <= lightness(y))
        assert (a == b) <= (x == y)
    assert {PALETTES[palette].colours[0], PALETTES[palette].colours[-1]} <= set(new)


def test_the_palettes_run_from_light_to_dark() -> None:
    for name, palette in PALETTES.items():
        found = [lightness(colour) for colour in palette.colours]
        assert found == sorted(found, reverse=True)
        # Guizhou's indigo has three steps beside the cloth.
        assert len(set(palette.colours)) == len(palette.words) == (4 if name == "guizhou" else 5)
        assert palette.source
        assert palette.title
        assert palette.home in ("tradition", "market")


def test_an_axis_of_palettes_names_its_variants() -> None:
    recipe = load_recipe(SAMPLES / "kawung.toml")
    axes = [parse_axis("seed=1,2"), palette_axis(recipe, ["sogan", "kelengan", "sogan"])]
    found = list(variants(axes, "kawung"))
    assert [each.name for each in found] == [
        f"kawung_seed-{seed}_palette-{name}" for seed in (1, 2) for name in ("sogan", "kelengan")
    ]
    assert len(palette_axis(recipe, ["all"]).values) == len(PALETTES)
    name, ink = next(iter(recipe.ink.items()))
    printed = replace(ink, cmyk=(0, 2, 8, 4))
    with pytest.raises(RecipeError, match=rf"ink.{name}: palettes are for the screen, and the cmyk"):
        palette_axis(replace(recipe, ink={**recipe.ink, name: printed}), ["sogan"])
    with pytest.raises(RecipeError, match='unknown palette "sogann": did you mean "sogan"'):
        palette_axis(recipe, ["sogann"])


DRAWN = """
[ink.leaf]
colour = "#00ff00"
width = "0.3 mm"
[motif.own]
kind = "svg"
file = "own.svg"
colours = true
dress = [{ colour = "#0000ff", ink = "leaf" }]
[[place]]
motif = "own"
width = "30 mm"
[tile]
size = ["40 mm", "40 mm"]
"""
OWN = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 30" width="30mm" height="30mm">
<path d="M0 0h8v8h-8z" fill="#00ff00"/><path d="M10 0h8v8h-8z" fill="#ffee00"/>
<path d="M20 0h8v8h-8z" fill="#ffef00"/><path d="M0 10h8v8h-8z" fill="#111111"/>
<path d="M10 10h8v8h-8z" fill="#0000ff"/></svg>"""


@pytest.mark.parametrize("ink", ['[ink.leaf]\ncolour = "#00ff00"\nwidth = "0.3 mm"', '[ink."#00ff00"]', ""])
@pytest.mark.parametrize("palette", ["sogan", "lasem"])
def test_drawings_that_keep_their_colours_take_those_of_a_palette(
    tmp_path: Path, ink: str, palette: str
) -> None:
    (tmp_path / "own.svg").write_text(OWN)
    text = DRAWN.replace('[ink.leaf]\ncolour = "#00ff00"\nwidth = "0.3 mm"', ink)
    text = text if "leaf]" in ink else text.replace('dress = [{ colour = "#0000ff", ink = "leaf" }]', "")
    before = read_recipe(text, folder=tmp_path)
    after = read_recipe(text, overrides=recoloured(before, palette), folder=tmp_path)
    # Each ink is what it was, in its place, and draws the same marks; none is left in its old colour.
    assert [*after.ink] == [*before.ink]
    assert [each.width for each in after.ink.values()] == [each.width for each in before.ink.values()]
    assert {each.colour for each in after.ink.values()} <= set(PALETTES[palette].colours)
    old, new = compile_recipe(before), compile_recipe(after)
    assert [layer.ink.name for layer in old.layers] == [layer.ink.name for layer in new.layers]
    for one, other in zip(old.layers, new.layers, strict=True):
        assert shapely.equals_identical(one.areas, other.areas).all()
    # A palette on a palette is the second.
    again = recoloured(before, "ijo"), recoloured(after, "ijo")
    texts = text, after.source
    first, second = (
        read_recipe(each, overrides=changes, folder=tmp_path)
        for each, changes in zip(texts, again, strict=True)
    )
    assert [each.colour for each in first.ink.values()] == [each.colour for each in second.ink.values()]


def test_every_palette_suits_a_sample_that_keeps_the_colours_of_its_drawing() -> None:
    recipe = load_recipe(SAMPLES / "lasem-bird.toml")
    for changes in palette_axis(recipe, ["kelengan", "guizhou"]).changes:
        assert [*load_recipe(SAMPLES / "lasem-bird.toml", changes).ink] == ["rose", "cotton", "indigo"]


COLOURWAYS = """
[colourway.night]
cloth = "#101020"
ink = { soga = "#5577aa" }

[colourway.red]
palette = "bangbangan"
ink = { cotton = "#ffffff" }
"""


@pytest.fixture
def kawung(tmp_path: Path) -> Path:
    path = tmp_path / "k.toml"
    path.write_text((SAMPLES / "kawung.toml").read_text("utf-8") + COLOURWAYS)
    return path


def test_a_colourway_changes_what_it_says(kawung: Path) -> None:
    recipe = load_recipe(kawung)
    night, red = (load_recipe(kawung, in_colourway(recipe, name)) for name in ("night", "red"))
    assert (night.cloth.colour, night.ink["soga"].colour) == ("#101020", "#5577aa")
    assert night.ink["cotton"] == recipe.ink["cotton"]
    assert {red.cloth.colour, red.ink["soga"].colour} < set(PALETTES["bangbangan"].colours)
    assert red.ink["cotton"].colour == "#ffffff"
    assert compile_recipe(night).layers[0].areas.tolist() == compile_recipe(recipe).layers[0].areas.tolist()


def test_files_of_each_colourway_and_a_sheet(kawung: Path) -> None:
    out = kawung.parent / "out"
    done = runner().invoke(
        cli, ["compile", str(kawung), "--colourway", "all", "-o", str(out), "-f", "svg,tiff"]
    )
    assert done.exit_code == 0, done.stderr
    assert sorted(path.name for path in out.iterdir()) == sorted(
        f"k-{name}{end}" for name in ("night", "red") for end in (".svg", "-soga.tiff", "-cotton.tiff")
    )
    assert "#5577aa" in (out / "k-night.svg").read_text("utf-8")
    # Plates are black whatever the colour.
    assert read_pixels(out / "k-night-soga.tiff") == read_pixels(out / "k-red-soga.tiff")
    args = [
        "sweep",
        str(kawung),
        "--colourways",
        "all",
        "--sheet",
        "--sheet-format",
        "svg",
        "-o",
        str(out / "s"),
    ]
    assert runner().invoke(cli, args).exit_code == 0
    assert "colourway night" in (out / "s" / "k-sheet.svg").read_text("utf-8")


def read_pixels(path: Path) -> bytes:
    with Image.open(path) as image:
        return image.tobytes()


def test_a_colourway_that_is_not_there(kawung: Path) -> None:
    recipe = load_recipe(kawung)
    with pytest.raises(RecipeError, match='unknown colourway "nigth": did you mean "night"'):
        colourway_axis(recipe, ["nigth"])
    with pytest.raises(RecipeError, match=r"the recipe has none: expected \[colourway.NAME\]"):
        colourway_axis(load_recipe(SAMPLES / "kawung.toml"), ["all"])
    assert colourway_axis(recipe, ["all"]).values == ("night", "red")


def test_baths_take_the_dyes_of_a_palette() -> None:
    path = SAMPLES / "wax-javanese.toml"
    recipe = load_recipe(path)
    solo = load_recipe(path, recoloured(recipe, "solo"))
    assert [bath.colour for bath in solo.bath] == [colour for _, colour in PALETTES["solo"].baths]
    assert [bath.name for bath in solo.bath] == [bath.name for bath in recipe.bath]
    assert solo.cloth.undyed == solo.ink["white"].colour == PALETTES["solo"].colours[0]
    # What has seen both is darker than either.
    assert lightness(solo.cloth.colour) < min(lightness(bath.colour) for bath in solo.bath)
    assert load_recipe(path, ["palette=solo"]).ink == solo.ink
    with pytest.raises(RecipeError, match="palette pekalongan has no baths, the recipe 2: expected one of"):
        recoloured(recipe, "pekalongan")
    with pytest.raises(RecipeError, match="the palette lasem has one bath, the recipe 2"):
        recoloured(recipe, "lasem")


@pytest.mark.parametrize("text", [DRAWN, DRAWN.replace("colours = true", "")])
def test_a_recipe_names_its_palette(tmp_path: Path, text: str) -> None:
    (tmp_path / "own.svg").write_text(OWN)
    plain = read_recipe(text, folder=tmp_path)
    named = read_recipe(f'palette = "solo"\n{text}', folder=tmp_path)
    same = read_recipe(text, overrides=recoloured(plain, "solo"), folder=tmp_path)
    assert (named.ink, named.cloth) == (same.ink, same.cloth)
    # Compiled, built in Python or with another palette over it, it is what it says.
    built = replace(read_recipe(text, folder=tmp_path), palette="solo")
    for recipe in (named, built):
        assert {layer.ink.colour for layer in compile_recipe(recipe).layers} <= set(PALETTES["solo"].colours)
    other = read_recipe(named.source, overrides=recoloured(named, "lasem"), folder=tmp_path)
    assert {ink.colour for ink in other.ink.values()} <= set(PALETTES["lasem"].colours)
    assert [*other.ink] == [*plain.ink]


def test_a_palette_is_a_colourway(kawung: Path) -> None:
    recipe = load_recipe(kawung)
    changes = in_colourway(recipe, "cirebon")
    assert {ink.colour for ink in load_recipe(kawung, changes).ink.values()} < set(
        PALETTES["cirebon"].colours
    )
    assert colourway_axis(recipe, ["all", "cirebon"]).values == ("night", "red", "cirebon")
    out = kawung.parent / "out"
    args = ["colourways", str(kawung), "--colourway", "all,cirebon", "-o", str(out), "-f", "svg", "-f", "pdf"]
    done = runner().invoke(cli, args)
    assert done.exit_code == 0, done.stderr
    drawn = (out / "k-colourways.svg").read_text("utf-8")
    for words in ("as written", "night", "red", "cirebon", "cloth #101020", "soga #5577aa"):
        assert f">{words}</text>" in drawn
    # Each picture is in its own colours.
    assert drawn.count('fill="#5577aa"') == 1
    assert (out / "k-colourways.pdf").read_bytes().startswith(b"%PDF")


def test_palettes_are_listed() -> None:
    told = runner().invoke(cli, ["palettes"]).stdout
    for name, each in PALETTES.items():
        assert name in told
        assert each.source in told
    listed = {each["name"]: each for each in json.loads(runner().invoke(cli, ["palettes", "--json"]).stdout)}
    assert [*listed] == [*PALETTES]
    assert [*listed["solo"]["colours"].values()] == list(PALETTES["solo"].colours)
