"""Fractals, automata, arrows, attractors, escapes and grammars: published figures and refusals."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.curves import (
    Attractor,
    AttractorMap,
    Automaton,
    Curve,
    Fourier,
    Fractal,
    FractalName,
    Julia,
    Kronecker,
    Mandelbrot,
    ShapeGrammar,
    trace,
)
from batik_vector.geometry.generators.systems import count_of
from batik_vector.geometry.regions import FillRule, settle
from batik_vector.geometry.sampling import Geometries

SIDE = math.sqrt(3) / 4


def region(curve: Curve) -> Geometries:
    areas = curve.region(1e-4)
    assert areas is not None
    assert shapely.is_valid(areas).all()
    return areas


@pytest.mark.parametrize("level", range(6))
def test_sierpinskis_triangle_has_its_count_and_area(level: int) -> None:
    areas = region(Fractal(level=level))
    assert len(areas) == count_of("sierpinski-triangle", level) == 3**level
    assert shapely.area(areas).sum() == pytest.approx(SIDE * (3 / 4) ** level)


@pytest.mark.parametrize("level", range(4))
def test_sierpinskis_carpet_has_its_area_and_holes(level: int) -> None:
    (area,) = region(Fractal(system=FractalName.SIERPINSKI_CARPET, level=level))
    assert area.area == pytest.approx((8 / 9) ** level)
    assert shapely.get_num_interior_rings(area) == (8**level - 1) / 7
    assert count_of("sierpinski-carpet", level) == 8**level
    cells = region(Kronecker(matrix=((1, 1, 1), (1, 0, 1), (1, 1, 1)), level=level)) if level else [area]
    assert shapely.area(shapely.symmetric_difference(cells[0], area)) < 1e-8


@pytest.mark.parametrize("level", range(5))
def test_kochs_island_has_its_perimeter_and_area(level: int) -> None:
    (area,) = region(Fractal(system=FractalName.KOCH, level=level))
    assert area.length == pytest.approx(3 * (4 / 3) ** level)
    assert area.area == pytest.approx(SIDE * (8 / 5 - 3 / 5 * (4 / 9) ** level))


def test_a_kronecker_power_has_the_ones_of_its_matrix_to_the_power() -> None:
    areas = region(Kronecker(matrix=((1, 0), (1, 1)), level=4))
    assert shapely.area(areas).sum() * 16**2 == pytest.approx(3**4)


def test_rule_90_is_pascals_triangle_modulo_two() -> None:
    curve = Automaton(rule=90, columns=64, rows=32, mirror=False)
    for row, cells in enumerate(curve.cells()):
        expected = [math.comb(row, k) % 2 for k in range(row + 1)]
        assert cells[32 - row : 32 + row + 1 : 2].tolist() == [bool(each) for each in expected]


def test_a_mirrored_history_closes_and_begins_where_it_is_told() -> None:
    cells = Automaton(rule=30, columns=40, rows=12, start=(3, 7)).cells()
    assert (cells == cells[::-1]).all()
    cells = Automaton(rule=30, columns=40, rows=12, start=(3, 7), periodic=True).cells()
    assert len(cells) == 22
    assert np.flatnonzero(cells[0]).tolist() == [3, 7]
    assert (cells[1:] == cells[:0:-1]).all()
    seeds = [Automaton(density=0.5, seed=seed).cells() for seed in (1, 1, 2)]
    assert (seeds[0] == seeds[1]).all()
    assert (seeds[0] != seeds[2]).any()


def test_arrows_of_points_come_near_to_the_line_through_them() -> None:
    square = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))
    line = shapely.Polygon(square)
    for harmonics, near in ((1, 0.6), (8, 0.15), (64, 0.03)):
        (ring,) = trace(Fourier(points=square, harmonics=harmonics), 1e-3).rings
        assert shapely.hausdorff_distance(shapely.LineString(ring), line.exterior) < near


def test_arrows_whose_turns_differ_by_n_have_n_fold_symmetry() -> None:
    (ring,) = trace(Fourier(arrows=((1, 1.0, 0.0), (-4, 0.3, 0.0), (6, 0.1, 0.0))), 1e-3).rings
    turn = np.exp(2j * np.pi / 5)
    turned = ring @ np.array([[turn.real, turn.imag], [-turn.imag, turn.real]])
    assert shapely.hausdorff_distance(shapely.LineString(ring), shapely.LineString(turned)) < 3e-3


@pytest.mark.parametrize("kind", AttractorMap)
def test_a_folded_circle_is_the_maps_image_of_the_circle_folded_once_less(kind: AttractorMap) -> None:
    once, twice = (Attractor(map=kind, folds=folds) for folds in (1, 2))
    t = np.linspace(0, 1, 50)
    (x, y), (a, b, c, d) = once.at(t).T, (-1.4, 1.6, 1.0, 0.7)
    if kind == AttractorMap.CLIFFORD:
        image = [np.sin(a * y) + c * np.cos(a * x), np.sin(b * x) + d * np.cos(b * y)]
    else:
        image = [np.sin(a * y) - np.cos(b * x), np.sin(c * x) - np.cos(d * y)]
    assert twice.at(t) == pytest.approx(np.column_stack(image))


def test_the_mandelbrot_sets_rings_close_in_on_its_area() -> None:
    # Its area is 1.5066 (Mitchell 2001); rings of later escapes lie within those of earlier ones.
    areas = []
    for escape in (6.0, 12.0, 60.0):
        rings = trace(Mandelbrot(escape=escape, samples=900, span=3.2), 1e-4).rings
        areas.append(float(shapely.area(settle(rings)).sum()) * 3.2**2)
    assert areas[0] > areas[1] > areas[2]
    assert areas[2] == pytest.approx(1.5066, rel=0.04)


def test_julia_sets_have_their_symmetry() -> None:
    # z² + 0 is the circle; zᵖ + c is p-fold.
    (disc,) = settle(trace(Julia(c=(0.0, 0.0), escape=20.0, samples=300, span=2.6), 1e-4).rings)
    assert disc.area * 2.6**2 == pytest.approx(np.pi, rel=0.01)
    (star,) = settle(trace(Julia(c=(-0.8, 0.3), power=6, escape=4.4, span=2.8), 1e-4).rings)
    turned = shapely.transform(star, lambda p: p @ [[0.5, math.sqrt(3) / 2], [-math.sqrt(3) / 2, 0.5]])
    assert shapely.area(shapely.symmetric_difference(star, turned)) < 0.02 * star.area


def test_a_wrapped_set_is_alike_on_opposite_edges() -> None:
    areas = settle(trace(Julia(c=(-0.4, 0.6), span=2.6, samples=300, periodic=True, escape=6.0), 1e-4).rings)
    whole = shapely.union_all(areas)
    for ends in (((-1, -1), (-1, 1)), ((-1, -1), (1, -1))):
        edge = shapely.LineString(np.array(ends) / 2)
        other = shapely.LineString(np.array(ends) / 2 + (np.array(ends[0]) == np.array(ends[1])))
        low, high = (shapely.intersection(whole, each).length for each in (edge, other))
        assert low == pytest.approx(high, abs=1e-9)
        assert 0.1 < low < 0.99


def test_a_grammar_makes_generation_after_generation() -> None:
    outline = ShapeGrammar(rules=("inscribe", "inscribe")).outline()
    assert outline.closed.sum() == 3
    areas = settle(trace(ShapeGrammar(rules=("inscribe", "inscribe")), 1e-3).rings, FillRule.EVENODD)
    # Squares of 2, 1 and ½: the middle one is bare.
    assert shapely.area(areas).sum() == pytest.approx(2 - 1 + 0.5)
    assert ShapeGrammar(rules=("corners", "sides"), first=2).outline().closed.sum() == 16
    spikes = settle(trace(ShapeGrammar(sides=3, rules=("spikes 0.5",), first=1), 1e-3).rings)
    assert len(spikes) == 3


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (
            lambda: Kronecker(matrix=((1, 0), (1,))),
            "matrix = rows of 2, 1 numbers: expected rows that are equally",
        ),
        (lambda: Kronecker(matrix=()), "matrix = no rows"),
        (lambda: Kronecker(matrix=((0, 0),)), "all cells are empty"),
        (lambda: Kronecker(level=12), "level = 12 makes"),
        (lambda: Automaton(rule=0, start=(80,)), "start = 80, expected cells from 0 to 63"),
        (lambda: Fractal(level=9, system=FractalName.KOCH), "level = 9, expected 0 to 6 of koch"),
        (lambda: Fourier(arrows=((0, 1.0, 0.0),)), "arrows = none that turns"),
        (lambda: Fourier(points=((0.0, 0.0), (1.0, 0.0))), "points = a list of 2"),
        (lambda: Fourier(points=((1.0, 1.0),) * 4), "points = all in one place"),
        (lambda: Attractor(a=0.0, b=0.0, c=0.5, d=0.5), "settles on no strange attractor"),
        (lambda: Attractor(a=4.0, b=4.0, c=4.0, d=4.0, folds=12), "does not settle"),
        (lambda: Julia(samples=4000), "a grid of 4000 × 4000, more than 4,000,000"),
        (lambda: Julia(escape=300.0, c=(2.0, 2.0)), "all points escape"),
        (lambda: ShapeGrammar(rules=("inscrbe",)), 'rules[0] = "inscrbe": did you mean "inscribe"?'),
        (lambda: ShapeGrammar(rules=("turn x",)), 'rules[0] = "turn x": expected one number behind the name'),
        (lambda: ShapeGrammar(rules=("inscribe 0",)), "expected a number other than 0"),
        (lambda: ShapeGrammar(rules=("corners",) * 12), "more than 20,000 shapes"),
        (lambda: ShapeGrammar(first=9), "first = 9, expected 0 to 3"),
    ],
)
def test_what_makes_no_pattern_is_told(made: Callable[[], Curve], words: str) -> None:
    with pytest.raises((GeometryError, TooLargeError)) as error:
        made()
    assert words in str(error.value)
