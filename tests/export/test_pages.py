"""Pages that come in pieces are the same files as those in one, and need not fit in memory."""

from __future__ import annotations

import errno
import io
import os
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import pikepdf
import pytest
import shapely
from ezdxf.filemanagement import read

from batik_vector.artwork import Artwork, Cell, Ink, Layer, Margins, Overlap
from batik_vector.artwork import page as pages
from batik_vector.errors import ExportError, UnsupportedByFormatError
from batik_vector.export import (
    DxfOptions,
    GcodeOptions,
    PdfOptions,
    PngOptions,
    SvgOptions,
    dxf,
    pdf,
    png,
    render,
    strokes,
    svg,
    write_artwork,
    write_page,
)
from batik_vector.export.pdf import container
from batik_vector.export.pdf.document import units_per_user_unit
from batik_vector.geometry.outlines import MM, Outlines, of_polylines
from batik_vector.tiling.cloth.spec import YardageSpec
from batik_vector.tiling.cloth.yardage import compile_yardage

from .drawings import InPieces, disc, geometries, line, sample
from .readers import pdf_rings, svg_layers, svg_rings

SETTINGS: list[tuple[str, Any]] = [
    ("svg", SvgOptions()),
    ("svg", SvgOptions(curves="bezier")),  # type: ignore[arg-type]
    ("svg", SvgOptions(profile="compact", cloth=False)),  # type: ignore[arg-type]
    ("pdf", PdfOptions()),
    ("pdf", PdfOptions(inks="spot", cloth=False)),  # type: ignore[arg-type]
    ("dxf", DxfOptions()),
    ("dxf", DxfOptions("R12")),  # type: ignore[arg-type]
    ("gcode", GcodeOptions(arcs=True)),
    ("png", PngOptions(dpi=20)),
]


@pytest.mark.parametrize("rings", [1, 2, 100])
@pytest.mark.parametrize(("format", "options"), SETTINGS)
def test_pieces_make_the_same_bytes(format: str, options: Any, rings: int) -> None:
    assert render(InPieces(sample(), rings), format, options) == render(sample(), format, options)


@pytest.mark.parametrize("piece", [1, 40, 700])
@pytest.mark.parametrize(("format", "options"), SETTINGS)
def test_an_artwork_handed_over_in_pieces_makes_the_same_bytes(
    monkeypatch: pytest.MonkeyPatch, format: str, options: Any, piece: int
) -> None:
    whole = [render(page, format, options) for page in (sample(2.0), crowd())]
    monkeypatch.setattr(pages, "PIECE", piece)
    pieces = list(crowd().areas(0))
    assert len(pieces) > (piece < 700) * 10
    assert [name for each in pieces for name in each.names] == list(crowd().layers[0].area_names)
    assert [render(page, format, options) for page in (sample(2.0), crowd())] == whole


def opened_dxf(data: bytes) -> Any:
    return read(io.StringIO(data.decode()))


def content_of(data: bytes) -> str:
    with pikepdf.open(io.BytesIO(data)) as opened:
        return opened.pages[0].Contents.read_bytes().decode()


