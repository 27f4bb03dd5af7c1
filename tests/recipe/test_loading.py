"""Recipes as they are read: values, text, changes from outside, lines, the schema."""

from __future__ import annotations

import datetime
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector import compile_recipe, load_recipe, read_recipe, write_artwork
from batik_vector.artwork import Artwork, Cell, Overlap
from batik_vector.errors import Fault, GeometryError, RecipeError
from batik_vector.export.options import DxfOptions, SvgOptions
from batik_vector.recipe.loading import located
from batik_vector.recipe.model import ClothSpec, InkSpec, Placement
from batik_vector.recipe.motif import Flower, Pistil, Rosette
from batik_vector.recipe.outputs import PdfOutput, SvgOutput
from batik_vector.recipe.reading.lines import Lines, parse_path
from batik_vector.recipe.references import Path as Keys
from batik_vector.recipe.references import dotted
from batik_vector.tiling.layouts import Julian
from batik_vector.tiling.symmetry.repeats import TileSpec

DESIGN = """\
title = "Four-square flower"            # Tian et al. 2019, Figure 14b
tolerance = "0.02 mm"
seed = 7                                # everything random hangs on it

[motif.flower]
kind   = "flower"
leaf   = { a = 0.2, b = 20, length = 1.2, width = 0.3, count = 8 }
petal  = { length = 1.0, count = 8 }
pistil = { length = 0.8, count = 16, cusp = 5 }
core   = { length = 0.5, count = 8, radius = 0.1 }

[ink.wax]
colour = "#f4efe2"

[cloth]
colour = "#1d2f5f"

[[place]]
motif  = "flower"
layout = { kind = "julian", power = 4, dist = 4, level = 1, shift = [1.3333, 1.3333], turn = 0 }
width  = "280 mm"
ink    = "wax"

[tile]
size   = ["320 mm", "320 mm"]
repeat = "half-drop"

[[output]]
format = "dxf"
"""

SMALL = """\
[motif.dot]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 1 } }]
[[place]]
motif = "dot"
scale = 1
[tile]
size = [20, 10]
"""


def faults(text: str, *overrides: str) -> list[str]:
    with pytest.raises(RecipeError) as caught:
        read_recipe(text, "k.toml", overrides)
    return [str(fault) for fault in caught.value.faults]


def test_the_recipe_of_the_design_is_read_as_written() -> None:
    recipe = read_recipe(DESIGN)
    assert (recipe.title, recipe.tolerance, recipe.seed) == ("Four-square flower", 0.02, 7)
    flower = recipe.motif["flower"]
    assert isinstance(flower, Flower)
    assert (flower.leaf.b, flower.leaf.count, flower.pistil.cusp, flower.core.radius) == (20.0, 8, 5, 0.1)
    assert recipe.ink == {"wax": InkSpec(colour="#f4efe2")}
    assert recipe.cloth == ClothSpec(colour="#1d2f5f")
    placement = recipe.place[0]
    assert placement.layout == Julian(power=4, dist=4.0, level=1, shift=(1.3333, 1.3333))
    assert (placement.width, placement.scale, placement.ink) == (280.0, None, "wax")
    assert recipe.tile == TileSpec(size=(320.0, 320.0), repeat="half-drop")
    assert [output.format for output in recipe.output] == ["dxf"]
    assert recipe.source == DESIGN


def test_what_is_left_out_has_its_default() -> None:
    recipe = read_recipe(SMALL)
    assert list(recipe.ink) == ["ink"]
    assert isinstance(recipe.motif["dot"], Rosette)
    assert recipe.output == ()
    assert recipe.tiling.repeat == "grid"


@pytest.mark.parametrize(
    ("written", "millimetres"),
    [
        ('"28 cm"', 280.0),
        ("280", 280.0),
        ("280.5", 280.5),
        ('"1 in"', 25.4),
        ('".5m"', 500.0),
        ('"1e2 mm"', 100.0),
    ],
)
def test_lengths_carry_units(written: str, millimetres: float) -> None:
    assert read_recipe(SMALL.replace("scale = 1", f"width = {written}")).place[0].width == millimetres


def test_colours_have_one_spelling() -> None:
    recipe = read_recipe(
        SMALL + '[ink.a]\ncolour = "#FED"\noverlap = "knockout"\n[cloth]\ncolour = "#ABCDEF"'
    )
    assert (recipe.ink["a"].colour, recipe.cloth.colour) == ("#ffeedd", "#abcdef")
    assert recipe.ink["a"].overlap is Overlap.KNOCKOUT


def test_line_ends_and_a_byte_order_mark_change_nothing(tmp_path: Path) -> None:
    path = tmp_path / "k.toml"
    path.write_bytes(b"\xef\xbb\xbf" + SMALL.replace("\n", "\r\n").encode())
    assert load_recipe(path) == read_recipe(SMALL) == read_recipe(SMALL.replace("\n", "\r\n"))


