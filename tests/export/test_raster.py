from __future__ import annotations

import io
import tracemalloc
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image
from shapely.affinity import affine_transform
from shapely.geometry.base import BaseGeometry

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export import PngOptions, TiffOptions, render
from batik_vector.export.raster import bands, sheet_of
from batik_vector.tiling.cloth.field import field_page, repeated
from tests.strategies import polygons

from .drawings import InPieces, disc, geometries, line, sample

Pixels = NDArray[np.bool_]
COUNTS = np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1).sum(axis=1, dtype=np.uint8)
"""How many bits each byte has."""


def drawn(artwork: Artwork, dpi: float, rows: int = 256) -> Pixels:
    """What the pixels of a page are: True where they are black."""
    sheet = sheet_of(artwork, dpi)
    made = np.vstack(list(bands(artwork, sheet, rows)))
    bits = np.unpackbits(made, axis=1)
    assert not bits[:, sheet.width :].any()
    return bits[:, : sheet.width].astype(bool)


def inside(artwork: Artwork, pixels: Pixels) -> Pixels:
    """Which centres lie in one of the areas, as shapely tells."""
    height, width = pixels.shape
    x = (np.arange(width) + 0.5) * artwork.cell.width / width
    y = artwork.cell.height - (np.arange(height) + 0.5) * artwork.cell.height / height
    covered = shapely.union_all(np.concatenate([layer.areas for layer in artwork.layers]))
    return np.asarray(shapely.contains_xy(covered, *np.meshgrid(x, y)))


def of_areas(areas: Sequence[BaseGeometry], columns: int = 20_000, rows: int = 20_000) -> Artwork:
    return Artwork("areas", Cell(columns, rows), (Layer(Ink("a", "#000000"), geometries(*areas)),))


@settings(max_examples=40)
@given(
    st.lists(st.tuples(polygons(), st.floats(0, 20), st.floats(0, 20)), min_size=1, max_size=4),
    st.integers(9_000, 25_000),
    st.floats(30, 200),
)
def test_a_pixel_is_black_where_its_centre_lies_inside(
    shapes: list[tuple[shapely.Polygon, float, float]], columns: int, dpi: float
) -> None:
    moved = [affine_transform(each, [4, 0, 0, 4, x, y]) for each, x, y in shapes]
    on_grid = shapely.get_parts(shapely.set_precision(np.array(moved), 0.001))
    artwork = of_areas([each for each in on_grid if not shapely.is_empty(each)], columns)
    pixels = drawn(artwork, dpi, rows=7)
    # shapely is unsure of what lies on a border.
    assert (pixels != inside(artwork, pixels)).sum() <= 2


def test_areas_side_by_side_share_no_pixel_and_leave_none() -> None:
    # Borders along centres: 100 µm pixels, whose centres lie at odd multiples of 50.
    cut = [(0, 0), (3.05, 0), (7.05, 4.0), (3.05, 8.05), (3.05, 10), (0, 10)]
    left = shapely.Polygon(cut)
    right = shapely.difference(shapely.box(0, 0, 10, 10), left)
    one, other = (drawn(of_areas([each], 10_000, 10_000), 254) for each in (left, right))
    assert (one ^ other).all()
    assert one.sum() / 100 == pytest.approx(left.area, abs=0.6)


@pytest.mark.parametrize("drop", [Fraction(0), Fraction(1, 2)])
def test_a_plate_is_the_same_wherever_its_repeat_begins(drop: Fraction) -> None:
    spots = of_areas([disc(5.05, 5.05, 3.17, 1.05), disc(14, 12.3, 4.44)])
    tile = replace(spots, cell=Cell(20_000, 20_000, drop))
    once, four = drawn(tile, 254), drawn(repeated(tile, 2, 2), 254)
    down = int(drop * 200)
    beside = np.roll(once, -down, axis=0)
    assert np.array_equal(four[:200, :200], once)
    assert np.array_equal(four[200:, 200:], beside)
    assert np.array_equal(field_pixels(tile), np.roll(once, (60, 70), (0, 1))) or drop


def field_pixels(tile: Artwork) -> Pixels:
    """A repeat that begins 7 mm left of the tile's corner and 6 mm below its upper edge."""
    bled = np.vstack(list(bands(page := field_page(tile, bleed=8), sheet := sheet_of(page, 254))))
    return np.unpackbits(bled, axis=1)[:, : sheet.width].astype(bool)[20:220, 10:210]


def test_640_mm_at_254_dpi_are_6400_pixels_in_tiff_and_png() -> None:
    tile = of_areas([disc(x, 300, 41.3, 11) for x in (100, 300, 540)], 640_000, 640_000)
    read = Image.open(io.BytesIO(render(tile, "tiff")))
    other = Image.open(io.BytesIO(render(tile, "png", PngOptions(dpi=254, bilevel=True))))
    for image in (read, other):
        assert (image.size, image.mode) == ((6400, 6400), "1")
    assert read.info["dpi"] == (254, 254)
    assert other.info["dpi"] == pytest.approx((254, 254), abs=1e-9)
    assert np.array_equal(np.asarray(read), np.asarray(other))
    black = 1 - np.asarray(read).mean()
    assert black == pytest.approx(shapely.area(tile.layers[0].areas).sum() / 640**2, rel=1e-4)


def test_lines_have_the_body_of_their_ink() -> None:
    stem = Layer(Ink("stem", "#000000", 2.0), lines=geometries(line((5, 5), (15, 5))))
    pixels = drawn(Artwork("line", Cell(20_000, 20_000), (stem,)), 508)
    assert pixels.sum() * 0.05**2 == pytest.approx(10 * 2 + np.pi, rel=2e-3)


def test_pieces_make_no_difference() -> None:
    whole = sample()
    pieces = InPieces(whole)
    sheet = sheet_of(whole, 200)
    one, other = (np.vstack(list(bands(each, sheet))) for each in (whole, pieces))
    assert np.array_equal(one, other)


def test_what_is_no_tile_has_exactly_so_many_pixels_to_the_inch() -> None:
    bled = sample(5.0)
    image = Image.open(io.BytesIO(render(bled, "tiff", TiffOptions(dpi=150))))
    assert image.info["dpi"] == (150, 150)
    assert image.size == (296, 237)


def test_a_large_plate_needs_little_memory() -> None:
    # 1.5 × 3 m at 360 dpi would be 900 MB, a byte to a pixel.
    spots = [disc(x, y, 20) for x in range(50, 1500, 200) for y in range(50, 3000, 200)]
    page = of_areas(spots, 1_500_000, 3_000_000)
    sheet = sheet_of(page, 360)
    assert (sheet.width, sheet.height) == (21_260, 42_520)
    tracemalloc.start()
    black = sum(int(COUNTS[band].sum()) for band in bands(page, sheet))
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 100e6
    area = shapely.area(page.layers[0].areas).sum()
    assert black / (sheet.width * sheet.height) == pytest.approx(area / 4.5e6, rel=1e-4)


def test_too_many_pixels_are_refused() -> None:
    with pytest.raises(UnsupportedByFormatError, match=r"dpi = 5080 .* 600,000 × .* dpi is the"):
        render(of_areas([disc(5, 5, 1)], 3_000_000, 3_000_000), "tiff", TiffOptions(dpi=5080))


def test_nothing_is_white() -> None:
    assert not drawn(Artwork("", Cell(10_000, 10_000), ()), 100).any()
