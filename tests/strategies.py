"""Hypothesis strategies shared by the tests."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import strategies as st

PLACES = ("anywhere", "inside", "in a hole", "at a vertex", "on an edge", "at a hole's vertex", "close")
"""Where the origin lies with regard to a polygon."""

_radii = st.floats(0.35, 1.0)


@st.composite
def rings(draw: st.DrawFn, size: float = 1.0) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Star-shaped rings about (0, 0): 3 to 11 vertices, shape (n, 2), anticlockwise, not closed."""
    count = draw(st.integers(3, 11))
    radii = np.array(draw(st.lists(_radii, min_size=count, max_size=count)))
    angles = (np.arange(count) + draw(st.floats(0.0, 1.0))) * 2 * math.pi / count
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]) * size


@st.composite
def polygons(draw: st.DrawFn, place: st.SearchStrategy[str] | None = None) -> shapely.Polygon:
    """Valid polygons with up to three holes, about one unit across, with the origin in one of ``PLACES``."""
    where = draw(st.sampled_from(PLACES) if place is None else place)
    shell = draw(rings())
    # A triangle of unequal corners may leave the centre on the edge of what it holds.
    room = shapely.Polygon(shell).exterior.distance(shapely.Point(0, 0)) * 0.8
    least = 1 if "hole" in where else 0
    holes = []
    for slot in range(draw(st.integers(least, 3))):
        angle = 2 * math.pi * slot / 3
        centre = np.array([math.cos(angle), math.sin(angle)]) * room * 0.55
        holes.append(draw(rings(room * draw(st.floats(0.1, 0.4)))) + centre)
    share = draw(st.floats(0.0, 1.0))
    if where == "inside":
        origin = np.zeros(2)
    elif where == "in a hole":
        origin = np.array([math.cos(0.0), math.sin(0.0)]) * room * 0.55
    elif where == "at a vertex":
        origin = shell[int(share * (len(shell) - 1))]
    elif where == "at a hole's vertex":
        origin = holes[0][int(share * (len(holes[0]) - 1))]
    elif where == "on an edge":
        origin = (shell[0] + shell[1]) / 2
    elif where == "close":
        origin = shell[0] * (1 + draw(st.sampled_from([-1, 1])) * 10.0 ** -draw(st.integers(1, 9)))
    else:
        origin = np.array([draw(st.floats(-3, 3)), draw(st.floats(-3, 3))])
    polygon = shapely.Polygon(shell - origin, [hole - origin for hole in holes])
    return polygon if polygon.is_valid else shapely.Polygon(shell - origin)


def spiral(turns: float, width: float = 0.12, count: int = 200) -> shapely.Polygon:
    """A band that winds ``turns`` times round the origin without enclosing it, a hole near its outer end."""
    t = np.linspace(0, 2 * math.pi * turns, count)
    radius = 0.5 + 0.35 * t / (2 * math.pi)
    inner = np.column_stack([(radius - width) * np.cos(t), (radius - width) * np.sin(t)])
    outer = np.column_stack([(radius + width) * np.cos(t), (radius + width) * np.sin(t)])
    i = int(count * 0.93)
    middle = (inner[i] + outer[i]) / 2
    turn = np.linspace(0, 2 * math.pi, 12, endpoint=False)
    hole = middle + width * 0.5 * np.column_stack([np.cos(turn), np.sin(turn)])
    return shapely.Polygon(np.vstack([inner, outer[::-1]]), [hole])
