from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.errors import ExportError
from batik_vector.export.numbers import (
    LIMIT_STEPS,
    NARROW_STEPS,
    WORD,
    Style,
    beside,
    digit_words,
    digits,
    headed,
    put,
    text,
    word,
)


def spelled(steps: list[int], style: Style) -> list[str]:
    numbers = np.array(steps, np.int64)
    size = digit_words(numbers)
    rows = np.zeros((len(numbers), 2 + size), WORD)
    assert put(rows, 0, numbers, style, size, word("\n")) == 1 + size
    return text(rows).decode("ascii").split("\n")[1:]


def plain(k: int) -> str:
    """Python's own spelling."""
    sign, k = "-" if k < 0 else "", abs(k)
    return f"{sign}{k // 1000}.{k % 1000:03d}".rstrip("0").rstrip(".")


near = st.integers(-NARROW_STEPS + 1, NARROW_STEPS - 1)
far = st.integers(-LIMIT_STEPS + 1, LIMIT_STEPS - 1)
edges = st.sampled_from(
    [0, 1, -1, 999, 1000, -1000, NARROW_STEPS - 1, NARROW_STEPS, 10**8, -(10**8) + 1, LIMIT_STEPS - 1]
)


@given(st.lists(near | edges, min_size=1) | st.lists(far | edges, min_size=1))
def test_numbers_are_spelled_as_python_spells_them(steps: list[int]) -> None:
    assert spelled(steps, Style.SHORT) == [plain(k) for k in steps]
    assert spelled(steps, Style.REAL) == [p if "." in (p := plain(k)) else f"{p}.0" for k in steps]
    assert spelled(steps, Style.STEPS) == [f"{k} " for k in steps]


@given(st.lists(near, min_size=1))
def test_the_text_reads_back_as_the_same_grid_point(steps: list[int]) -> None:
    assert [float(s) for s in spelled(steps, Style.SHORT)] == [k / 1000 for k in steps]


def test_every_thousandth_of_the_tables() -> None:
    steps = [*range(-2000, 2000), *range(NARROW_STEPS - 3000, NARROW_STEPS + 3000)]
    assert spelled(steps, Style.SHORT) == [plain(k) for k in steps]
    assert spelled(steps[:4000], Style.SHORT) == [plain(k) for k in steps[:4000]]


@pytest.mark.parametrize("step", [LIMIT_STEPS, -LIMIT_STEPS, 2**62])
def test_out_of_range_is_refused(step: int) -> None:
    with pytest.raises(ExportError, match="beyond"):
        digit_words(np.array([0, step]))


def test_leads_may_differ_and_stand_before_the_sign() -> None:
    rows = np.zeros((2, 3), WORD)
    put(rows, 0, np.array([-1500, 20]), Style.SHORT, 2, np.array([word("ZM"), word(" ")]))
    assert text(rows) == b"ZM-1.5 0.02"


@given(st.lists(st.integers(0, 2**31 - 1), min_size=1))
def test_digits(values: list[int]) -> None:
    assert text(beside(len(values), digits(np.array(values), 16), b" ")).split() == [
        b"%X" % v for v in values
    ]
    assert text(beside(len(values), digits(np.array(values), 10, 10), b" ")).split() == [
        b"%d" % v for v in values
    ]


@given(st.lists(st.integers(0, 5), min_size=1, max_size=6), st.integers(1, 40))
def test_heads_stand_before_their_rows(counts: list[int], breadth: int) -> None:
    offsets = np.r_[0, np.cumsum(counts)].astype(np.int64)
    heads = beside(len(counts), b"<" + b"h" * breadth, digits(np.arange(len(counts))), b">")
    rows = beside(int(offsets[-1]), b"row", digits(np.arange(offsets[-1])), b",").view(WORD)
    expected = "".join(
        f"<{'h' * breadth}{i}>" + "".join(f"row{k}," for k in range(offsets[i], offsets[i + 1]))
        for i in range(len(counts))
    )
    assert headed(heads, rows, offsets).decode() == expected
