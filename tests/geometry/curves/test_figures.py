"""Periods, cusps, petals and bounds: what the formulas promise, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from batik_vector.errors import GeometryError
from batik_vector.geometry.curves import Circle, Hypocycloid, Petal, Polygon, Rose, Superellipse, trace


@pytest.mark.parametrize(
    ("n", "d", "petals"), [(2, 1, 4), (3, 1, 3), (4, 1, 8), (5, 1, 5), (7, 3, 7), (5, 4, 10), (4, 2, 4)]
)
def test_a_rose_has_n_petals_when_nd_is_odd_and_2n_when_even(n: int, d: int, petals: int) -> None:
    rose = Rose(n, d)
    assert rose.petals == petals
    assert len(trace(rose, 1e-3).rings) == petals


@pytest.mark.parametrize("n", range(1, 9))
def test_the_area_of_a_rose_is_that_of_the_books(n: int) -> None:
    import shapely

    # π/4 for odd n, π/2 for even: MathWorld, Rose Curve.
    area = sum(shapely.Polygon(ring).area for ring in trace(Rose(n), 1e-5).rings)
    assert area == pytest.approx(math.pi / (4 if n % 2 else 2), rel=1e-3)


@pytest.mark.parametrize("t", np.linspace(0, 1, 41))
def test_a_superellipse_satisfies_its_implicit_form(t: float) -> None:
    a, b, r1, r2 = 0.7, 3.0, 2.0, 0.5
    x, y = Superellipse(a, b, r1, r2).at(np.array([t]))[0]
    assert abs(x / r1) ** (2 / a) + abs(y / r2) ** (2 / b) == pytest.approx(1, abs=1e-9)


def test_the_tips_of_a_leaf_are_exact() -> None:
    tips = Superellipse(0.2, 20, 1.2, 0.3).at(np.array([0, 0.25, 0.5, 0.75, 1.0]))
    assert tips.tolist() == [[1.2, 0], [0, 0.3], [-1.2, 0], [0, -0.3], [1.2, 0]]


@pytest.mark.parametrize(
    ("m", "n", "copies"), [(16, 5, 1), (10, 4, 2), (20, 5, 5), (15, 6, 3), (24, 6, 6), (32, 5, 1)]
)
def test_a_pistil_shows_all_its_cusps_once(m: int, n: int, copies: int) -> None:
    star = Hypocycloid(m, n, 1.0)
    traced = trace(star, 1e-3)
    assert len(traced.strands) == star.copies == copies
    points = np.vstack([strand[:-1] for strand in traced.strands])
    radius = np.hypot(*points.T)
    cusps = points[radius > 1 - 1e-9]
    angles = np.sort(np.round(np.degrees(np.arctan2(*cusps.T[::-1])) % 360, 6) % 360)
    assert angles == pytest.approx(np.arange(m) * 360 / m, abs=1e-5)
    assert radius.max() == pytest.approx(1)


@pytest.mark.parametrize(("m", "n", "word"), [(5, 5, "point"), (10, 5, "segment"), (3, 5, "swings past")])
def test_pistils_that_are_none_are_refused_with_good_neighbours(m: int, n: int, word: str) -> None:
    with pytest.raises(GeometryError, match=word) as caught:
        Hypocycloid(m, n)
    assert "try m = " in str(caught.value)
    named = str(caught.value).split("try m = ")[1].split(", ")
    for neighbour in named:
        Hypocycloid(int(neighbour), n)


@pytest.mark.parametrize(
    "build",
    [
        lambda: Rose(0),
        lambda: Rose(2, 0),
        lambda: Circle(0),
        lambda: Circle(math.nan),
        lambda: Circle(math.inf),
        lambda: Polygon(2),
        lambda: Superellipse(a=-1),
        lambda: Petal(2, -1.0),
    ],
)
def test_numbers_out_of_bounds_are_refused_with_the_bounds(build: object) -> None:
    with pytest.raises(GeometryError, match=r"expected .* to "):
        build()  # type: ignore[operator]


def test_curves_are_values() -> None:
    assert Rose(4, 1, 0.5) == Rose(4, 1, 0.5)
    assert len({Circle(1), Circle(1), Circle(2)}) == 2
