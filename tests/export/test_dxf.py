from __future__ import annotations

import io
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pikepdf
import pytest
import shapely
from ezdxf import recover
from ezdxf.filemanagement import read

from batik_vector.artwork import Artwork, Cell, Ink, Layer, Provenance
from batik_vector.export import dxf, pdf, svg
from batik_vector.export.dxf import skeleton
from batik_vector.export.options import DxfOptions, DxfVersion
from batik_vector.export.palette import ACI, distinct_aci, dxf_names, r12_names, rgb

from .drawings import area_of, disc, empty, geometries, length_of, line, sample
from .readers import Ring, svg_layers

pytestmark = pytest.mark.filterwarnings(
    "ignore::DeprecationWarning:ezdxf", "ignore::DeprecationWarning:pyparsing"
)
VERSIONS = list(DxfVersion)


def written(artwork: Artwork, version: DxfVersion = DxfVersion.R2000, order: bool = False) -> bytes:
    return dxf.render(artwork, DxfOptions(version, order))


def name(version: DxfVersion, ink: str) -> str:
    """The layer of an ink."""
    return (dxf_names if version is DxfVersion.R2000 else r12_names)([ink])[0]


def opened(artwork: Artwork, version: DxfVersion = DxfVersion.R2000, order: bool = False) -> Any:
    return read(io.StringIO(written(artwork, version, order).decode("ascii")))


def rings(document: Any, layer: str) -> list[Ring]:
    found = []
    for entity in document.modelspace():
        if entity.dxf.layer != layer:
            continue
        if entity.dxftype() == "LWPOLYLINE":
            found.append(Ring([(x, y) for x, y, *_ in entity.get_points()], entity.closed))
        else:
            assert entity.dxftype() == "POLYLINE"
            found.append(Ring([(p.x, p.y) for p in entity.points()], entity.is_closed))
    return found


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("bleed", [0.0, 3.0])
def test_areas_and_lengths_are_the_artworks(version: DxfVersion, bleed: float) -> None:
    artwork = sample(bleed)
    document = opened(artwork, version)
    wax = rings(document, name(version, "wax"))
    assert sum(r.area for r in wax) == pytest.approx(area_of(artwork, 0), abs=1e-9)
    assert all(r.closed for r in wax)
    soga = rings(document, name(version, "soga brown"))
    assert [r.closed for r in soga] == [False, True, False]
    assert sum(r.length for r in soga) == pytest.approx(length_of(artwork, 1), abs=1e-9)
    assert soga[0].points == [(1, 1), (39, 1), (39, 3.5)]
    for ring in wax + soga:
        assert ring.points[0] != ring.points[-1]
    assert [r.closed for r in rings(document, name(version, "Indigo_2"))] == [True, False]


@pytest.mark.parametrize("version", VERSIONS)
def test_what_lies_inside_is_cut_first_and_the_drawing_stays_the_same(version: DxfVersion) -> None:
    nested = geometries(disc(20, 15, 12, 10), disc(20, 15, 8, 6), disc(20, 15, 4), disc(36, 4, 2))
    seam = geometries(line((20, 12), (20, 18)), line((18, 14), (22, 14), (22, 16), (18, 14)))
    layer = Layer(Ink("w", "#000000"), nested, seam)
    artwork = Artwork("", Cell(40_000, 30_000), (layer,))
    given, found = (rings(opened(artwork, version, order), name(version, "w")) for order in (False, True))
    assert [ring.closed for ring in given] == [True] * 6 + [False, True]
    across = [max(x for x, _ in ring.points) for ring in found]
    assert max(across.index(20), across.index(22)) < across.index(24)
    assert across.index(24) < across.index(26) < across.index(28) < across.index(30) < across.index(32)
    assert sorted((r.closed, sorted(r.points)) for r in found) == sorted(
        (r.closed, sorted(r.points)) for r in given
    )


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("artwork", [sample(), sample(2.5), empty()], ids=["plain", "bleed", "empty"])
def test_ezdxf_finds_nothing_to_mend(version: DxfVersion, artwork: Artwork) -> None:
    audit = opened(artwork, version).audit()
    assert (audit.errors, audit.fixes) == ([], [])
    # The recovering reader also reports structure that the plain one passes over.
    _, audit = recover.read(io.BytesIO(written(artwork, version)))
    assert (audit.errors, audit.fixes) == ([], [])


