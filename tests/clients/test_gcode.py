"""G-code in LinuxCNC's interpreter, which makes of it what a machine would do."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork
from batik_vector.export import GcodeOptions, gcode
from batik_vector.export.walk import Order, RecordingSurface, walk
from batik_vector.machines import Machine
from batik_vector.machines.gcode import Gcode
from batik_vector.recipe.reading.machines import read_machine
from tests.clients import drawings, programs
from tests.export.gcode_reader import Cut, Stroke, along

pytestmark = pytest.mark.clients

ARCS = (
    "border-p2mm",
    "five-circle",
    "four-square",
    "fractal-koch",
    "lsystem-kolam",
    "three-baths",
    "line-art",
)
"""Drawings that are followed arc by arc, which takes long."""
SAGITTA = 0.0005
"""Millimetres by which chords of an arc may be off."""
MACHINES = {
    "generic": Machine(),
    "percent": Machine(gcode=Gcode(stop="%", comment="()")),  # type: ignore[arg-type]
    # Without the sizes of their beds: what is drawn here is larger.
    **{
        name: Machine(tool=read_machine(name).tool, gcode=read_machine(name).gcode)
        for name in ("grbl-servo-plotter", "grbl-laser", "drag-knife", "linuxcnc-pen", "wax-pen")
    },
}
OF_MARLIN = re.compile(rb"^(M104|M109|M0 Canting).*\n", re.MULTILINE)
"""Words of a heater and a display, which only Marlin knows."""


def followed(data: bytes, folder: Path) -> tuple[list[Stroke], list[str]]:
    """Return what a program draws, and all that the interpreter said."""
    path = folder / "drawing.ngc"
    path.write_bytes(OF_MARLIN.sub(b"", data))
    said = programs.rs274(path)
    strokes, at, tool = list[Stroke](), (0.0, 0.0), 0
    open_stroke: Stroke | None = None
    height = 0.0
    for line in said:
        name, _, rest = line.partition("(")
        numbers = [float(each) for each in re.findall(r"-?\d+\.\d+|-?\d+", rest)]
        if name == "STRAIGHT_TRAVERSE":
            open_stroke, at, height = None, (numbers[0], numbers[1]), numbers[2]
        elif name == "CHANGE_TOOL":
            tool += 1
        elif name in ("STRAIGHT_FEED", "ARC_FEED"):
            straight = name == "STRAIGHT_FEED"
            if straight and numbers[2] != height:
                height = numbers[2]
                continue
            if open_stroke is None:
                open_stroke = Stroke(at, tool)
                strokes.append(open_stroke)
            to = numbers[0], numbers[1]
            centre = None if straight else (numbers[2], numbers[3])
            motion = 1 if straight else (3 if numbers[4] > 0 else 2)
            open_stroke.cuts.append(Cut(motion, *to, centre, 0.0))
            at = to
    return strokes, said


def drawn(artwork: Artwork) -> list[list[list[float]]]:
    """Return the contours of an artwork in the order in which a tool follows them, in mm.

    Those of which one begins where the one before it ended are one: the tool stays down.
    """
    surface = RecordingSurface()
    walk(artwork, surface, Order.CONTOURS)
    out = list[list[list[float]]]()
    begun = False
    for name, arguments in surface.calls:
        begun = begun and name != "ink"
        if name == "areas":
            points, rings = arguments[0].repeating()  # type: ignore[attr-defined]
            for stroke in ((points[a:b] / 1000).tolist() for a, b in pairwise(rings)):
                if begun and out[-1][-1] == stroke[0]:
                    out[-1] += stroke[1:]
                else:
                    out.append(stroke)
                begun = True
    return out


def check_followed(drawing: Artwork, folder: Path, machine: str) -> None:
    data = gcode.render(drawing, GcodeOptions(machine_profile=MACHINES[machine]))
    strokes, said = followed(data, folder)
    assert [stroke.points.tolist() for stroke in strokes] == drawn(drawing)
    assert "PROGRAM_END()" in said or machine == "percent"
    assert "USE_LENGTH_UNITS(CANON_UNITS_MM)" in said


def everywhere_near(one: shapely.LineString, other: shapely.LineString, near: float) -> bool:
    """Tell whether no place on a line is further from another: every 0.2 mm, and at vertices."""
    shapely.prepare(other)
    places = shapely.points(shapely.get_coordinates(shapely.segmentize(one, 0.2)))
    return bool(shapely.dwithin(places, other, near).all())


def test_the_interpreter_draws_the_artwork_to_the_last_digit(drawing: Artwork, tmp_path: Path) -> None:
    check_followed(drawing, tmp_path, "generic")


@pytest.mark.parametrize("machine", MACHINES)
def test_it_does_so_in_the_words_of_every_machine(lopsided: Artwork, tmp_path: Path, machine: str) -> None:
    check_followed(lopsided, tmp_path, machine)


def test_tools_come_in_turn(lopsided: Artwork, tmp_path: Path) -> None:
    inks = sum(len(layer.areas) + len(layer.lines) > 0 for layer in lopsided.layers)
    _, said = followed(gcode.render(lopsided), tmp_path)
    assert said.count("PROGRAM_STOP()") == inks - 1
    strokes, said = followed(
        gcode.render(lopsided, GcodeOptions(machine_profile=MACHINES["linuxcnc-pen"])), tmp_path
    )
    assert [line for line in said if line.startswith("CHANGE_TOOL")] == [
        f"CHANGE_TOOL({number})" for number in range(1, inks + 1)
    ]
    assert sorted({stroke.tool for stroke in strokes}) == list(range(1, inks + 1))


@pytest.mark.parametrize("name", ARCS)
def test_arcs_keep_to_the_artwork(name: str, tmp_path: Path) -> None:
    drawing = drawings.artwork(name)
    strokes, said = followed(gcode.render(drawing, GcodeOptions(arcs=True)), tmp_path)
    told = drawn(drawing)
    near = 2 * drawing.tolerance + 0.002
    whole, bounds = [], []
    for stroke, points in zip(strokes, told, strict=True):
        assert stroke.points[[0, -1]].tolist() == [points[0], points[-1]]
        # Without what the four decimals of the interpreter's own listing lose.
        path = shapely.LineString(np.concatenate(list(along(stroke, SAGITTA))))
        line = shapely.LineString(points)
        assert everywhere_near(path, line, near)
        assert everywhere_near(line, path, near)
        whole.append(shapely.get_parts(path))
        bounds.append(line.bounds)
    drawn_bounds, told_bounds = (
        shapely.total_bounds(shapes) for shapes in (np.concatenate(whole), shapely.box(*np.array(bounds).T))
    )
    assert np.abs(drawn_bounds - told_bounds).max() <= near
    # What is straight has none.
    assert any(line.startswith("ARC_FEED") for line in said) == any(
        cut.centre for stroke in strokes for cut in stroke.cuts
    )


def test_arcs_stand_for_most_of_the_moves(tmp_path: Path) -> None:
    drawing = drawings.artwork("three-baths")
    strokes, _ = followed(gcode.render(drawing, GcodeOptions(arcs=True)), tmp_path)
    assert sum(len(stroke.cuts) for stroke in strokes) < sum(map(len, drawn(drawing))) / 2


def test_the_interpreter_would_tell(lopsided: Artwork, tmp_path: Path) -> None:
    path = tmp_path / "cut.ngc"
    path.write_bytes(gcode.render(lopsided).removesuffix(b"M2\n"))
    with pytest.raises(AssertionError, match="no percent sign or program end"):
        programs.rs274(path)
