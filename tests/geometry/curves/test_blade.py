"""Blades: where they begin and end, how broad they are, and which bends fold them over."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import GeometryError
from batik_vector.geometry.curves import Blade, trace
from batik_vector.geometry.regions import FillRule, settle
from tests.thorough import examples, long

POWERS = st.floats(0.35, 6)


def test_it_runs_from_the_origin_to_its_tip_and_is_broadest_where_its_powers_say() -> None:
    blade = Blade(2.0, 0.3, 1.0, 3.0)
    assert blade.at(np.array([0.0, 0.5, 1.0])) == pytest.approx(np.array([[0, 0], [2, 0], [0, 0]]), abs=1e-12)
    (ring,) = trace(blade, 1e-4).rings
    x, y = ring[np.argmax(ring[:, 1])]
    assert (x, y) == (pytest.approx(0.5, abs=0.02), pytest.approx(0.3, abs=1e-4))


def test_a_midrib_bent_by_a_right_angle_ends_going_up() -> None:
    tip = Blade(1.0, 0.1, bend=90.0).at(np.array([0.5]))[0]
    assert tip == pytest.approx([2 / np.pi, 2 / np.pi])


def test_halves_of_powers_are_an_ellipse() -> None:
    points = Blade(2.0, 0.5, 0.5, 0.5).at(np.linspace(0, 1, 60))
    assert (points[:, 0] - 1) ** 2 + (points[:, 1] / 0.5) ** 2 == pytest.approx(1)


@long
@settings(max_examples=examples(40, 600), deadline=None)
@given(POWERS, POWERS, st.floats(-1, 1), st.floats(-1, 1), st.integers(0, 12))
def test_every_blade_that_is_not_refused_is_one_piece(
    base: float, tip: float, lean: float, share: float, teeth: int
) -> None:
    most = np.degrees(0.94 / (0.25 * (1 + abs(lean))))
    (ring,) = trace(Blade(1.0, 0.25, base, tip, share * min(most, 170.0), lean, teeth), 1e-3).rings
    # Where it is drawn out to a thread its sides may meet, by less than the tolerance.
    parts = settle([ring], FillRule.NONZERO)
    assert shapely.area(parts).max() == pytest.approx(shapely.Polygon(ring).area, rel=1e-3)


def test_a_bend_that_folds_it_over_is_refused_with_the_bends_that_do_not() -> None:
    with pytest.raises(GeometryError, match=r"bend = 200 folds .* expected -136 to 136, or a smaller width"):
        Blade(1.0, 0.4, bend=200.0)
    Blade(1.0, 0.4, bend=136.0)