def test_outputs_have_the_options_of_their_format() -> None:
    text = '[[output]]\nformat = "svg"\nname = "field"\nprofile = "compact"\nrepeat = [3, 2]\n'
    text += '[[output]]\nformat = "pdf"\nbleed = "5 mm"\ninks = "spot"\n'
    text += '[[output]]\nformat = "dxf"\nversion = "R12"\n'
    svg, pdf, dxf = read_recipe(SMALL + text).output
    assert isinstance(svg, SvgOutput)
    assert isinstance(pdf, PdfOutput)
    assert (svg.name, svg.repeat, svg.options) == ("field", (3, 2), SvgOptions(profile=svg.profile))
    assert (pdf.bleed, pdf.options.inks) == (5.0, "spot")
    assert type(dxf.options) is DxfOptions
    assert dxf.options.version == "R12"


def test_every_placement_names_an_ink_where_there_are_several() -> None:
    inks = "[ink.a]\n[ink.b]\n"
    words = "k.toml:4: place[0].ink: missing: the recipe has several inks, expected one of a, b"
    assert faults(SMALL + inks) == [words]
    assert read_recipe(SMALL.replace("scale = 1", 'scale = 1\nink = "b"') + inks).place[0].ink == "b"
    assert read_recipe(SMALL.replace("} }]", '}, ink = "a" }]') + inks)
    assert read_recipe(SMALL.replace("} }]", '}, treatment = "cut" }]') + inks)


def test_names_that_no_file_could_show_are_refused() -> None:
    more = '[ink."a\\u0000"]\n[motif.""]\nkind = "rosette"\nelements = [{ curve = { kind = "circle" } }]\n'
    found = faults(SMALL + more)
    assert [fault.split(": ", 2)[2] for fault in found] == [
        "expected a name of 1 to 80 printable characters"
    ] * 2


def test_a_recipe_built_in_python_is_checked_alike() -> None:
    good = read_recipe(DESIGN)
    with pytest.raises(
        RecipeError, match=r'place\[0\]\.motif: unknown motif "flowre": did you mean "flower"\?'
    ):
        replace(good, place=(Placement(motif="flowre", width=3.0),))
    with pytest.raises(GeometryError, match="width and scale"):
        Placement(motif="flower", width=3.0, scale=1.0)
    with pytest.raises(GeometryError, match="expected #rrggbb"):
        InkSpec(colour="blue")
    with pytest.raises(GeometryError, match="is a point"):
        Pistil(count=5, cusp=5)
    with pytest.raises(GeometryError, match="no folder"):
        SvgOutput(name="../x")


# Changes from outside.


def test_a_value_is_set_and_comments_stay() -> None:
    recipe = read_recipe(
        DESIGN, overrides=["motif.flower.petal.count=12", "place[0].width=200 mm", "title=New"]
    )
    assert recipe.motif["flower"] == replace(
        Flower(leaf=read_recipe(DESIGN).motif["flower"].leaf, pistil=Pistil(length=0.8, count=16, cusp=5)),  # type: ignore[union-attr]
        petal=replace(Flower().petal, count=12),
    )
    assert (recipe.place[0].width, recipe.title) == (200.0, "New")
    changed = [
        new for old, new in zip(DESIGN.split("\n"), recipe.source.split("\n"), strict=True) if old != new
    ]
    assert changed == [
        'title = "New"            # Tian et al. 2019, Figure 14b',
        "petal  = { length = 1.0, count = 12 }",
        'width  = "200 mm"',
    ]
    assert read_recipe(recipe.source) == recipe


@pytest.mark.parametrize(
    ("change", "path", "value"),
    [
        ("place.0.width=3", ("place", 0, "width"), 3),
        ('motif."flower".kind=flower', ("motif", "flower", "kind"), "flower"),
        ("ink.dye.colour=#abc", ("ink", "dye", "colour"), "#abc"),
        ('output[0]={format="pdf", bleed=3}', ("output", 0), {"format": "pdf", "bleed": 3}),
        ("tile.cut = unit", ("tile", "cut"), "unit"),
        ("tile.size=[10, '2 cm']", ("tile", "size"), [10, "2 cm"]),
        ("cloth.colour='#fff'", ("cloth", "colour"), "#fff"),
        ("title=a = b\nseed = 3", ("title",), "a = b\nseed = 3"),
    ],
)
def test_the_text_says_what_was_set(change: str, path: Keys, value: Any) -> None:
    data: Any = tomllib.loads(read_recipe(DESIGN, overrides=[change]).source)
    for part in path:
        data = data[part]
    assert data == value


