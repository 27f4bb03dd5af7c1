from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.errors import ExportError
from batik_vector.export.numbers import (
    LIMIT_STEPS,
    WORD,
    Reach,
    Room,
    Style,
    beside,
    check_range,
    digits,
    hexadecimals,
    lead,
    room_for,
    spelling,
    text,
)

NEAR, MIDDLE = 10**6, 10**7


def spelled(steps: list[int], style: Style, before: str = "", width: int = 1) -> list[str]:
    """Numbers as they are written in columns of rows, behind a word of their own."""
    numbers = np.array(steps, np.int64)
    chosen = spelling(numbers, style, before)
    rows = np.zeros((len(numbers), width + chosen.words), WORD)
    rows[:, 0] = ord("\n")
    assert chosen.put(rows, width, numbers) == width + chosen.words
    return text(rows).decode("ascii").split("\n")[1:]


def plain(k: int) -> str:
    """Python's own spelling."""
    sign, k = "-" if k < 0 else "", abs(k)
    return f"{sign}{k // 1000}.{k % 1000:03d}".rstrip("0").rstrip(".")


near = st.integers(0, NEAR - 1)
middle = st.integers(-NEAR + 1, MIDDLE - 1)
far = st.integers(-LIMIT_STEPS + 1, LIMIT_STEPS - 1)
edges = st.sampled_from(
    [0, 1, -1, 999, 1000, -999, -1000, NEAR - 1, NEAR, -NEAR + 1, -NEAR, MIDDLE - 1, MIDDLE, -MIDDLE]
    + [10**8, -(10**8) + 1, LIMIT_STEPS - 1, 1 - LIMIT_STEPS]
)
lists = [st.lists(kind, min_size=1) for kind in (near, middle, far | edges)]


@given(st.one_of(lists), st.sampled_from(["", " ", "M"]))
def test_numbers_are_spelled_as_python_spells_them(steps: list[int], before: str) -> None:
    points = [p if "." in (p := plain(k)) else f"{p}.0" for k in steps]
    assert spelled(steps, Style.SHORT, before) == [before + plain(k) for k in steps]
    assert spelled(steps, Style.REAL, before) == [before + point for point in points]
    assert spelled(steps, Style.STEPS, before) == [f"{before}{k} " for k in steps]


@given(st.lists(middle, min_size=1))
def test_the_text_reads_back_as_the_same_grid_point(steps: list[int]) -> None:
    assert [float(s) for s in spelled(steps, Style.SHORT)] == [k / 1000 for k in steps]


@pytest.mark.parametrize("before", ["", " "])
@pytest.mark.parametrize(
    "steps", [range(NEAR), range(1 - NEAR, NEAR, 7), range(MIDDLE - 3000, MIDDLE + 3000)]
)
def test_every_number_of_the_tables(steps: range, before: str) -> None:
    assert spelled(list(steps), Style.SHORT, before) == [before + plain(k) for k in steps]


@pytest.mark.parametrize(
    ("steps", "before", "reach", "words"),
    [
        ([0, NEAR - 1], " ", Reach.NEAR, 2),
        ([0, NEAR], " ", Reach.MIDDLE, 3),
        ([0, MIDDLE - 1], "", Reach.NEAR, 2),
        ([-1, NEAR - 1], " ", Reach.MIDDLE, 3),
        ([1 - NEAR, MIDDLE - 1], "", Reach.MIDDLE, 2),
        ([-NEAR], "", Reach.FAR, 4),
        ([MIDDLE], " ", Reach.FAR, 4),
        ([], " ", Reach.NEAR, 2),
    ],
)
def test_a_block_takes_the_fewest_words(steps: list[int], before: str, reach: Reach, words: int) -> None:
    chosen = spelling(np.array(steps, np.int64), Style.SHORT, before)
    assert (chosen.reach, chosen.words) == (reach, words)


@pytest.mark.parametrize("step", [LIMIT_STEPS, -LIMIT_STEPS, 2**62])
def test_out_of_range_is_refused(step: int) -> None:
    for refuse in (check_range, lambda steps: spelling(steps, Style.SHORT)):
        with pytest.raises(ExportError, match="beyond"):
            refuse(np.array([0, step]))


@pytest.mark.parametrize("most", [20, NEAR, MIDDLE])
def test_leads_may_differ_and_stand_before_the_sign(most: int) -> None:
    numbers = np.array([-1500, 20, 7, most])
    for steps in (numbers, np.abs(numbers)):
        chosen = spelling(steps, Style.SHORT, " ")
        rows = np.zeros((4, chosen.words), WORD)
        chosen.put(rows, 0, steps)
        lead(rows, np.array([0]), "M")
        lead(rows, np.array([2]), "")
        expected = f"M{plain(int(steps[0]))} 0.02{plain(7)} {plain(most)}"
        assert text(rows).decode() == expected


@given(st.lists(st.integers(0, 10**12 - 1) | st.integers(0, 10**5), min_size=1))
def test_digits(values: list[int]) -> None:
    assert text(beside(len(values), digits(np.array(values)), b" ")).split() == [b"%d" % v for v in values]


@given(st.lists(st.integers(0, 16**6 - 1), min_size=1))
def test_hexadecimals(values: list[int]) -> None:
    written = text(beside(len(values), hexadecimals(np.array(values)), b" "))
    assert written.split() == [b"%06X" % v for v in values]


@given(st.lists(st.integers(1, 5), min_size=1, max_size=6), st.integers(1, 40), st.data())
def test_heads_stand_before_their_runs(counts: list[int], breadth: int, data: st.DataObject) -> None:
    offsets = np.r_[0, np.cumsum(counts)].astype(np.int64)
    headed = np.array(data.draw(st.lists(st.booleans(), min_size=len(counts), max_size=len(counts))))
    heads = beside(len(counts), b"<" + b"h" * breadth, digits(np.arange(len(counts))), b">")
    points = beside(int(offsets[-1]), b"row", digits(np.arange(offsets[-1])), b",").view(WORD)
    room = headed * room_for(heads.shape[1], points.shape[1])
    layout = Room(offsets, room)
    rows = points[layout.source]
    layout.put(rows, np.flatnonzero(headed), heads[headed])
    expected = "".join(
        (f"<{'h' * breadth}{i}>" if headed[i] else "")
        + "".join(f"row{k}," for k in range(offsets[i], offsets[i + 1]))
        for i in range(len(counts))
    )
    assert text(rows).decode() == expected
    assert (layout.source[layout.first] == offsets[:-1]).all()
    assert (layout.source[layout.last] == offsets[1:] - 1).all()
    assert (layout.source[layout.row_of(np.arange(offsets[-1]))] == np.arange(offsets[-1])).all()
