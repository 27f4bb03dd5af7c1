"""Sliders: from where to where a number goes, and by which steps."""

from __future__ import annotations

import math
from typing import Any

from batik_vector.recipe.reading.field_types import Hint

STEPS = 200
"""Steps of a slider, at least."""
FEW = 100
"""Whole numbers of which a slider takes all."""
LENGTH = 10.0
"""mm that a slider reaches for a length of which nothing is known."""
SHORTEST = 1e-6
"""What a slider reaches at least."""
TURNED = 180.0
"""Degrees that sliders of angles reach on both sides."""


def span_of(
    hint: Hint, useful: tuple[float, float] | None, value: Any, default: Any, angle: bool
) -> tuple[float, float]:
    """Return the ends of a slider, which hold the value in any case."""
    low, high = (hint.bounds.low, hint.bounds.high) if hint.bounds else (-math.inf, math.inf)
    held = [float(each) for each in (value, default) if _is_number(each)]
    ends = useful
    if ends is not None and held and held[0] > ends[1]:
        # What is larger than pleases, as where motifs are drawn in mm, can be made larger still.
        ends = ends[0], min(high, _round_up(1.5 * held[0]))
    if ends is None and angle:
        ends = max(low, -TURNED), min(high, TURNED)
    if ends is None and hint.base is int and high - low <= FEW:
        ends = low, high
    if ends is None:
        usual = LENGTH if hint.length else 1.0
        most = max(2 * abs(held[-1]) if held else 0.0, 10 * max(low, 0.0)) or usual
        if held and abs(held[0]) > most:
            most = 1.5 * abs(held[0])
        most = _round_up(max(most, SHORTEST))
        ends = max(low, -most if low < 0 else 0.0), min(high, most)
    return max(low, min([ends[0], *held])), min(high, max([ends[1], *held]))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _round_up(value: float) -> float:
    """Return the next of 1, 2, 5, 10, 20 …"""
    size = 10.0 ** math.floor(math.log10(value))
    return next(size * each for each in (1, 2, 5, 10) if size * each >= value * (1 - 1e-9))


def step_of(hint: Hint, span: tuple[float, float]) -> float:
    """Return the step of a slider."""
    if hint.base is int:
        return 1
    return _round_up(max(span[1] - span[0], SHORTEST) / STEPS) / 2 if span[1] > span[0] else 1.0