def test_a_fault_that_was_set_is_told_of_the_setting_and_others_of_their_line() -> None:
    text = DESIGN.replace('"0.02 mm"', "0")
    assert faults(text, "seed=-1", "motif.flower.pistil.count=10") == [
        "--set motif.flower.pistil.count=10: motif.flower.pistil.count: 10 with cusp = 5: "
        "m = 10 is twice n = 5, a line segment: with n = 5 try m = 8, 9, 11",
        "--set seed=-1: seed: -1, expected 0 to 9223372036854775807",
        "k.toml:2: tolerance: 0, expected 0.002 to 5 mm",
    ]


# Files that say which recipe made them.


@pytest.mark.parametrize("suffix", ["svg", "pdf", "dxf", "gcode", "png"])
def test_a_compiled_file_is_its_recipe(tmp_path: Path, suffix: str) -> None:
    recipe = read_recipe(SMALL, overrides=["title=Dots & <more>"])
    first = write_artwork(compile_recipe(recipe), tmp_path / f"a.{suffix}")
    again = load_recipe(first)
    assert again == recipe
    second = write_artwork(compile_recipe(again), tmp_path / f"b.{suffix}")
    assert first.read_bytes() == second.read_bytes()


def test_a_file_made_from_python_says_that_it_has_no_recipe(tmp_path: Path) -> None:
    path = write_artwork(Artwork("x", Cell(1000, 1000), ()), tmp_path / "x.svg")
    with pytest.raises(RecipeError, match="was made from Python and carries no recipe"):
        load_recipe(path)


# Lines.

LINED = (
    '''\
# a comment [with] brackets = "and more"
title = """several
lines"""
a.b . "c d" = 1   # dotted
list = [ 1, # one
  [2, 3],
  { x = 1, y = { z = "}" } },
]
odd = 'it'''
    + """'
[t.u]
x = 1979-05-27 07:32:00
"q.r" = '''
]]'''
[[p]]
n = 1
[[p.q]]
m = 1
[[p.q]]
m = 2
[p.s]
k = -inf
[[p]]
n = 2
[[p.q]]
m = 3
"""
)


@pytest.mark.parametrize(
    ("key", "line"),
    [
        ("title", 2),
        ('a.b."c d"', 4),
        ("list", 5),
        ("list[0]", 5),
        ("list[1]", 6),
        ("list[1][1]", 6),
        ("list[2].y.z", 7),
        ("t", 10),
        ("t.u.x", 11),
        ('t.u."q.r"', 12),
        ("p", 14),
        ("p[0].n", 15),
        ("p[0].q[0].m", 17),
        ("p[0].q[1]", 18),
        ("p[0].q[1].m", 19),
        ("p[0].s.k", 21),
        ("p[1]", 22),
        ("p[1].q[0].m", 25),
        ("p[1].q[0].nothing.here", 24),
        ("nothing", None),
    ],
)
def test_every_key_has_its_line(key: str, line: int | None) -> None:
    text = LINED.replace("odd = 'it'", "odd = 'it'")
    tomllib.loads(text)
    assert Lines(text).line(parse_path(key)) == line


keys = st.lists(st.one_of(st.text(st.characters(codec="utf-8"), max_size=4), st.integers(0, 9)), max_size=5)


@given(keys)
def test_paths_are_read_as_they_are_written(rest: list[str | int]) -> None:
    path = ("k", *rest)
    assert parse_path(dotted(path)) == path


values = st.recursive(
    st.one_of(
        st.integers(-9, 9),
        st.text("ab\n\"'[]{}=#,. ", max_size=9),
        st.booleans(),
        st.just(datetime.date(2024, 2, 29)),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text("ab.[", max_size=3), inner, max_size=3)
    ),
    max_leaves=12,
)


@given(st.dictionaries(st.text("ab \"'", min_size=1, max_size=3), values, max_size=4))
def test_every_key_of_any_text_is_found(data: dict[str, Any]) -> None:
    import tomlkit

    text = tomlkit.dumps(data)
    lines = Lines(text)

    def look(value: Any, path: Keys) -> None:
        assert path in lines or not path
        for key, inner in (
            value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        ):
            look(inner, (*path, key))

    look(tomllib.loads(text), ())


def test_a_fault_of_a_later_stage_is_given_its_line() -> None:
    error = RecipeError(
        [
            Fault("power = 0: not so", "place[0].layout"),
            Fault("too large", "a b"),
            Fault("x", "", "y.toml", 3),
        ]
    )
    assert [str(fault) for fault in located(error, "k.toml", DESIGN).faults] == [
        "k.toml: a b: too large",
        "y.toml:3: x",
        "k.toml:20: place[0].layout.power: 0: not so",
    ]
