"""What pens draw of a page: every stroke, from the page's upper left corner, y down; guides are no pen's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely import LineString, box

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.artwork.page import Geometries
from batik_vector.command.plugins.pens import pens_of
from batik_vector.geometry.outlines import of_polylines
from batik_vector.machines import Machine
from batik_vector.processes.options import PlotProcess
from batik_vector.processes.prepared import Prepared, Tool


def geometries(*given: shapely.Geometry) -> Geometries:
    return np.array(given, dtype=object)


@pytest.fixture
def page() -> Artwork:
    inks = [Ink("wax", "#f4efe2", 0.8), Ink("blue", "#1d2f5f", 1.2)]
    layers = (
        Layer(inks[0], areas=geometries(box(2, 3, 8, 9))),
        Layer(inks[1], lines=geometries(LineString([(1, 1), (5, 1), (5, 7)]))),
    )
    return Artwork("two pens", Cell(20_000, 10_000), layers)


def test_a_pen_draws_what_its_ink_does(page: Artwork) -> None:
    wax, blue = pens_of(page)
    assert [(pen.number, pen.ink) for pen in (wax, blue)] == [
        (1, page.layers[0].ink),
        (2, page.layers[1].ink),
    ]
    (ring,) = wax.lines
    assert ring[0].tolist() == ring[-1].tolist()
    assert sorted(map(tuple, ring[:-1].tolist())) == [(2, 1), (2, 7), (8, 1), (8, 7)]
    (open_line,) = blue.lines
    assert open_line.tolist() == [[1, 9], [5, 9], [5, 3]]


def test_pens_are_numbered_as_a_plot_says(page: Artwork) -> None:
    plot = PlotProcess(pens={"wax": 7, "blue": 2}).apply(page, Machine())
    assert [(pen.number, pen.ink.name) for pen in pens_of(plot)] == [(2, "blue"), (7, "wax")]


def test_places_are_counted_from_the_corner_of_the_page_with_its_margins(page: Artwork) -> None:
    strokes = of_polylines(geometries(LineString([(-3, -2), (21, 14)])), 1000)
    (pen,) = pens_of(Prepared(page, (Tool(Ink("wax", "#000000"), strokes),)))
    assert pen.lines[0].tolist() == [[0, 16], [24, 0]]


def test_no_pen_draws_guides(page: Artwork) -> None:
    plot = PlotProcess().apply(page, Machine())
    guided = replace(plot, tools=(plot.tools[0], replace(plot.tools[1], guide=True)))
    assert [pen.ink.name for pen in pens_of(guided)] == ["wax"]
