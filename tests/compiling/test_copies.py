"""Sheets of copies: bodies of lines are made once, and marks come in the order of the copies."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Ink
from batik_vector.compiling.copies import Laid, Look, set_down, sized
from batik_vector.geometry.curves import Circle, Superellipse
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.recipe.figures import draw
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.welding.congruent import polygons
from batik_vector.tiling.welding.sheets import Sheet

LEAF = Element(curve=Superellipse(0.5, 3, 1.0, 0.4), name="leaf", treatment=Treatment.STROKE, turn=17)
DOTS = Element(curve=Circle(0.1), name="dot", count=3, radius=1.4)
FIGURES = draw(Rosette(elements=(LEAF, DOTS)), 2e-3)
LOOK = Look(Placement(motif="m", scale=1.0, gap=1.0), {"wax": Ink("wax", "#000000", 0.8)}, 0.02)
STEPS = np.array([(30.0 * x, 30.0 * y) for y in range(4) for x in range(5)])


def down(maps: Affines) -> tuple[list[Sheet], list[Sheet]]:
    return set_down(Laid(FIGURES, maps, True), "m", LOOK)


def test_the_body_of_a_line_is_made_once_for_all_its_copies(monkeypatch: pytest.MonkeyPatch) -> None:
    made, buffer = [], shapely.buffer

    def counted(marks: object, *args: object, **more: object) -> object:
        made.append(np.size(marks))  # type: ignore[arg-type]
        return buffer(marks, *args, **more)  # type: ignore[call-overload]

    monkeypatch.setattr(shapely, "buffer", counted)
    down(Affines.translations(STEPS) @ Affine.scale(9.0))
    once = sum(made)
    made.clear()
    down(Affines.translations(STEPS[:2]) @ Affine.scale(9.0))
    assert sum(made) == once < len(STEPS)


@pytest.mark.parametrize("turn", [0.0, 24.0])
def test_marks_come_copy_by_copy_where_each_map_brings_them(turn: float) -> None:
    maps = Affines.of([Affine.translation((x, y)) @ Affine.turn(turn * (x + y)) for x, y in STEPS.tolist()])
    maps = maps @ Affine.scale(9.0)
    (bare,), (leaves, dots) = down(maps)
    for sheet, figure in zip((leaves, dots), sized(FIGURES, maps), strict=True):
        true = figure.areas if sheet is dots else shapely.buffer(figure.lines, 0.4, quad_segs=32)
        assert len(sheet.areas) == len(true)
        assert shapely.hausdorff_distance(polygons(sheet.areas), true).max() < 0.02
    assert len(bare.areas) == len(STEPS) * (2 + 3)
    assert bare.gap == 1.0


def test_copies_of_several_sizes_are_all_there() -> None:
    maps = Affines.translations(STEPS) @ Affines.scales(*[np.resize([9.0, 5.0], len(STEPS))] * 2)
    _, (_, dots) = down(maps)
    assert shapely.area(polygons(dots.areas)) == pytest.approx(
        np.repeat(np.resize([81.0, 25.0], 20), 3) * 0.0314, rel=0.05
    )
