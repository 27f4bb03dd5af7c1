"""Orbits: equal images lie together wherever a period cuts, and pieces of a region weld without a slit."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Cell
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.tiling.symmetry.groups import GROUPS, Kind
from batik_vector.tiling.symmetry.orbits import LAP, TRIVIAL, Orbit, Region, brought_together
from batik_vector.tiling.symmetry.spread import Frame, Spread, orbit_of

PERIODS = [(), ((30.0, 0.0),), ((30.0, 12.0), (0.0, 24.0)), ((30.0, 0.0), (10.0, 24.0))]
special = st.sampled_from([0.0, 0.25, 0.5, 1 / 3, 1.0])


def disc(radius: float, at: tuple[float, float] = (0.0, 0.0)) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    return np.array([shapely.Point(at).buffer(radius, 16)], dtype=object)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(
    st.sampled_from(PERIODS[1:]),
    st.tuples(special, special),
    st.lists(
        st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.floats(-1e-9, 1e-9), st.floats(-1e-9, 1e-9)),
        min_size=2,
        max_size=12,
    ),
)
def test_images_equal_modulo_the_periods_come_to_lie_together(
    periods: tuple[tuple[float, float], ...],
    share: tuple[float, float],
    moves: list[tuple[int, int, float, float]],
) -> None:
    basis = np.array(periods)
    place = np.array(share[: len(periods)]) @ basis
    images = []
    for i, j, dx, dy in moves:
        x, y = place + np.array((i, j)[: len(periods)]) @ basis
        images.append(Affine.translation((x + dx, y + dy)))
    together = brought_together(images, np.zeros(2), periods)
    assert np.ptp([image.e for image in together]) < 1e-7
    assert np.ptp([image.f for image in together]) < 1e-7
    # None has moved by anything but whole periods.
    for before, after in zip(images, together, strict=True):
        whole = np.array([after.e - before.e, after.f - before.f]) @ np.linalg.pinv(basis)
        assert whole == pytest.approx(np.rint(whole), abs=1e-9)


@pytest.mark.parametrize(("periods", "expected"), [(PERIODS[0], 3), (PERIODS[1], 2), (PERIODS[2], 2)])
def test_copies_a_period_apart_are_drawn_once(
    periods: tuple[tuple[float, float], ...], expected: int
) -> None:
    copies = [IDENTITY, Affine.translation((30.0, 0.0)), Affine.translation((30.0, 12.0 + 24.0))]
    orbit = Orbit(periods=periods)
    assert len(orbit.images(copies, [disc(1.0)], 0.01)) == expected


@pytest.mark.parametrize(
    ("at", "expected"),
    [((0.0, 0.0), 1), ((50.0, 50.0), 1), ((50.0, 0.0), 2), ((20.0, 20.0), 4), ((20.0, 7.0), 8)],
)
def test_a_symmetric_motif_on_a_special_place_is_drawn_once(at: tuple[float, float], expected: int) -> None:
    orbit = orbit_of(GROUPS["p4m"], Frame(Cell(100_000, 100_000), frozenset(Kind)))
    assert len(orbit.images([Affine.translation(at)], [disc(3.0)], 0.01)) == expected
    comma = [np.concatenate([disc(3.0), disc(1.0, (5.0, 2.0))])]
    assert len(orbit.images([Affine.translation(at)], comma, 0.01)) == 8


def test_a_motif_with_one_mirror_has_half_its_images_on_a_mirror_that_runs_along_it() -> None:
    orbit = orbit_of(GROUPS["pm"], Frame(Cell(100_000, 80_000), frozenset(Kind)))
    pear = [np.concatenate([disc(3.0), disc(1.0, (0.0, 5.0))])]
    assert len(orbit.images([Affine.translation((50.0, 13.0))], pear, 0.01)) == 1
    assert len(orbit.images([Affine.translation((50.0, 13.0)) @ Affine.turn(30)], pear, 0.01)) == 2


def test_what_has_no_symmetry_is_left_alone() -> None:
    assert TRIVIAL.is_trivial
    marks = disc(2.0)
    assert TRIVIAL.mirrored(marks) is marks


def test_a_region_laps_over_edges_that_come_to_run_aslant_only() -> None:
    corners = ((0.0, 0.0), (100.0, 0.0), (50.0, 80.0))
    region = Region(corners, (False, False, False))
    assert region.lapped(IDENTITY) == (False, True, True)
    # Turned, the first edge runs aslant too.
    assert region.lapped(Affine.turn(60)) == (True, True, True)
    assert region.lapped(Affine.turn(90)) == (False, True, True)
    # A mirror is never lapped over.
    assert Region(corners, (False, False, True)).lapped(Affine.turn(60)) == (True, True, False)
    assert region.shape((False,) * 3).equals(shapely.Polygon(corners))
    lapped = region.shape((False, True, True))
    assert lapped.bounds[1] == pytest.approx(0, abs=1e-9)
    for p, q in ((corners[1], corners[2]), (corners[2], corners[0])):
        middle = shapely.Point((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)
        assert lapped.exterior.distance(middle) == pytest.approx(LAP)


def test_pieces_that_rounding_makes_vanish_are_left_out() -> None:
    orbit = orbit_of(GROUPS["p2"], Frame(Cell(40_000, 30_000), frozenset(Kind)), spread=Spread.CUT)
    speck = disc(0.0001, (7.0003, 7.0002))
    hair = np.array([shapely.LineString([(3, 3), (3.0001, 3)])], dtype=object)
    assert len(orbit.mirrored(np.concatenate([speck, hair]))) == 0


def test_lines_are_cut_where_the_region_ends() -> None:
    orbit = orbit_of(GROUPS["pm"], Frame(Cell(40_000, 30_000), frozenset(Kind)), spread=Spread.CUT)
    line = np.array([shapely.LineString([(-15, 5), (15, 11)])], dtype=object)
    pieces = orbit.mirrored(line)
    # Half of it lies in the region; the other half, a period on, lies in the next one.
    assert shapely.length(pieces).sum() == pytest.approx(2 * line[0].length * 15 / 30, abs=0.01)
    assert set(shapely.get_coordinates(pieces)[:, 0][[0, -1]]) <= {0.0, 15.0, -15.0, 20.0, -20.0}


@pytest.mark.parametrize("at", [(10.0, 9.0), (10.0, 0.5)], ids=["inside", "over an edge"])
def test_a_hole_that_touches_its_outline_is_filled_in_no_image(at: tuple[float, float]) -> None:
    """A turn moves the point in which both begin by the last bits of its floats, and each over the other."""
    orbit = orbit_of(GROUPS["pg"], Frame(Cell(40_000, 30_000), frozenset(Kind)), spread=Spread.CUT)
    t = np.linspace(0, 1, 60)[:-1]
    leaf = np.sin(np.pi * t) * np.exp(3j * (t - 0.5))
    for turn in np.linspace(0.1, 6, 23):
        outline, hole = ((scale * np.exp(1j * turn) * leaf) for scale in (4, 2.4))
        rings = [np.column_stack([ring.real, ring.imag]) + at for ring in (outline, hole)]
        whole = shapely.Polygon(rings[0]).area
        images = orbit.mirrored(np.array([shapely.Polygon(rings[0], rings[1:])], dtype=object))
        assert shapely.is_valid(images).all()
        assert shapely.area(images).sum() == pytest.approx(2 * 0.64 * whole, rel=0.01)
