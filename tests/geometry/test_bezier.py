from dataclasses import dataclass

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.bezier import Cubics, fit_cubics
from batik_vector.geometry.curves import Curve, trace
from batik_vector.geometry.curves.rose import Rose
from batik_vector.geometry.curves.superellipse import Superellipse
from batik_vector.geometry.sampling import Array, Points


@dataclass(frozen=True)
class Wild(Curve):
    """A random Fourier curve: bends of every size, inflections, some hairpins finer than the sampling."""

    seed: int

    def at(self, t: Array) -> Points:
        random = np.random.default_rng(self.seed)
        radius = 10 ** random.uniform(-0.3, 2)
        z = radius * np.exp(2j * np.pi * t)
        for k in range(2, random.integers(3, 12)):
            size = radius * random.uniform(0.05, 0.5) / k**1.5
            turning = 2j * np.pi * k * random.choice([-1, 1])
            z = z + complex(*random.normal(size=2)) * size * np.exp(turning * t)
        return np.column_stack([z.real, z.imag])


TOLERANCE = 0.02
CHORD = 0.02

SMOOTH = {
    "rose": (Rose(2, 1, 120.0), 6),
    "overlapping rose": (Rose(5, 3, 120.0), 8),
    "narrow rose": (Rose(8, 1, 60.0), 6),
    "small rose": (Rose(3, 1, 20.0), 6),
    "leaf": (Superellipse(length=60.0, width=15.0), 20),
    "ellipse": (Superellipse(1.0, 1.0, 60.0, 15.0), 6),
    "pointed leaf": (Superellipse(1.0, 3.0, 60.0, 15.0), 12),
    "squircle": (Superellipse(0.4, 0.4, 60.0, 15.0), 16),
}
"""Curves, and how many cubics one ring of theirs may take."""


def fit(points: Points, closed: bool = True, tolerance: float = TOLERANCE) -> Cubics:
    return fit_cubics(points, np.array([0, len(points)]), np.array([closed]), tolerance)


def arc(radius: float, begin: float, end: float, vertices: int, centre: complex = 0) -> Points:
    angle = np.radians(np.linspace(begin, end, vertices))
    return np.column_stack([centre.real + radius * np.cos(angle), centre.imag + radius * np.sin(angle)])


def closed_up(points: Points) -> Points:
    return np.vstack([points, points[:1]])


def circle(radius: float, vertices: int) -> Points:
    return closed_up(arc(radius, 0, 360, vertices + 1)[:-1])


