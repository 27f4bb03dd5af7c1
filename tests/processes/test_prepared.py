"""Pages as machines follow them: what a process leaves is written as it is, and files say what was done."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.filemanagement import readfile

from batik_vector.artwork import Ink, Margins, Page
from batik_vector.command.cli import cli
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import GeometryError
from batik_vector.export import render
from batik_vector.export.provenance import read_provenance
from batik_vector.machines import Machine
from batik_vector.making.jobs import planned, read_jobs
from batik_vector.making.running import run
from batik_vector.processes.options import PROCESSES, PlotProcess
from batik_vector.processes.order import travel
from batik_vector.processes.prepared import Prepared, Tool
from batik_vector.processes.travel import ways, with_travel
from batik_vector.recipe.loading import read_recipe
from tests.calling import runner
from tests.processes.strokes import box, strokes

SAMPLES = Path(__file__).parents[2] / "samples"


@pytest.fixture(scope="module")
def tile() -> Page:
    """A tile to prepare."""
    return compile_recipe(read_recipe((SAMPLES / "kawung.toml").read_text()))


def prepared(tile: Page, *inks: str) -> Prepared:
    """Boxes for two pens, the first of them out of the cell."""
    drawn = strokes(box(-1000, 5000, 4000), box(20000, 5000, 4000), (False, [(9, 9), (9000, 9)]))
    return Prepared(
        tile, tuple(Tool(Ink(name, "#000000"), drawn, pen) for pen, name in enumerate(inks, 2)), ("plot",)
    )


def test_strokes_are_written_in_their_order_and_pens_have_their_numbers(tile: Page, tmp_path: Path) -> None:
    page = prepared(tile, "wax", "ash")
    svg = render(page, "svg", check=False).decode()
    assert re.findall(r'label="(\d+ \w+)"', svg) == ["2 wax", "3 ash"]
    (tmp_path / "a.dxf").write_bytes(render(page, "dxf", check=False))
    rings = list(readfile(tmp_path / "a.dxf").modelspace().query("LWPOLYLINE[layer=='wax']"))
    found = [(ring.closed, tuple(ring[0][:2])) for ring in rings if isinstance(ring, LWPolyline)]
    assert found == [(True, (-3.0, 3.0)), (True, (18.0, 3.0)), (False, (0.009, 0.009))]


def test_a_page_grows_with_what_is_drawn_beyond_it_and_its_origin_stays(tile: Page) -> None:
    page = prepared(tile, "wax")
    assert page.margins == Margins(left=3000)
    assert page.cell == tile.cell


@pytest.mark.parametrize("format_", ["svg", "pdf", "dxf"])
def test_files_tell_the_processes_that_they_went_through(tile: Page, tmp_path: Path, format_: str) -> None:
    path = tmp_path / f"a.{format_}"
    path.write_bytes(render(prepared(tile, "wax"), format_, check=False))
    assert read_provenance(path).processes == ("plot",)


def test_ways_lead_from_stroke_to_stroke_and_no_pen_draws_them(tile: Page) -> None:
    page = prepared(tile, "wax")
    shown = with_travel(page)
    found = ways(page.tools[0].strokes)
    assert found[:, 0].tolist() == [[0, 0], [-3000, 3000], [18000, 3000]]
    assert found[:, 1].tolist() == [[-3000, 3000], [18000, 3000], [9, 9]]
    along = np.hypot(*(found[1:, 1] - found[1:, 0]).T).sum() / 1000
    assert travel(page.tools[0].strokes) == pytest.approx(along, abs=0.01)
    assert [plate.guide for plate in shown.plates] == [False, True]
    assert '"%98 travel"' in render(shown, "svg", check=False).decode()


def test_processes_are_done_in_turn_and_reported(tmp_path: Path) -> None:
    recipe = tmp_path / "kawung.toml"
    both = '[[output]]\nformat = "svg"\nprocess = [{ kind = "plot" }, { kind = "plot", join = false }]\n'
    recipe.write_text((SAMPLES / "kawung.toml").read_text() + both)
    (job,) = planned(read_jobs([str(recipe)]), tmp_path)
    (file,) = run(job, lambda stage: None)["files"]
    assert isinstance(file["process"], dict)
    assert read_provenance(file["path"]).processes == ("plot", "plot join=false")


def test_a_call_gives_every_file_its_process(tmp_path: Path) -> None:
    call = [
        "compile",
        str(SAMPLES / "kawung.toml"),
        "-o",
        str(tmp_path),
        "-f",
        "svg,dxf",
        "--process",
        "plot",
        "--json",
    ]
    done = runner().invoke(cli, call)
    assert done.exit_code == 0, done.output
    assert [each["format"] for each in json.loads(done.stdout)["recipes"][0]["files"]] == ["svg", "dxf"]
    assert all(read_provenance(tmp_path / f"kawung.{each}").processes == ("plot",) for each in ("svg", "dxf"))


def test_what_a_process_refuses_is_told_by_its_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(self: PlotProcess, page: Page, machine: Machine) -> Prepared:
        raise GeometryError("join = true, expected false")

    monkeypatch.setattr(PROCESSES["plot"], "apply", refuse)
    recipe = tmp_path / "kawung.toml"
    recipe.write_text(
        (SAMPLES / "kawung.toml").read_text() + '[[output]]\nformat = "svg"\nprocess = { kind = "plot" }\n'
    )
    told = runner().invoke(cli, ["compile", str(recipe), "-o", str(tmp_path / "out")])
    assert told.exit_code == 2
    assert "output[0].process.join: true, expected false" in told.stderr
    assert re.search(r"kawung\.toml:\d+: ", told.stderr)
    assert not list(tmp_path.glob("out/*"))


def test_files_that_ask_for_the_same_go_through_it_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[str] = []
    apply = PlotProcess.apply

    def counted(self: PlotProcess, page: Page, machine: Machine) -> Prepared:
        seen.append(str(self.resolved(machine)))
        return apply(self, page, machine)

    monkeypatch.setattr(PlotProcess, "apply", counted)
    recipe = tmp_path / "kawung.toml"
    plot = 'process = { kind = "plot" }'
    tables = [f'format = "{each}"\n{plot}' for each in ("svg", "dxf", "pdf")]
    tables.append(f'format = "gcode"\nmachine = "pen-plotter"\n{plot}')
    recipe.write_text(
        (SAMPLES / "kawung.toml").read_text() + "".join(f"[[output]]\n{each}\n" for each in tables)
    )
    done = runner().invoke(cli, ["compile", str(recipe), "-o", str(tmp_path)])
    assert seen == ["plot", "plot width=0.4"]
    assert done.stderr.count(" drawn, ") == 6, "told once for each of the two, of both pens and together"
