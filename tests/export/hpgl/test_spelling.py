from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.export.hpgl.spelling import Trail, encoded, plain, trail

from .plotter import Drawn, Place, Plotter

near = st.integers(-40, 40)
far = st.integers(-(10**8), 10**8)
strokes = st.one_of(
    *(
        st.lists(st.lists(st.tuples(x, x), min_size=1, max_size=7), max_size=7)
        for x in (near, far, st.integers(0, 3))
    )
)


def arrays(
    parts: list[list[Place]],
) -> tuple[np.ndarray[tuple[int, int], np.dtype[np.int64]], np.ndarray[tuple[int], np.dtype[np.int64]]]:
    points = np.array([place for part in parts for place in part], np.int64).reshape(-1, 2)
    return points, np.concatenate([[0], np.cumsum([len(part) for part in parts])]).astype(np.int64)


def segments(parts: list[list[Place]]) -> list[tuple[Place, Place]]:
    return [(a, b) for part in parts for a, b in itertools.pairwise(part) if a != b]


def drawn(made: Trail, how: str, most: int, at: Place | None) -> Drawn:
    plotter = Plotter()
    plotter.pen = 1
    if at is not None:
        plotter.at, plotter.down = at, True
    return plotter.take(plain(made, most) if how == "plain" else encoded(made))


@given(
    strokes, st.sampled_from(["plain", "encoded"]), st.integers(1, 9), st.sampled_from([None, (0, 0), (1, 1)])
)
def test_what_is_spelled_is_drawn_segment_by_segment(
    parts: list[list[Place]], how: str, most: int, at: Place | None
) -> None:
    made = trail(*arrays(parts), at)
    paper = drawn(made, how, most, at)
    assert segments([places for _, places in paper.strokes]) == segments(parts)


@given(strokes)
def test_the_pen_is_lifted_only_where_the_next_stroke_begins_elsewhere(parts: list[list[Place]]) -> None:
    made = trail(*arrays(parts), None)
    lines = segments(parts)
    gaps = sum(a[1] != b[0] for a, b in itertools.pairwise(lines)) + bool(lines)
    assert drawn(made, "plain", 100, None).ups == len(made) == gaps


def test_a_pd_holds_no_more_points_than_the_machine_takes() -> None:
    made = trail(*arrays([[(x, x * x) for x in range(8)]]), None)
    assert plain(made, 3) == b"PU0,0;PD1,1,2,4,3,9;PD4,16,5,25,6,36;PD7,49;\n"


def test_nothing_is_spelled_as_nothing() -> None:
    made = trail(*arrays([[(3, 3)], [(4, 4), (4, 4)]]), None)
    assert plain(made, 9) == encoded(made) == b""


@pytest.mark.parametrize(
    ("number", "spelled"), [(0, "_"), (1, "a"), (-1, "b"), (15, "}"), (16, "?`"), (-16, "@`"), (500, "G~")]
)
def test_numbers_of_pe_are_those_of_the_book(number: int, spelled: str) -> None:
    made = trail(*arrays([[(0, 0), (number, 1)]]), None)
    assert encoded(made) == b"PE7<=__" + spelled.encode() + b"a;\n"
