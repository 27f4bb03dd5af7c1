"""Decimals read all at once are those that Python reads one by one, to the bit, or are left to it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.paths.data import LONG, parse_path
from batik_vector.geometry.paths.decimals import decimals_in
from batik_vector.patterns import numbers_in


def bits(numbers: list[float]) -> list[str]:
    return [number.hex() for number in numbers]


written = st.builds(
    lambda sign, whole, rest, gap: (sign + whole + rest, gap),
    st.sampled_from(["", "-"]),
    st.from_regex(r"\A[0-9]{1,9}\Z"),
    st.from_regex(r"\A(\.[0-9]{0,6})?\Z"),
    st.sampled_from([" ", ",", ", ", "\n\t"]),
)


@settings(derandomize=True, max_examples=200, deadline=None)
@given(st.lists(written, min_size=1, max_size=30))
def test_decimals_are_those_that_python_reads(pairs: list[tuple[str, str]]) -> None:
    found = decimals_in("".join(number + gap for number, gap in pairs))
    assert found is not None
    assert bits(found) == bits([float(number) for number, _ in pairs])


@settings(derandomize=True, max_examples=500, deadline=None)
@given(st.text("0123456789..-, \n", max_size=24))
def test_whatever_is_read_at_once_is_read_alike_one_by_one(text: str) -> None:
    found = decimals_in(text)
    if found is not None:
        one_by_one = numbers_in(text)
        assert one_by_one is not None
        assert bits(found) == bits(one_by_one)


@pytest.mark.parametrize(
    "text", ["", " , ", ".", "-", "1 .", "1--2", "1- 2", "1.5.5", "12345678901234567890"]
)
def test_what_is_broken_or_too_long_is_left_to_others(text: str) -> None:
    assert decimals_in(text) is None


def test_a_number_with_more_places_than_a_float_has_powers_is_left_to_others() -> None:
    assert decimals_in("0." + "0" * 22 + "1") is None
    assert decimals_in("0." + "0" * 21 + "1") == [1e-22]


@pytest.mark.parametrize("last", ["7.25 -3", "7.25-3", "7.25e0 -3", "7.25,-3.", "+7.25 -3"])
def test_long_path_data_draw_what_short_ones_do(last: str) -> None:
    many = " ".join(f"{number / 7:.3f}" for number in range(LONG // 5))
    assert len(many) > LONG
    drawn = parse_path(f"M0 0L{many} {last}").points
    assert drawn[-1].tolist() == [7.25, -3.0]
    assert math.isclose(drawn[7, 0], 12 / 7, abs_tol=1e-3)


def test_a_broken_number_in_long_path_data_is_refused() -> None:
    with pytest.raises(ValueError, match="cannot be read"):
        parse_path("M0 0L" + "1.25 " * LONG + "1 - 2")
