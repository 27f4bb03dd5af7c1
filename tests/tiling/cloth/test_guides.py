"""Marks of a cloth: trim marks, crosses and the bar stand outside of what is drawn, and are seen."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from tests.tiling.cloth.test_yardage import DISCS, cloth


def test_marks_stand_outside_the_drawing() -> None:
    page = cloth(DISCS, 150, 210, edge="bleed", bleed=5, selvedge=20, marks=True)
    assert [(plate.ink.name, plate.guide) for plate in page.plates] == [("wax", False), ("marks", True)]
    (guides,) = page.lines(1)
    printed = np.array([-5_000, -5_000, 155_000, 215_000])
    lines = np.asarray(shapely.linestrings(guides.points.reshape(-1, 2, 2).astype(float)), dtype=object)
    assert not shapely.intersects(lines, shapely.box(*printed)).any()
    margins = page.margins
    low, high = guides.points.min(axis=0), guides.points.max(axis=0)
    assert (low > [-margins.left, -margins.bottom]).all()
    assert (high < [150_000 + margins.right, 210_000 + margins.top]).all()
    by_name: dict[str, list[Any]] = {}
    for name, line in zip(guides.names, lines, strict=True):
        by_name.setdefault(name, []).append(line)
    assert max(line.length for line in by_name["marks.bar"]) == 100_000
    assert sorted({line.coords[0][1] for line in by_name["marks.repeat"]}) == [k * 40_000 for k in range(6)]
    assert {line.coords[0][0] for line in by_name["marks.cut"]} == {-20_000, 170_000}
    assert len(by_name["marks.trim"]) == len(by_name["marks.cross"]) == 8


def test_a_page_grows_to_hold_its_bar() -> None:
    page = cloth(DISCS, 30, 50, marks=True)
    (guides,) = page.lines(1)
    assert guides.points[:, 0].max() < 30_000 + page.margins.right


@pytest.mark.parametrize("width", [30, 96, 104, 108, 150])
def test_the_bar_crosses_no_other_mark(width: float) -> None:
    page = cloth(DISCS, width, 50, marks=True)
    (guides,) = page.lines(1)
    lines = np.asarray(shapely.linestrings(guides.points.reshape(-1, 2, 2).astype(float)), dtype=object)
    bar = np.array(guides.names) == "marks.bar"
    assert shapely.distance(shapely.union_all(lines[bar]), shapely.union_all(lines[~bar])) >= 1_000
    assert guides.points[:, 1].min() > -page.margins.bottom


def test_marks_show_on_dark_cloth_and_on_light() -> None:
    for colour, seen in (("#161b30", "#ffffff"), ("#fed", "#000000")):
        page = cloth(replace(DISCS, cloth=colour), 100, 100, marks=True)
        assert page.plates[-1].ink.colour == seen
