"""Cantings: the broadest spout that fits draws, and metres are areas over breadths."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell
from batik_vector.processes.waxing.cantings import drawn_by

SPOUTS = {"isen": 0.8, "klowong": 1.6, "tembok": 3.0}
PAGE = Artwork("page", Cell(100_000, 100_000), ())


def told(*areas: shapely.Geometry) -> dict[str, Any]:
    return drawn_by(PAGE, np.array(areas, dtype=object), SPOUTS)


def metres(facts: dict[str, Any]) -> dict[str, float]:
    return {each["canting"]: each["metres"] for each in facts["cantings"]}


def line(breadth: float, length: float = 50.0) -> shapely.Polygon:
    return shapely.LineString([(20, 20), (20 + length, 20)]).buffer(breadth / 2, quad_segs=32)


@pytest.mark.parametrize(
    ("breadth", "canting"), [(0.9, "isen"), (1.6, "klowong"), (2.9, "klowong"), (3, "tembok")]
)
def test_a_line_is_drawn_by_the_broadest_spout_that_fits(breadth: float, canting: str) -> None:
    facts = told(line(breadth))
    found = metres(facts)
    expected = line(breadth).area / SPOUTS[canting] / 1000
    assert found[canting] == pytest.approx(expected, rel=0.02)
    assert sum(found.values()) - found[canting] < 0.001
    assert facts["finer_mm2"] < 0.2


def test_what_is_finer_than_the_finest_is_told() -> None:
    facts = told(line(0.5))
    assert facts["finer_mm2"] == pytest.approx(line(0.5).area, abs=0.06)
    assert sum(metres(facts).values()) < 0.001


def test_a_broad_area_with_a_thin_stem_is_for_two() -> None:
    leaf = shapely.union(shapely.box(30, 30, 50, 50), shapely.box(39.5, 10, 40.5, 30))
    found = metres(told(leaf))
    assert found["tembok"] == pytest.approx(400 / 3000, rel=0.02)
    assert found["isen"] == pytest.approx(20 / 800, rel=0.1)


def test_dots_are_counted_and_broad_discs_are_none() -> None:
    discs = [shapely.Point(20 + 15 * k, 50).buffer(r) for k, r in enumerate((0.5, 1.0, 1.5, 6.0))]
    assert told(*discs, line(1.6))["dots"] == 3


def test_wax_goes_on_across_the_edges_of_the_tile() -> None:
    # A line of 2 mm along the seam, half on either side: neither half is one of 1 mm.
    halves = shapely.box(0, 0, 1, 100), shapely.box(99, 0, 100, 100)
    found = metres(told(*halves))
    assert found["klowong"] == pytest.approx(200 / 1600, rel=0.01)
    assert found["isen"] < 0.001


def test_without_cantings_nothing_is_told() -> None:
    assert drawn_by(PAGE, np.array([line(1.0)], dtype=object), {})["cantings"] == []
