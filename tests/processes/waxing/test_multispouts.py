"""Cantings with several spouts draw at once what lies a pitch apart, and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell
from batik_vector.errors import GeometryError
from batik_vector.processes.options import WaxProcess
from batik_vector.processes.waxing.cantings import drawn_by

PAGE = Artwork("page", Cell(200_000, 200_000), ())


def saved(areas: Sequence[shapely.Geometry], spouts: int, pitch: float = 2.0) -> tuple[float, int]:
    facts = drawn_by(
        PAGE, np.array([*areas, None], dtype=object)[:-1], {"isen": 0.8}, {"isen": (pitch, spouts)}
    )
    (told,) = facts["cantings"]
    assert (told["at_once"]["spouts"], told["at_once"]["pitch_mm"]) == (spouts, pitch)
    return told["at_once"]["metres_saved"], told["at_once"]["dots_saved"]


def lines(*ordinates: float, length: float = 50.0) -> list[shapely.Polygon]:
    return [shapely.LineString([(20, y), (20 + length, y)]).buffer(0.4, quad_segs=32) for y in ordinates]


@pytest.mark.parametrize(
    ("ordinates", "spouts", "metres"),
    [
        ((20, 22), 2, 0.05),
        ((20, 22.15), 2, 0.05),  # The hand gives way.
        ((20, 22, 24), 2, 0.05),
        ((20, 22, 24), 3, 0.1),
        ((20, 22, 24, 26), 2, 0.1),
        ((20, 22, 40, 42), 2, 0.1),
        ((20, 23), 2, 0),
        ((20, 21.4), 2, 0),
        ((20,), 2, 0),
    ],
)
def test_lines_a_pitch_apart_are_drawn_at_once(
    ordinates: tuple[float, ...], spouts: int, metres: float
) -> None:
    metres_saved, dots_saved = saved(lines(*ordinates), spouts)
    # Ends are round, and strips between lines end a little before them.
    assert metres_saved == pytest.approx(metres, rel=0.12, abs=0.001)
    assert dots_saved == 0


def test_rings_about_one_another_are_drawn_at_once_and_a_short_neighbour_saves_its_own_length() -> None:
    rings = [shapely.Point(100, 100).buffer(r, quad_segs=64).exterior.buffer(0.4) for r in (30, 32)]
    assert saved(rings, 2)[0] == pytest.approx(2 * np.pi * 0.031, rel=0.02)
    both = [*lines(20), *lines(22, length=20)]
    assert saved(both, 2)[0] == pytest.approx(0.02, abs=0.001)


def dots(places: list[tuple[float, float]]) -> list[shapely.Polygon]:
    return [shapely.Point(x, y).buffer(0.4) for x, y in places]


@pytest.mark.parametrize(("spouts", "rows"), [(2, 5), (3, 4), (5, 2), (7, 2)])
def test_dots_in_a_row_are_set_at_once(spouts: int, rows: int) -> None:
    places = [(30.0 + 2 * k, 40.0 + k / 8) for k in range(10)]
    assert saved(dots(places), spouts) == (0, 10 - rows)


def test_dots_round_a_corner_or_off_the_pitch_are_not_one_row() -> None:
    corner = [(30.0, 30.0), (32.0, 30.0), (32.0, 32.0), (60.0, 30.0), (63.0, 30.0)]
    assert saved(dots(corner), 3) == (0, 1)
    grid = [(30.0 + 2 * i, 30.0 + 2 * j) for i, j in product(range(10), range(4))]
    assert saved(dots(grid), 2) == (0, 20)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"isan": (2.0, 2)}, 'multi_spouts = unknown canting "isan": did you mean "isen"?'),
        (
            {"isen": (0.8, 2)},
            "multi_spouts = 0.8 mm of isen, from spout to spout, expected more than the 0.8 mm",
        ),
    ],
)
def test_spouts_that_cannot_be_are_refused(asked: dict[str, tuple[float, int]], words: str) -> None:
    with pytest.raises(GeometryError, match=words.replace("?", r"\?")):
        WaxProcess(multi_spouts=asked)