def test_the_audit_can_fail() -> None:
    broken = written(sample()).replace(
        b"\n330\n17\n100\nAcDbEntity\n8\nwax\n", b"\n330\n99\n100\nAcDbEntity\n8\nw*x\n"
    )
    audit = read(io.StringIO(broken.decode("ascii"))).audit()
    assert audit.errors or audit.fixes


@pytest.mark.parametrize(("version", "code"), [(DxfVersion.R2000, "AC1015"), (DxfVersion.R12, "AC1009")])
def test_the_header_says_what_is_inside(version: DxfVersion, code: str) -> None:
    data = written(sample(3.0), version)
    header = read(io.StringIO(data.decode("ascii"))).header
    assert header["$ACADVER"] == code
    for low, high in (("$EXTMIN", "$EXTMAX"), ("$LIMMIN", "$LIMMAX"), ("$PLIMMIN", "$PLIMMAX")):
        assert tuple(header[low])[:2] == (-3, -3)
        assert tuple(header[high])[:2] == (43, 33)
    if version is DxfVersion.R2000:
        assert (header["$INSUNITS"], header["$MEASUREMENT"]) == (4, 1)
        # LibreCAD's scale on paper, and where the origin lies on it.
        assert header["$PSVPSCALE"] == 1
        assert tuple(header["$PINSBASE"])[:2] == (3, 3)
    assert (b"LWPOLYLINE" in data) == (version is DxfVersion.R2000)
    assert not re.search(rb"\n *999\n|SPLINE\n  5|\nHATCH\n|\nINSERT\n", data)


def test_handles_are_unique_and_below_the_seed() -> None:
    document = opened(sample())
    data = written(sample()).decode("ascii")
    lines = data.split("ENDSEC\n", 1)[1].split("\n")
    kinds = {"5": "handle", "105": "handle"}
    handles = [v for c, v in zip(lines[0::2], lines[1::2], strict=False) if kinds.get(c.strip())]
    assert len(handles) > 50
    assert len(handles) == len(set(handles))
    seed = int(re.findall(r"\$HANDSEED\n *5\n([0-9A-F]+)", data)[0], 16)
    assert max(int(h, 16) for h in handles) < seed
    owner = document.modelspace().block_record_handle
    assert {e.dxf.owner for e in document.modelspace()} == {owner}


@pytest.mark.parametrize("version", VERSIONS)
def test_every_ink_is_a_declared_layer(version: DxfVersion) -> None:
    document = opened(sample(), version)
    colours = {layer.dxf.name: layer.dxf.color for layer in document.layers}
    inks = {
        DxfVersion.R2000: {"wax", "soga brown", "Indigo_2"},
        DxfVersion.R12: {"WAX", "SOGA_BROWN", "INDIGO_2"},
    }[version]
    assert {"0", *inks} <= set(colours)
    assert len({colours[ink] for ink in inks}) == 3
    assert {e.dxf.get("color", 256) for e in document.modelspace()} == {256}
    assert f"\n 70\n{len(colours)}\n" in written(sample(), version).decode("ascii")


@pytest.mark.parametrize("version", VERSIONS)
def test_many_points_and_large_places(version: DxfVersion) -> None:
    marks = geometries(
        shapely.Point(500, 500).buffer(400, quad_segs=20_000),
        disc(90_000, -40, 30, 20),
        disc(-0.5, -0.25, 0.125),
    )
    layer = Layer(Ink("w", "#000000"), areas=marks)
    found = rings(opened(Artwork("", Cell(100_000_000, 1_000_000), (layer,)), version), name(version, "w"))
    truth = shapely.get_rings(marks)
    assert len(found) == len(truth)
    for ring, true in zip(found, truth, strict=True):
        assert np.array_equal(np.array(ring.points), shapely.get_coordinates(true)[:-1])


