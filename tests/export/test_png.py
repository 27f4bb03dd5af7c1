from __future__ import annotations

import io

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from batik_vector.artwork import Artwork, Cell
from batik_vector.errors import ExportError, UnsupportedByFormatError
from batik_vector.export import png, svg
from batik_vector.export.options import PngOptions, Profile, SvgOptions

from .drawings import area_of, sample, stacked


def picture(artwork: Artwork, **options: object) -> Image.Image:
    return Image.open(io.BytesIO(png.render(artwork, PngOptions(**options))))  # type: ignore[arg-type]


def test_colours_cover_what_the_artwork_says() -> None:
    artwork = sample()
    image = picture(artwork, dpi=254)
    assert image.size == (400, 300)
    pixels = np.asarray(image.convert("RGB"), float)
    wax, cloth, soga = (np.array(c) for c in ((0xF4, 0xEF, 0xE2), (0x12, 0x34, 0x56), (0xA0, 0x30, 0x20)))

    def near(colour: NDArray[np.int64]) -> float:
        """Square millimetres of a colour."""
        return float((np.abs(pixels - colour).sum(axis=2) < 40).mean() * 1200)

    assert near(wax) == pytest.approx(area_of(artwork, 0), rel=0.03)
    assert near(cloth) > 700
    assert 5 < near(soga) < 40
    # Upright: the stem lies at the foot of the page.
    assert (np.abs(pixels[290] - soga).sum(axis=1) < 60).sum() > 300


@pytest.mark.parametrize("artwork", [sample(), stacked()])
@pytest.mark.parametrize("cloth", [True, False])
def test_it_is_to_the_pixel_what_cairosvg_makes_of_our_svg(artwork: Artwork, cloth: bool) -> None:
    import cairosvg

    ours = picture(artwork, dpi=100, cloth=cloth)
    drawing = svg.render(artwork, SvgOptions(profile=Profile.COMPACT, cloth=cloth, order=False))
    drawing = drawing.replace(b" viewBox=", b' preserveAspectRatio="none" viewBox=', 1)
    width, height = ours.size
    data = cairosvg.svg2png(bytestring=drawing, output_width=width, output_height=height)
    assert np.array_equal(np.asarray(ours), np.asarray(Image.open(io.BytesIO(data))))


def test_a_large_picture_has_fewer_shades_at_borders_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    fine = picture(sample(), dpi=254)
    monkeypatch.setattr(png, "LARGE_PIXELS", 1)
    large = picture(sample(), dpi=254)
    whole, coarse = (np.asarray(each.convert("RGB"), float) for each in (fine, large))
    assert 0 < np.abs(whole - coarse).mean() < 1
    assert (np.abs(whole - coarse).max(axis=2) > 40).mean() < 0.01
    assert large.info["dpi"] == pytest.approx((254, 254), abs=0.02)
    assert picture(sample(), dpi=254, cloth=False).mode == "RGBA"


def test_bleed_is_not_shown() -> None:
    assert picture(sample(5.0), dpi=254).size == (400, 300)
    plain, bled = (np.asarray(picture(sample(b), dpi=100).convert("RGB")) for b in (0.0, 5.0))
    assert np.array_equal(plain, bled)


def test_overlaid_marks_stay_filled() -> None:
    pixels = np.asarray(picture(stacked(), dpi=254).convert("RGB"))
    assert tuple(pixels[50, 50]) == (255, 0, 0)


def test_without_cloth_the_ground_is_clear() -> None:
    assert np.asarray(picture(sample(), cloth=False))[0, 0, 3] == 0
    # At 100 dpi the cell has no whole number of pixels: it is fitted to them, with no gap at any edge.
    assert (np.asarray(picture(sample(), dpi=100).convert("RGBA"))[..., 3] == 255).all()


def test_the_file_knows_its_resolution() -> None:
    assert picture(sample(), dpi=150).info["dpi"] == pytest.approx((150, 150), abs=0.02)


def test_too_many_pixels_are_refused_with_the_estimate() -> None:
    vast = Artwork("", Cell(5_000_000, 5_000_000), ())
    with pytest.raises(
        UnsupportedByFormatError, match=r"47,244 × 47,244 pixels .* (\d+) dpi is the most"
    ) as caught:
        png.render(vast, PngOptions(dpi=240))
    most = int(str(caught.value).split("GB): ")[1].split()[0])
    png.pixel_size(vast, most)
    with pytest.raises(ExportError):
        png.pixel_size(vast, most + 2)
    with pytest.raises(ExportError):
        png.pixel_size(Artwork("", Cell(40_000_000, 1_000), ()), 100)


def test_a_cloth_too_large_for_one_dpi_is_not_told_that_0_dpi_is_the_most() -> None:
    with pytest.raises(UnsupportedByFormatError, match=r"GB\): show less cloth, or the tile$"):
        png.pixel_size(Artwork("", Cell(1_000_000_000, 1_000_000_000), ()), 100)
