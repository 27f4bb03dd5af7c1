"""Fills in recipes: they are copied with their motif, keep to what is seen, and leave the tile sound."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork
from batik_vector.certificate import certify
from batik_vector.certificate.expectations import Asked
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import BatikError
from batik_vector.geometry import work
from batik_vector.recipe.loading import read_recipe
from tests.thorough import examples, long

BASE = """
[cloth]
colour = "#17244a"
[ink.light]
colour = "#7d9fc6"
width = 0.8
[ink.cotton]
colour = "#f4efe2"
[motif.m]
kind = "rosette"
elements = [
  { name = "petal", curve = { kind = "petal", n = 2, length = 20 }, count = 4, ink = "cotton"PETAL },
  { name = "eye", curve = { kind = "circle", radius = 5 }, ink = "light", gap = 1EYE },
]
[[place]]
motif = "m"
SCALEATPLACE
[tile]
size = [50, 50]
repeat = "REPEAT"
"""

DOTS = ', fill_with = { kind = "cecek"'


def made(petal: str = "", eye: str = "", place: str = "", repeat: str = "grid") -> Artwork:
    text = BASE.replace("PETAL", petal).replace("EYE", eye).replace("PLACE", place).replace("REPEAT", repeat)
    text = text.replace("AT", "at = [0, 0]\n" if repeat == "p4m" else "")
    text = text.replace("SCALE", "" if "width = 300" in place else "scale = 1\n")
    return compile_recipe(read_recipe(text))


def ink(artwork: Artwork, name: str) -> Any:
    return shapely.union_all(next(layer.areas for layer in artwork.layers if layer.ink.name == name))


def holes(shape: shapely.Geometry) -> np.ndarray:
    """Return the areas of the holes of a shape."""
    rings = [hole for part in shapely.get_parts(shape) for hole in part.interiors]
    return np.array([shapely.Polygon(ring).area for ring in rings])


def test_marks_without_an_ink_stay_bare_in_what_is_filled() -> None:
    plain, dotted = made(), made(DOTS + ", width = 1 }")
    found = holes(ink(dotted, "cotton"))
    dot = 12 * 0.5 * 0.5**2 * np.sin(np.pi / 6)  # of twelve corners
    assert len(found) > 80
    assert found == pytest.approx(dot, rel=0.01)
    lost = ink(plain, "cotton").area - ink(dotted, "cotton").area
    assert lost == pytest.approx(found.sum(), rel=1e-6)


def test_marks_in_an_ink_lie_in_what_is_beneath_to_the_grid() -> None:
    plain, dotted = made(), made(DOTS + ', ink = "light" }')
    cotton, light = ink(dotted, "cotton"), ink(dotted, "light")
    assert cotton.intersection(light).area < 1e-6
    whole = ink(plain, "cotton").union(ink(plain, "light"))
    assert cotton.union(light).area == pytest.approx(whole.area, rel=1e-6)


def test_an_outline_is_filled_in_its_own_ink() -> None:
    outline = ', treatment = "stroke", ink = "light"'
    petal = outline.replace(', ink = "light"', "")
    lined = made(petal + ', fill_with = { kind = "galaran", margin = 1 }')
    parts = shapely.get_parts(ink(lined, "cotton"))
    assert len(parts) > 12
    # A line of 1 mm runs along the edge: its body, and then the margin, lie between the edge and the marks.
    solid = ink(made(), "cotton")
    marks = parts[shapely.area(parts) < shapely.area(parts).max()]
    edge = shapely.distance(marks, shapely.boundary(shapely.union_all(marks)))
    assert (edge == 0).all()
    body = ink(made(petal), "cotton")
    assert body.area < ink(lined, "cotton").area < solid.area


def test_what_lies_over_an_element_keeps_the_margin_too() -> None:
    marked = made(', fill_with = { kind = "cecek", ink = "light", width = 1, margin = 1 }')
    parts = shapely.get_parts(ink(marked, "light"))
    dots = parts[shapely.area(parts) < 2]
    eyes = parts[shapely.area(parts) > 2]
    assert len(dots) > 50
    # The eye's own gap of 1 mm, and the margin of another.
    assert min(shapely.distance(dots, eye).min() for eye in eyes) >= 1.999


@pytest.mark.parametrize("repeat", ["p4m", "half-drop"])
@pytest.mark.parametrize(
    "fill",
    [
        'kind = "cecek", follow = "contour"',
        'kind = "sawut", ink = "light"',
        'kind = "contours"',
        'kind = "sisik", width = 0.5',
    ],
)
def test_the_certificate_holds(fill: str, repeat: str) -> None:
    artwork = made(
        f", fill_with = {{ {fill} }}", ', fill_with = { kind = "cecek", follow = "contour" }', repeat=repeat
    )
    found = certify(artwork, asked=Asked("p4m", exactly=False) if repeat == "p4m" else None)
    assert found.passed


def test_a_placement_fills_what_has_no_fill_of_its_own() -> None:
    one = made(place='fill_with = { kind = "cecek", width = 1, spacing = 2.5 }')
    assert len(holes(ink(one, "cotton"))) > 30
    assert len(holes(ink(one, "light"))) > 2


REFUSED = {
    "margin": (
        DOTS + ", margin = 30 }",
        r'motif\.m\.elements\[0\]\.fill_with\.margin = 30: no mark of "cecek" has room',
    ),
    "ink": (
        DOTS + ', ink = "cotton" }',
        r'fill_with\.ink = "cotton": the element itself is filled with that ink',
    ),
    "dense": (
        DOTS + ", spacing = 0.05, width = 0.02 }",
        r"fill_with\.spacing = 0\.05: about .* expected at least",
    ),
}


@pytest.mark.parametrize(("petal", "words"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_is_told_with_key_and_value(petal: str, words: str) -> None:
    with pytest.raises(BatikError, match=words):
        made(petal, place="width = 300" if "0.05" in petal else "")


def test_many_bare_dots_cost_what_they_take(monkeypatch: pytest.MonkeyPatch) -> None:
    # Counted as so many crossings, or united two by two, 9,000 dots were work for three millions.
    monkeypatch.setattr(work, "LIMIT", 1_000_000.0)
    dots = DOTS + ", spacing = 0.3, width = 0.1, margin = 0.2 }"
    many = made(dots.replace("spacing = 0.3", "spacing = 0.24"))
    assert len(holes(ink(many, "cotton"))) > 8000


@long
@pytest.mark.skipif(examples(0, 1) == 0, reason="takes ten seconds")
def test_a_hundred_thousand_bare_dots_compile() -> None:
    begin = time.process_time()
    many = made(DOTS + ", spacing = 0.068, width = 0.03, margin = 0.05 }")
    assert time.process_time() - begin < 60
    assert len(holes(ink(many, "cotton"))) > 100_000


def test_a_seed_tosses_dots_otherwise() -> None:
    text = BASE.replace("PETAL", DOTS + ', follow = "scatter" }').replace("EYE", "").replace("PLACE", "")
    text = text.replace("REPEAT", "grid").replace("SCALE", "scale = 1\n").replace("AT", "")
    first, other = (compile_recipe(read_recipe(f"seed = {seed}\n{text}")) for seed in (1, 2))
    assert ink(first, "cotton").symmetric_difference(ink(other, "cotton")).area > 1
