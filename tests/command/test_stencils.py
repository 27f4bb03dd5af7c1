"""Stencils from the command to files: what repeats carries its bridges, and cutters get contours."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import ezdxf
import pytest
import shapely
from click.testing import Result

from batik_vector.command.cli import cli
from tests.calling import runner

RECIPE = """\
title = "Rings"

[cloth]
colour = "#ffffff"

[ink.dye]
colour = "#1d2f5f"

[motif.ring]
kind = "rosette"
elements = [
  { name = "disc", curve = { kind = "circle", radius = 8 }, ink = "dye" },
  { name = "hole", curve = { kind = "circle", radius = 5 }, treatment = "cut" },
]

[[place]]
motif = "ring"
scale = "1 mm"

[tile]
size = ["40 mm", "40 mm"]
"""
YARDAGE = '\n[yardage]\nwidth = "100 mm"\nlength = "100 mm"\n'


def compiled(folder: Path, *call: str, recipe: str = RECIPE) -> Result:
    (folder / "r.toml").write_text(recipe, encoding="utf-8")
    return runner().invoke(cli, ["compile", str(folder / "r.toml"), "-o", str(folder / "out"), *call])


def report(folder: Path, *call: str, recipe: str = RECIPE) -> dict[str, Any]:
    done = compiled(folder, "--json", *call, recipe=recipe)
    assert done.exit_code == 0, done.stderr
    (found,) = json.loads(done.stdout)["recipes"]
    return dict(found)


def test_a_stencil_is_told_of(tmp_path: Path) -> None:
    done = compiled(tmp_path, "-f", "dxf", "--process", "stencil bridge=1mm symmetric=false")
    assert "dye: 1 opening, 1 island, 1 bridge of 1 mm that close 3.0" in done.stderr
    assert "narrowest member 1.00" in done.stderr
    assert "78.22 mm² hang on 1 bridge" in done.stderr
    (file,) = report(tmp_path, "-f", "dxf", "--process", "stencil bridge=1mm")["files"]
    (sheet,) = file["process"]["stencil"]["sheets"]
    # The ring stands on a centre of the square lattice.
    assert (sheet["bridges"], sheet["islands"], sheet["symmetries"]) == (4, 1, 8)


def test_contours_go_round_what_is_open(tmp_path: Path) -> None:
    report(tmp_path, "-f", "dxf", "--process", "stencil bridge=1mm symmetric=false")
    lines = list(ezdxf.readfile(tmp_path / "out" / "r.dxf").modelspace().query("LWPOLYLINE"))  # type: ignore[attr-defined]
    areas = [shapely.Polygon([point[:2] for point in line.get_points()]) for line in lines]
    assert len(areas) == 1  # a C, and no ring in a ring
    assert areas[0].area == pytest.approx(3.1416 * (64 - 25) - 3, abs=0.5)


def test_what_repeats_carries_its_bridges(tmp_path: Path) -> None:
    recipe = RECIPE + '\n[[output]]\nformat = "svg"\nrepeat = [3, 3]\n'
    process = "stencil bridge=1mm symmetric=false"
    (file,) = report(tmp_path, "--process", process, recipe=recipe)["files"]
    assert file["size_mm"] == [120, 120]
    assert file["process"]["stencil"]["sheets"][0]["bridges"] == 1
    text = (tmp_path / "out" / "r.svg").read_text(encoding="utf-8")
    assert text.count("<path") == 9
    checked = runner().invoke(cli, ["check", str(tmp_path / "out" / "r.svg")])
    assert checked.exit_code == 0, checked.stderr


def test_cloth_is_filled_with_what_is_bridged(tmp_path: Path) -> None:
    plain = report(tmp_path, "-f", "dxf", recipe=RECIPE + YARDAGE)
    (file,) = report(tmp_path, "-f", "dxf", "--process", "stencil bridge=1mm", recipe=RECIPE + YARDAGE)[
        "files"
    ]
    assert file["size_mm"] == plain["files"][0]["size_mm"]
    assert file["process"]["stencil"]["sheets"][0]["bridges"] == 4
    lines = list(ezdxf.readfile(tmp_path / "out" / "r.dxf").modelspace().query("LWPOLYLINE"))  # type: ignore[attr-defined]
    inner = [line for line in lines if line.dxf.layer == "dye" and line.closed]
    # Each ring within the cloth is four quarters now.
    assert len(inner) > 16


def test_a_stencil_is_cut(tmp_path: Path) -> None:
    call = ["--process", "stencil bridge=1mm symmetric=false", "--process", "cut keep=ground kerf=0.1mm"]
    (file,) = report(tmp_path, "-f", "svg", *call)["files"]
    assert list(file["process"]) == ["stencil", "cut"]
    assert file["process"]["cut"]["tools"][0]["contours"] == 1
    done = compiled(tmp_path, "-f", "dxf", "--process", "cut", "--process", "stencil")
    assert done.exit_code == 2
    assert '"stencil", expected before what is not done to the tile' in done.stderr


def test_borders_get_no_bridges(tmp_path: Path) -> None:
    border = '\n[[border]]\nsize = ["20 mm", "20 mm"]\nplace = [{ motif = "ring", scale = "0.5 mm" }]\n'
    done = compiled(tmp_path, "-f", "dxf", "--process", "stencil", recipe=RECIPE + YARDAGE + border)
    assert done.exit_code == 2
    assert "borders would stay as they are" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("format", ["svg", "pdf", "dxf", "hpgl", "png"])
def test_every_format_takes_stencils(tmp_path: Path, format: str) -> None:
    one, two = (
        report(tmp_path, "-f", format, "--process", "stencil bridge=1mm") and _bytes(tmp_path)
        for _ in range(2)
    )
    assert one == two


def _bytes(folder: Path) -> bytes:
    (path,) = (folder / "out").iterdir()
    return path.read_bytes()
