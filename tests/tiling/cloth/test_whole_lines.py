"""Lines along the edge of a tile, whose bodies show on both sides of it."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import pikepdf
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Cell, DropAxis, Ink, Layer
from batik_vector.geometry.outlines import to_polylines, together
from batik_vector.making.pages import Latest, render_output
from batik_vector.processes.options import PlotProcess
from batik_vector.recipe.outputs import PdfOutput
from batik_vector.tiling.cloth.field import field_page
from batik_vector.units import on_grid

WIDTH = 3.0
TRIM = shapely.box(0, 0, 20, 16)


def tile(ways: list[list[tuple[int, int]]], drop: str, axis: DropAxis) -> Artwork:
    """Return a tile of 20 x 16 mm with lines (mm) cut at its edges, as the compiler cuts them."""
    cell = Cell(20_000, 16_000, Fraction(drop), axis)
    lines = [shapely.LineString(way) for way in ways]
    copies = [shapely.affinity.translate(line, *shift) for line in lines for shift in shifts(cell)]
    drawn = shapely.union_all([*copies]).intersection(shapely.box(0, 0, 20, 16))
    parts = [part for part in shapely.get_parts(drawn) if part.geom_type == "LineString"]
    # What lies on the right or upper edge lies on the left or lower one too.
    kept = [part for part in parts if part.bounds[0] < 20 and part.bounds[1] < 16]
    marks = np.array([*shapely.transform(np.array(kept, dtype=object), on_grid), None], dtype=object)[:-1]
    return Artwork("lines", cell, (Layer(Ink("ink", "#000000", WIDTH), lines=marks),))


def shifts(cell: Cell) -> list[tuple[float, float]]:
    (ax, ay), (bx, by) = np.array(cell.lattice) / 1000
    return [(i * ax + j * bx, i * ay + j * by) for i in range(-2, 3) for j in range(-2, 3)]


def shown(lines: Sequence[shapely.LineString]) -> shapely.Geometry:
    """Return what of the bodies of lines shows on the tile."""
    near = [line for line in lines if line.distance(TRIM) < WIDTH]
    return shapely.union_all(shapely.buffer(near, WIDTH / 2, quad_segs=16)) & TRIM


WAYS = st.lists(
    st.lists(st.tuples(st.integers(0, 20), st.integers(0, 16)), min_size=2, max_size=4, unique=True),
    min_size=1,
    max_size=3,
)


@settings(max_examples=15, deadline=None, derandomize=True)
@given(ways=WAYS, drop=st.sampled_from(["0", "1/2", "1/4"]), axis=st.sampled_from(list(DropAxis)))
def test_both_halves_of_a_line_show(ways: list[list[tuple[int, int]]], drop: str, axis: DropAxis) -> None:
    artwork = tile(ways, drop, axis)
    page = field_page(artwork, whole_lines=True)
    drawn = to_polylines(together(list(page.lines(0))), 1000)
    lines, everywhere = artwork.layers[0].lines, shifts(page.cell)
    cloth = [shapely.affinity.translate(line, *shift) for line in lines for shift in everywhere]
    # The arcs of two ways of cutting are chords apart.
    assert shapely.symmetric_difference(shown(list(drawn)), shown(cloth)).area < 0.05
    assert page.margins == field_page(artwork).margins


@pytest.mark.parametrize("whole", [False, True])
def test_a_line_on_the_edge_is_drawn_on_both_edges_only_where_asked(whole: bool) -> None:
    artwork = tile([[(0, 4), (0, 9)]], "0", DropAxis.COLUMN)
    drawn = to_polylines(together(list(field_page(artwork, whole_lines=whole).lines(0))), 1000)
    assert {line.bounds[0] for line in drawn} == ({0.0, 20.0} if whole else {0.0})


@pytest.mark.parametrize(
    ("given", "strokes"),
    [
        ({}, 1),
        ({"inks": "spot"}, 2),
        ({"inks": "spot", "wrap": False}, 1),
        ({"wrap": True}, 2),
        ({"inks": "spot", "bleed": 1.0}, 2),
        ({"inks": "spot", "process": (PlotProcess(),)}, 1),
    ],
)
def test_print_files_show_both_halves(given: dict[str, Any], strokes: int) -> None:
    sink = io.BytesIO()
    artwork = tile([[(0, 4), (0, 9)]], "0", DropAxis.COLUMN)
    render_output(artwork, PdfOutput(**given), sink, Latest())
    with pikepdf.open(sink) as document:
        content = document.pages[0].Contents.read_bytes()
    assert len(re.findall(rb"^S$", content, re.MULTILINE)) == strokes
