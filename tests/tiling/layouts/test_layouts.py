"""Layouts: what each of them promises of its copies."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork
from batik_vector.errors import GeometryError
from batik_vector.geometry.curves import Circle, Superellipse
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.recipe.model import Placement, Recipe
from batik_vector.recipe.motif import Element
from batik_vector.recipe.motif import Rosette as Figure
from batik_vector.tiling.layouts import Bend, Places, RosetteLayout
from batik_vector.tiling.symmetry.repeats import TileSpec

quick = settings(max_examples=60, deadline=None, derandomize=True)


def copies(layout: RosetteLayout) -> Affines:
    found = layout.images((1.0, 1.0))
    assert not isinstance(found, Bend)
    return found


groups = st.tuples(st.sampled_from("CD"), st.integers(1, 24))


@quick
@given(groups, st.floats(0.1, 5), st.floats(-180, 180), st.floats(-180, 180))
def test_a_rosette_has_its_group_and_its_order(
    group: tuple[str, int], radius: float, turn: float, axis: float
) -> None:
    kind, n = group
    layout = RosetteLayout(group=f"{kind}{n}", shift=(radius, radius / 3), turn=turn, axis=axis)
    images = copies(layout)
    assert len(images) == (n if kind == "C" else 2 * n)
    assert sum(image.determinant < 0 for image in images) == (0 if kind == "C" else n)
    # Each operation of the group brings the images of a point that has no symmetry onto themselves.
    spot = np.array([[0.3, 0.1]])
    there = np.concatenate([image.at(spot) for image in images])
    turned = [Affine.turn(360 / n)] + ([Affine.mirror(axis)] if kind == "D" else [])
    for operation in turned:
        gap = np.hypot(*(operation.at(there)[:, None] - there[None]).transpose(2, 0, 1))
        assert gap.min(axis=1).max() < 1e-9 * (1 + radius)


def test_rosettes_are_named_in_any_letters() -> None:
    assert RosetteLayout(group=" d6 ").group == "D6"


@pytest.mark.parametrize("name", ["E6", "D0", "C", "D501", "6", ""])
def test_what_is_no_rosette_is_refused(name: str) -> None:
    with pytest.raises(GeometryError, match=r'expected "Cn" \(turns\) or "Dn" \(turns and mirrors\)'):
        RosetteLayout(group=name)


def drawn(layout: RosetteLayout, motif: Element) -> Artwork:
    return compile_recipe(
        Recipe(
            motif={"m": Figure(elements=(motif,))},
            place=(Placement(motif="m", layout=layout, scale=10, at=(50, 50)),),
            tile=TileSpec(size=(100, 100)),
        )
    )


LEAF = Element(curve=Superellipse(a=1.0, b=1.3, length=1.0, width=0.3))


@pytest.mark.parametrize(("turn", "marks"), [(0.0, 6), (20.0, 12), (90.0, 6)])
def test_a_motif_on_a_mirror_is_drawn_once(turn: float, marks: int) -> None:
    # A leaf along or across the mirror is its own image, one aslant is not; spread out, none meet.
    layout = RosetteLayout(group="D6", shift=(3.5, 0.0), turn=turn)
    areas = drawn(layout, LEAF).layers[0].areas
    one = drawn(RosetteLayout(group="C1", shift=(3.5, 0.0)), LEAF).layers[0].areas
    total = float(shapely.area(areas).sum())
    if marks == 6:
        assert len(areas) == 6
        assert total == pytest.approx(6 * float(shapely.area(one).sum()), rel=1e-3)
    else:
        # Two leaves cross over each mirror.
        assert len(areas) == 6
        assert total > 6.5 * float(shapely.area(one).sum())


def test_a_motif_at_the_centre_is_drawn_once() -> None:
    areas = drawn(RosetteLayout(group="D5", shift=(0.0, 0.0)), Element(curve=Circle(1.0))).layers[0].areas
    assert len(areas) == 1
    assert shapely.get_num_coordinates(areas)[0] < 120


def test_places_say_where_each_copy_lies() -> None:
    images = Places(at=((2.0, 3.0), (5.0, 4.0, 90.0)), mirrored=((8.0, 3.0, 30.0),)).images((1.0, 1.0))
    assert not isinstance(images, Bend)
    expected = [
        Affine.translation((2, 3)),
        Affine.translation((5, 4)) @ Affine.turn(90),
        Affine.translation((8, 3)) @ Affine.turn(30) @ Affine.mirror(0),
    ]
    for image, wanted in zip(images, expected, strict=True):
        assert image.row == pytest.approx(wanted.row)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "at is empty, and so is mirrored: expected at least one place"),
        ({"at": ((1.0,),)}, r"at\[0\] has 1 numbers, expected \[x, y\] or \[x, y, turn\]"),
        ({"at": ((1.0, 2.0),), "mirrored": ((1.0, 2.0, 3.0, 4.0),)}, r"mirrored\[0\] has 4 numbers"),
        ({"at": ((1.0, 1e9),)}, "expected -10000 to 10000"),
    ],
)
def test_places_that_are_none_are_refused(given: dict[str, Any], words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        Places(**given)
