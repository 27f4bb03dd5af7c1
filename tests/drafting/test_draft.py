"""Tiles taken over: the recipe draws the drawing's cloth, with its group, and every mark is a motif once."""

from __future__ import annotations

import functools
import math
import re
import tomllib
from typing import Any

import pytest

from batik_vector import compile_recipe, read_recipe
from batik_vector.drafting.draft import Draft, drafted
from batik_vector.errors import GeometryError
from batik_vector.export import render
from batik_vector.importing.document import DrawingError
from batik_vector.tiling.symmetry.groups import GROUPS, Kind
from tests.importing.drawings import svg

HIGH = {Kind.ANY: 30.0, Kind.SQUARE: 24.0, Kind.HEXAGONAL: 41.569}


def draft(inner: str, head: str = 'width="60mm" height="40mm" viewBox="0 0 60 40"', **said: Any) -> Draft:
    return drafted(svg(inner, head), lambda text: compile_recipe(read_recipe(text)), **said)


@functools.cache
def tables(text: str) -> dict[str, Any]:
    return tomllib.loads(text)


@pytest.mark.parametrize("name", GROUPS)
def test_every_group_is_found_and_one_mark_of_it_placed(name: str) -> None:
    width, height = 24.0, HIGH[GROUPS[name].kind]
    made = compile_recipe(
        read_recipe(
            f"""
            tile = {{ size = [{width}, {height}], repeat = "{name}" }}
            [motif.leaf]
            kind = "path"
            d = "M0 0 L4 1 C5 2 5 3 2 2.5 Z"
            [[place]]
            motif = "leaf"
            scale = 0.5
            region = "centre"
            """
        )
    )
    drawing = re.sub(rb"<metadata>.*?</metadata>", b"", render(made, "svg"), flags=re.DOTALL)
    found = drafted(drawing, lambda text: compile_recipe(read_recipe(text)))
    assert found.group.name == name
    assert found.proof.holds
    assert (found.marks, found.motifs, found.placed) == (GROUPS[name].copies, 1, 1)
    repeat = tables(found.text)["tile"]["repeat"]
    assert repeat == ("grid" if name == "p1" else name)


def test_two_hundred_dots_are_one_motif() -> None:
    dots = "".join(
        f'<circle cx="{5.37 * i % 50 + 2 + (i % 7) * 0.11:.2f}" cy="{i // 11 * 2.1 + 1:.2f}" r="0.7"/>'
        for i in range(200)
    )
    found = draft(dots)
    assert found.proof.holds
    assert found.motifs == 1
    (place,) = tables(found.text)["place"]
    assert len(place["layout"]["at"]) == found.placed
    assert all(len(spot) == 2 for spot in place["layout"]["at"])


STACKED = """
<rect width="60" height="40" fill="#223355"/>
<circle cx="20" cy="20" r="9" fill="#cc3322"/>
<circle cx="27" cy="20" r="9" fill="#eedd88"/>
<circle cx="34" cy="20" r="9" fill="#cc3322"/>
<circle cx="34" cy="20" r="3" fill="#223355"/>
<path d="M5 30h10v5h-10z" fill="#223355"/>
"""


def test_what_lies_on_top_stays_there() -> None:
    found = draft(STACKED)
    assert found.proof.holds
    recipe = tables(found.text)
    assert [ink["overlap"] for ink in recipe["ink"].values()] == ["knockout", "knockout"]
    assert recipe["cloth"]["colour"] == "#223355"
    # Discs stay whole; what has the cloth's colour cuts what is beneath it, and is nothing where nothing is.
    cut = [name for name, motif in recipe["motif"].items() if motif.get("treatment") == "cut"]
    assert [place.get("ink", "bare") for place in recipe["place"]] == ["red", "yellow", "red", "bare"]
    assert len(cut) == 1
    assert found.motifs == 3


