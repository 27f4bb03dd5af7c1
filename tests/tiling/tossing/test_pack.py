"""Packed marks: their outlines nestle, clear of one another across every seam, the same for the same seed."""

from __future__ import annotations

import time

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Cell
from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.maps.affine import Affine
from batik_vector.tiling.layouts import Pack, Toss
from batik_vector.tiling.tossing.toss import Marks, Tossed, toss
from tests.thorough import examples, long
from tests.tiling.tossing.leaves import LEAVES
from tests.tiling.tossing.test_toss import (
    BEAN,
    CELLS,
    DOT,
    NOTHING,
    SQUARE,
    drawn,
    least_gap,
    marks,
    places,
    torus,
)

FEW = [shapely.transform(leaf, lambda xy: xy * 0.35) for leaf in LEAVES[[0, 2, 4, 6, 9, 11]]]


def packed(side: int, spec: Pack | Toss, seed: int = 1) -> Tossed:
    """The twelve leaves on a square of so many mm."""
    return toss(
        spec, Marks(tuple("abcdefghijkl"), LEAVES, 0.02), torus(Cell(side * 1000, side * 1000)), NOTHING, seed
    )


@long
@pytest.mark.parametrize("seed", range(examples(2, 16)))
def test_no_two_marks_come_nearer_than_asked(seed: int) -> None:
    cell = CELLS[seed % len(CELLS)]
    spec = Pack(distance=(0.5, 1.0, 0.0)[seed % 3], size=(0.8, 1.2), flip=True, tries=20)
    shapes = drawn(toss(spec, marks(*FEW), torus(cell), NOTHING, seed), FEW)
    assert len(shapes) >= 5
    assert least_gap(shapes, cell) >= spec.distance


def test_marks_lie_closer_than_a_toss_and_the_report_says_what_is_there() -> None:
    specs = Toss(distance=1.0, tries=300, settle=3), Pack(distance=1.0, tries=50)
    tossed, pack = (packed(70, spec) for spec in specs)
    assert pack.report.covers > max(0.55, tossed.report.covers + 0.1)
    shapes = drawn(pack, list(LEAVES))
    cell = Cell(70_000, 70_000)
    assert pack.report.covers == pytest.approx(shapely.area(shapes).sum() / 70**2, abs=1e-6)
    assert pack.report.distance == pytest.approx(least_gap(shapes, cell), abs=2e-3)
    assert 1 <= pack.report.distance < 1.2
    assert pack.report.counts == tuple(len(copies) for copies in pack.copies)


@long
@pytest.mark.skipif(examples(0, 1) == 0, reason="takes some seconds")
def test_twelve_leaves_cover_six_tenths_of_a_large_repeat_in_ten_seconds() -> None:
    begin = time.process_time()
    pack = packed(300, Pack(distance=1.0))
    assert time.process_time() - begin < 10
    assert pack.report.covers >= 0.6
    assert least_gap(drawn(pack, list(LEAVES)), Cell(300_000, 300_000)) >= 1
    assert max(pack.report.counts) < 2 * min(pack.report.counts)


def test_a_seed_falls_the_same_way_always_and_another_seed_another_way() -> None:
    spec = Pack(size=(0.8, 1.2), count=9, tries=20)
    one, again, other = (toss(spec, marks(*FEW), torus(), NOTHING, seed) for seed in (1, 1, 2))
    assert one.copies == again.copies
    assert places(one) != places(other)


@pytest.mark.parametrize(
    "operations",
    [
        [Affine(), Affine.turn(180)],
        [Affine(), Affine.mirror()],
        [Affine.turn(90 * k) @ each for k in range(4) for each in (Affine(), Affine.mirror())],
    ],
    ids=["p2", "pm", "p4m"],
)
def test_images_under_a_symmetry_keep_the_distance_too(operations: list[Affine]) -> None:
    cell = Cell(50_000, 50_000)
    pack = toss(Pack(count=5, tries=20), marks(BEAN, DOT), torus(cell, operations), NOTHING, 2)
    assert sum(pack.report.counts) == 5 * len(operations)
    assert least_gap(drawn(pack, [BEAN, DOT]), cell, operations) >= 1


def test_turns_sizes_and_counts_are_those_allowed() -> None:
    spec = Pack(turns=(0, 90), size=(0.5, 1.0), count=8, weights=(1, 3), tries=30)
    pack = toss(spec, marks(BEAN, DOT), torus(), NOTHING, 1)
    assert pack.report.counts == (2, 6)
    maps = [copy for copies in pack.copies for copy in copies]
    turns = np.round(np.degrees(np.arctan2([m.c for m in maps], [m.a for m in maps])))
    sizes = np.hypot([m.a for m in maps], [m.c for m in maps])
    assert set(turns) <= {0, 90}
    assert ((sizes >= 1 - 1e-9) & (sizes <= 2 + 1e-9)).all()
    leaning = toss(Pack(turn=(10, 40), count=6, tries=20), marks(BEAN), torus(), NOTHING, 1).copies[0]
    turns = np.degrees(np.arctan2([m.c for m in leaning], [m.a for m in leaning]))
    assert ((turns > 9.99) & (turns < 40.01)).all()


def test_a_share_of_the_repeat_is_covered_where_it_is_asked() -> None:
    pack = toss(Pack(fill=0.2, tries=20), marks(DOT), torus(), NOTHING, 1)
    assert pack.report.covers == pytest.approx(0.2, abs=0.01)


def test_what_lies_there_is_kept_clear_of() -> None:
    first = toss(Toss(count=4, distance=4), marks(BEAN), torus(), NOTHING, 1)
    second = toss(Pack(distance=0.7, count=30, tries=20), marks(DOT), torus(), first.field, 2)
    together = np.concatenate([drawn(first, [BEAN]), drawn(second, [DOT])])
    assert least_gap(together, SQUARE) >= 0.7


def test_a_count_that_does_not_fit_is_told_with_how_many_do() -> None:
    with pytest.raises(GeometryError, match=r"count = 60: only \d\d fit at a distance of 1 mm"):
        toss(Pack(count=60, tries=20), marks(BEAN, DOT), torus(), NOTHING, 1)


def test_work_past_the_limit_is_refused_with_what_would_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "LIMIT", 100_000.0)
    with (
        pytest.raises(
            TooLargeError, match=r"tries = 500: after [\d,]+ places there are .* expected fewer tries"
        ),
        work.account(),
    ):
        toss(Pack(tries=500), marks(DOT), torus(), NOTHING, 1)
