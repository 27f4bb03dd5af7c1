"""Arrangements fill their rectangle, tell what covers each face, and are alike on both sides of a seam."""

from __future__ import annotations

import math
from random import Random
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity

from batik_vector.errors import TooLargeError
from batik_vector.geometry.arrangement import Arrangement, arranged, faces, noding
from batik_vector.geometry.arrangement.chaining import chained
from batik_vector.geometry.arrangement.noding import edges_of, noded
from batik_vector.geometry.outlines import Steps
from batik_vector.geometry.sampling import Geometries
from tests.thorough import examples, long

W, H = 9000, 7000
BOX = (0, 0, W, H)


def star(chance: Random) -> shapely.Polygon:
    """Return a simple polygon about a middle anywhere near, on whole steps."""
    count = chance.randint(3, 40)
    angles = sorted(chance.uniform(0, math.tau) for _ in range(count))
    x, y, far = chance.randint(0, W), chance.randint(0, H), chance.randint(2, 4000)
    radii = [far * chance.uniform(0.3, 1) for _ in angles]
    points = [(x + r * math.cos(a), y + r * math.sin(a)) for a, r in zip(angles, radii, strict=True)]
    return shapely.Polygon(np.rint(points))


def layer(chance: Random, count: int) -> Geometries:
    found = [star(chance) for _ in range(count)]
    good = [each for each in found if each.is_valid and each.area > 0]
    return np.asarray(shapely.orient_polygons(np.array(good, dtype=object)), dtype=object)


def around(areas: Geometries, right: int = W, up: int = H) -> Geometries:
    """Return areas with their repeats on a lattice."""
    moves = [(i * right, j * up) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return np.array([affinity.translate(each, *move) for move in moves for each in areas], dtype=object)


@long
@settings(max_examples=examples(10, 120), deadline=None, derandomize=True)
@given(st.integers(0, 10**6))
def test_faces_fill_the_box_and_layers_are_as_they_were(seed: int) -> None:
    chance = Random(seed)
    layers = [layer(chance, chance.randint(0, 5)) for _ in range(3)]
    found = arranged(layers, BOX)
    assert shapely.area(found.faces).sum() == W * H
    assert shapely.is_valid(found.faces).all()
    assert shapely.coverage_is_valid(found.faces)
    coords = shapely.get_coordinates(found.faces)
    assert (coords == np.rint(coords)).all()
    box = shapely.box(*BOX)
    for areas, covered in zip(layers, found.covered, strict=True):
        wanted = shapely.intersection(shapely.union_all(areas), box)
        region = found.region(covered)
        assert shapely.is_valid(region).all()
        off = shapely.symmetric_difference(wanted, shapely.union_all(region))
        # Each edge may have moved by the rounding of the crossings on it.
        edges = float(shapely.length(wanted)) + sum(
            float(shapely.length(shapely.union_all(each))) for each in layers
        )
        assert off.area <= edges


@long
@settings(max_examples=examples(8, 60), deadline=None, derandomize=True)
@given(st.integers(0, 10**6))
def test_both_sides_of_a_seam_are_alike(seed: int) -> None:
    chance = Random(seed)
    layers = [around(layer(chance, 3)) for _ in range(2)]
    found = arranged(layers, BOX)
    for axis, far in ((0, W), (1, H)):
        assert stretches(found, axis, 0) == stretches(found, axis, far)


def stretches(found: Arrangement, axis: int, value: int) -> dict[tuple[int, int], tuple[bool, ...]]:
    """Return the edges of faces along a side of the box, and which layers cover each."""
    told = {}
    for number, face in enumerate(found.faces):
        for ring in (face.exterior, *face.interiors):
            xy = np.asarray(ring.coords)
            on = (xy[:-1, axis] == value) & (xy[1:, axis] == value)
            for one, other in zip(xy[:-1][on], xy[1:][on], strict=True):
                low, high = sorted((int(one[1 - axis]), int(other[1 - axis])))
                told[low, high] = tuple(found.covered[:, number].tolist())
    return told


def test_a_corner_off_an_edge_by_rounding_lies_on_it() -> None:
    # The crossing of a slanted edge is between the points of the grid: the neighbour's corner is beside it.
    left = shapely.Polygon([(0, 0), (100, 0), (137, 1000), (0, 1000)])
    right = shapely.Polygon([(100, 0), (1000, 0), (1000, 1000), (137, 1000), (119, 500)])
    found = arranged([np.array([left], object), np.array([right], object)], (0, 0, 1000, 1000))
    assert len(found.faces) == 2


def test_a_hole_and_an_island_in_it_are_faces_of_their_own() -> None:
    ring = shapely.Polygon(shapely.box(10, 10, 90, 90).exterior, [shapely.box(30, 30, 70, 70).exterior])
    areas = shapely.orient_polygons(np.array([ring, shapely.box(45, 45, 55, 55)], object))
    found = arranged([np.asarray(areas, object)], (0, 0, 100, 100))
    assert sorted(zip(shapely.area(found.faces).tolist(), found.covered[0].tolist(), strict=True)) == [
        (100, True),
        (1500, False),
        (3600, False),
        (4800, True),
    ]


def test_faces_come_in_one_order_whatever_the_order_of_areas() -> None:
    areas = layer(Random(5), 6)
    one, other = arranged([areas], BOX), arranged([areas[::-1]], BOX)
    assert shapely.to_wkb(one.faces).tolist() == shapely.to_wkb(other.faces).tolist()


@long
@settings(max_examples=examples(10, 120), deadline=None, derandomize=True)
@given(st.integers(0, 10**6))
def test_lines_are_chained_from_fork_to_fork(seed: int) -> None:
    chance = Random(seed)
    ends = noded(edges_of([layer(chance, chance.randint(0, 5))]), BOX).ends
    lines = chained(ends)
    coords, line = shapely.get_coordinates(lines, return_index=True)
    points = coords.astype(int)
    same = line[1:] == line[:-1]
    made = np.hstack([points[:-1][same], points[1:][same]])
    assert sorted(map(sorted, made.reshape(-1, 2, 2).tolist())) == sorted(
        map(sorted, ends.reshape(-1, 2, 2).tolist())
    )
    places, meet = np.unique(ends.reshape(-1, 2), axis=0, return_counts=True)
    forks = set(map(tuple, places[meet != 2].tolist()))
    for each in lines:
        first, *inner, last = ((int(x), int(y)) for x, y in each.coords)
        assert (first == last) or {first, last} <= forks
        assert not forks & set(inner)


def test_edges_are_compared_with_those_alone_that_are_new(monkeypatch: pytest.MonkeyPatch) -> None:
    """What was compared in one round is not in the next."""
    rounds = []
    compared = noding._compared

    def counted(a: Steps, b: Steps, *rest: Any) -> Any:
        rounds.append(len(a))
        return compared(a, b, *rest)

    monkeypatch.setattr(noding, "_compared", counted)
    arranged([layer(Random(8), 40)], BOX)
    assert len(rounds) > 2
    assert rounds[-1] < rounds[0] / 5


def test_too_many_edges_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(faces, "MOST", 10)
    with pytest.raises(TooLargeError, match=r"edges, expected at most 10: take the tile, or less cloth"):
        arranged([layer(Random(5), 6)], BOX)
