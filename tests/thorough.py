"""How much a test tries: some in ``make test``, the rest and more in ``make test-long``.

    @long
    @settings(max_examples=examples(100, 1000))

A test marked so runs in both. ``make test-long LONG=3`` tries three times as many, ``LONG=0.2`` fewer, as
`.ci/run` does.

    @pytest.mark.parametrize("name", rarely(SAMPLES, 3))

Of these ``make test`` tries every third, and ``make test-long`` the others, which are marked slow. So may be
any test.
"""

from __future__ import annotations

import os
import zlib
from collections.abc import Sequence
from typing import Any, TypeVar

import pytest

long = pytest.mark.long
slow = pytest.mark.slow
TIMES = float(os.environ.get("BATIK_LONG") or 0)
T = TypeVar("T")


def examples(few: int, many: int) -> int:
    """Return how many examples to try now."""
    return max(few, round(many * TIMES))


def some(names: Sequence[T], step: int) -> Sequence[T]:
    """Return every so many of some samples; all of them in a whole ``make test-long``."""
    return names if TIMES >= 1 else names[::step]


def rarely(parameters: Sequence[Any], step: int) -> list[Any]:
    """Return parameters of a test, all marked slow but every so many.

    Of names those that a sum over their letters chooses, which are the same in all tests: what is compiled
    for one serves the others. Of other things the first and every so many on.
    """
    return [each if _chosen(each, number, step) else _slow(each) for number, each in enumerate(parameters)]


def _chosen(each: Any, number: int, step: int) -> bool:
    return (zlib.crc32(each.encode()) if isinstance(each, str) else number) % step == 0


def _slow(each: Any) -> Any:
    if isinstance(each, type(pytest.param())):
        return pytest.param(*each.values, marks=[*each.marks, slow], id=each.id)
    return pytest.param(*(each if isinstance(each, tuple) else (each,)), marks=slow)
