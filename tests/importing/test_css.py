"""What styles say in the ways of later CSS: origins, units, colours; and what is told about strokes."""

from __future__ import annotations

import pytest
import shapely

from batik_vector.importing.svg import read_svg, read_tile
from tests.importing.drawings import DISC, svg

PATH = "M10 10h20v10h-20z"


@pytest.mark.parametrize(
    ("given", "same"),
    [
        ('transform="rotate(30)" transform-origin="center"', "rotate(30 50 50)"),
        ('style="transform:rotate(90deg);transform-origin:20px 15px"', "rotate(90 20 15)"),
        ('style="transform:scale(.5);transform-origin:top right"', "translate(50 0) scale(.5)"),
        ('style="transform:scale(.5);transform-origin:right 25%"', "translate(50 12.5) scale(.5)"),
        ('transform="rotate(30)" transform-origin="0 0"', "rotate(30)"),
        ('style="transform:rotate(.25turn) translate(0, -60px)"', "rotate(90) translate(0 -60)"),
        ('style="transform:rotate(100grad) translate(0, -60px)"', "rotate(90) translate(0 -60)"),
        ('style="transform:rotate(0.5rad)"', "rotate(28.6478897565)"),
        ('style="transform:translate(.1in, 0)"', "translate(9.6 0)"),
    ],
)
def test_transforms_in_a_style_are_read_with_units_and_origin(given: str, same: str) -> None:
    head = 'width="200mm" height="200mm" viewBox="0 0 100 100"'
    found, expected = (
        read_tile(svg(f'<path d="{PATH}" {each}/>', head)).layers[0].areas
        for each in (given, f'transform="{same}"')
    )
    assert shapely.hausdorff_distance(found[0], expected[0]) < 1e-6


@pytest.mark.parametrize(
    ("colour", "expected"),
    [
        ("hsl(0deg 100% 50%)", "#ff0000"),
        ("hsl(120, 100%, 50%)", "#00ff00"),
        ("hsl(.5turn 100% 25% / 1)", "#008080"),
        ("rgb(100% 0 0 / 50%)", "#ff0000"),
        ("rgb(168 111 58)", "#a86f3a"),
        ("hwb(120 0% 0%)", None),
        ("rgb(1 2)", None),
        ("rgb(1px 2 3)", None),
    ],
)
def test_colours_with_spaces_are_read(colour: str, expected: str | None) -> None:
    reading = read_svg(svg(f'<circle cx="50" cy="50" r="9" fill="{colour}"/>'))
    told = any("is not understood" in note for note in reading.notes)
    assert told == (expected is None)
    assert expected is None or reading.artwork.layers[0].ink.colour == expected
    assert any("half transparent" in note for note in reading.notes) == ("50%)" in colour and "/" in colour)


def test_different_colours_that_are_not_understood_stay_different_inks() -> None:
    fills = ["var(--leaf)", "var(--stem)", "color(display-p3 1 0 0)", "var(--leaf)", "black"]
    inner = "".join(
        f'<circle cx="{10 + 20 * i}" cy="50" r="5" fill="{fill}"/>' for i, fill in enumerate(fills)
    )
    assert [len(layer.areas) for layer in read_tile(svg(inner)).layers] == [2, 1, 1, 1]


def test_each_ink_that_strokes_says_once_what_counts() -> None:
    strokes = '<path d="M5 5H80M5 9H80" fill="none" stroke="red" stroke-width="2"/>' * 2
    notes = read_svg(svg(DISC + strokes)).notes
    assert sum("measured by their bodies at the seam" in note for note in notes) == 1


def test_areas_alone_have_no_word_about_strokes() -> None:
    assert not any("stroke" in note for note in read_svg(svg(DISC)).notes)
