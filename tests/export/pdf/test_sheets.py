"""A drawing divided over the pages of one PDF."""

from __future__ import annotations

import io
import itertools
import re
from typing import Any

import pikepdf
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Cell, Layer
from batik_vector.errors import GeometryError, UnsupportedByFormatError
from batik_vector.export import pdf
from batik_vector.export.options import Pages, PdfOptions
from batik_vector.export.pdf.sheets import planned
from tests.export.drawings import sample
from tests.export.readers import pdf_rings

from .profiles import profile

POINT = 25.4 / 72


def tiled(**more: Any) -> PdfOptions:
    return PdfOptions(pages=Pages.TILE, **more)


def opened(artwork: Artwork, options: PdfOptions) -> pikepdf.Pdf:
    return pikepdf.open(io.BytesIO(pdf.render(artwork, options)))


def box(page: pikepdf.Page, name: str) -> list[float]:
    return [float(edge) * POINT for edge in page.obj[name]]


def long() -> Artwork:
    return Artwork("long", Cell(1_500_000, 12_000_000), (Layer(sample().layers[0].ink),))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    size=st.tuples(st.integers(20_000, 20_000_000), st.integers(20_000, 20_000_000)),
    page=st.none() | st.tuples(st.integers(300, 5080), st.integers(300, 5080)),
    overlap=st.integers(0, 150),
)
def test_windows_cover_the_drawing_and_overlap_as_asked(
    size: tuple[int, int], page: tuple[int, int] | None, overlap: int
) -> None:
    more = {"page": f"{page[0]} x {page[1]} mm"} if page else {}
    if not page and min(size) < 2000 * overlap:
        overlap = 0
    sheets = planned(size, tiled(overlap=overlap, **more))
    columns = sorted({(each.left, each.width) for each in sheets.windows})
    rows = sorted({(each.bottom, each.height) for each in sheets.windows})
    assert len(sheets.windows) == len(columns) * len(rows)
    for side, spans in zip(size, (columns, rows), strict=True):
        assert spans[0][0] == 0
        assert spans[-1][0] + spans[-1][1] >= side
        assert all(width <= 5_080_000 for _, width in spans)
        for (at, width), (after, _) in itertools.pairwise(spans):
            assert at + width - after == overlap * 1000
        if not page:
            assert spans[-1][0] + spans[-1][1] == side
    # Each strip that two share has its crosses in the middle, and both show them.
    for one, two in itertools.pairwise(each for each in sheets.windows if each.left == 0):
        middle = two.bottom + overlap * 500
        assert sum(y == middle for _, y in sheets.crosses) == 2 * len(columns)
        ours, theirs = (set("".join(sheets.marks(each)).split("S\n")) for each in (one, two))
        assert len(ours & theirs - {""}) >= 2


def test_a_cloth_is_divided_in_units_that_every_reader_knows() -> None:
    document = opened(long(), tiled())
    sides = [box(page, "/MediaBox") for page in document.pages]
    assert [round(side[3], 3) for side in sides] == [5000, 5000, 2020]
    assert {round(side[2], 3) for side in sides} == {1500}
    assert all("/UserUnit" not in page.obj for page in document.pages)
    assert len(opened(long(), tiled(page="500 x 1000 mm")).pages) == 4 * 13


def test_the_drawing_is_written_once_and_shown_by_every_page() -> None:
    options = tiled(page="30 x 20 mm", overlap=4)
    document = opened(sample(3.0), options)
    assert len(document.pages) == 4
    forms = {page.Resources.XObject.Drawing.objgen for page in document.pages}
    assert len(forms) == 1
    form: Any = document.pages[0].Resources.XObject.Drawing
    alone = opened(sample(3.0), PdfOptions())
    single = alone.pages[0].Contents.read_bytes()
    assert form.read_bytes() == single
    assert pdf_rings(single.decode("ascii"), 1)[0]
    for page, (x, y) in zip(document.pages, [(0, 0), (26, 0), (0, 16), (26, 16)], strict=True):
        words = page.Contents.read_bytes().decode("ascii")
        moved = re.match(r"1 0 0 1 (\S+) (\S+) cm\n/Drawing Do\n", words)
        assert moved
        assert [float(each) * POINT for each in moved.groups()] == pytest.approx([-x, -y], abs=1e-6)
        assert box(page, "/MediaBox") == pytest.approx([0, 0, 30, 20], abs=1e-6)
        trim = [max(3 - x, 0), max(3 - y, 0), min(43 - x, 30), min(33 - y, 20)]
        assert box(page, "/TrimBox") == pytest.approx(trim, abs=1e-6)
        assert words.count("S\n") == words.count("l\n") / 2 > 0


def test_crosses_stand_on_every_plate() -> None:
    document = opened(sample(), tiled(page="30 x 20 mm", overlap=4, inks="spot"))
    for page in document.pages:
        assert str(page.Resources.ColorSpace.All[1]) == "/All"
        assert b"/All CS 1 SCN\n" in page.Contents.read_bytes()


def test_what_fits_the_page_is_one() -> None:
    assert pdf.render(sample(), tiled(page="200 x 100 mm")) == pdf.render(sample())


def test_a_press_takes_a_long_cloth_in_pages() -> None:
    document = opened(long(), tiled(inks="spot", icc="press.icc", icc_profile=profile()))
    assert len(document.pages) == 3
    assert document.pages[2].Resources.ColorSpace.All[2][0] == "/Lab"


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"page": "A3"}, 'expected a size such as "420 x 297 mm"'),
        ({"page": "420 x 297 ells"}, 'expected a size such as "420 x 297 mm"'),
        ({"page": "6 x 6 m"}, "expected 10 to 5080 mm each way"),
        ({"page": "30 x 5 mm"}, "expected 10 to 5080 mm each way"),
        ({"page": "30 x 20 mm", "overlap": 10.5}, "overlap = 10.5 mm, expected at most 10 mm"),
        ({"page": "10 x 10 mm", "overlap": 4.9}, "pages, expected at most 10,000: a larger page"),
    ],
)
def test_pages_that_will_not_do_are_refused(more: dict[str, Any], words: str) -> None:
    with pytest.raises(UnsupportedByFormatError, match=words):
        pdf.render(long(), tiled(**more))


def test_the_size_of_pages_wants_pages() -> None:
    with pytest.raises(GeometryError, match='expected pages = "tile" beside it'):
        PdfOptions(page="420 x 297 mm")
