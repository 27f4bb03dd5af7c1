"""Stamps: set side by side they print the plate, and their pins stand in the same places."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, violations
from batik_vector.errors import GeometryError
from batik_vector.machines import Machine
from batik_vector.processes.options import WaxProcess
from batik_vector.processes.waxing.caps import grid_of, stamp
from tests.processes.waxing.designs import drawn, meeting


def wax(page: Artwork, **told: object) -> Artwork:
    return WaxProcess(**told).apply(page, Machine())  # type: ignore[arg-type]


@pytest.mark.parametrize("number", [2, 9])
def test_stamps_side_by_side_print_the_plate(number: int) -> None:
    page = drawn(number)
    plate = wax(page, plate="all")
    grid = grid_of(page.cell, (11.0, 17.0))
    assert len(grid) > 4
    printed = {layer.ink.name: list[shapely.Geometry]() for layer in plate.layers}
    for each in range(1, len(grid) + 1):
        print_ = stamp(plate, grid, each, 2.0)
        assert violations(print_) == []
        left, bottom, right, top = grid.window(each)
        assert (print_.cell.columns, print_.cell.rows) == (right - left, top - bottom)
        assert print_.cell.width <= 11
        assert print_.cell.height <= 17
        for layer in print_.layers[:-1]:
            printed[layer.ink.name] += [
                shapely.affinity.translate(area, left / 1000, bottom / 1000) for area in layer.areas
            ]
    for layer in plate.layers:
        whole, parts = shapely.union_all(layer.areas), shapely.union_all(printed[layer.ink.name])
        # An edge may be bent by half a step where a stamp ends on it.
        assert float(shapely.area(shapely.symmetric_difference(whole, parts))) < 0.001 * whole.length
        overlap = float(shapely.area(printed[layer.ink.name]).sum()) - float(parts.area)
        assert abs(overlap) < 1e-6


def test_pins_stand_where_those_of_the_next_print_stand() -> None:
    page = drawn(2)
    cell = Cell(page.cell.columns // 6 * 6, page.cell.rows // 6 * 6, Fraction(1, 3))
    plain = Artwork("plate", cell, ())
    (layer,) = stamp(plain, grid_of(cell, (1000, 1000)), 1, 2.0).layers
    pins = {
        tuple(np.rint(shapely.get_coordinates(each.centroid)[0] * 1000).astype(int)) for each in layer.areas
    }
    assert layer.ink.name == "pins"
    third = cell.rows // 3
    # Beside the corners, those of the columns on either side, which stand a third higher and lower.
    assert pins == {
        (x, y)
        for x, heights in ((0, (0, cell.rows - third, cell.rows)), (cell.columns, (0, third, cell.rows)))
        for y in heights
    }


def test_a_stamp_as_large_as_the_repeat_is_one_file_and_several_are_counted() -> None:
    page = meeting(4)
    one = WaxProcess(plate="1-nglowong", cap=(100.0, 100.0))
    assert one.parts(page) == []
    many = WaxProcess(plate="1-nglowong", cap=(page.cell.width / 2, 100.0))
    assert [name for name, _ in many.parts(page)] == ["cap-1", "cap-2"]
    all_of_them = WaxProcess(cap=(page.cell.width / 2, 100.0)).parts(page)
    assert [name for name, _ in all_of_them][:3] == ["1-nglowong-cap-1", "1-nglowong-cap-2", "2-nembok-cap-1"]
    front, back = (
        many.parts(page)[0][1],
        WaxProcess(plate="1-nglowong", cap=many.cap, cap_number=1, mirror=True),
    )
    pair = front.apply(page, Machine()), back.apply(page, Machine())
    areas = [float(shapely.area(each.layers[0].areas).sum()) for each in pair]
    assert areas[0] == pytest.approx(areas[1])


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ({"cap": (5.0, 5.0), "plate": "all"}, "cap_number = none, expected 1 to"),
        ({"cap": (5.0, 5.0), "plate": "all", "cap_number": 999}, "cap_number = 999, expected at most"),
        ({"cap": (50.0, 50.0), "plate": "cloth"}, 'plate = "cloth", expected a plate, or no cap'),
        ({"cap_number": 2}, "cap_number = 2, expected the size of a cap beside it"),
    ],
)
def test_what_no_stamp_prints_is_told(told: dict[str, object], words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        wax(meeting(4), **told)
