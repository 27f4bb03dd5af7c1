"""Readers of HP-GL: hp2xx, ezhpgl, and the checker of a 7475A."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork
from batik_vector.export import HpglOptions, Turn, render
from batik_vector.recipe.reading.machines import read_machine
from tests.clients import drawings, programs

pytestmark = pytest.mark.clients

READERS = {"hp2xx": programs.hp2xx, "ezhpgl": programs.ezhpgl}
OLD = "hp7475a"


def written(artwork: Artwork, folder: Path, machine: str, **options: object) -> Path:
    path = folder / "drawing.hpgl"
    chosen = HpglOptions(device=read_machine(machine).hpgl_device, **options)  # type: ignore[arg-type]
    path.write_bytes(render(artwork, "hpgl", chosen))
    return path


@pytest.fixture(params=["kawung", "line-art", "three-baths", "chrysanthemum-line"])
def drawing(request: pytest.FixtureRequest) -> Artwork:
    name: str = request.param
    return drawings.artwork(name)


@pytest.mark.parametrize("reader", READERS.values(), ids=READERS)
@pytest.mark.parametrize(
    ("machine", "encoded"), [("hpgl", False), ("hpgl", True), (OLD, False), ("hp7580b", False)]
)
def test_readers_draw_the_artwork(
    drawing: Artwork,
    tmp_path: Path,
    machine: str,
    encoded: bool,
    reader: Callable[[Path], programs.Plotted],
) -> None:
    width, height = drawing.cell.width, drawing.cell.height
    path = written(
        drawing, tmp_path, machine, encoded=encoded, turn=Turn.NONE, **sheet(machine, width, height)
    )
    strokes = reader(path)
    unit = read_machine(machine).hpgl.unit
    corner = 0.0 if machine != "hp7580b" else None
    assert {pen for pen, _ in strokes} == set(range(1, len(drawing.layers) + 1))
    for pen, layer in enumerate(drawing.layers, start=1):
        marks = [*shapely.boundary(layer.areas), *layer.lines]
        places = np.concatenate([np.array(each) for number, each in strokes if number == pen])
        left, bottom, right, top = np.floor(shapely.total_bounds(np.array(marks)) / unit + 0.5)
        found = np.rint([*places.min(axis=0), *places.max(axis=0)])
        assert (found[2:] - found[:2]).tolist() == [right - left, top - bottom]
        if corner is not None:
            assert found[:2].tolist() == [left, bottom]
        length = sum(
            float(np.hypot(*np.diff(np.array(each), axis=0).T).sum())
            for number, each in strokes
            if number == pen
        )
        assert length * unit == pytest.approx(sum(mark.length for mark in marks), rel=0.003)


def sheet(machine: str, width: float, height: float) -> dict[str, object]:
    """A sheet of the drawing's size where the machine's own may be too small: readers know no limits."""
    return {} if machine == "hpgl" else {"page": f"{width + 1} x {height + 1} mm"}


def test_the_checker_of_a_7475a_has_nothing_to_say(drawing: Artwork, tmp_path: Path) -> None:
    width, height = drawing.cell.width, drawing.cell.height
    path = written(drawing, tmp_path, OLD, speed=100, **sheet(OLD, width, height))
    assert "Syntax check PASSED" in (words := programs.hpgl_buddy(path))
    assert " 0 warning(s)" in words


def test_the_checker_takes_the_words_of_its_sheets(tmp_path: Path) -> None:
    path = written(drawings.artwork("kawung"), tmp_path, OLD)
    assert "PS4;" in path.read_text()
    assert " 0 warning(s)" in programs.hpgl_buddy(path)


def test_the_checker_would_find_what_it_does_not_know(tmp_path: Path) -> None:
    path = written(drawings.artwork("kawung"), tmp_path, "hpgl", encoded=True)
    with pytest.raises(AssertionError, match="FAILED"):
        programs.hpgl_buddy(path)


@pytest.mark.parametrize("reader", READERS.values(), ids=READERS)
def test_the_recipe_is_carried_past_readers(
    tmp_path: Path, reader: Callable[[Path], programs.Plotted]
) -> None:
    bare = reader(written(drawings.artwork("kawung"), tmp_path, "hpgl"))
    assert reader(written(drawings.artwork("kawung"), tmp_path, "hpgl", comment=True)) == bare
