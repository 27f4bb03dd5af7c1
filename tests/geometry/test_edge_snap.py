"""What all but lies on an edge of the page lies on it; what only touches the edge does no more than that."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.certificate import certify
from batik_vector.geometry.edge_snap import snapped
from batik_vector.importing.svg import read_tile
from tests.importing.drawings import svg
from tests.thorough import examples, long

REACH = 2000.0
FAR = (100_000_000, 100_000_000)


def moved(chain: list[tuple[float, float]]) -> list[tuple[float, float]]:
    xy = np.array(chain, float)
    return [tuple(point) for point in snapped(xy, np.array([0, len(xy)]), FAR, REACH).tolist()]


@pytest.mark.parametrize("begin", range(6))
def test_a_side_rounded_off_lies_on_the_edge_wherever_its_ring_begins(begin: int) -> None:
    """Its corners miss the edge by 1300, 800, 0 and 400 steps; one lies too far off."""
    ring = [(1300.0, 0.0), (9e6, 0.0), (9e6, 9e6), (400.0, 9e6), (2100.0, 7e6), (800.0, 5e6)]
    ring = ring[begin:] + ring[:begin]
    found = moved([*ring, ring[0]])
    assert found[0] == found[-1]
    assert sorted(found[1:]) == [(0, 0), (0, 5e6), (0, 9e6), (2100, 7e6), (9e6, 0), (9e6, 9e6)]


def test_vertices_between_two_corners_follow_them() -> None:
    ring = [(1300.0, 0.0), (9e6, 0.0), (9e6, 9e6), (400.0, 9e6), (1900.0, 7e6), (800.0, 5e6), (1300.0, 0.0)]
    assert [x for x, _ in moved(ring)] == [0, 9e6, 9e6, 0, 0, 0, 0]


@pytest.mark.parametrize("begin", [0, 1, 5, 6])
def test_of_a_curve_that_touches_the_edge_one_vertex_lies_on_it(begin: int) -> None:
    angles = np.arange(60) * 2 * np.pi / 60
    disc = np.rint(np.column_stack([1e5 + 50 - 1e5 * np.cos(angles), 5e7 + 1e5 * np.sin(angles)]))
    disc = np.roll(disc, begin, axis=0)
    found = np.array(moved([tuple(point) for point in [*disc.tolist(), disc[0].tolist()]]))
    on_edge = found[:-1][found[:-1, 0] == 0]
    assert on_edge.tolist() == [[0, 5e7]]


def test_ends_of_lines_lie_on_the_edge_and_what_crosses_it_does_so_once() -> None:
    across = [(1300.0, 5e5), (5e6, 5e5), (99_999_000.0, 5e5)]
    assert moved(across) == [(0, 5e5), (5e6, 5e5), (1e8, 5e5)]
    across = [(5e6, 9e7), (1900.0, 5.1e7), (30.0, 5e7), (-1800.0, 4.9e7), (-5e6, 1e7)]
    assert [x for x, _ in moved(across)] == [5e6, 1900, 0, -1800, -5e6]


def at_edge(edge: str, away: float, along: float) -> tuple[float, float]:
    """Return a place off an edge of a page of 100 × 100."""
    places = {
        "left": (away, along),
        "right": (100 - away, along),
        "top": (along, away),
        "bottom": (along, 100 - away),
    }
    return places[edge]


@long
@settings(max_examples=examples(6, 150), derandomize=True, deadline=None)
@given(
    st.floats(0.2, 12).map(lambda r: round(r, 2)),
    st.floats(15, 85).map(lambda y: round(y, 2)),
    st.sampled_from(["left", "right", "top", "bottom"]),
    st.sampled_from(["px", "mm"]),
    st.floats(0, 180),
    st.sampled_from([1.0, 0.6]),
)
def test_discs_that_touch_the_edge_pass_whatever_their_radius(
    radius: float, along: float, edge: str, unit: str, degrees: float, share: float
) -> None:
    across, up = radius, radius * share
    turn = math.radians(degrees)
    reach = {
        "left": math.hypot(across * math.cos(turn), up * math.sin(turn)),
        "top": math.hypot(across * math.sin(turn), up * math.cos(turn)),
    }["left" if edge in ("left", "right") else "top"]
    x, y = at_edge(edge, reach, along)
    mark = f'<ellipse rx="{across}" ry="{up}" transform="translate({x} {y}) rotate({degrees})"/>'
    head = f'width="100{unit}" height="100{unit}" viewBox="0 0 100 100"'
    tile = read_tile(svg(mark + '<path d="M40 40h1v1z" fill="#00f"/>', head))
    assert certify(tile).passed


@pytest.mark.parametrize("edge", ["left", "right", "top", "bottom"])
def test_a_disc_cut_by_the_edge_does_not_pass(edge: str) -> None:
    x, y = at_edge(edge, 2.98, 50)
    assert not certify(read_tile(svg(f'<circle cx="{x}" cy="{y}" r="3"/>'))).passed
