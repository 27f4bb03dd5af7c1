"""How many examples a random test tries: some in ``make test``, many more in ``make test-long``.

    @long
    @settings(max_examples=examples(100, 1000))

A test marked so runs in both; ``make test-long`` runs nothing else. ``make test-long LONG=3`` tries three
times as many, ``LONG=0.25`` fewer, as `.ci/run` does.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import pytest

long = pytest.mark.long
TIMES = float(os.environ.get("BATIK_LONG") or 0)
T = TypeVar("T")


def examples(few: int, many: int) -> int:
    """Return how many examples to try now."""
    return max(few, round(many * TIMES))


def some(names: Sequence[T], step: int) -> Sequence[T]:
    """Return every so many of some samples; all of them in a whole ``make test-long``."""
    return names if TIMES >= 1 else names[::step]


def whole(test: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a test that ``make test-long`` runs only where it is whole, for less would be what others run."""
    return long(test) if TIMES >= 1 else test
