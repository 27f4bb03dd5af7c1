"""How many examples a random test tries: some in ``make test``, many more in ``make test-long``.

    @long
    @settings(max_examples=examples(100, 1000))

A test marked so runs in both; ``make test-long`` runs nothing else. ``make test-long LONG=3`` tries three
times as many, ``LONG=0.4`` fewer, as `.ci/run` does.
"""

from __future__ import annotations

import os

import pytest

long = pytest.mark.long


def examples(few: int, many: int) -> int:
    """Return how many examples to try now."""
    times = float(os.environ.get("BATIK_LONG") or 0)
    return max(few, round(many * times))
