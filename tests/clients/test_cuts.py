"""What is cut, in programs that cutters and lasers are fed by: each follows the strokes one by one."""

from __future__ import annotations

import functools
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
import shapely
from ezdxf.filemanagement import readfile

from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import GcodeOptions, HpglOptions, SvgOptions, Turn, gcode, render
from batik_vector.geometry.outlines import to_polylines
from batik_vector.processes.options import CutProcess
from batik_vector.processes.prepared import Prepared
from batik_vector.recipe.loading import load_recipe
from batik_vector.recipe.reading.machines import read_machine
from tests.clients import programs
from tests.clients.test_gcode import followed
from tests.clients.test_machines import LABEL, SVG, strokes_of

pytestmark = pytest.mark.clients

SAMPLES = Path(__file__).parents[2] / "samples"
CUTS = {
    "machine-vinyl": ("vinyl-cutter", {"weed_box": 4.0, "weed_lines": 30.0, "registration": 6.0}),
    "machine-laser": ("grbl-laser", {"keep": "ground", "tabs": 1}),
}


MARGIN = 10.0
"""Room about the page, in mm, for what a cut draws outside of it."""


@functools.cache
def prepared(name: str) -> Prepared:
    machine, told = CUTS[name]
    page = compile_recipe(load_recipe(SAMPLES / f"{name}.toml"))
    return CutProcess(**told).apply(page, read_machine(machine))  # type: ignore[arg-type]


@pytest.fixture(params=CUTS)
def cut(request: pytest.FixtureRequest) -> Prepared:
    return prepared(request.param)


def lines_of(page: Prepared) -> list[np.ndarray]:
    """Return the strokes of each tool as lines in mm, those that are closed coming back."""
    return [to_polylines(tool.strokes, 1000) for tool in page.tools]


def lengths(strokes: programs.Plotted) -> dict[int, float]:
    """Return how much each pen draws, in units."""
    found: dict[int, float] = {}
    for pen, points in strokes:
        found[pen] = found.get(pen, 0.0) + float(np.hypot(*np.diff(np.array(points), axis=0).T).sum())
    return found


def same(found: list[shapely.LineString], told: np.ndarray, near: float) -> None:
    """Check that strokes are followed one by one, in their order and direction."""
    assert len(found) == len(told)
    assert shapely.hausdorff_distance(found, told).max() <= near
    for end in (0, -1):
        apart = shapely.distance(shapely.get_point(found, end), shapely.get_point(told, end))
        assert apart.max() <= near


def test_vpype_follows_a_cut(cut: Prepared, tmp_path: Path) -> None:
    path = tmp_path / "cut.svg"
    path.write_bytes(render(cut, "svg", SvgOptions(cloth=False)))
    layers = ET.parse(programs.vpype(path)).getroot().findall(f"{SVG}g")
    names = [layer.get(LABEL, "") for layer in layers]
    assert names == [f"{pen} {tool.ink.name}" for pen, tool in enumerate(cut.tools, start=1)]
    # The page grows by what stands outside it, as the marks do: alike on all its sides.
    beyond = -float(min(shapely.bounds(np.concatenate(lines_of(cut))).min(), 0.0))
    for layer, told in zip(layers, lines_of(cut), strict=True):
        page = shapely.transform(told, lambda at: [beyond, cut.cell.height + beyond] + at * [1, -1])
        same(list(strokes_of(layer)), page, 0.005)


def test_ezdxf_finds_a_cut_in_order_and_nothing_to_mend(cut: Prepared, tmp_path: Path) -> None:
    path = tmp_path / "cut.dxf"
    path.write_bytes(render(cut, "dxf"))
    document = readfile(path)
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    for tool, told in zip(cut.tools, lines_of(cut), strict=True):
        found = []
        for entity in document.modelspace().query(f'LWPOLYLINE[layer=="{tool.ink.name}"]'):
            points = np.array(entity.get_points("xy"))  # type: ignore[attr-defined]
            closed = entity.closed  # type: ignore[attr-defined]
            found.append(shapely.LineString(np.vstack([points, points[:1]]) if closed else points))
        same(found, told, 1e-6)


def test_librecad_prints_a_cut(cut: Prepared, tmp_path: Path) -> None:
    path = tmp_path / "cut.dxf"
    path.write_bytes(render(cut, "dxf"))
    left, low, right, high = programs.page_mm(programs.librecad(path))
    assert right - left >= cut.cell.width - 0.36
    assert high - low >= cut.cell.height - 0.36


def test_openscad_takes_a_cut_for_areas(tmp_path: Path) -> None:
    machine = read_machine("laser")
    page = CutProcess(kerf=0.1).apply(compile_recipe(load_recipe(SAMPLES / "kawung.toml")), machine)
    path = tmp_path / "cut.dxf"
    path.write_bytes(render(page, "dxf"))
    told = shapely.polygons([shapely.LinearRing(line.coords) for line in np.concatenate(lines_of(page))])
    found = shapely.polygons([shapely.LinearRing(ring) for ring in programs.openscad(path)])
    assert len(found) == len(told)
    assert shapely.total_bounds(found) == pytest.approx(shapely.total_bounds(told), abs=1e-3)
    assert shapely.area(found).sum() == pytest.approx(shapely.area(told).sum(), rel=1e-4)


def test_an_interpreter_of_gcode_follows_a_cut(tmp_path: Path) -> None:
    page = prepared("machine-laser")
    profile = read_machine("grbl-laser")
    strokes, said = followed(gcode.render(page, GcodeOptions(machine_profile=profile)), tmp_path)
    assert "PROGRAM_END()" in said
    same([shapely.LineString(stroke.points) for stroke in strokes], lines_of(page)[0], 0.001)


@pytest.mark.parametrize("machine", ["hpgl", "graphtec-ce6000-60"])
def test_readers_of_hpgl_follow_a_cut(cut: Prepared, tmp_path: Path, machine: str) -> None:
    path = tmp_path / "cut.hpgl"
    # The first cut and the marks stand outside the page.
    options = HpglOptions(device=read_machine(machine).hpgl_device, margin=MARGIN, turn=Turn.NONE)
    path.write_bytes(render(cut, "hpgl", options))
    unit = read_machine(machine).hpgl.unit
    strokes = programs.ezhpgl(path)
    for pen, told in enumerate(lines_of(cut), start=1):
        found = [np.array(each) * unit - MARGIN for number, each in strokes if number == pen]
        same([shapely.LineString(each) for each in found], told, unit)
    # hp2xx moves what it writes to the corner, and lifts the pen within strokes.
    assert lengths(programs.hp2xx(path)) == pytest.approx(lengths(strokes), rel=1e-6)
