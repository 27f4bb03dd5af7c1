from __future__ import annotations

import io
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pikepdf
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.export import pdf
from batik_vector.export.options import Curves, PdfInks, PdfOptions
from tests.export.drawings import area_of, empty, geometries, length_of, sample
from tests.export.readers import pdf_rings

POINT = 25.4 / 72


def opened(artwork: Artwork, **options: Any) -> pikepdf.Pdf:
    return pikepdf.open(io.BytesIO(pdf.render(artwork, PdfOptions(**options))))


def content(document: pikepdf.Pdf) -> str:
    return document.pages[0].Contents.read_bytes().decode("ascii")


def box(document: pikepdf.Pdf, name: str) -> list[float]:
    return [float(edge) for edge in document.pages[0].obj[name]]


@pytest.mark.parametrize("bleed", [0.0, 3.0])
def test_areas_and_lengths_are_the_artworks(bleed: float) -> None:
    artwork = sample(bleed)
    text = content(opened(artwork))
    for i in range(3):
        filled, drawn = pdf_rings(text, i + 1)
        assert sum(r.area for r in filled) / 1e6 == pytest.approx(area_of(artwork, i), abs=1e-9)
        assert sum(r.length for r in drawn) / 1e3 == pytest.approx(length_of(artwork, i), abs=1e-9)
        assert all(r.closed for r in filled)
    assert [r.closed for r in pdf_rings(text, 2)[1]] == [False, True, False]
    assert "400 w\n" in text
    assert "1250 w\n" in text


def test_boxes_are_exact() -> None:
    document = opened(sample(3.0))
    assert box(document, "/MediaBox") == pytest.approx([0, 0, 46 / POINT, 36 / POINT], abs=1e-7)
    assert box(document, "/BleedBox") == box(document, "/MediaBox")
    assert box(document, "/TrimBox") == pytest.approx(
        [3 / POINT, 3 / POINT, 43 / POINT, 33 / POINT], abs=1e-7
    )


def test_one_unit_of_the_stream_is_a_micrometre_on_the_page() -> None:
    document = opened(sample(3.0))
    matrix = [float(x) for x in content(document).split(" cm\n")[0].split()]
    assert matrix == pytest.approx([72 / 25400, 0, 0, 72 / 25400, 0, 0], rel=1e-12)
    stem = pdf_rings(content(document), 2)[1][0]
    assert stem.points[0] == (4000, 4000)


def test_each_ink_is_a_layer_with_its_name() -> None:
    document = opened(sample())
    groups = document.Root.OCProperties.D.Order
    assert [str(g.Name) for g in groups] == ["cloth", "wax", "soga brown", "Indigo/2"]
    assert [g.objgen for g in document.Root.OCProperties.OCGs] == [g.objgen for g in groups]
    properties = document.pages[0].Resources.Properties
    used = re.findall(r"/OC (/L\d+) BDC", content(document))
    assert [properties[name].objgen for name in used] == [g.objgen for g in groups]
    assert float(document.pdf_version) >= 1.5


def test_cloth_fills_the_page_or_is_left_out() -> None:
    filled, _ = pdf_rings(content(opened(sample(3.0))), 0)
    assert filled[0].area == 46_000 * 36_000
    bare = opened(sample(), cloth=False)
    assert "cloth" not in [str(g.Name) for g in bare.Root.OCProperties.OCGs]


def test_inks_are_their_colours() -> None:
    text = content(opened(sample()))
    assert "0.95686 0.93725 0.88627 rg\n" in text
    assert "0.62745 0.18824 0.12549 RG\n" in text


def test_inks_as_separations() -> None:
    document = opened(sample(), inks=PdfInks.SPOT)
    spaces = document.pages[0].Resources.ColorSpace
    names = [str(spaces[f"/S{i}"][1]) for i in range(3)]
    assert names == ["/wax", "/soga brown", "/Indigo/2"]
    assert [float(x) for x in spaces["/S0"][3].C1] == pytest.approx(
        [0xF4 / 255, 0xEF / 255, 0xE2 / 255], abs=1e-5
    )
    text = content(document)
    assert "/S0 cs 1 scn\n" in text
    assert "/S1 CS 1 SCN\n" in text
    assert not re.search(r" (rg|RG|k|K|g|G)\n", text)


