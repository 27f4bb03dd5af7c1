"""The normal form: every rule at the head of artwork.py is found broken when it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer, Overlap, violations
from batik_vector.compiling.compiler import inspect

INK = Ink("wax", "#f4efe2")
SQUARE = shapely.box(1, 1, 4, 4)


def artwork(*areas: shapely.Geometry, lines: tuple[shapely.Geometry, ...] = (), ink: Ink = INK) -> Artwork:
    polygons = shapely.orient_polygons(np.array(areas, dtype=object)) if areas else np.empty(0, object)
    return Artwork("test", Cell(10_000, 10_000), (Layer(ink, polygons, np.array(lines, dtype=object)),))


def raw(area: shapely.Geometry) -> Artwork:
    return Artwork("test", Cell(10_000, 10_000), (Layer(INK, np.array([area], dtype=object)),))


def test_a_sound_artwork_has_no_violations() -> None:
    sound = artwork(SQUARE, shapely.box(4, 1, 6, 2), lines=(shapely.LineString([(0, 0), (10, 10)]),))
    assert violations(sound) == []
    assert inspect(sound)["violations"] == []
    assert sound.vertex_count == 12


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        (raw(shapely.box(1, 1, 11, 4)), "outside the cell"),
        (raw(shapely.box(-0.001, 1, 4, 4)), "outside the cell"),
        (raw(shapely.Polygon([(1, 1), (4, 4), (4, 1), (1, 4)])), "invalid"),
        (raw(shapely.box(1, 1, 4, 4, ccw=False)), "clockwise"),
        (raw(shapely.box(1.0005, 1, 4, 4)), "off the 1 µm grid"),
        (raw(shapely.Polygon([(1, 1), (np.inf, 1), (4, 4)])), "not finite"),
        (raw(shapely.Polygon()), "empty"),
        (raw(shapely.Point(1, 1)), "no polygon"),
        (
            raw(shapely.Polygon([(1, 1), (4, 1), (4, 4)], [[(2, 1.5), (3, 1.5), (3, 2)]])),
            "hole runs anticlockwise",
        ),
        (artwork(SQUARE, shapely.box(3, 3, 5, 5)), "1 pairs of areas overlap"),
        (artwork(lines=(shapely.LineString([(1, 1), (1, 1), (2, 2)]),)), "length zero"),
        (
            artwork(
                lines=(shapely.LineString([(1, 1), (2, 2)]), shapely.LineString([(3, 3), (2, 2), (1, 1)]))
            ),
            "drawn twice",
        ),
        (replace(artwork(SQUARE), layers=artwork(SQUARE).layers * 2), 'two layers named "wax"'),
    ],
)
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
