"""Unions of large areas that set aside what lies apart are those that GEOS makes of the whole."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Geometries
from batik_vector.tiling.torus import joining


def nested(count: int, seed: int) -> Geometries:
    """Return nets of rings within rings round random places: holes, islands in them, and lone islands."""
    chance = np.random.default_rng(seed)
    middles = shapely.points(chance.integers(0, 10_000, (count, 2)))
    breadths = chance.integers(300, 1500, count).astype(float)
    stacks = [
        shapely.difference(
            shapely.buffer(middles, breadths * share), shapely.buffer(middles, breadths * (share - 0.12))
        )
        for share in (1.0, 0.75, 0.5, 0.25)
    ]
    return np.asarray(shapely.transform(np.concatenate(stacks), np.rint), dtype=object)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("away", [0, 4000, 30_000])
def test_what_is_set_aside_comes_back(monkeypatch: pytest.MonkeyPatch, seed: int, away: int) -> None:
    monkeypatch.setattr(joining, "LARGE", 0)
    one, other = shapely.union_all(nested(20, seed)), shapely.union_all(nested(20, seed + 100))
    other = shapely.transform(other, lambda xy: xy + away)
    first, second = np.array([one, other], dtype=object), np.array([other, one], dtype=object)
    joined = joining.joined_pairs(first, second)
    assert shapely.is_valid(joined).all()
    whole = shapely.union(first, second)
    assert shapely.equals_exact(shapely.normalize(joined), shapely.normalize(whole), 0).all()


def test_only_what_meets_is_overlaid(monkeypatch: pytest.MonkeyPatch) -> None:
    one = shapely.union_all(nested(40, 1))
    other = shapely.transform(one, lambda xy: xy + [9000, 0])
    overlaid: list[int] = []
    union = shapely.union

    def counted(a: shapely.Geometry, b: shapely.Geometry) -> shapely.Geometry:
        overlaid.append(int(np.sum(shapely.get_num_coordinates([a, b]))))
        return union(a, b)

    monkeypatch.setattr(joining, "LARGE", 0)
    monkeypatch.setattr(shapely, "union", counted)
    joining.joined_pairs(np.array([one], dtype=object), np.array([other], dtype=object))
    whole = 2 * int(shapely.get_num_coordinates(one))
    assert max(overlaid) < whole / 2
