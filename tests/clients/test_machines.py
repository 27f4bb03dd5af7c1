"""Programs that machines are fed by: vpype, Inkscape's writers of DXF and HPGL, Ghostscript's plates."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import shapely
from ezdxf.filemanagement import readfile
from PIL import Image

from batik_vector.artwork import Artwork, Overlap
from batik_vector.export import PdfOptions, SvgOptions, render
from batik_vector.geometry.outlines import to_polylines
from batik_vector.machines import Machine
from batik_vector.processes.options import PlotProcess
from tests.clients import drawings, programs

pytestmark = pytest.mark.clients

SVG = "{http://www.w3.org/2000/svg}"
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
PROCESS = {"Cyan", "Magenta", "Yellow", "Black"}
PER_MM = 4.0


@pytest.fixture(params=["four-square", "three-baths"])
def drawing(request: pytest.FixtureRequest) -> Artwork:
    name: str = request.param
    return drawings.artwork(name)


def written(artwork: Artwork, folder: Path, **options: object) -> Path:
    path = folder / "drawing.svg"
    path.write_bytes(render(artwork, "svg", SvgOptions(**options)))  # type: ignore[arg-type]
    return path


def pens(artwork: Artwork) -> dict[str, int]:
    """How many contours each pen draws, by the label of its layer."""
    return {
        f"{pen} {layer.ink.name}": len(shapely.get_rings(layer.areas)) + len(layer.lines)
        for pen, layer in enumerate(artwork.layers, start=1)
    }


@pytest.mark.parametrize("curves", ["polyline", "bezier"])
def test_vpype_gives_each_ink_a_pen_and_the_cloth_none(drawing: Artwork, tmp_path: Path, curves: str) -> None:
    root = ET.parse(programs.vpype(written(drawing, tmp_path, curves=curves))).getroot()
    found, shut = {}, {}
    for layer in root.findall(f"{SVG}g"):
        label = layer.get(LABEL, "")
        # Closed ones it writes as polygons.
        found[label] = sum(1 for each in layer if each.tag.removeprefix(SVG) != "g")
        shut[label] = sum(1 for each in layer if each.tag == f"{SVG}polygon")
    assert found == {**pens(drawing), "%99 cloth": 1}
    rings = sum(len(shapely.get_rings(layer.areas)) for layer in drawing.layers)
    rings += sum(int(shapely.is_closed(layer.lines).sum()) for layer in drawing.layers)
    assert sum(shut.values()) == rings + 1


def test_vpype_has_what_each_pen_of_a_plot_draws(drawing: Artwork, tmp_path: Path) -> None:
    inks = [layer.ink.name for layer in drawing.layers]
    plot = PlotProcess(once="all", pens={name: 3 * n + 2 for n, name in enumerate(inks)})  # type: ignore[arg-type]
    prepared = plot.apply(drawing, Machine())
    path = tmp_path / "plot.svg"
    path.write_bytes(render(prepared, "svg", SvgOptions(cloth=False)))
    root = ET.parse(programs.vpype(path)).getroot()
    found = {layer.get(LABEL, ""): list(strokes_of(layer)) for layer in root.findall(f"{SVG}g")}
    assert list(found) == [f"{3 * n + 2} {name}" for n, name in enumerate(inks)]
    for tool, read in zip(prepared.tools, found.values(), strict=True):
        mine = to_polylines(tool.strokes, 1000)
        mine = shapely.transform(mine, lambda at: [0, drawing.cell.height] + at * [1, -1])
        assert len(read) == len(mine)
        assert shapely.length(read).sum() == pytest.approx(shapely.length(mine).sum(), rel=1e-4)
        assert shapely.total_bounds(read) == pytest.approx(shapely.total_bounds(mine), abs=0.002)
        # vpype takes an inch for 25.40000076 mm, and keeps the order.
        assert shapely.hausdorff_distance(read, mine).max() < 0.005


def strokes_of(layer: ET.Element) -> Iterator[shapely.LineString]:
    """Yield the strokes of a layer in mm."""
    for each in layer:
        kind = each.tag.removeprefix(SVG)
        if kind == "line":
            words = " ".join(each.get(name, "") for name in ("x1", "y1", "x2", "y2"))
        else:
            assert kind in ("polygon", "polyline")
            words = each.get("points", "")
        at = np.array(re.split(r"[ ,]+", words.strip()), float).reshape(-1, 2) * 25.4 / 96
        yield shapely.LineString(np.vstack([at, at[:1]]) if kind == "polygon" else at)


def test_inkscapes_dxf_writers_leave_out_the_cloth(drawing: Artwork, tmp_path: Path) -> None:
    svg = written(drawing, tmp_path)
    old = readfile(programs.inkscape_export(svg, "dxf"))
    assert {each.dxf.layer for each in old.modelspace()} == set(pens(drawing))
    new = readfile(programs.inkscape_r14(svg)).modelspace().query("LWPOLYLINE")
    found = {layer: len(entities) for layer, entities in new.groupby("layer").items()}
    assert found == {label.replace(" ", "_"): count for label, count in pens(drawing).items()}


@pytest.mark.parametrize("cloth", [False, True])
def test_inkscapes_hpgl_writer_draws_the_cloth_unless_it_is_left_out(tmp_path: Path, cloth: bool) -> None:
    artwork = drawings.artwork("four-square")
    hpgl = programs.inkscape_export(written(artwork, tmp_path, cloth=cloth), "hpgl").read_text()
    # It begins with a stroke that makes a knife turn.
    assert len(re.findall(r"(?<=;)PD", hpgl)) - 1 == sum(pens(artwork).values()) + cloth


def inked(artwork: Artwork, number: int) -> float:
    """Share of a page that an ink covers, less what lies above it and is no overlay."""
    above = [layer for layer in artwork.layers[number + 1 :] if layer.ink.overlap is not Overlap.OVERLAY]
    bodies = [
        shapely.union_all([*layer.areas, *shapely.buffer(layer.lines, layer.ink.width / 2, quad_segs=32)])
        for layer in (artwork.layers[number], *above)
    ]
    page = shapely.box(0, 0, artwork.cell.width, artwork.cell.height)
    seen = shapely.intersection(shapely.difference(bodies[0], shapely.union_all(bodies[1:])), page)
    return float(seen.area / page.area)


@pytest.mark.parametrize("cloth", [None, True])
def test_ghostscript_separates_the_inks_and_leaves_the_process_plates_white(
    drawing: Artwork, tmp_path: Path, cloth: bool | None
) -> None:
    pdf = tmp_path / "drawing.pdf"
    options = PdfOptions(inks="spot", cloth=cloth)  # type: ignore[arg-type]
    pdf.write_bytes(render(drawing, "pdf", options))
    plates = programs.plates(pdf, PER_MM)
    names = {layer.ink.name for layer in drawing.layers} | ({"cloth"} if cloth else set())
    assert plates.keys() == PROCESS | names
    shares = {name: 1 - float(np.asarray(Image.open(path)).mean()) / 255 for name, path in plates.items()}
    assert {shares[name] for name in PROCESS} == {0.0}
    for number, layer in enumerate(drawing.layers):
        assert shares[layer.ink.name] == pytest.approx(inked(drawing, number), abs=0.01)


def test_a_plate_in_rgb_would_be_seen(tmp_path: Path) -> None:
    pdf = tmp_path / "drawing.pdf"
    pdf.write_bytes(render(drawings.artwork("three-baths"), "pdf"))
    plates = programs.plates(pdf, 1.0)
    assert min(int(np.asarray(Image.open(plates[name])).min()) for name in PROCESS) < 255
