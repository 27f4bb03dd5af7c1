"""Sketches of a toss: marks stay where they fell; and what was thrown before is not thrown again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.geometry import work
from batik_vector.tiling.layouts import Toss
from batik_vector.tiling.torus import remembered
from batik_vector.tiling.tossing import toss as tossing
from batik_vector.tiling.tossing.falls import Falls
from batik_vector.tiling.tossing.marks import Field
from batik_vector.tiling.tossing.toss import Marks, Tossed, toss
from tests.tiling.tossing.test_toss import BEAN, DOT, NOTHING, bean, marks, torus

SPEC = Toss(distance=0.5, settle=3, tries=200)


def thrown(made: Marks, spec: Toss = SPEC, taken: Field = NOTHING) -> Tossed:
    return toss(spec, made, torus(), taken, 1)


def same(a: Tossed, b: Tossed) -> bool:
    return a.report == b.report and a.field.shapes.tolist() == b.field.shapes.tolist()


def test_marks_of_a_sketch_stay_where_they_fell_in_their_new_shape() -> None:
    falls = Falls()
    with falls.kept():
        before = thrown(marks(BEAN))
    with falls.sketched():
        after = thrown(marks(bean(6.5, 2, 0.4)))
    assert after.report == before.report
    assert np.allclose(after.field.middles, before.field.middles)
    assert shapely.area(after.field.shapes).sum() > shapely.area(before.field.shapes).sum()
    with falls.sketched():
        assert same(thrown(marks(BEAN)), before)
    exact = thrown(marks(bean(6.5, 2, 0.4)))
    assert not np.allclose(exact.field.middles[:5], after.field.middles[:5])


def test_what_grows_into_the_way_of_others_is_left_out_of_a_sketch() -> None:
    falls = Falls()
    small, large = marks(bean(3, 3)), marks(bean(4.5, 4.5))
    few = Toss(distance=0.5, count=6)
    with falls.kept():
        before = thrown(marks(DOT), taken=thrown(small, few).field)
    with falls.sketched():
        heroes = thrown(large, few)
        dots = thrown(marks(DOT), taken=heroes.field)
    tree = shapely.STRtree(dots.field.shapes)
    assert len(heroes.field) == 6
    assert 0 < len(dots.field) < len(before.field)
    assert not len(tree.query(heroes.field.shapes, predicate="intersects")[0])


@pytest.mark.parametrize(
    "other", [replace(SPEC, distance=0.9), replace(SPEC, seed=5)], ids=["distance", "seed"]
)
def test_a_toss_that_is_asked_for_otherwise_is_thrown_again(other: Toss) -> None:
    falls = Falls()
    with falls.kept():
        before = thrown(marks(BEAN))
    with falls.sketched():
        after = thrown(marks(BEAN), other)
    assert before.field.middles.tolist() != after.field.middles.tolist()


def test_what_fell_is_remembered_and_its_work_counted_again(monkeypatch: pytest.MonkeyPatch) -> None:
    remembered.clear()
    taken = thrown(marks(bean(4, 4)), Toss(distance=1.0, count=5)).field
    with work.account():
        first = thrown(marks(BEAN, DOT), taken=taken)
        spent = work.counted()
    monkeypatch.setattr(tossing, "_filled", lambda *_: pytest.fail("thrown again"))
    with work.account():
        assert same(thrown(marks(BEAN, DOT), taken=taken), first)
        assert work.counted() == spent
    monkeypatch.undo()
    for spec, made in ((replace(SPEC, settle=2), marks(BEAN, DOT)), (SPEC, marks(DOT, BEAN))):
        assert not same(thrown(made, spec, taken), first)
    remembered.clear()
    assert same(thrown(marks(BEAN, DOT), taken=taken), first)
