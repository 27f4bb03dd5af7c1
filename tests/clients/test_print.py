"""Print files in Ghostscript, poppler, MuPDF and qpdf: plates as the artwork has them."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from PIL import Image

from batik_vector.artwork import Artwork, Cell, Ink, Layer, Overlap
from batik_vector.export import Pages, PdfInks, PdfOptions, render
from batik_vector.machines import Machine
from batik_vector.making.pages import Latest, render_output
from batik_vector.processes.options import TrapProcess
from batik_vector.recipe.outputs import PdfOutput
from batik_vector.tiling.cloth.field import field_page
from batik_vector.tiling.cloth.print_marks import with_print_marks
from tests.clients import programs
from tests.clients.pictures import load

pytestmark = pytest.mark.clients
PROCESS = {"Cyan", "Magenta", "Yellow", "Black"}
PER_MM = 10.0
PRESS = Path("/usr/share/color/icc/ghostscript/default_cmyk.icc")
"""A profile that comes with Ghostscript."""


def layer(ink: Ink, areas: Iterable[shapely.Geometry]) -> Layer:
    return Layer(ink, np.array([*areas, None], dtype=object)[:-1])


def two(overlap: Overlap = Overlap.WELD) -> Artwork:
    """Two squares of 20 mm, the upper half over the lower, on a tile of 40 mm."""
    light = Ink("light/warm", "#ffe080", cmyk=(0.0, 10.0, 60.0, 0.0))
    dark = Ink("dark blue", "#102040", overlap=overlap, lab=(13.0, 5.0, -25.0))
    areas = [shapely.box(5, 5, 25, 25)], [shapely.box(15, 5, 35, 25)]
    return Artwork("two", Cell(40_000, 40_000), (layer(light, areas[0]), layer(dark, areas[1])))


def inked(artwork: Artwork, folder: Path, **options: Any) -> dict[str, float]:
    """Square millimetres of each plate that are inked, of spots by name."""
    pdf = folder / "drawing.pdf"
    pdf.write_bytes(render(artwork, "pdf", PdfOptions(inks=PdfInks.SPOT, **options)))
    words = programs.run("qpdf", "--check", pdf, home=folder)
    assert "No syntax or stream encoding errors found" in words
    found = {}
    for name, path in programs.plates(pdf, PER_MM).items():
        dark = 1 - np.asarray(Image.open(path)).astype(float) / 255
        found[name.replace("%2F", "/")] = float(dark.sum()) / PER_MM**2
    assert {found.pop(name) for name in PROCESS} == {0.0}
    return found


@pytest.mark.parametrize("alternate", [None, "rgb", "cmyk", "lab"])
def test_an_overlay_leaves_the_plate_beneath_whole(tmp_path: Path, alternate: str | None) -> None:
    plates = inked(two(Overlap.OVERLAY), tmp_path, alternate=alternate)
    assert plates == {"light/warm": pytest.approx(400, rel=0.01), "dark blue": pytest.approx(400, rel=0.01)}


def test_overprint_is_as_asked(tmp_path: Path) -> None:
    assert inked(two(), tmp_path)["light/warm"] == pytest.approx(200, rel=0.01)
    assert inked(two(), tmp_path, overprint="all")["light/warm"] == pytest.approx(400, rel=0.01)
    cut = inked(two(Overlap.OVERLAY), tmp_path, overprint="none")
    assert cut["light/warm"] == pytest.approx(200, rel=0.01)


def test_a_trap_is_on_the_plate_of_the_ink_that_spreads(tmp_path: Path) -> None:
    light, dark = two().layers
    beside = replace(two(), layers=(layer(light.ink, [shapely.box(5, 5, 15, 25)]), dark))
    assert inked(beside, tmp_path)["light/warm"] == pytest.approx(200, rel=0.01)
    made = TrapProcess(width=1.0).apply(beside, Machine())
    assert isinstance(made, Artwork)
    plates = inked(made, tmp_path)
    assert plates["light/warm"] == pytest.approx(float(made.layers[0].areas[0].area), rel=0.005)
    assert plates["light/warm"] == pytest.approx(220, rel=0.01)
    assert plates["dark blue"] == pytest.approx(400, rel=0.01)


@pytest.mark.parametrize("viewer", [programs.poppler, programs.mupdf])
def test_a_file_for_a_press_is_taken_for_one(tmp_path: Path, viewer: Callable[[Path, float], Path]) -> None:
    press: Any = {"icc": "press.icc", "icc_profile": PRESS.read_bytes()}
    plates = inked(two(Overlap.OVERLAY), tmp_path, **press)
    assert plates == {"light/warm": pytest.approx(400, rel=0.01), "dark blue": pytest.approx(400, rel=0.01)}
    pdf = tmp_path / "drawing.pdf"
    words = programs.run("pdfinfo", pdf, home=tmp_path)
    assert re.search(r"PDF subtype: +PDF/X-4\n", words)
    picture = np.asarray(load(viewer(pdf, PER_MM)))
    assert picture[20, 20].min() > 250
    assert picture[250, 100].tolist() != picture[250, 300].tolist()


def test_marks_stand_on_every_plate_and_each_has_its_own_patch(tmp_path: Path) -> None:
    pdf = tmp_path / "drawing.pdf"
    page = with_print_marks(field_page(two(Overlap.OVERLAY), bleed=3.0))
    pdf.write_bytes(render(page, "pdf", PdfOptions(inks=PdfInks.SPOT)))
    pictures = {name: np.asarray(Image.open(path)) for name, path in programs.plates(pdf, PER_MM).items()}
    left, bottom, *_ = (round(each * PER_MM) for each in programs.page_mm(pdf, "TrimBox"))
    trim = pictures["Cyan"].shape[0] - bottom
    assert len(pictures) == 6
    inked = {}
    for name, picture in pictures.items():
        # The corner's trim mark ends 2 mm from the bleed.
        assert picture[trim - 2 : trim + 2, left - 100 : left - 60].min() < 100
        inked[name] = float((picture[trim + 240 :] < 100).sum()) / PER_MM**2
    assert {name for name, area in inked.items() if area > 36} == {"light%2Fwarm", "dark blue"}


@pytest.mark.parametrize("viewer", [programs.poppler, programs.mupdf])
def test_a_line_along_the_edge_shows_its_other_half(
    tmp_path: Path, viewer: Callable[[Path, float], Path]
) -> None:
    lines = np.array([shapely.LineString([(0.5, 0), (0.5, 40)]), None], dtype=object)[:-1]
    tile = Artwork("line", Cell(40_000, 40_000), (Layer(Ink("ink", "#000000", 4.0), lines=lines),))
    sink = io.BytesIO()
    render_output(tile, PdfOutput(inks=PdfInks.SPOT), sink, Latest())
    pdf = tmp_path / "line.pdf"
    pdf.write_bytes(sink.getvalue())
    row = np.asarray(load(viewer(pdf, PER_MM)))[200, :, 0] < 128
    assert np.flatnonzero(row).tolist() == [*range(25), *range(385, 400)]


@pytest.mark.parametrize("inks", list(PdfInks))
def test_the_pages_of_a_divided_drawing_are_its_parts(tmp_path: Path, inks: PdfInks) -> None:
    tile = two(Overlap.OVERLAY)
    whole, pages = tmp_path / "whole.pdf", tmp_path / "pages.pdf"
    whole.write_bytes(render(tile, "pdf", PdfOptions(inks=inks)))
    divided = PdfOptions(inks=inks, pages=Pages.TILE, page="24 x 24 mm", overlap=8)
    pages.write_bytes(render(tile, "pdf", divided))
    assert "No syntax" in programs.run("qpdf", "--check", pages, home=tmp_path)
    known = np.asarray(load(programs.mupdf(whole, PER_MM)).convert("L")).astype(int)
    dpi = programs.dpi(PER_MM)
    programs.run("mutool", "draw", "-q", "-r", dpi, "-o", tmp_path / "m-%d.png", pages, home=tmp_path)
    programs.run("pdftoppm", "-png", "-r", dpi, pages, tmp_path / "p", home=tmp_path)
    for name in ("m", "p"):
        for number, (x, y) in enumerate([(0, 160), (160, 160), (0, 0), (160, 0)], start=1):
            part = np.asarray(Image.open(tmp_path / f"{name}-{number}.png").convert("L")).astype(int)
            expected = known[y : y + 240, x : x + 240]
            odd = np.abs(part[:240, :240] - expected) > 40
            # Crosses apart: five millimetres of lines of 0.2 mm each, which hardly show on what is dark.
            assert 20 < odd.sum() < 1500


def test_crosses_of_pages_stand_on_every_plate(tmp_path: Path) -> None:
    pdf = tmp_path / "pages.pdf"
    options = PdfOptions(inks=PdfInks.SPOT, pages=Pages.TILE, page="24 x 40 mm", overlap=8)
    pdf.write_bytes(render(two(), "pdf", options))
    for path in programs.plates(pdf, PER_MM).values():
        picture = np.asarray(Image.open(path))
        # The first page's, in the middle of the strip that both share, a quarter from above.
        assert picture[98:103, 190:210].min(axis=0).max() < 100
