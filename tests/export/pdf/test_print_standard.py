"""PDF/X-4 as its standard asks, read back by pikepdf; and files that are no profile of a press."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pikepdf
import pytest

from batik_vector.artwork import Artwork, Cell, Layer, Provenance
from batik_vector.errors import ExportError, GeometryError, RecipeError, UnsupportedByFormatError
from batik_vector.export import pdf
from batik_vector.export.options import PdfOptions
from batik_vector.export.pdf.icc import icc_profile
from batik_vector.recipe.loading import load_recipe
from tests.export.drawings import sample

from .profiles import profile

XMP = "{http://ns.adobe.com/xap/1.0/}"
NPES = "{http://www.npes.org/pdfx/ns/id/}"
MM = "{http://ns.adobe.com/xap/1.0/mm/}"


def options(data: bytes | None = None, **more: Any) -> PdfOptions:
    given: dict[str, Any] = {"inks": "spot", "icc": "press.icc", **more}
    return PdfOptions(icc_profile=data or profile(), **given)


def opened(artwork: Artwork, chosen: PdfOptions) -> pikepdf.Pdf:
    return pikepdf.open(io.BytesIO(pdf.render(artwork, chosen)))


def alternates(document: pikepdf.Pdf) -> list[str]:
    spaces = [space[2] for _, space in document.pages[0].Resources.ColorSpace.items()]
    return [str(each[0] if isinstance(each, pikepdf.Array) else each) for each in spaces]


def test_the_file_says_for_which_press_it_is() -> None:
    document = opened(sample(3.0), options(condition="FOGRA51"))
    (intent,) = document.Root.OutputIntents
    said: Any = intent
    assert (str(said.S), str(said.OutputConditionIdentifier), str(said.Info)) == (
        "/GTS_PDFX",
        "FOGRA51",
        "Press",
    )
    assert said.DestOutputProfile.read_bytes() == profile()
    assert said.DestOutputProfile.N == 4
    other = opened(sample(), options())
    assert str(other.Root.OutputIntents[0].OutputConditionIdentifier) == "Custom"


def test_dates_trapping_and_version_are_told_twice_and_alike() -> None:
    document = opened(sample(3.0), options(date="2026-11-30"))
    assert document.pdf_version == "1.6"
    info = document.docinfo
    assert {str(info[key]) for key in ("/CreationDate", "/ModDate")} == {"D:20261130000000Z"}
    assert str(info["/Trapped"]) == "/False"
    with document.open_metadata() as xmp:
        assert (
            xmp["{http://www.npes.org/pdfx/ns/id/}GTS_PDFXVersion"] == info["/GTS_PDFXVersion"] == "PDF/X-4"
        )
        assert {xmp[XMP + key] for key in ("CreateDate", "ModifyDate", "MetadataDate")} == {
            "2026-11-30T00:00:00Z"
        }
        assert xmp["pdf:Trapped"] == "False"
        assert re.fullmatch("uuid:[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", str(xmp[MM + "DocumentID"]))
        assert (xmp[MM + "RenditionClass"], xmp[MM + "VersionID"]) == ("default", "1")
    assert str(document.Root.OCProperties.D.Name)
    page: Any = document.pages[0].obj
    media, bleed, trim = ([float(x) for x in page[key]] for key in ("/MediaBox", "/BleedBox", "/TrimBox"))
    assert all(a <= b <= c for a, b, c in zip(media[:2], bleed[:2], trim[:2], strict=True))
    assert all(a >= b >= c for a, b, c in zip(media[2:], bleed[2:], trim[2:], strict=True))
    assert "/ArtBox" not in page


def test_what_was_trapped_says_so() -> None:
    made = Provenance(processes=("trap width=0.3mm",))
    document = opened(replace(sample(), provenance=made), options())
    assert str(document.docinfo["/Trapped"]) == "/True"
    with document.open_metadata() as xmp:
        assert xmp["pdf:Trapped"] == "True"


def test_the_same_page_is_the_same_file_and_another_has_another_name() -> None:
    assert pdf.render(sample(), options()) == pdf.render(sample(), options())
    names = []
    for artwork in (sample(), sample(title="Another")):
        with opened(artwork, options()).open_metadata() as xmp:
            names.append(xmp[MM + "DocumentID"])
    assert names[0] != names[1]


def test_alternates_are_the_presss_or_of_no_device() -> None:
    first, *others = sample().layers
    told = replace(first, ink=replace(first.ink, cmyk=(1.0, 2.0, 30.0, 0.0)))
    artwork = replace(sample(), layers=(told, *others))
    assert alternates(opened(artwork, options())) == ["/DeviceCMYK", "/Lab", "/Lab"]
    assert alternates(opened(artwork, options(profile("RGB")))) == ["/Lab", "/Lab", "/Lab"]
    assert alternates(opened(artwork, options(alternate="cmyk"))) == ["/DeviceCMYK"] * 3
    assert alternates(opened(artwork, options(profile("RGB"), alternate="rgb"))) == ["/DeviceRGB"] * 3
    screen = opened(artwork, options(profile("RGB"), inks="rgb"))
    assert "/OutputIntents" in screen.Root


@pytest.mark.parametrize(
    ("data", "more", "words"),
    [
        (profile(), {"inks": "rgb"}, 'expected inks = "spot"'),
        (profile("GRAY"), {"inks": "rgb"}, 'expected inks = "spot"'),
        (profile(), {"alternate": "rgb"}, 'expected "lab"'),
        (profile("RGB"), {"alternate": "cmyk"}, 'expected "lab"'),
        (b"no profile", {}, "is no ICC profile"),
    ],
)
def test_what_does_not_suit_the_press_is_refused(data: bytes, more: dict[str, str], words: str) -> None:
    with pytest.raises(UnsupportedByFormatError, match=words):
        pdf.render(sample(), options(data, **more))


def test_pages_in_larger_units_are_refused() -> None:
    long = Artwork("long", Cell(6_000_000, 1_000), (Layer(sample().layers[0].ink),))
    with pytest.raises(UnsupportedByFormatError, match='pages = "tile"'):
        pdf.render(long, options())


def test_a_profile_that_was_not_read_is_asked_for() -> None:
    with pytest.raises(UnsupportedByFormatError, match="beside the recipe"):
        pdf.render(sample(), PdfOptions(icc="press.icc"))


@pytest.mark.parametrize("version", [2, 4])
def test_a_profile_is_read(version: int) -> None:
    found = icc_profile(profile("RGB", name="Uncoated paper", version=version))
    assert (found.space, found.components, found.name) == ("RGB", 3, "Uncoated paper")


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda data: b"", "is no ICC profile"),
        (lambda data: data[:127], "is no ICC profile"),
        (lambda data: data.replace(b"acsp", b"ascp"), "is no ICC profile"),
        (lambda data: data[:-1], "it is damaged"),
        (lambda data: data.replace(b"prtr", b"mntr"), "of a display, expected one of an output device"),
        (lambda data: data.replace(b"CMYK", b"Lab "), '"Lab" colours, expected CMYK'),
        (lambda data: data[:128] + b"\xff" * 4 + data[132:], "4,294,967,295 tags"),
        (lambda data: data[:140] + b"\xff" * 4 + data[144:], "beyond its end"),
    ],
)
def test_what_is_no_profile_of_a_press_is_told_apart(spoil: Callable[[bytes], bytes], words: str) -> None:
    with pytest.raises(ExportError, match=re.escape(words)):
        icc_profile(spoil(profile()))


def test_a_day_is_one_of_the_calendar() -> None:
    for day in ("2026-02-30", "30.11.2026", "2026-11-30T00:00", "２０２６-11-30"):
        with pytest.raises(GeometryError, match="a day in quotes"):
            options(date=day)


RECIPE = """\
title = "Dots"
[motif.dot]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 2 } }]
[[place]]
motif = "dot"
scale = 1
layout = { kind = "single" }
[tile]
size = [20, 20]
[[output]]
format = "pdf"
inks = "spot"
icc = "press.icc"
"""


def test_a_recipes_profile_is_read_beside_it(tmp_path: Path) -> None:
    recipe = tmp_path / "dots.toml"
    recipe.write_text(
        RECIPE.replace(
            'kind = "circle"\nradius = 2', 'kind = "curve"\ncurve = { kind = "circle", radius = 2 }'
        )
    )
    with pytest.raises(RecipeError, match="no such file"):
        load_recipe(recipe)
    (tmp_path / "press.icc").write_bytes(profile(kind="mntr"))
    with pytest.raises(
        RecipeError, match=r'dots.toml:14: output\[0\].icc: "press.icc" is an ICC profile of a display'
    ):
        load_recipe(recipe)
    (tmp_path / "press.icc").write_bytes(profile())
    (output,) = load_recipe(recipe).output
    assert output.options.icc_profile == profile()
