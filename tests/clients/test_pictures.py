"""The comparisons must be able to fail: each of these drawings is wrong in one way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import shapely
from PIL import Image, ImageChops, ImageOps

from batik_vector.artwork import Artwork
from batik_vector.export import render
from tests.clients.drawings import artwork, outlines
from tests.clients.pictures import differing, reference, stray
from tests.thorough import rarely

PER_MM = 4.0


def scaled(picture: Image.Image) -> Image.Image:
    """What a page at 90 and not 96 dpi looks like."""
    small = picture.resize((picture.width * 90 // 96, picture.height * 90 // 96))
    out = picture.copy()
    out.paste(small, (0, 0))
    return out


def stretched(picture: Image.Image) -> Image.Image:
    """One in a hundred too wide."""
    wide = picture.resize((round(picture.width * 1.01), picture.height))
    return wide.crop((0, 0, *picture.size))


WRONGS: dict[str, Callable[[Image.Image], Image.Image]] = {
    "mirrored": ImageOps.mirror,
    "upside down": ImageOps.flip,
    "turned": lambda picture: picture.rotate(180),
    "scaled": scaled,
    "stretched": stretched,
    "shifted": lambda picture: ImageChops.offset(picture, 3, 0),
    "inverted": ImageOps.invert,
}


@pytest.mark.parametrize("wrong", rarely(list(WRONGS.values()), 3), ids=list(WRONGS))
def test_a_wrong_picture_is_told(lopsided: Artwork, wrong: Callable[[Image.Image], Image.Image]) -> None:
    picture = reference(render(lopsided, "svg"), PER_MM)
    assert differing(picture, picture) == 0
    assert differing(picture, wrong(picture)) > 5e-3


@pytest.mark.parametrize("wrong", [name for name in WRONGS if name != "inverted"])
def test_wrong_outlines_are_told(lopsided: Artwork, wrong: str) -> None:
    picture = reference(outlines(lopsided, 1 / PER_MM), PER_MM)
    assert stray(picture, picture) == 0
    assert stray(picture, WRONGS[wrong](picture)) > 0.05


def test_a_missing_mark_is_told(lopsided: Artwork) -> None:
    layer = lopsided.layers[-1]
    areas, lines = layer.areas[1:], layer.lines[1:]
    poorer = replace(lopsided, layers=(*lopsided.layers[:-1], replace(layer, areas=areas, lines=lines,
                     area_names=(), line_names=())))  # fmt: skip
    whole, less = (reference(render(each, "svg"), PER_MM) for each in (lopsided, poorer))
    assert differing(whole, less) > 1e-3
    drawn, left = (reference(outlines(each, 1 / PER_MM), PER_MM) for each in (lopsided, poorer))
    assert stray(drawn, left) > 1e-3


def test_filled_holes_are_told() -> None:
    lopsided = artwork("three-baths")
    layers = tuple(
        replace(layer, areas=np.asarray(shapely.polygons(shapely.get_exterior_ring(layer.areas)), object))
        for layer in lopsided.layers
    )
    filled = replace(lopsided, layers=layers)
    whole, less = (reference(render(each, "svg"), PER_MM) for each in (lopsided, filled))
    assert differing(whole, less) > 1e-3
