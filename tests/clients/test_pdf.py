"""PDF in poppler, MuPDF and qpdf."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from batik_vector.artwork import Artwork
from batik_vector.export import PdfOptions, SvgOptions, render
from batik_vector.tiling.cloth.field import with_bleed
from tests.clients import programs
from tests.clients.drawings import per_mm, shared_out
from tests.clients.pictures import differing, load, reference, shade_apart

pytestmark = pytest.mark.clients
ALIKE = 1e-3
SAME_SHADE = 4.0

VARIANTS = {
    "plain": PdfOptions(),
    "bezier": PdfOptions(curves="bezier"),  # type: ignore[arg-type]
    "spot": PdfOptions(inks="spot"),  # type: ignore[arg-type]
    "bare": PdfOptions(cloth=False),
}
VIEWERS = {"poppler": programs.poppler, "mupdf": programs.mupdf}


def written(artwork: Artwork, folder: Path, options: PdfOptions = VARIANTS["plain"]) -> Path:
    path = folder / "drawing.pdf"
    path.write_bytes(render(artwork, "pdf", options))
    return path


@pytest.mark.parametrize(("drawing", "viewer"), shared_out(VIEWERS), indirect=["drawing"])
def test_viewers_and_cairosvg_draw_the_same(drawing: Artwork, tmp_path: Path, viewer: str) -> None:
    scale = per_mm(drawing)
    picture = load(VIEWERS[viewer](written(drawing, tmp_path), scale))
    known = reference(render(drawing, "svg"), scale)
    assert differing(picture, known) < ALIKE
    assert shade_apart(picture, known) < SAME_SHADE


@pytest.mark.parametrize("variant", [name for name in VARIANTS if name != "plain"])
@pytest.mark.parametrize("viewer", VIEWERS.values(), ids=list(VIEWERS))
def test_variants_look_alike(
    lopsided: Artwork, tmp_path: Path, viewer: Callable[[Path, float], Path], variant: str
) -> None:
    scale = per_mm(lopsided)
    options = VARIANTS[variant]
    picture = load(viewer(written(lopsided, tmp_path, options), scale))
    known = reference(render(lopsided, "svg", SvgOptions(cloth=options.shows_cloth)), scale)
    assert differing(picture, known) < ALIKE


@pytest.mark.parametrize("viewer", VIEWERS.values(), ids=list(VIEWERS))
def test_bleed_shows_beyond_the_trim(
    lopsided: Artwork, tmp_path: Path, viewer: Callable[[Path, float], Path]
) -> None:
    grown = with_bleed(lopsided, 5.0)
    scale = per_mm(lopsided)
    pdf = written(grown, tmp_path)
    trim = programs.page_mm(pdf, "TrimBox")
    width, height = lopsided.cell.width, lopsided.cell.height
    assert trim == pytest.approx((5, 5, 5 + width, 5 + height), abs=0.01)
    assert programs.page_mm(pdf) == pytest.approx((0, 0, width + 10, height + 10), abs=0.01)
    picture = load(viewer(pdf, scale))
    assert differing(picture, reference(render(grown, "svg"), scale)) < ALIKE


def test_the_page_has_the_size_of_the_cell(drawing: Artwork, tmp_path: Path) -> None:
    box = programs.page_mm(written(drawing, tmp_path))
    assert box == pytest.approx((0, 0, drawing.cell.width, drawing.cell.height), abs=0.01)


def test_qpdf_finds_nothing_wrong(drawing: Artwork, tmp_path: Path) -> None:
    qpdf_is_content(written(drawing, tmp_path))


@pytest.mark.parametrize("variant", VARIANTS)
def test_qpdf_finds_nothing_wrong_with_variants(lopsided: Artwork, tmp_path: Path, variant: str) -> None:
    qpdf_is_content(written(with_bleed(lopsided, 3.0), tmp_path, VARIANTS[variant]))


def qpdf_is_content(pdf: Path) -> None:
    words = programs.run("qpdf", "--check", pdf, home=pdf.parent)
    assert "No syntax or stream encoding errors found" in words
    assert "WARNING" not in words