def crowd(count: int = 60) -> Artwork:
    discs = [disc(5 + 10 * (i % 10), 5 + 10 * (i // 10), 4, 2) for i in range(count)]
    names = tuple(f"m.part{i % 3}" for i in range(count))
    layer = Layer(Ink("wax", "#f4efe2", overlap=Overlap.OVERLAY), geometries(*discs), area_names=names)
    return Artwork("crowd", Cell(100_000, 100_000), (layer,))


@pytest.mark.parametrize("rings", [3, 7, 1000])
def test_paths_of_many_marks_are_parted_at_the_same_places(
    monkeypatch: pytest.MonkeyPatch, rings: int
) -> None:
    monkeypatch.setattr(strokes, "PATH_POINTS", 500)
    options = SvgOptions(profile="compact")  # type: ignore[arg-type]
    whole = svg.render(crowd(), options)
    assert whole.count(b"<path ") > 5
    # A polygon in two pieces has a path to itself: here every piece ends with a polygon.
    assert svg.render(InPieces(crowd(), 2 * rings), options) == whole


@pytest.mark.parametrize("points", [1, 60, 500])
def test_however_much_is_spelled_at_once_the_file_is_the_same(
    monkeypatch: pytest.MonkeyPatch, points: int
) -> None:
    whole = svg.render(crowd())
    monkeypatch.setattr(svg, "AT_ONCE", points)
    assert svg.render(crowd()) == whole
    assert svg.render(InPieces(crowd(), 7)) == whole


def test_a_polygon_in_pieces_is_one_path() -> None:
    holes = [shapely.box(x + 1, 1, x + 3, 9) for x in range(0, 90, 4)]
    comb = shapely.difference(shapely.box(0, 0, 92, 10), shapely.union_all(holes))
    layer = Layer(Ink("wax", "#f4efe2"), geometries(comb, disc(50, 50, 8)), area_names=("comb", "disc"))
    page = InPieces(Artwork("comb", Cell(100_000, 100_000), (layer,)), 3)
    found = list(svg_layers(svg.render(page))["1 wax"])
    assert [path.get("id") for path in found] == ["comb1", "disc1"]
    assert len(svg_rings(svg_layers(svg.render(page))["1 wax"], filled=True)) == 1 + len(holes) + 1
    content = content_of(pdf.render(page))
    assert content.count("f*\n") == 2
    drawing = opened_dxf(dxf.render(page))
    assert len(drawing.modelspace()) == 1 + len(holes) + 1


def test_a_polygon_longer_than_a_path_is_parted_from_others_the_same_in_pieces(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(strokes, "PATH_POINTS", 90)
    holes = [shapely.box(x + 1, 1, x + 3, 9) for x in range(0, 90, 4)]
    comb = shapely.difference(shapely.box(0, 0, 92, 10), shapely.union_all(holes))
    layer = Layer(Ink("wax", "#f4efe2"), geometries(disc(50, 50, 8), comb, disc(20, 50, 8)))
    artwork = Artwork("comb", Cell(100_000, 100_000), (layer,))
    options = SvgOptions(profile="compact")  # type: ignore[arg-type]
    assert svg.render(artwork, options).count(b"<path ") == 3
    for rings in (1, 3, 5):
        assert svg.render(InPieces(artwork, rings), options) == svg.render(artwork, options)


def cloth(**spec: Any) -> Any:
    """Cloth of discs and an endless trellis, in pieces."""
    net = shapely.difference(shapely.box(0, 0, 20, 20), shapely.box(2, 2, 18, 18))
    layers = (
        Layer(
            Ink("wax", "#f4efe2", 0.5), geometries(net), geometries(line((3, 3), (17, 17))), ("net",), ("l",)
        ),
        Layer(Ink("soga", "#a03020"), geometries(disc(10, 10, 5, 2)), area_names=("m.disc",)),
    )
    artwork = Artwork("cloth", Cell(20_000, 20_000), layers)
    return compile_yardage(artwork, YardageSpec(**spec), piece=300)


def rings_of(page: Any) -> list[list[list[float]]]:
    """All rings of a page in mm, from its marks themselves."""
    found = []
    for number in range(len(page.plates)):
        for outlines in (*page.areas(number), *page.lines(number)):
            found += [part.tolist() for part in np.split(outlines.points / 1000, outlines.rings[1:-1])]
    return found


def begun_anew(ring: list[list[float]]) -> list[list[float]]:
    """The ring from its least point on, a line of two points from the lesser: where they begin is free."""
    points = [[float(x), float(y)] for x, y in ring]
    first = points.index(min(points))
    return points[first:] + points[:first]


def test_every_format_reads_back_as_the_cloth() -> None:
    page = cloth(width=170, length=230, edge="bleed", bleed=3, selvedge=12, marks=True)
    expected = rings_of(page)
    corner = np.array([page.margins.left, page.margins.bottom]) / 1000
    height = (page.cell.rows + page.margins.bottom + page.margins.top) / 1000

    drawing = opened_dxf(dxf.render(page, DxfOptions(order=False)))
    assert not drawing.audit().errors
    polylines = [
        [list(point) for point in each.get_points("xy")] for each in drawing.modelspace().query("LWPOLYLINE")
    ]
    assert sorted(polylines) == sorted(expected)
    assert {each.dxf.layer for each in drawing.modelspace()} == {"wax", "soga", "marks"}

    layers = svg_layers(svg.render(page))
    assert list(layers) == ["%99 cloth", "1 wax", "2 soga", "%98 marks"]
    found = [
        np.round((np.array(ring.points) - [corner[0], 0]) * [1, -1] + [0, height - corner[1]], 3).tolist()
        for label, layer in layers.items()
        for filled in (True, False)
        for ring in svg_rings(layer, filled)
        if label != "%99 cloth"
    ]
    assert sorted(map(begun_anew, found)) == sorted(map(begun_anew, expected))

    content = content_of(pdf.render(page))
    found = []
    for layer in (1, 2, 3):
        filled, stroked = pdf_rings(content, layer)
        found += [np.round(np.array(r.points) / 1000 - corner, 3).tolist() for r in filled + stroked]
    assert sorted(found) == sorted(expected)


def guides() -> Outlines:
    return replace(of_polylines(geometries(line((-3, -3), (-1, -3))), MM), names=["marks.cross"])


def test_guides_stand_on_every_plate_and_no_pen_draws_them() -> None:
    page = InPieces(sample(2.0), guides=guides(), own_margins=Margins(5_000, 7_000, 9_000, 11_000))
    opened = pikepdf.open(io.BytesIO(pdf.render(page, PdfOptions(inks="spot"))))  # type: ignore[arg-type]
    spaces = opened.pages[0].Resources.ColorSpace
    assert [str(space[1]) for _, space in spaces.items()][-1] == "/All"
    with_layers = svg_layers(svg.render(page))
    assert list(with_layers)[-1] == "%98 marks"
    drawing = opened_dxf(dxf.render(page))
    assert "marks" in drawing.layers


def test_boxes_and_pages_follow_the_margins() -> None:
    page = InPieces(sample(2.0), own_margins=Margins(5_000, 7_000, 9_000, 11_000))
    width, height = page.cell.width, page.cell.height
    document = pikepdf.open(io.BytesIO(pdf.render(page)))
    opened = document.pages[0]
    boxes = {
        name: [float(each) * 25.4 / 72 for each in opened[name]]
        for name in ("/TrimBox", "/BleedBox", "/MediaBox")
    }
    assert boxes["/MediaBox"] == pytest.approx([0, 0, width + 14, height + 18], abs=1e-4)
    assert boxes["/TrimBox"] == pytest.approx([5, 7, 5 + width, 7 + height], abs=1e-4)
    assert boxes["/BleedBox"] == pytest.approx([3, 5, 7 + width, 9 + height], abs=1e-4)
    head = svg.render(page)[:400].decode()
    assert f'width="{width + 14:g}mm"' in head
    assert f'height="{height + 18:g}mm"' in head
    header = opened_dxf(dxf.render(page)).header
    assert header["$PINSBASE"] == (5, 7, 0)
    assert header["$EXTMIN"][:2] == (-5, -7)
    assert header["$EXTMAX"][:2] == (width + 9, height + 11)


def test_pages_beyond_five_metres_have_larger_units() -> None:
    page = cloth(width=100, length=12_000)
    assert units_per_user_unit(page) == 3
    assert units_per_user_unit(cloth(width=100, length=5_000)) == 1
    document = pikepdf.open(io.BytesIO(pdf.render(page)))
    opened = document.pages[0]
    assert float(opened.UserUnit) == 3
    assert float(opened.MediaBox[3]) * 3 * 25.4 / 72 == pytest.approx(12_000)


def test_a_long_content_stream_is_written_before_its_length_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    short = content_of(pdf.render(crowd()))
    monkeypatch.setattr(container, "HELD_BACK", 100)
    monkeypatch.setattr(container, "BLOCK", 64)
    data = pdf.render(crowd())
    # Behind the catalogue, pages, stream, metadata and title come two layers.
    assert b"/Length 9 0 R /Filter" in data
    assert content_of(data) == short


def test_handles_in_a_dxf_are_counted_to_the_end() -> None:
    drawing = opened_dxf(dxf.render(InPieces(crowd(), 5)))
    handles = [int(each.dxf.handle, 16) for each in drawing.modelspace()]
    assert handles == list(range(dxf.FIRST_ENTITY, dxf.FIRST_ENTITY + 120))
    assert int(drawing.header["$HANDSEED"], 16) > handles[-1]


def test_more_contours_than_handles_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dxf, "LAST_HANDLE", dxf.FIRST_ENTITY + 50)
    with pytest.raises(UnsupportedByFormatError, match="50 contours at most"):
        dxf.render(crowd())


def test_previews_of_too_much_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(png, "MAX_VERTICES", 100)
    with pytest.raises(UnsupportedByFormatError, match=r"about [\d,]+ vertices, past the limit of 100"):
        png.render(cloth(width=200, length=200))
    with pytest.raises(UnsupportedByFormatError, match="dpi is the most"):
        png.pixel_size(cloth(width=200, length=10_000), 100)


class _StopError(Exception):
    pass


def stopping(page: InPieces, error: BaseException) -> Any:
    class Broken(InPieces):
        def areas(self, number: int) -> Any:
            yield from super().areas(number)
            if number == 2:
                raise error

    return Broken(page.artwork)


@pytest.mark.parametrize("error", [KeyboardInterrupt(), _StopError(), ExportError("no")])
@pytest.mark.parametrize("format", ["svg", "pdf", "dxf"])
def test_what_stops_halfway_leaves_what_was_there(tmp_path: Path, format: str, error: BaseException) -> None:
    path = tmp_path / f"a.{format}"
    page = stopping(InPieces(sample()), error)
    with pytest.raises(type(error)):
        write_artwork(page, path)
    assert os.listdir(tmp_path) == []
    path.write_bytes(b"before")
    with pytest.raises(type(error)):
        write_artwork(page, path)
    assert os.listdir(tmp_path) == [path.name]
    assert path.read_bytes() == b"before"


def test_a_full_disk_is_told_with_the_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(page: Any, sink: BinaryIO, options: Any) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(svg, "write", full)
    with pytest.raises(ExportError, match=r"a\.svg could not be written: No space left"):
        write_artwork(sample(), tmp_path / "a.svg")
    assert os.listdir(tmp_path) == []


def test_a_sink_may_be_any_file(tmp_path: Path) -> None:
    with open(tmp_path / "a.dxf", "wb") as sink:
        write_page(InPieces(sample()), sink, "dxf")
    assert (tmp_path / "a.dxf").read_bytes() == dxf.render(sample())
