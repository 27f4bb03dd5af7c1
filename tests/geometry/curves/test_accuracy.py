"""No chord stands farther from the true curve than the tolerance, and no vertex is spent in vain."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.geometry.curves import (
    CURVES,
    Attractor,
    Automaton,
    Blade,
    Butterfly,
    Circle,
    Curve,
    Fourier,
    Fractal,
    FractalName,
    Hypocycloid,
    Julia,
    Kronecker,
    LSystem,
    Mandelbrot,
    Parametric,
    PathCurve,
    Petal,
    PointsCurve,
    Polar,
    Polygon,
    Rose,
    Segment,
    ShapeGrammar,
    Spiral,
    Star,
    Superellipse,
    Wave,
    polar,
    trace,
)
from tests.thorough import rarely

MOTIF_MM = 300.0
TOLERANCE_MM = 0.02

EXAMPLES: list[Curve] = [
    Superellipse(),
    *(Superellipse(a, b) for a, b in [(0.2, 1), (0.2, 5), (0.2, 20), (0.1, 10), (0.3, 10), (0.4, 10)]),
    Superellipse(1, 1, 1, 1),
    Superellipse(0.05, 0.05),
    Superellipse(5, 5),
    *(Rose(n, d) for n, d in [(1, 1), (2, 1), (3, 1), (4, 1), (8, 1), (7, 3), (2, 3), (1, 3), (5, 4)]),
    Petal(),
    Petal(9),
    *(
        Hypocycloid(m, n)
        for m, n in [(16, 5), (8, 5), (24, 5), (32, 5), (10, 4), (15, 6), (3, 1), (20, 5), (7, 2)]
    ),
    Circle(0.1),
    Circle(1.0),
    Blade(),
    Blade(bend=70, lean=0.6, teeth=7),
    Blade(1, 0.1, 0.35, 3),
    Butterfly(fringe=0.0, level=0.5),
    Butterfly(1.0, 3.0, 0.0, -0.4),
    Polygon(7),
    Star(5, 1, 0.4),
    Polar(),
    Polar(0.6, ((5, 0.3, 20.0), (11, 0.08, 0.0))),
    Parametric(((1, 1.0, 0.0), (7, 0.15, 0.0)), ((1, 1.0, -90.0), (7, 0.15, -90.0))),
    Parametric(((3, 1.0, 0.0),), ((2, 1.0, 30.0),)),
    Spiral(),
    Spiral(6.5, 1.0, 0.0),
    Segment(),
    Wave(),
    Wave(6, 0.1, 40.0),
    LSystem(system="koch-snowflake"),
    Fractal(system=FractalName.KOCH, level=3),
    Kronecker(),
    Automaton(rule=254, rows=20),
    Fourier(),
    Attractor(folds=1),
    Julia(samples=40, escape=5.0, span=3.6),
    Mandelbrot(samples=40, escape=5.0),
    ShapeGrammar(rules=("turn",), first=1),
    LSystem(system="kolam-anklets", level=2, round=1.0),
    PathCurve("M0 0C1 0 1 1 0 1C-2 2 -2 -1 0 0Z"),
    PathCurve("M3 0A3 2 20 0 1 -3 0L-1 -2Q0 -3 1 -1Z"),
    PointsCurve(((0, 0), (3, 1), (4, 0), (3, -1))),
    PointsCurve(((0, 0), (3, 1), (4, 0), (3, -1)), smooth=True),
    PointsCurve(((0, 0), (3, 1), (4, 0), (3, -1)), smooth=True, corners=(0, 2)),
    PointsCurve(((0, 0), (1, 1), (2, -1), (5, 0)), smooth=True, closed=False),
    Curve.from_function(lambda t: (t, np.abs(np.sin(9 * t)))),
    polar(lambda angle: 1 - 0.5 * np.sin(angle)),
]


def name_of(curve: Curve) -> str:
    """A name without memory addresses, so that parallel runs collect alike."""
    return type(curve).__name__


def dense(curve: Curve) -> np.ndarray:
    """The curve at even parameters with the breaks among them, and closer and closer towards each break."""
    knots = np.concatenate([[0.0], curve.breaks(), [1.0]])
    inner = np.concatenate(
        [np.geomspace(1e-14, 0.02, 400), np.linspace(0.02, 0.98, 1500), 1 - np.geomspace(1e-14, 0.02, 400)]
    )
    t = np.unique(
        np.concatenate([knots, (knots[:-1, None] + np.diff(knots)[:, None] * np.sort(inner)).ravel()])
    )
    points = curve.at(t)
    # Steps that only rounding makes are no steps.
    apart = np.hypot(*np.diff(points, axis=0).T) > 1e-12
    return np.asarray(points[np.concatenate([[True], apart])])


def scale_of(points: np.ndarray) -> float:
    return MOTIF_MM / float(np.ptp(points[:, 0]))


def farthest(points: np.ndarray, line: np.ndarray) -> float:
    """How far points stand from a polyline at most."""
    chords = shapely.linestrings(np.stack([line[:-1], line[1:]], axis=1))
    _, away = shapely.STRtree(np.asarray(chords)).query_nearest(
        shapely.points(points), all_matches=False, return_distance=True
    )
    return float(away.max())


@pytest.mark.parametrize("curve", rarely(EXAMPLES, 7), ids=name_of)
def test_the_drawing_stays_within_the_tolerance_both_ways(curve: Curve) -> None:
    truth = dense(curve)
    tolerance = TOLERANCE_MM / scale_of(truth)
    strand = trace(curve, tolerance).strands[0]
    assert farthest(truth, strand) <= tolerance * (1 + 1e-6)
    # And back: every vertex lies on the true curve.
    assert farthest(strand, truth) <= tolerance * 0.2


def needed(truth: np.ndarray, tolerance: float) -> float:
    """Chords that an inscribed polyline needs: ∫ √(κ/8ε) ds between corners, plus one for each of these."""
    step = np.diff(truth, axis=0)
    length = np.hypot(*step.T)
    step, length = step[length > 0], length[length > 0]
    turn = np.abs(np.angle(np.exp(1j * np.diff(np.angle(step[:, 0] + 1j * step[:, 1])))))
    corner = turn > 0.3
    reach = (length[:-1] + length[1:]) / 2
    density = np.sqrt(np.where(corner, 0, turn) * reach / (8 * tolerance))
    total = np.cumsum(density)
    spans = np.diff(np.concatenate([[0.0], total[corner], [total[-1]]]))
    return float(np.maximum(np.ceil(spans), 1).sum())


@pytest.mark.parametrize("curve", EXAMPLES, ids=name_of)
def test_vertices_are_at_most_twice_what_the_tolerance_needs(curve: Curve) -> None:
    truth = dense(curve)
    tolerance = TOLERANCE_MM / scale_of(truth)
    spent = len(trace(curve, tolerance).strands[0]) - 1
    assert spent <= 2 * needed(truth, tolerance)


def test_every_curve_of_the_catalogue_is_among_the_examples() -> None:
    assert {type(curve) for curve in EXAMPLES} >= set(CURVES.values())


@pytest.mark.parametrize("curve", EXAMPLES, ids=name_of)
def test_closed_curves_close_and_are_drawn_once(curve: Curve) -> None:
    ends = curve.at(np.array([0.0, 1.0]))
    if not curve.closed:
        assert np.hypot(*(ends[1] - ends[0])) > 0.1
        return
    assert np.hypot(*(ends[1] - ends[0])) < 1e-9
    t = (np.arange(4001) + 0.5) / 4001
    points = curve.at(t)
    # Traced twice, the second half would come to lie on the first.
    half = shapely.LineString(points[: len(points) // 2])
    rest = shapely.distance(shapely.points(points[len(points) // 2 :]), half)
    assert np.median(rest) > 1e-4


def test_a_finer_tolerance_costs_the_root_of_it() -> None:
    counts = [len(trace(Rose(4), 10.0**-k).strands[0]) for k in (3, 5)]
    assert 8 < counts[1] / counts[0] < 12


@pytest.mark.parametrize("curve", [each for each in EXAMPLES if each.arcs() > 1], ids=name_of)
def test_arcs_that_are_alike_are_the_first_turned(curve: Curve) -> None:
    t = np.linspace(0, 1 / curve.arcs(), 50, endpoint=False)
    first = curve.at(t) @ [1, 1j]
    for number in range(1, curve.arcs()):
        arc = curve.at(t + number / curve.arcs()) @ [1, 1j]
        turn = arc[25] / first[25]
        assert abs(turn) == pytest.approx(1)
        assert np.abs(arc - turn * first).max() < 1e-9
        assert np.isclose(curve.breaks(), number / curve.arcs(), rtol=0, atol=1e-15).any()
