"""The turtle walks as it is told, symbol by symbol, whichever way its walk is worked out."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from batik_vector.errors import GeometryError
from batik_vector.geometry.lsystems.expansion import expanded
from batik_vector.geometry.lsystems.grammar import grammar_of
from batik_vector.geometry.lsystems.turtle import Gait, Walk, walked

SLOW = [HealthCheck.too_slow]
"""Others may be at work on the machine."""


def walk(axiom: str, gait: Gait, marks: str = "") -> Walk:
    return walked(expanded(grammar_of(axiom, ["X -> X"], "F"), 0), "F", gait, marks)


def step_by_step(word: str, gait: Gait) -> list[tuple[complex, complex]]:
    """Return the steps drawn, as a turtle with a stack walks them."""
    at, way, size = 0j, gait.heading, 1.0
    stack, steps = [], []
    for symbol in word:
        if symbol in "Ff":
            new = at + size * cmath.exp(1j * math.radians(way))
            if symbol == "F":
                steps.append((at, new))
            at = new
        elif symbol in "+-|":
            way += {"+": gait.angle, "-": -gait.angle, "|": 180}[symbol]
        elif symbol == '"':
            size *= gait.shrink
        elif symbol == "[":
            stack.append((at, way, size))
        elif symbol == "]":
            at, way, size = stack.pop()
    return steps


def balanced(word: str) -> str:
    out, depth = "", 0
    for symbol in word:
        if symbol == "]" and not depth:
            continue
        depth += (symbol == "[") - (symbol == "]")
        out += symbol
    return out + "]" * depth + "F"


@settings(max_examples=80, deadline=None, derandomize=True, suppress_health_check=SLOW)
@given(st.text(alphabet='FFFf+-|[]"', max_size=40).map(balanced), st.sampled_from([90.0, 60.0, 25.7, 0.0]))
def test_the_steps_are_those_of_a_turtle_with_a_stack(word: str, angle: float) -> None:
    gait = Gait(angle, 30, 0.8, 0.9)
    found = walk(word, gait)
    starts = np.ones(len(found.points), bool)
    starts[found.offsets[1:] - 1] = False
    begin = np.flatnonzero(starts)
    steps = np.column_stack([found.points[begin], found.points[begin + 1]])
    expected = np.array(step_by_step(word, gait))
    key = np.lexsort(np.round(np.column_stack([steps.real, steps.imag]), 6).T)
    other = np.lexsort(np.round(np.column_stack([expected.real, expected.imag]), 6).T)
    assert steps[key] == pytest.approx(expected[other], abs=1e-9)


def test_strokes_narrow_along_their_length_and_at_branches() -> None:
    found = walk("FF[+FF]FF", Gait(90, taper=0.5))
    stem, branch = np.split(found.widths, found.offsets[1:-1])
    assert stem == pytest.approx([1, 0.875, 0.75, 0.625, 0.5])
    assert branch == pytest.approx([0.375, 0.28125, 0.1875])
    assert walk("F!F", Gait(90, taper=0.5)).widths[-1] == pytest.approx(0.25)


def test_marks_have_the_pose_of_the_turtle() -> None:
    at, way, size = walk('F+"FX', Gait(90, shrink=0.5), "X").marks["X"]
    assert at == pytest.approx([1 + 0.5j])
    assert way == pytest.approx([1j])
    assert size == pytest.approx([0.5])


@pytest.mark.parametrize("word", ["f", "+", "[f]X"])
def test_a_turtle_that_draws_nothing_is_told(word: str) -> None:
    with pytest.raises(GeometryError, match="draws nothing at this level"):
        walk(word, Gait(90))


def test_branches_too_deep_and_factors_of_nothing_are_refused() -> None:
    with pytest.raises(GeometryError, match="nested 3,000 deep"):
        walk("[" * 3000 + "F" + "]" * 3000, Gait(90))
    with pytest.raises(GeometryError, match='factor of 0 at """'):
        walk('F"(0)F', Gait(90))
