"""Points that fall on points of an outline are found in a table, and nothing else is."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.certificate.symmetry.same_places import STRAY, SamePlaces

BASIS = np.array([[40.0, 7.0], [0.0, 31.0]])
NEAR = 0.01


def table(count: int = 500, seed: int = 1) -> tuple[SamePlaces, np.ndarray, np.ndarray, np.ndarray]:
    chance = np.random.default_rng(seed)
    xy, kind = chance.uniform(-50, 90, (count, 2)), chance.integers(0, 3, count)
    way = chance.normal(size=(count, 2))
    return SamePlaces(xy, kind, way, way, BASIS, NEAR), xy, kind, way


@given(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), st.integers(0, 99))
def test_a_point_meets_itself_at_every_translate(steps: tuple[int, int], seed: int) -> None:
    places, xy, kind, way = table(seed=seed)
    moved = xy + BASIS @ np.array(steps)
    # Along the edge a fellow may stand off, across it hardly.
    moved += way / np.hypot(*way.T)[:, None] * NEAR / 2
    distance = places.distances(moved, kind, way)
    assert np.isfinite(distance).mean() > 0.7  # some share a place in the table, or lie in different bins
    assert distance[np.isfinite(distance)].max() <= NEAR / STRAY


def test_what_stands_off_or_heads_the_other_way_or_is_of_another_kind_is_not_met() -> None:
    places, xy, kind, way = table()
    upright = np.column_stack([-way[:, 1], way[:, 0]]) / np.hypot(*way.T)[:, None]
    assert np.isinf(places.distances(xy + 2 * NEAR / STRAY * upright, kind, way)).all()
    assert np.isinf(places.distances(xy, kind, -way)).all()
    assert np.isinf(places.distances(xy, (kind + 1) % 3, way)).all()
    assert np.isfinite(places.distances(xy, kind, np.zeros_like(way))).mean() > 0.8
