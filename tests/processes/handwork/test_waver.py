"""Wavers: they repeat bit by bit, and no two places fall on one another."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Cell, DropAxis
from batik_vector.processes.handwork.waver import Wave, Waver
from tests.thorough import examples, long

CELLS = (
    Cell(60_000, 40_000),
    Cell(60_000, 40_000, Fraction(1, 2)),
    Cell(60_000, 42_000, Fraction(1, 3), DropAxis.ROW),
    Cell(3_000, 100_000),
)


@long
@settings(max_examples=examples(20, 200), deadline=None)
@given(
    cell=st.sampled_from(CELLS),
    seed=st.integers(0, 1000),
    reach=st.floats(1000, 30_000),
    push=st.floats(0, 3000),
    times=st.tuples(st.integers(-5, 5), st.integers(-5, 5)),
)
def test_it_repeats_and_parts_places_no_more_than_it_says(
    cell: Cell, seed: int, reach: float, push: float, times: tuple[int, int]
) -> None:
    waver = Waver.drawn(cell, [Wave(reach, push), Wave(reach / 3, push / 4)], [seed]).eased(0.7)
    assert waver.strain <= 0.7 + 1e-9
    dice = np.random.default_rng(seed)
    places = dice.integers(-200_000, 200_000, (300, 2))
    (ax, ay), (bx, by) = cell.lattice
    i, j = times
    far = np.array([i * ax + j * bx, i * ay + j * by])
    assert (waver.moved(places + far) == waver.moved(places) + far).all()
    near = places + dice.integers(-500, 501, places.shape)
    apart = np.hypot(*(near - places).T)
    change = np.hypot(*(waver.at(near) - waver.at(places)).T)
    assert (change <= waver.strain * apart + 1e-6).all()