def test_what_no_sheets_can_stack_is_drawn_as_it_shows() -> None:
    # Each disc lies over the one before it, all round the torus: the first over the last, too.
    discs = "".join(
        f'<circle cx="{x}" cy="20" r="13" fill="{fill}"/>'
        for x, fill in ((0, "#cc3322"), (20, "#eedd88"), (40, "#224488"), (60, "#cc3322"))
    )
    found = draft(discs)
    assert found.proof.holds
    assert found.motifs == 3


def test_turned_and_mirrored_marks_are_copies() -> None:
    leaf = '<path d="M0 0L4 1C5 2 5 3 2 2.5Z" transform="{}"/>'
    places = ["translate(8 9)", "translate(21 30) rotate(37.5)", "translate(44 12) scale(-1 1)"]
    found = draft("".join(leaf.format(place) for place in places))
    assert found.proof.holds
    assert (found.marks, found.motifs) == (3, 1)
    (place,) = tables(found.text)["place"]
    assert len(place["layout"]["mirrored"]) == 1
    assert [round(spot[2], 3) for spot in place["layout"]["at"] if len(spot) == 3] == [-37.5]


def test_strokes_are_marks_by_their_bodies() -> None:
    lines = '<g fill="none" stroke="#334" stroke-width="2"><path d="M10 10q10 8 20 0"/>'
    found = draft(lines + '<path d="M-5 30h70" stroke-dasharray="3 2"/><path d="M0 20h60"/></g>')
    assert found.proof.holds
    assert "ground-1" in tables(found.text)["motif"]


def test_a_half_drop_is_taken_as_one() -> None:
    inner = '<circle cx="12" cy="0" r="4"/><circle cx="12" cy="40" r="4"/><path d="M30 12l9 3-6 7z"/>'
    found = draft(inner, repeat="half-drop")
    assert found.proof.holds
    assert tables(found.text)["tile"] == {"size": ["60 mm", "40 mm"], "repeat": "half-drop"}


def test_a_page_of_several_repeats_becomes_one() -> None:
    flag = '<path d="M{} {}l6 1 -5 5z"/>'
    found = draft("".join(flag.format(x, y) for x in (4, 24, 44) for y in (7, 27)))
    assert (found.marks, found.placed) == (6, 1)
    assert tables(found.text)["tile"] == {"size": ["20 mm", "20 mm"], "repeat": "grid"}


def test_names_of_the_drawing_are_names_of_motifs() -> None:
    found = draft(
        '<path id="bird wing" d="M5 5l9 3-6 7z"/><rect id="stem" x="30" y="5" width="2" height="20"/>'
    )
    assert list(tables(found.text)["motif"]) == ["bird-wing", "stem"]


def test_long_outlines_stand_in_a_drawing_beside_the_recipe() -> None:
    angles = [2 * math.pi * i / 400 for i in range(400)]
    places = [(11 + i % 5, math.cos(angle), math.sin(angle)) for i, angle in enumerate(angles)]
    points = " ".join(f"{30 + r * x:.3f},{20 + r * y:.3f}" for r, x, y in places)
    found = draft(f'<polygon id="burr" points="{points}"/><circle cx="6" cy="6" r="3"/>', beside="own.svg")
    assert found.proof.holds
    motif = tables(found.text)["motif"]
    assert motif["burr"] == {"kind": "svg", "file": "own.svg", "elements": "burr"}
    assert 'id="burr"' in found.drawing


def test_the_same_drawing_gives_the_same_recipe() -> None:
    assert draft(STACKED).text == draft(STACKED).text


def test_what_cannot_be_taken_over_is_told() -> None:
    with pytest.raises(DrawingError, match="text hangs on a font"):
        draft('<text x="3" y="9">batik</text>')
    with pytest.raises(DrawingError, match="nothing is drawn"):
        draft("")
    with pytest.raises(GeometryError, match="expected"):
        draft(STACKED, repeat="herringbone")