def test_no_plate_for_the_cloth_unless_it_is_asked_for() -> None:
    def drawn(cloth: bool | None, *more: Layer) -> tuple[list[str], list[str], str]:
        artwork = replace(sample(), layers=sample().layers + more)
        document = opened(artwork, inks=PdfInks.SPOT, cloth=cloth)
        names = [str(space[1]) for _, space in document.pages[0].Resources.ColorSpace.items()]
        return [str(g.Name) for g in document.Root.OCProperties.OCGs], names, content(document)

    inks = ["/wax", "/soga brown", "/Indigo/2"]
    for cloth in (None, False):
        assert drawn(cloth)[:2] == (["wax", "soga brown", "Indigo/2"], inks)
    groups, names, text = drawn(True)
    assert groups[0] == "cloth"
    assert names == ["/cloth", *inks]
    assert text.count("/S0 cs 1 scn\n") == 1
    # Process inks are what any other colour would be printed with.
    assert not re.search(r" (rg|RG|k|K|g|G)\n", text)
    # An ink of that name keeps its plate to itself.
    assert drawn(True, Layer(Ink("cloth", "#000000")))[1] == ["/cloth (ground)", *inks, "/cloth"]


def test_a_plate_for_all_is_not_every_plate() -> None:
    layer = replace(sample().layers[0], ink=Ink("All", "#000000"))
    document = opened(replace(sample(), layers=(layer,)), inks=PdfInks.SPOT)
    assert str(document.pages[0].Resources.ColorSpace["/S0"][1]) == "/All ink"


def test_pages_past_the_limit_use_larger_units() -> None:
    layer = Layer(Ink("w", "#000000"), areas=geometries(shapely.box(0, 0, 12_000, 1)))
    document = opened(Artwork("long", Cell(12_000_000, 1_000_000), (layer,)))
    unit = float(document.pages[0].obj["/UserUnit"])
    media = box(document, "/MediaBox")
    assert max(media) <= 14_400
    assert media[2] * unit == pytest.approx(12_000 / POINT, abs=1e-6)
    assert float(content(document).split()[0]) * unit == pytest.approx(72 / 25400, rel=1e-12)
    # Beyond 9,999.999 mm the digits take another road.
    assert pdf_rings(content(document), 1)[0][0].area == 12e6 * 1e3
    short = opened(sample())
    assert "/UserUnit" not in short.pages[0].obj


def test_title_and_producer_and_no_dates() -> None:
    data = pdf.render(sample(title="Käwung (\\) \U0001f33a"))
    with pikepdf.open(io.BytesIO(data)) as document:
        assert str(document.docinfo["/Title"]) == "Käwung (\\) \U0001f33a"
        assert str(document.docinfo["/Producer"]) == "batik_vector 0.1.0"
        with document.open_metadata() as xmp:
            assert xmp["dc:title"] == "Käwung (\\) \U0001f33a"
    assert b"Date" not in data


def test_the_id_is_the_contents() -> None:
    one, two = (opened(sample(title=t)).trailer.ID[0] for t in ("a", "b"))
    assert bytes(one) != bytes(two)


def test_curves_keep_the_shape() -> None:
    marks = geometries(shapely.Point(20, 15).buffer(10, quad_segs=64))
    artwork = Artwork("c", Cell(40_000, 30_000), (Layer(Ink("w", "#000000"), areas=marks),))
    (ring,) = pdf_rings(content(opened(artwork, curves=Curves.BEZIER, curve_tolerance=0.01)), 1)[0]
    assert 3 <= ring.curves <= 24
    assert ring.closed
    assert ring.area / 1e6 == pytest.approx(np.pi * 100, rel=2e-3)


@pytest.mark.skipif(not shutil.which("qpdf"), reason="qpdf is not installed")
@pytest.mark.parametrize("inks", list(PdfInks))
def test_qpdf_finds_no_fault(tmp_path: Path, inks: PdfInks) -> None:
    for name, artwork in (("full", sample(3.0)), ("empty", empty())):
        path = tmp_path / f"{name}.pdf"
        path.write_bytes(pdf.render(artwork, PdfOptions(inks=inks)))
        check = subprocess.run(["qpdf", "--check", str(path)], capture_output=True, text=True, check=False)
        assert check.returncode == 0, check.stdout + check.stderr


def test_an_empty_artwork_is_a_page() -> None:
    document = opened(empty(), cloth=False)
    assert len(document.pages) == 1
    assert "/OCProperties" not in document.Root
    # pikepdf before 10 calls it by another name.
    check: Any = getattr(document, "check_pdf_syntax", None) or getattr(document, "check", None)
    assert not check()
