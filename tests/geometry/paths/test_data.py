"""Path data: every way of spelling them draws the same."""

from __future__ import annotations

import contextlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.paths.data import parse_path
from batik_vector.patterns import numbers_in

numbers = st.integers(-500, 500).map(lambda n: n / 8)
steps = st.lists(
    st.tuples(st.sampled_from("LHVCSQTA"), st.lists(numbers, min_size=7, max_size=7)), max_size=8
)
TAKES = {"L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7}


@settings(derandomize=True, max_examples=60, deadline=None)
@given(steps)
def test_relative_path_data_draw_the_same(path: list[tuple[str, list[float]]]) -> None:
    at = np.array([3.0, 5.0])
    absolute, relative = "M3 5", "m 3,5"
    for letter, values in [*path, ("L", [1.0, 2.0])]:
        taken = np.array(values[: TAKES[letter]])
        if letter == "A":
            taken[:2] = np.abs(taken[:2]) + 0.1
            taken[3:5] = taken[3:5] > 0
        moved = taken.copy()
        if letter in "HV":
            moved += at[int(letter == "V")]
            at = np.where([letter == "H", letter == "V"], moved, at)
        else:
            ends = slice(5, 7) if letter == "A" else slice(None)
            moved[ends] += np.tile(at, len(moved[ends]) // 2)
            at = moved[-2:]
        absolute += letter + spelled(moved, letter)
        relative += letter.lower() + spelled(taken, letter)
    one, other = parse_path(absolute), parse_path(relative)
    assert (one.kinds == other.kinds).all()
    assert one.points == pytest.approx(other.points, abs=1e-6)


def spelled(values: np.ndarray, letter: str) -> str:
    """Write numbers as tightly as SVG allows."""
    words = [f"{value:g}" for value in values.tolist()]
    if letter == "A":
        return " ".join([*words[:3], words[3] + words[4] + words[5], words[6]])
    return "".join(word if i == 0 or word[0] == "-" else " " + word for i, word in enumerate(words))


@settings(derandomize=True, max_examples=150, deadline=None)
@given(st.text("MmLlHhVvCcSsQqTtAaZz0123456789.,- e+x", max_size=40))
def test_no_path_data_is_more_than_refused(text: str) -> None:
    with contextlib.suppress(ValueError):
        outline = parse_path(text)
        assert len(outline.points) == len(outline.kinds)


pieces = st.sampled_from(["1", "-2.5", ".5", "1.", "+3", "1e2", "1E-2", "-1.5e+1", "-", "e", "1_0", "inf"])


@settings(derandomize=True, max_examples=300, deadline=None)
@given(st.lists(st.tuples(pieces, st.sampled_from(["", " ", ",", " , ", "\n"])), min_size=1, max_size=6))
def test_numbers_are_read_as_lists_of_them_are_however_they_are_parted(parts: list[tuple[str, str]]) -> None:
    text = "".join(map("".join, parts))
    read = numbers_in(text)
    path = f"M0 0h{text}"
    if read:
        assert parse_path(path).points[1:, 0].tolist() == np.cumsum(read).tolist()
    else:
        with pytest.raises(ValueError, match="path"):
            parse_path(path)
