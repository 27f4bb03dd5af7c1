"""Networks of cracks: every junction is a T, pieces are as large as asked, and breadths follow the model."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.ops import substring

from batik_vector.artwork import Cell
from batik_vector.processes.handwork.crackling import bodies
from batik_vector.processes.handwork.network import Network, grown, widths
from batik_vector.processes.handwork.options import CrackleProcess
from tests.thorough import examples, long

CELLS = (
    Cell(60_000, 60_000),
    Cell(80_000, 50_000, Fraction(1, 2)),
    Cell(31_000, 90_000, Fraction(1, 3)),
)


def reduced(points: np.ndarray[tuple[int, int], np.dtype[np.int64]], cell: Cell) -> list[tuple[int, int]]:
    """Return where points lie on the torus, as whole numbers that tell places apart."""
    (ax, ay), (bx, by) = cell.lattice
    assert bx == 0
    turns = points[:, 0] // ax
    return list(
        zip((points[:, 0] - turns * ax).tolist(), ((points[:, 1] - turns * ay) % by).tolist(), strict=True)
    )


def degrees(network: Network, cell: Cell) -> dict[tuple[int, int], int]:
    """Return how many ways lead off from each place where a crack begins or ends."""
    found = dict[tuple[int, int], int]()
    lines = [
        reduced(network.points[a:b], cell)
        for a, b in zip(network.offsets[:-1].tolist(), network.offsets[1:].tolist(), strict=True)
    ]
    # The first closes round the torus, and goes on over itself for a bit.
    first = list(dict.fromkeys(lines[0]))
    for line in lines[1:]:
        for end in (line[0], line[-1]):
            found[end] = found.get(end, 0) + 1
    for number, line in enumerate([first, *lines[1:]]):
        for place in line if number == 0 else line[1:-1]:
            if place in found:
                found[place] += 2
    return found


@pytest.mark.parametrize("cell", CELLS, ids=str)
@pytest.mark.parametrize("direction", [None, 30.0])
def test_every_junction_is_a_t(cell: Cell, direction: float | None) -> None:
    network = grown(cell, 6000, 5, direction, 0.6)
    found = degrees(network, cell)
    assert len(found) == 2 * (len(network) - 1)
    assert set(found.values()) == {3}


@pytest.mark.parametrize(("seed", "size"), [(1725604709, 3825.473902421349), (1092787732, 5563.853399638055)])
def test_no_two_cracks_end_in_one_place(seed: int, size: float) -> None:
    # As they are drawn by chance two of them do, from either side of a third.
    cell = Cell(30_000, 30_000)
    assert set(degrees(grown(cell, size, seed), cell).values()) == {3}


@long
@settings(max_examples=examples(2, 12), deadline=None)
@given(seed=st.integers(0, 2**31 - 1), size=st.floats(3500, 8000))
def test_there_are_as_many_pieces_as_asked_and_all_junctions_are_ts(seed: int, size: float) -> None:
    cell = Cell(30_000, 30_000)
    network = grown(cell, size, seed)
    assert set(degrees(network, cell).values()) == {3}
    lines = np.array(
        [
            shapely.LineString(network.points[a:b])
            for a, b in zip(network.offsets[:-1], network.offsets[1:], strict=True)
        ]
    )
    turns = range(-3, 4)
    around = [
        shapely.affinity.translate(each, 30_000 * i, 30_000 * j)
        for each in lines
        for i in turns
        for j in turns
    ]
    near = np.array(around)
    near = near[shapely.intersects(near, shapely.box(-20_000, -20_000, 50_000, 50_000))]
    pieces = shapely.get_parts(shapely.polygonize([shapely.union_all(near, grid_size=1)]))
    middles = shapely.get_coordinates(shapely.centroid(pieces))
    whole = pieces[((middles >= 0) & (middles < 30_000)).all(axis=1)]
    mean = np.sqrt(shapely.area(whole).mean())
    assert len(whole) == pytest.approx(network.pieces, rel=0.01)
    assert mean == pytest.approx(size, rel=0.05)


def test_breadths_as_drawn_follow_the_model() -> None:
    cell, spec = Cell(200_000, 200_000), CrackleProcess(density=10, width=(0.2, 0.8), seed=9)
    network = grown(cell, 10_000, 9)
    drawn = bodies(network, cell, spec)
    # Bodies stand in the order of their cracks, as none is put together of pieces.
    assert len(drawn) == len(network)
    middles = [
        substring(shapely.LineString(network.points[a:b]), 0.2, 0.8, normalized=True)
        for a, b in zip(network.offsets[:-1], network.offsets[1:], strict=True)
    ]
    around = shapely.buffer(middles, 1000, cap_style="flat")
    breadth = np.sort(shapely.area(shapely.intersection(drawn, around)) / shapely.length(middles)) / 1000
    share = np.sqrt(np.clip((breadth - 0.2) / 0.6, 0, 1))
    place = np.arange(len(breadth) + 1) / len(breadth)
    apart = max(np.abs(share - place[:-1]).max(), np.abs(share - place[1:]).max())
    # Kolmogorov and Smirnov: the 1 % quantile of the distance of a sample from what it is drawn of.
    assert apart < 1.63 / np.sqrt(len(breadth))


def test_older_cracks_are_broader() -> None:
    network = grown(CELLS[0], 6000, 1)
    broad = widths(network.age, 0.1, 0.6)
    assert (np.diff(broad) < 0).all()
    assert 0.1 < broad[-1] < 0.105
    assert 0.59 < broad[0] < 0.6


def test_a_direction_is_followed() -> None:
    along = {}
    for direction in (0.0, 90.0):
        network = grown(CELLS[0], 4000, 2, direction, 1.0)
        way = np.abs(np.diff(network.points, axis=0)).astype(float)
        way = way[way.sum(axis=1) < 3000]
        along[direction] = way[:, 0].sum() / way[:, 1].sum()
    assert along[0.0] > 1.5
    assert along[90.0] < 1 / 1.5


def test_the_same_seed_gives_the_same_cracks_and_another_others() -> None:
    one, again, other = (grown(CELLS[0], 6000, seed) for seed in (1, 1, 2))
    assert one.points.tobytes() == again.points.tobytes()
    assert one.points.tobytes() != other.points.tobytes()