def test_r12_says_when_a_recipe_is_too_long() -> None:
    data = written(sample(provenance=Provenance("x" * 20_000, 1, "1")), DxfVersion.R12)
    assert dxf.R12_LEFT_OUT.encode() in data
    assert max(map(len, data.splitlines())) <= 255
    assert read(io.StringIO(data.decode("ascii"))).audit().errors == []


def test_strings_are_short_and_ascii() -> None:
    data = written(sample(provenance=Provenance("ä" * 5000, 1, "1")))
    assert max(map(len, data.splitlines())) <= 255
    assert data.isascii()


def test_ezdxf_keeps_the_provenance_when_it_saves() -> None:
    from batik_vector.export.provenance import _read

    stream = io.StringIO()
    opened(sample()).write(stream)
    assert _read(stream.getvalue().encode()) == sample().provenance


@pytest.mark.parametrize(
    ("names", "expected", "old"),
    [
        (["wax", "Wax", "WAX"], ["wax", "Wax_2", "WAX_3"], ["WAX", "WAX_2", "WAX_3"]),
        (
            ["0", "defpoints", "九", "", "..."],
            ["0_2", "defpoints_2", "ink", "ink_2", "..."],
            ["0_2", "DEFPOINTS_2", "INK", "INK_2", "INK_3"],
        ),
        (["Rötel 1/2"], ["Rotel 1_2"], ["ROTEL_1_2"]),
        (['a<>/\\":;?*|,=`b\tc '], ["a_b_c"], ["A_B_C"]),
        (["a" * 40, "a" * 50], ["a" * 40, "a" * 50], ["A" * 31, "A" * 29 + "_2"]),
        (["a" * 300, "A" * 300], ["a" * 255, "A" * 253 + "_2"], ["A" * 31, "A" * 29 + "_2"]),
    ],
)
def test_names(names: list[str], expected: list[str], old: list[str]) -> None:
    assert dxf_names(names) == expected
    assert r12_names(names) == old


def test_inks_are_called_alike_in_every_format() -> None:
    inks = [layer.ink.name for layer in sample().layers[:2]]
    assert inks == ["wax", "soga brown"]
    assert {each.dxf.name for each in opened(sample()).layers} >= set(inks)
    with pikepdf.open(io.BytesIO(pdf.render(sample()))) as document:
        assert {str(group.Name) for group in document.Root.OCProperties.OCGs} >= set(inks)
    assert [label.split(" ", 1)[1] for label in svg_layers(svg.render(sample()))][1:3] == inks


def test_colours_are_near_and_distinct() -> None:
    assert distinct_aci(["#ff1010", "#0000f0", "#ee0000"]) != [1, 5, 1]
    assert distinct_aci(["#ff1010", "#0000f0", "#f0f010"]) == [1, 5, 2]
    assert sorted(distinct_aci(["#336699"] * 7)) == sorted(ACI)
    assert len(distinct_aci(["#336699"] * 9)) == 9
    assert rgb("#0f8") == (0, 255, 136)


def test_the_skeletons_are_what_the_script_makes() -> None:
    folder = Path(dxf.__file__).parent
    # ezdxf may change with its version, but never what varies from run to run.
    assert skeleton.r2000() == skeleton.r2000()
    assert skeleton.r2000() == (folder / dxf.R2000_SKELETON).read_text("ascii")
    assert skeleton.r12() == (folder / dxf.R12_SKELETON).read_text("ascii")


def test_an_ink_named_like_a_mark_of_the_skeleton_does_no_harm() -> None:
    layer = replace(sample().layers[0], ink=Ink("@ENTITIES@", "#000000"))
    document = opened(
        replace(sample(provenance=Provenance("@LAYERS@ @ENTITIES@", 1, "@TOP@")), layers=(layer,))
    )
    assert len(rings(document, "@ENTITIES@")) == 3
