"""Borders against the truth: frames laid mark by mark in plain floats, without a grid."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.compiling.borders import compile_borders
from batik_vector.geometry.curves import Curve
from batik_vector.geometry.sampling import Points
from batik_vector.recipe.model import Placement
from batik_vector.recipe.motif import Element
from batik_vector.tiling.symmetry.friezes import FRIEZES
from tests.frames import (
    CLOTH,
    DEPTH,
    HEIGHT,
    PERIOD,
    WIDTH,
    border,
    many,
    recipe,
    shapes,
    sound,
)


def by_hand(marks: list[shapely.Geometry]) -> shapely.Geometry:
    """A frame of whole periods, mark by mark, in plain floats and without a grid."""
    cover = []
    for length, isometries in (
        (WIDTH, ([1, 0, 0, 1, 0, 0], [-1, 0, 0, -1, WIDTH, HEIGHT])),
        (HEIGHT, ([0, -1, -1, 0, WIDTH, HEIGHT], [0, 1, 1, 0, 0, 0])),
    ):
        wedge = shapely.Polygon([(0, 0), (length, 0), (length - DEPTH, DEPTH), (DEPTH, DEPTH)])
        count = round(length / PERIOD)
        run = [
            shapely.transform(mark, partial(np.add, [k * PERIOD, 0]))
            for mark in marks
            for k in range(-3, count + 3)
        ]
        band = shapely.union_all(run, grid_size=1e-7).intersection(wedge)
        for a, b, c, d, e, f in isometries:
            cover.append(shapely.affinity.affine_transform(band, [a, b, c, d, e, f]))
    return shapely.union_all(cover, grid_size=1e-7)


@many
@given(
    shapes,
    st.floats(0, 360),
    st.tuples(st.floats(-40, 40), st.floats(-10, 46)),
    st.sampled_from(list(FRIEZES)),
)
def test_a_mitred_frame_is_what_placing_mark_by_mark_gives(
    curve: Curve, turn: float, at: tuple[float, float], name: str
) -> None:
    placement = Placement(motif="m", scale=1, at=at, turn=turn)
    spec = border(placement, frieze=name)
    done = compile_borders([spec], recipe(Element(curve=curve)), CLOTH)
    if not done.layers:
        return
    areas = sound(done).areas
    marks = images(curve, turn, at, name)
    true = by_hand(marks)
    assert shapely.union_all(areas).symmetric_difference(true).area <= 0.052 * (shapely.length(true) + 1)


def images(curve: Curve, turn: float, at: tuple[float, float], name: str) -> list[shapely.Geometry]:
    """All images of a mark within one period, drawn finely."""
    ring = shapely.Polygon(curve.at(np.linspace(0, 1, 201)))
    mark = shapely.affinity.rotate(shapely.make_valid(ring), turn, origin=(0, 0))
    mark = shapely.affinity.translate(mark, *at)
    return [
        shapely.affinity.affine_transform(
            mark, [sx, 0, 0, sy, float(shift) * PERIOD, DEPTH if sy < 0 else 0.0]
        )
        for sx, sy, shift in FRIEZES[name].steps()
    ]


@many
@given(shapes, st.tuples(st.floats(0, 40), st.floats(2, 34)), st.floats(2, 60))
def test_a_bent_frame_is_the_band_bent(curve: Curve, at: tuple[float, float], radius: float) -> None:
    spec = border(Placement(motif="m", scale=1, at=at), corner="bend", radius=radius, limit=20)
    done = compile_borders([spec], recipe(Element(curve=curve)), CLOTH)
    drawn = shapely.union_all(sound(done).areas)
    stretch = done.fits[0].stretch
    count = round(sum(fit.periods for fit in done.fits))
    flat = shapely.union_all(
        [
            shapely.affinity.translate(mark, k * PERIOD)
            for mark in images(curve, 0, at, "p1")
            for k in range(-3, count + 4)
        ],
        grid_size=1e-7,
    )
    outer, middle = radius + DEPTH, radius + DEPTH / 2
    true = shapely.union_all(
        [
            shapely.make_valid(shapely.transform(flat.intersection(box).segmentize(0.5), carry))
            for box, carry in stretches(stretch, outer, middle)
        ],
        grid_size=1e-7,
    )
    assert drawn.symmetric_difference(true).area <= 0.06 * (shapely.length(true) + 4)


def stretches(
    stretch: float, outer: float, middle: float
) -> Iterator[tuple[shapely.Polygon, Callable[[Points], Points]]]:
    """Cut a straight band into what lies along the sides and what goes round their ends, with its way there.

    It begins in the middle of the lower side.
    """
    at, begin = 0.0, WIDTH / 2
    for number in range(5):
        length = (WIDTH, HEIGHT)[number % 2]
        c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][number % 4]
        origin = [(0, 0), (WIDTH, 0), (WIDTH, HEIGHT), (0, HEIGHT)][number % 4]
        runs = [(length - outer - begin, False), (middle * np.pi / 2, True)]
        if number == 4:
            runs = [(WIDTH / 2 - outer, False)]
        for run, bends in runs:

            def carry(
                xy: Points,
                at: float = at,
                bends: bool = bends,
                first: float = length - outer if bends else begin,
                axes: tuple[tuple[int, int], tuple[int, int]] = ((c, s), (-s, c)),
                origin: tuple[float, float] = origin,
            ) -> Points:
                along, y = xy[:, 0] * stretch - at, xy[:, 1]
                if bends:
                    angle, away = along / middle, outer - y
                    along, y = away * np.sin(angle), outer - away * np.cos(angle)
                return np.asarray(np.column_stack([first + along, y]) @ np.array(axes) + np.array(origin))

            yield shapely.box(at / stretch, 0, (at + run) / stretch, DEPTH), carry
            at += run
        begin = outer
