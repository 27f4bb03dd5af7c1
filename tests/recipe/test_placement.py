"""What a placement leaves to its layout."""

from __future__ import annotations

import pytest
import shapely

from batik_vector import compile_recipe, read_recipe
from batik_vector.errors import GeometryError
from batik_vector.tiling.layouts import Toss

FALL = """
[motif.pod]
kind = "rosette"
elements = [{ curve = { kind = "superellipse", a = 1, b = 1.4, length = 5, width = 2 } }]

[[place]]
motif  = "pod"
scale  = 1
layout = { kind = "toss", count = 6, distance = 1 }

[tile]
size   = [40, 40]
repeat = "mirror"
"""


def test_a_mirror_repeat_does_not_cut_what_is_tossed() -> None:
    whole = compile_recipe(read_recipe(FALL))
    cut = compile_recipe(read_recipe(FALL.replace("scale  = 1", 'scale  = 1\nregion = "cut"')))
    one = compile_recipe(read_recipe(FALL.replace("count = 6", "count = 1")))
    # Each of six marks, and its three mirror images, is as large as any other.
    pods = 6 * float(shapely.area(one.layers[0].areas).sum())
    assert shapely.area(whole.layers[0].areas).sum() == pytest.approx(pods, rel=1e-3)
    assert shapely.area(cut.layers[0].areas).sum() < 0.999 * pods


def test_turn_and_turns_of_a_toss_shut_each_other_out() -> None:
    Toss(turns=(0.0, 90.0))
    with pytest.raises(GeometryError, match="expected one of them"):
        Toss(turns=(0.0, 90.0), turn=(0.0, 10.0))
