"""The normal form: every rule at the head of the artwork is found broken when it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Layer, Overlap, violations
from batik_vector.compiling.compiler import inspect

from .broken_artworks import BROKEN, INK, SQUARE, artwork, raw


def test_a_sound_artwork_has_no_violations() -> None:
    sound = artwork(SQUARE, shapely.box(4, 1, 6, 2), lines=(shapely.LineString([(0, 0), (10, 10)]),))
    assert violations(sound) == []
    assert inspect(sound)["violations"] == []
    assert sound.vertex_count == 12


@pytest.mark.parametrize(("broken", "words"), BROKEN)
def test_every_broken_rule_is_found(broken: Artwork, words: str) -> None:
    assert any(words in found for found in violations(broken)), violations(broken)


def test_an_overlay_may_overlap_and_a_bleed_may_reach_out() -> None:
    assert (
        violations(artwork(SQUARE, shapely.box(3, 3, 5, 5), ink=replace(INK, overlap=Overlap.OVERLAY))) == []
    )
    assert violations(replace(raw(shapely.box(-2, 1, 4, 4)), bleed=3.0)) == []


def test_a_gap_at_the_seam_is_told_with_its_place() -> None:
    half = Artwork(
        "gap", Cell(10_000, 10_000), (Layer(INK, np.array([shapely.box(0, 2, 3, 5)], dtype=object)),)
    )
    assert inspect(half)["seam"] == [{"ink": "wax", "edges": "left and right", "from_mm": 2.0, "to_mm": 5.0}]
