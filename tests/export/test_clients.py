"""The same drawing in the programs that people open it with: size, place and colours must agree."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from PIL import Image

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.export import DxfOptions, SvgOptions, write_artwork

from .drawings import geometries

pytestmark = pytest.mark.clients
DPI = 254


def drawing(bleed: float = 2.0) -> Artwork:
    """A page that looks different however it is turned, mirrored, moved or scaled."""
    marks = geometries(
        shapely.box(2, 2, 22, 8), shapely.box(2, 8, 6, 26), shapely.Point(24, 20).buffer(5, quad_segs=99)
    )
    layer = Layer(Ink("wax", "#ff0000"), areas=marks)
    return Artwork("F", Cell(40_000, 30_000), (layer,), "#0000ff", bleed=bleed)


def call(*command: str | Path) -> None:
    if not shutil.which(str(command[0])):
        pytest.skip(f"{command[0]} is not installed")
    env = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    subprocess.run([str(c) for c in command], env=env, check=True, capture_output=True, timeout=120)


def pixels(path: Path) -> NDArray[np.float64]:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"), float)


def check_filled(path: Path) -> None:
    """Check a picture at 10 pixels per mm, red marks on blue, the bleed shown."""
    found = pixels(path)
    height, width = found.shape[:2]
    assert (width, height) == pytest.approx((440, 340), abs=1)
    y, x = np.mgrid[0:height, 0:width]
    places = shapely.points(x.ravel() / 10 + 0.05 - 2, (height - y.ravel()) / 10 - 0.05 - 2)
    truth = shapely.union_all(drawing().layers[0].areas)
    # Pixels on an edge are mixed, and poppler makes the page up to a pixel higher.
    sure = (shapely.distance(truth.boundary, places) > 0.25).reshape(height, width)
    # So are those on the page's edge, where programs round its size each in their own way.
    edge = [0, 1, -2, -1]
    sure[edge] = sure[:, edge] = False
    inside = shapely.contains(truth, places).reshape(height, width)
    assert (found[sure & inside] == (255, 0, 0)).all()
    assert (found[sure & ~inside] == (0, 0, 255)).all()


@pytest.mark.parametrize("profile", ["editable", "compact"])
@pytest.mark.parametrize("curves", ["polyline", "bezier"])
def test_inkscape(tmp_path: Path, profile: str, curves: str) -> None:
    path = write_artwork(drawing(), tmp_path / "a.svg", options=SvgOptions(profile, curves))  # type: ignore[arg-type]
    call("inkscape", path, "-d", str(DPI), "-o", tmp_path / "a.png")
    check_filled(tmp_path / "a.png")


def test_chromium(tmp_path: Path) -> None:
    path = write_artwork(drawing(), tmp_path / "a.svg")
    scale = DPI / 96
    call(
        "chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}",
        f"--force-device-scale-factor={scale}", "--window-size=600,500", f"--screenshot={tmp_path / 'a.png'}",
        path.as_uri(),
    )  # fmt: skip
    with Image.open(tmp_path / "a.png") as image:
        image.crop((0, 0, 440, 340)).save(tmp_path / "b.png")
    check_filled(tmp_path / "b.png")


def test_poppler(tmp_path: Path) -> None:
    call(
        "pdftoppm",
        "-r",
        str(DPI),
        "-png",
        "-singlefile",
        write_artwork(drawing(), tmp_path / "a.pdf"),
        tmp_path / "a",
    )
    check_filled(tmp_path / "a.png")


def test_mupdf(tmp_path: Path) -> None:
    path = write_artwork(drawing(), tmp_path / "a.pdf")
    call("mutool", "draw", "-q", "-r", str(DPI), "-o", tmp_path / "a.png", path)
    check_filled(tmp_path / "a.png")


@pytest.mark.parametrize("version", ["R2000", "R12"])
@pytest.mark.parametrize("bleed", [0.0, 2.0])
def test_librecad(tmp_path: Path, version: str, bleed: float) -> None:
    if version == "R12" and bleed:
        pytest.skip("R12 has no $PINSBASE: LibreCAD lays its page from the cell's corner")
    path = write_artwork(drawing(bleed), tmp_path / "a.dxf", options=DxfOptions(version))  # type: ignore[arg-type]
    call("librecad", "dxf2pdf", path)
    call("pdftoppm", "-r", str(DPI), "-png", "-singlefile", tmp_path / "a.pdf", tmp_path / "a")
    found = pixels(tmp_path / "a.png")
    height, width = found.shape[:2]
    # LibreCAD rounds its page to whole points.
    assert (width, height) == pytest.approx((400 + 20 * bleed, 300 + 20 * bleed), abs=5)
    drawn = np.argwhere((found < 200).any(axis=2))
    truth = shapely.union_all(drawing().layers[0].areas)
    places = shapely.points(drawn[:, 1] / 10 + 0.05 - bleed, (height - drawn[:, 0]) / 10 - 0.05 - bleed)
    edges = shapely.union_all([shape.boundary for shape in drawing().layers[0].areas])
    assert shapely.distance(edges, places).max() < 0.5
    assert len(drawn) == pytest.approx(truth.boundary.length * 10, rel=0.25)
