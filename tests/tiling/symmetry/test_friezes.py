"""The seven frieze groups: groups, all seven, under every name they go by."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import UnknownNameError
from batik_vector.tiling.symmetry.friezes import FRIEZES, IDENTITY, Step, composed, frieze, orbit

quick = settings(max_examples=40, deadline=None, derandomize=True)


def test_there_are_seven_and_no_two_are_the_same() -> None:
    groups = {frozenset(row.steps()) for row in FRIEZES.values()}
    assert len(FRIEZES) == len(groups) == 7


@pytest.mark.parametrize("name", FRIEZES)
def test_the_operations_are_a_group(name: str) -> None:
    steps = FRIEZES[name].steps()
    assert steps[0] == IDENTITY
    assert len(set(steps)) == len(steps)
    for last, first in product(steps, steps):
        assert composed(last, first) in steps
    for step in steps:
        assert any(composed(step, other) == IDENTITY == composed(other, step) for other in steps)


HAS: dict[str, Callable[[Step], bool]] = {
    "glide or mirror along the band": lambda step: step[:2] == (1, -1),
    "mirror along the band": lambda step: step == (1, -1, Fraction(0)),
    "upright mirror": lambda step: step[:2] == (-1, 1),
    "half turn": lambda step: step[:2] == (-1, -1),
}


@pytest.mark.parametrize(
    ("name", "order", "has"),
    [
        ("p1", 1, ()),
        ("p11g", 2, ("glide or mirror along the band",)),
        ("p11m", 2, ("glide or mirror along the band", "mirror along the band")),
        ("p1m1", 2, ("upright mirror",)),
        ("p2", 2, ("half turn",)),
        ("p2mg", 4, ("glide or mirror along the band", "upright mirror", "half turn")),
        ("p2mm", 4, tuple(HAS)),
    ],
)
def test_each_has_the_symmetries_that_name_it(name: str, order: int, has: tuple[str, ...]) -> None:
    steps = FRIEZES[name].steps()
    assert len(steps) == order
    assert {what for what, is_it in HAS.items() if any(map(is_it, steps))} == set(has)


@pytest.mark.parametrize("name", FRIEZES)
@quick
@given(period=st.floats(1, 500), depth=st.floats(1, 500), u=st.floats(0.03, 0.22), v=st.floats(0.03, 0.47))
def test_a_point_has_as_many_images_in_a_period_as_the_group_is_large(
    name: str, period: float, depth: float, u: float, v: float
) -> None:
    band = orbit(name, period, depth)
    assert band.periods == ((period, 0.0),)
    assert band.operations[0].is_identity
    point = np.array([[u * period, v * depth]])
    images = np.vstack([operation.at(point) for operation in band.operations]) / (period, depth)
    images[:, 0] %= 1
    assert ((images[:, 1] > 0) & (images[:, 1] < 1)).all()
    assert len(np.unique(np.round(images, 9), axis=0)) == len(FRIEZES[name].steps())
    # The images of the images are no new ones.
    again = np.vstack([op.at(images * (period, depth)) for op in band.operations]) / (period, depth)
    away = np.abs(again[:, None] - images[None])
    away[..., 0] = np.minimum(away[..., 0] % 1, 1 - away[..., 0] % 1)
    assert (away.max(axis=2).min(axis=1) < 1e-9).all()


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("p111", "p1"),
        ("hop", "p1"),
        ("∞×", "p11g"),
        ("Step", "p11g"),
        ("p1m", "p11m"),
        ("jump", "p11m"),
        ("pm11", "p1m1"),
        ("*∞∞", "p1m1"),
        ("spinning hop", "p2"),
        ("p112", "p2"),
        ("pma2", "p2mg"),
        ("Spinning-Sidle", "p2mg"),
        ("pmm2", "p2mm"),
        ("*22∞", "p2mm"),
    ],
)
def test_every_name_is_understood(written: str, name: str) -> None:
    assert frieze(written).name == name


def test_an_unknown_name_is_answered_with_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match='unknown frieze "p2mmm": did you mean "p2mm"'):
        frieze("p2mmm")
    with pytest.raises(UnknownNameError, match="expected one of"):
        frieze("zzz")
