"""Separations: what they show as without their inks, and which inks lie over others."""

from __future__ import annotations

import io
import re
from dataclasses import replace
from typing import Any

import pikepdf
import pytest
from PIL import Image, ImageCms

from batik_vector.artwork import Artwork, Ink, Overlap
from batik_vector.errors import GeometryError
from batik_vector.export import pdf
from batik_vector.export.options import Overprint, PdfInks, PdfOptions
from batik_vector.export.pdf.separations import cmyk_of, lab_of, reckoned
from tests.export.drawings import sample


def spaces(artwork: Artwork, **options: Any) -> list[tuple[str, list[float], list[float]]]:
    """The alternate of each separation, and its colours at no tint and at full tint."""
    document = pikepdf.open(io.BytesIO(pdf.render(artwork, PdfOptions(inks=PdfInks.SPOT, **options))))
    found = []
    for _, space in document.pages[0].Resources.ColorSpace.items():
        family: Any = space[2][0] if isinstance(space[2], pikepdf.Array) else space[2]
        none, full = ([float(part) for part in each] for each in (space[3].C0, space[3].C1))
        found.append((str(family), none, full))
    return found


def content(artwork: Artwork, **options: Any) -> str:
    document = pikepdf.open(io.BytesIO(pdf.render(artwork, PdfOptions(**options))))
    return document.pages[0].Contents.read_bytes().decode("ascii")


def inked(**more: Any) -> Artwork:
    """The sample with its first ink told in another way."""
    first, *others = sample().layers
    return replace(sample(), layers=(replace(first, ink=replace(first.ink, **more)), *others))


def test_an_ink_that_says_its_colour_in_print_shows_it() -> None:
    told = inked(cmyk=(10.0, 0.0, 62.5, 5.0))
    wax, soga, _ = spaces(told)
    assert wax == ("/DeviceCMYK", [0, 0, 0, 0], [0.1, 0, 0.625, 0.05])
    assert soga[0] == "/DeviceRGB"
    assert spaces(inked(lab=(88.5, -3.25, 40.0)))[0] == ("/Lab", [100, 0, 0], [88.5, -3.25, 40])
    assert spaces(told, alternate="rgb")[0] == ("/DeviceRGB", [1, 1, 1], [0.95686, 0.93725, 0.88627])


def test_one_alternate_for_all_inks() -> None:
    cmyk = spaces(inked(cmyk=(10.0, 0.0, 62.5, 5.0)), alternate="cmyk")
    assert {family for family, _, _ in cmyk} == {"/DeviceCMYK"}
    assert [full for _, _, full in spaces(sample(), alternate="lab")] == [
        pytest.approx(lab_of(layer.ink.colour), abs=1e-5) for layer in sample().layers
    ]


@pytest.mark.parametrize(
    ("colour", "parts"),
    [
        ("#ffffff", (0, 0, 0, 0)),
        ("#000000", (0, 0, 0, 1)),
        ("#ff0000", (0, 1, 1, 0)),
        ("#808080", (0, 0, 0, 127 / 255)),
        ("#1d2f5f", (1 - 0x1D / 0x5F, 1 - 0x2F / 0x5F, 0, 1 - 0x5F / 255)),
    ],
)
def test_cmyk_by_the_plainest_rule(colour: str, parts: tuple[float, ...]) -> None:
    assert cmyk_of(colour) == pytest.approx(parts)


@pytest.mark.parametrize(
    "colour", ["#ffffff", "#000000", "#a03020", "#1d2f5f", "#f4efe2", "#00ff00", "#7f7f7f"]
)
def test_lab_is_what_little_cms_makes_of_it(colour: str) -> None:
    change = ImageCms.buildTransform(
        ImageCms.createProfile("sRGB"),
        ImageCms.createProfile("LAB", 5003),
        "RGB",
        "LAB",
        renderingIntent=ImageCms.Intent.RELATIVE_COLORIMETRIC,
    )
    swatch = Image.new("RGB", (1, 1), colour)
    level, a, b = (int(each) for each in ImageCms.applyTransform(swatch, change).getpixel((0, 0)))  # type: ignore[union-attr]
    assert lab_of(colour) == pytest.approx((level / 2.55, a - 128, b - 128), abs=1.0)


def test_overlays_leave_what_is_beneath_on_its_plate() -> None:
    artwork = inked(overlap=Overlap.OVERLAY)
    text = content(artwork, inks="spot")
    assert re.findall(r"/(Over|Cut) gs|/S(\d) cs", text) == [("Over", ""), ("", "0"), ("Cut", ""), ("", "2")]
    document = pikepdf.open(io.BytesIO(pdf.render(artwork, PdfOptions(inks=PdfInks.SPOT))))
    states: Any = document.pages[0].Resources.ExtGState
    assert [states.Over.OP, states.Over.op, states.Over.OPM] == [True, True, 1]
    assert [states.Cut.OP, states.Cut.op, states.Cut.OPM] == [False, False, 0]
    assert " gs\n" not in content(sample(), inks="spot")
    assert " gs\n" not in content(artwork, inks="spot", overprint="none")
    assert content(sample(), inks="spot", overprint="all").count(" gs\n") == 1
    assert " gs\n" not in content(artwork)


def test_after_traps_nothing_is_cut_out_of_the_plates_beneath() -> None:
    made = replace(sample().provenance, processes=("trap width=0.3mm",))
    assert content(replace(sample(), provenance=made), inks="spot").count("/Over gs\n") == 1


def test_what_is_of_separations_alone_is_refused_of_screen_colours() -> None:
    for given in ({"alternate": "lab"}, {"overprint": Overprint.ALL}):
        with pytest.raises(GeometryError, match='inks = "spot"'):
            PdfOptions(**given)


def test_inks_whose_cmyk_is_reckoned_are_named() -> None:
    options = PdfOptions(inks=PdfInks.SPOT, alternate="cmyk")  # type: ignore[arg-type]
    assert reckoned(inked(cmyk=(0.0, 0.0, 10.0, 0.0)), options) == ["soga brown", "Indigo/2"]
    assert reckoned(sample(), PdfOptions(inks=PdfInks.SPOT)) == []


def test_parts_of_a_colour_have_bounds() -> None:
    with pytest.raises(GeometryError, match="cmyk"):
        Ink("wax", "#ffffff", cmyk=(0.0, 0.0, 0.0, 101.0))
