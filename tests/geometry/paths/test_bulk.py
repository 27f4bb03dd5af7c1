"""Long path data, read in bulk, are the outline that they are read to piece by piece."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.paths import bulk, data
from batik_vector.geometry.paths.pen import drawn

NUMBERS = st.one_of(
    st.integers(-999, 999).map(str),
    st.floats(-1e4, 1e4).map(lambda number: f"{number:.3f}"),
    st.floats(-1e4, 1e4).map(repr),
    st.sampled_from(["-.5", ".5", "1.", "+3", "1e2", "1E-2", "-1.5e+1", "0"]),
)
COMMANDS = st.tuples(
    st.sampled_from("LlHhVvCcSsQqTtMmZz"), st.integers(1, 3), st.randoms(use_true_random=False)
)


@st.composite
def texts(draw: st.DrawFn) -> str:
    """Return path data, numbers glued where SVG lets them be."""
    parts = ["M1 2"]
    for letter, times, dice in draw(st.lists(COMMANDS, min_size=1, max_size=30)):
        takes = data._TAKES[letter]
        text = letter
        for _ in range(takes * times):
            number = draw(NUMBERS)
            glued = number[0] in "+-" or (
                number[0] == "." and "." in text.rpartition(" ")[2].rpartition("-")[2]
            )
            text += number if glued and dice.random() < 0.5 else dice.choice([" ", ",", " , "]) + number
        parts.append(text)
    return "".join(parts)


@settings(max_examples=60, deadline=None)
@given(texts())
def test_bulk_reads_what_piece_by_piece_is_read(text: str) -> None:
    mine = bulk.commands_of(text + " " * bulk.LONG_TEXT)
    assert mine is not None
    one, other = drawn(mine), drawn(data._commands(text))
    assert np.array_equal(one.points, other.points)
    assert np.array_equal(one.kinds, other.kinds)
    assert np.array_equal(one.closed, other.closed)


ODD = [
    "M0 0L1",
    "L0 0",
    "M0 0Z1",
    "M0 0x",
    "M0 0La",
    "M1_0 0",
    "M0 0A1 1 0 011 1",
    "1M0 0",
    "M0 0L1..5 2",
    "M0 0Lé",
]


@pytest.mark.parametrize("text", ODD)
def test_what_is_not_sound_is_left_to_others(text: str) -> None:
    found = bulk.commands_of(text + " " * bulk.LONG_TEXT)
    assert found is None or found[0][0] != "M"
