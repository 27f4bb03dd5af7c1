"""Bodies of lines: wherever a round tip passes is covered, however tightly it turns."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.sampling import Array
from batik_vector.processes.handwork.ribbons import ribbons
from tests.thorough import examples, long

HOOK = [[81106, 16116], [82426, 14801], [83404, 13726], [83657, 13365], [83789, 13076], [83800, 12882]]
"""A line that turns back within its own breadth where it ends: its outline crosses itself nowhere."""


def left_open(line: Array, radius: Array) -> float:
    """Return the area (steps²) that a round tip of the least radius covers and a line's body does not."""
    points = np.rint(line).astype(np.int64)
    made = shapely.union_all(ribbons(points, np.array([0, len(points)]), radius, round_ends=True))
    tip = shapely.buffer(shapely.linestrings(points), radius.min() - 2, quad_segs=16)
    return float(shapely.area(shapely.difference(tip, made)))


def test_a_hook_at_the_end_is_as_broad_as_the_rest() -> None:
    line = np.array([*HOOK, [83777, 12848]])
    assert left_open(line, np.full(len(line), 420.0)) == 0


@long
@settings(max_examples=examples(100, 1000), deadline=None)
@given(st.data())
def test_no_bend_is_narrower_than_its_line(data: st.DataObject) -> None:
    count = data.draw(st.integers(2, 12))
    turns = np.cumsum(data.draw(st.lists(st.floats(-1.2, 1.2), min_size=count, max_size=count)))
    ways = np.array(data.draw(st.lists(st.floats(20, 900), min_size=count, max_size=count)))
    steps = ways[:, None] * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    line = np.concatenate([[[0.0, 0.0]], np.cumsum(steps, axis=0)])
    swell = data.draw(st.lists(st.floats(1, 1.3), min_size=count + 1, max_size=count + 1))
    assert left_open(line, 420 * np.array(swell)) == pytest.approx(0, abs=20)
