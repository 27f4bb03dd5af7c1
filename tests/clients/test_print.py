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
from batik_vector.export import PdfInks, PdfOptions, render
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
