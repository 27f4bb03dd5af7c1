"""Plates replayed as a dyeing give the design back, and their seams are exact."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, violations
from batik_vector.machines import Machine
from batik_vector.processes.options import WaxProcess
from batik_vector.tiling.torus.seams import mismatch
from batik_vector.tiling.torus.torus import to_step_grid
from tests.processes.waxing.designs import drawn, meeting
from tests.processes.waxing.replaying import Cloth, apart, dyed, painted
from tests.thorough import examples, long

HALF_STEP = 0.00075
"""How far (mm) an edge may be brought where its crossing with another is rounded to the grid."""


def wax(page: Artwork, **told: object) -> Artwork:
    return WaxProcess(**told).apply(page, Machine())  # type: ignore[arg-type]


def replayed(page: Artwork) -> Cloth:
    plates = wax(page, plate="all")
    return dyed(plates, plates.facts["wax"]["work"])


def shown(page: Artwork) -> Cloth:
    """Return the cloth as the file of it shows it."""
    assert page.dyeing
    cloth = wax(page, plate="cloth")
    return painted(cloth)


@long
@settings(max_examples=examples(5, 75), deadline=None, derandomize=True)
@given(st.integers(0, 10_000))
@example(5924)  # wax that touches itself along a line
def test_wax_replayed_gives_the_design_back(number: int) -> None:
    page = meeting(number)
    assert apart(replayed(page), painted(page)) < 1e-6
    assert apart(replayed(page), shown(page)) < 1e-6


@long
@settings(max_examples=examples(3, 75), deadline=None, derandomize=True)
@given(st.integers(0, 10_000))
def test_wax_of_curves_replayed_gives_the_design_back(number: int) -> None:
    page = drawn(number)
    cloth = replayed(page)
    assert apart(cloth, shown(page)) < 1e-6
    # Edges that cross do so between the points of the grid, on which all plates lie.
    edges = sum(float(shapely.length(part)) for part in painted(page).values())
    assert apart(cloth, painted(page)) < edges * HALF_STEP


@long
@settings(max_examples=examples(3, 15), deadline=None, derandomize=True)
@given(st.integers(0, 10_000), st.booleans())
def test_plates_are_in_the_normal_form_and_their_seams_exact(number: int, mirror: bool) -> None:
    page = drawn(number)
    for plates in (wax(page, plate="all", mirror=mirror), wax(page, plate="cloth", mirror=mirror)):
        assert violations(plates) == []
        borders = {each[1:] for each in plates.borders}
        for layer in plates.layers:
            breaks = {tuple(each) for each in mismatch(to_step_grid(layer.areas), plates.cell).tolist()}
            assert breaks <= borders


@pytest.mark.parametrize("number", [3, 11])
def test_plates_of_each_bath_are_what_it_does_not_see(number: int) -> None:
    page = meeting(number)
    plates = wax(page, plate="all", plates="baths")
    cloth = painted(page)
    for layer, bath in zip(plates.layers, ("indigo", "soga"), strict=True):
        dry = shapely.union_all([part for seen, part in cloth.items() if bath not in seen])
        assert float(shapely.area(shapely.symmetric_difference(shapely.union_all(layer.areas), dry))) < 1e-6


def test_a_mirrored_plate_is_the_same_wax_from_behind() -> None:
    page = meeting(5)
    front, back = (wax(page, plate="all", mirror=mirror) for mirror in (False, True))
    for one, other in zip(front.layers, back.layers, strict=True):
        turned = shapely.transform(
            shapely.union_all(one.areas), lambda xy: np.c_[page.cell.width - xy[:, 0], xy[:, 1]]
        )
        assert (
            float(shapely.area(shapely.symmetric_difference(turned, shapely.union_all(other.areas)))) < 1e-6
        )
    assert violations(back) == []


def test_a_replay_that_leaves_a_step_out_is_told() -> None:
    page = meeting(7)
    plates = wax(page, plate="all")
    work = [each for each in plates.facts["wax"]["work"] if each["doing"] != "scrape"]
    with pytest.raises(AssertionError):
        dyed(plates, work)