def drawn(cubics: Cubics, samples: int = 200) -> Points:
    """The fit as a dense polyline, by Bernstein's formula."""
    u = np.linspace(0, 1, samples)
    basis = np.stack([(1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u * u * (1 - u), u**3], axis=1)
    return np.asarray(np.einsum("ij,mjk->mik", basis, cubics.points).reshape(-1, 2))


def stray(points: Points, line: Points) -> float:
    return float(shapely.distance(shapely.points(points), shapely.linestrings(line)).max())


def kinks(cubics: Cubics) -> Array:
    """Angles between the tangents where neighbours meet, the last and the first included."""
    z = cubics.points[..., 0] + 1j * cubics.points[..., 1]
    into, out = z[:, 3] - z[:, 2], np.roll(z[:, 1] - z[:, 0], -1)
    return np.asarray(np.abs(np.angle(out / into)))


def ring_of(curve: Curve, tolerance: float) -> Points:
    return trace(curve, tolerance).rings[0]


@pytest.mark.parametrize("sampling", [CHORD, 0.005])
@pytest.mark.parametrize("name", SMOOTH)
def test_fit_is_near_the_true_curve_both_ways(name: str, sampling: float) -> None:
    curve, most = SMOOTH[name]
    points, truth = ring_of(curve, sampling), ring_of(curve, 1e-4)
    cubics = fit(points)
    dense = drawn(cubics)
    assert stray(points, dense) <= TOLERANCE
    assert stray(dense, points) <= 1.5 * TOLERANCE
    assert stray(truth, dense) <= TOLERANCE + sampling
    assert stray(dense, truth) <= TOLERANCE + sampling
    assert len(cubics.points) <= most
    assert not cubics.straight.any()


@pytest.mark.parametrize("sampling", [CHORD, 0.005])
def test_wild_curves_are_kept_to(sampling: float) -> None:
    for seed in (*range(20), 69):
        points, truth = ring_of(Wild(seed), sampling), ring_of(Wild(seed), 1e-3)
        cubics = fit(points)
        dense = drawn(cubics, 120)
        assert stray(points, dense) <= TOLERANCE, seed
        # A hairpin between two vertices has no smooth interpretation to hold the fit to.
        assert stray(dense, points) <= 1.6 * TOLERANCE, seed
        assert stray(dense, truth) <= 2.2 * TOLERANCE, seed


def test_the_check_can_fail() -> None:
    points = ring_of(SMOOTH["leaf"][0], CHORD)
    cubics = fit(points)
    cubics.points[0, 1] += 0.2
    assert stray(drawn(cubics), points) > 1.5 * TOLERANCE


@pytest.mark.parametrize("tolerance", [0.005, 0.02, 0.1])
def test_a_tighter_tolerance_is_kept(tolerance: float) -> None:
    points = ring_of(Rose(5, 3, 120.0), 0.002)
    assert stray(points, drawn(fit(points, tolerance=tolerance))) <= tolerance


@pytest.mark.parametrize(
    ("radius", "vertices"), [(50.0, 112), (50.0, 1000), (5.0, 36), (0.5, 12), (200.0, 222)]
)
def test_circles_take_few_smooth_cubics(radius: float, vertices: int) -> None:
    cubics = fit(circle(radius, vertices))
    assert 2 <= len(cubics.points) <= 8
    assert np.abs(np.hypot(*drawn(cubics).T) - radius).max() <= TOLERANCE
    assert kinks(cubics).max() < 1e-9


def test_a_circle_of_twelve_is_smooth_and_an_octagon_is_not() -> None:
    assert np.abs(np.hypot(*drawn(fit(circle(50.0, 12))).T) - 50).max() <= TOLERANCE
    octagon = fit(circle(50.0, 8))
    assert octagon.straight.all()
    assert len(octagon.points) == 8


def test_smooth_joints_share_their_tangents() -> None:
    for name in ("ellipse", "squircle"):
        assert kinks(fit(ring_of(SMOOTH[name][0], CHORD))).max() < 1e-9
    petal = kinks(fit(ring_of(Rose(5, 3, 120.0), CHORD)))
    # The last joint is the petal's corner.
    assert petal[:-1].max() < 1e-9
    assert petal[-1] > 0.5


def test_cubics_join_bit_for_bit() -> None:
    for curve, _ in SMOOTH.values():
        points = fit(ring_of(curve, CHORD)).points
        assert (points[1:, 0] == points[:-1, 3]).all()
        assert (points[-1, 3] == points[0, 0]).all()


def test_polygons_stay_as_they_are() -> None:
    for polygon in (
        circle(40.0, 4),
        circle(3.0, 3),
        np.array([[0, 0], [90, 0], [90, 1], [0, 1], [0, 0]], float),
    ):
        cubics = fit(polygon)
        assert cubics.straight.all()
        np.testing.assert_array_equal(cubics.points[:, 0], polygon[:-1])
        np.testing.assert_allclose(cubics.points[:, 1], (2 * polygon[:-1] + polygon[1:]) / 3)


def test_vertices_amid_straight_edges_are_left_out() -> None:
    side = np.column_stack([np.linspace(-10, 10, 21), np.full(21, -10.0)])
    turned = [side @ np.array([[c, s], [-s, c]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    square = np.vstack([edge[:-1] for edge in turned])
    # Begun amid an edge.
    cubics = fit(closed_up(np.roll(square, 7, axis=0)))
    assert len(cubics.points) == 4
    assert cubics.straight.all()
    assert {tuple(p) for p in cubics.points[:, 0]} == {(-10, -10), (10, -10), (10, 10), (-10, 10)}


def test_straight_runs_meet_arcs_with_their_tangent() -> None:
    corners = [(40 + 20j, 0), (-40 + 20j, 90), (-40 - 20j, 180), (40 - 20j, 270)]
    cubics = fit(closed_up(np.vstack([arc(8.0, a, a + 90, 14, z) for z, a in corners])))
    assert len(cubics.points) == 8
    assert cubics.straight.sum() == 4
    assert kinks(cubics).max() < 1e-9


def test_a_straight_run_into_a_parabola_has_no_kink() -> None:
    x = np.cumsum(np.linspace(0.4, 1.2, 40))
    bow = np.column_stack([x, x**2 / 20])
    cubics = fit(np.vstack([[[-50.0, 0.0], [0.0, 0.0]], bow]), closed=False)
    assert cubics.straight.tolist() == [True] + [False] * (len(cubics.points) - 1)
    assert kinks(cubics)[:-1].max() < 1e-9


def test_rings_begin_at_their_corner() -> None:
    petal = ring_of(Rose(2, 1, 120.0), CHORD)
    late = closed_up(np.roll(petal[:-1], 30, axis=0))
    np.testing.assert_allclose(fit(late).points, fit(petal).points, atol=1e-9)


def test_a_half_disc_keeps_its_corners_and_its_diameter() -> None:
    cubics = fit(closed_up(arc(50.0, 0, 180, 57)))
    assert len(cubics.points) <= 5
    assert cubics.straight.sum() == 1
    ends = cubics.points[cubics.straight][0]
    np.testing.assert_allclose(np.sort(ends[[0, 3], 0]), [-50, 50])
    assert (kinks(cubics) > 0.5).sum() == 2


@pytest.mark.parametrize("degrees", [20, 45, 90, 170])
def test_corners_between_arcs_stay_corners(degrees: float) -> None:
    # Two equal arcs that meet at an angle: a lens, open towards one side.
    first = arc(30.0, 90 - 60, 90, 40) - [0, 30.0]
    turned = np.radians(degrees)
    rotation = np.array([[np.cos(turned), np.sin(turned)], [-np.sin(turned), np.cos(turned)]])
    second = (arc(30.0, 90, 90 + 60, 40) - [0, 30.0]) @ rotation
    points = np.vstack([first, second[1:]])
    cubics = fit(points, closed=False)
    assert (cubics.points[:, 0] == points[39]).all(axis=1).any()
    assert kinks(cubics)[:-1].max() == pytest.approx(turned, abs=0.02)
    assert len(cubics.points) <= 4


def test_cusps_are_nodes() -> None:
    cubics = fit(ring_of(SMOOTH["leaf"][0], CHORD))
    tips = np.abs(np.abs(cubics.points[:, 0]) - [60.0, 0.0]).max(axis=1) < 1e-9
    assert tips.sum() == 2
    assert (np.sort(kinks(cubics))[-2:] > 3.0).all()


def test_points_on_the_grid_cost_no_more() -> None:
    points = ring_of(Rose(5, 3, 120.0), 0.001)
    rounded = np.round(points, 3)
    exact, gridded = fit(points), fit(rounded)
    assert len(gridded.points) <= len(exact.points) + 2
    assert stray(rounded, drawn(gridded)) <= TOLERANCE


def test_symmetric_rings_give_nearly_symmetric_cubics() -> None:
    for curve in (Rose(2, 1, 120.0), Superellipse(1.0, 1.0, 60.0, 15.0)):
        nodes = fit(ring_of(curve, CHORD)).points[:, 0]
        mirrored = nodes * [1, -1]
        away = np.abs(nodes[:, None] - mirrored[None]).max(axis=2).min(axis=1)
        assert away.max() < 3.0


@pytest.mark.parametrize(
    ("points", "closed", "count"),
    [
        ([], False, 0),
        ([(1, 1)], False, 0),
        ([(1, 1), (1, 1), (1, 1)], True, 0),
        ([(0, 0), (3, 4)], False, 1),
        ([(0, 0), (3, 4), (0, 0)], True, 2),
        ([(0, 0), (1, 0), (1, 0), (5, 0)], False, 1),
        ([(0, 0), (1, 0), (5, 0), (2, 0), (0, 0)], True, 2),
        ([(0, 0), (10, 0), (0, 0.001)], False, 2),
        ([(0, 0), (1e-9, 0), (0, 1e-9), (0, 0)], True, 2),
    ],
)
def test_degenerate_lines(points: list[tuple[float, float]], closed: bool, count: int) -> None:
    cubics = fit(np.array(points, float).reshape(-1, 2), closed)
    assert len(cubics.points) == count
    assert np.isfinite(cubics.points).all()
    assert cubics.offsets.tolist() == [0, count]


def test_a_tiny_ring_stays_a_ring() -> None:
    cubics = fit(np.round(circle(0.004, 12), 3))
    assert 2 <= len(cubics.points) <= 12
    assert np.abs(drawn(cubics)).max() < 0.01


def test_nonsense_is_refused() -> None:
    with pytest.raises(GeometryError):
        fit(np.array([[0, 0], [np.nan, 1]]), closed=False)
    with pytest.raises(GeometryError):
        fit(circle(1.0, 12), tolerance=0.0)


def test_bulk_equals_one_by_one() -> None:
    lines = [ring_of(curve, CHORD) for curve, _ in SMOOTH.values()]
    lines += [circle(50.0, 112), circle(40.0, 4), np.empty((0, 2)), np.array([[1.0, 1.0], [2.0, 5.0]])]
    closed = np.array([True] * (len(lines) - 2) + [False] * 2)
    offsets = np.concatenate([[0], np.cumsum([len(line) for line in lines])])
    bulk = fit_cubics(np.vstack(lines), offsets, closed, TOLERANCE)
    alone = [fit(line, bool(ring)) for line, ring in zip(lines, closed, strict=True)]
    assert np.diff(bulk.offsets).tolist() == [len(one.points) for one in alone]
    np.testing.assert_allclose(bulk.points, np.vstack([one.points for one in alone]), rtol=0, atol=1e-6)
    np.testing.assert_array_equal(bulk.straight, np.concatenate([one.straight for one in alone]))
    again = fit_cubics(np.vstack(lines), offsets, closed, TOLERANCE)
    np.testing.assert_array_equal(bulk.points, again.points)


def test_one_cubic_stands_for_many_vertices() -> None:
    lines = [ring_of(Rose(2, 1, 120.0), CHORD), circle(50.0, 112), ring_of(Rose(5, 3, 120.0), CHORD)] * 20
    offsets = np.concatenate([[0], np.cumsum([len(line) for line in lines])])
    cubics = fit_cubics(np.vstack(lines), offsets, np.ones(len(lines), bool), TOLERANCE)
    assert offsets[-1] / len(cubics.points) > 15
