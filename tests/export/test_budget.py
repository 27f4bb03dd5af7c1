"""What the writers may spend, counted and not timed: work goes with vertices, calls with pieces of a page."""

from __future__ import annotations

import gc
import io
import sys
import tracemalloc
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.artwork import page as pages
from batik_vector.export import DxfOptions, GcodeOptions, PdfOptions, SvgOptions, render, write_page
from batik_vector.export.numbers import Spelling
from batik_vector.export.pdf import container
from batik_vector.processes import order
from tests.thorough import slow

from .drawings import geometries, line

SETTINGS: list[tuple[str, Any]] = [
    ("svg", SvgOptions()),
    ("svg", SvgOptions(profile="compact")),  # type: ignore[arg-type]
    ("pdf", PdfOptions()),
    ("dxf", DxfOptions()),
    ("dxf", DxfOptions("R12")),  # type: ignore[arg-type]
    ("gcode", GcodeOptions()),
]
SIDES = 48
"""Corners of each mark."""
settings = pytest.mark.parametrize(
    ("format", "options"), SETTINGS, ids=lambda each: getattr(each, "name", None)
)


class Sink(io.RawIOBase):
    """Counts what is written, and forgets it."""

    def __init__(self) -> None:
        self.calls = self.size = self.at = 0

    def write(self, data: Any) -> int:
        self.calls += 1
        self.at += len(data)
        self.size = max(self.size, self.at)
        return len(data)

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        self.at = offset
        return offset

    def tell(self) -> int:
        return self.at


def crowd(marks: int, lines: int = 0) -> Artwork:
    """A page of so many small polygons under three names, and of so many straight lines."""
    turns = np.arange(SIDES) * (2 * np.pi / SIDES)
    places = np.stack(np.divmod(np.arange(marks), 100), axis=1) * 10.0 + 5
    rings = places[:, None] + 4 * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    areas = geometries(*shapely.polygons(rings))
    strokes = geometries(*(line((1, 1 + k / 8), (99, 1 + k / 8)) for k in range(lines)))
    names = [tuple(f"part.{k % 3}" for k in range(count)) for count in (marks, lines)]
    layer = Layer(Ink("wax", "#f4efe2", 0.1), areas, strokes, *names)
    return Artwork("crowd", Cell(1_000_000, 1_000_000), (layer,))


def spent(artwork: Artwork, format: str, options: Any) -> Sink:
    sink = Sink()
    # To check an artwork takes as much memory as the artwork, and calls of its own.
    write_page(artwork, sink, format, options, check=False)  # type: ignore[arg-type]
    return sink


@settings
def test_every_byte_is_written_once(format: str, options: Any) -> None:
    page = crowd(60, 20)
    sink = spent(page, format, options)
    assert sink.size == len(render(page, format, options))
    assert sink.at == sink.size


@settings
@pytest.mark.parametrize("piece", [1000, 5000])
def test_the_sink_is_called_for_pieces_and_not_for_marks(
    monkeypatch: pytest.MonkeyPatch, format: str, options: Any, piece: int
) -> None:
    monkeypatch.setattr(pages, "PIECE", piece)
    few = spent(crowd(2), format, options).calls
    page = crowd(600)
    assert spent(page, format, options).calls <= few + 4 * (page.vertex_count // piece + 1)


@settings
def test_a_coordinate_is_spelled_once(monkeypatch: pytest.MonkeyPatch, format: str, options: Any) -> None:
    real, counts = Spelling.put, list[int]()

    def put(self: Spelling, rows: Any, at: int, steps: Any) -> int:
        counts.append(len(steps))
        return real(self, rows, at, steps)

    monkeypatch.setattr(Spelling, "put", put)
    monkeypatch.setattr(pages, "PIECE", 5000)
    page = crowd(600)
    spent(page, format, options)
    corners, pieces = 600 * SIDES, page.vertex_count // 5000 + 1
    # Rows left free for what stands between marks are spelled over: a few for each mark.
    assert 2 * corners <= sum(counts) <= 2 * (corners + 600 * 10)
    assert len(counts) <= 2 * pieces


def calls(artwork: Artwork, format: str, options: Any) -> int:
    """How many functions are called, in Python and from Python, to write a page."""
    counted = [0]

    def count(frame: object, event: str, argument: object) -> None:
        counted[0] += event in ("call", "c_call")

    sys.setprofile(count)
    try:
        spent(artwork, format, options)
    finally:
        sys.setprofile(None)
    return counted[0]


@settings
def test_no_function_is_called_for_each_mark(format: str, options: Any) -> None:
    few, many = crowd(20, 20), crowd(1000, 300)
    # What changes an order is called for each change: see tests/processes.
    options = replace(options, order=False) if hasattr(options, "order") else options
    calls(few, format, options)
    # svgwrite's calls are among them: it makes the furniture alone.
    assert calls(many, format, options) <= calls(few, format, options) + 20


def test_the_count_of_calls_can_fail() -> None:
    layers = crowd(1000).layers
    named = replace(layers[0], area_names=tuple(f"a{k}x" for k in range(1000)))
    many = replace(crowd(2), layers=(named,))
    assert calls(many, "svg", SvgOptions()) > calls(crowd(2), "svg", SvgOptions()) + 1000


@slow
@settings
def test_memory_does_not_grow_with_the_page(
    monkeypatch: pytest.MonkeyPatch, format: str, options: Any
) -> None:
    monkeypatch.setattr(pages, "PIECE", 2000)
    monkeypatch.setattr(order, "BATCH", 2000)
    monkeypatch.setattr(container, "HELD_BACK", 1000)
    monkeypatch.setattr(container, "BLOCK", 1000)
    peaks = []
    for marks in (100, 100, 800):
        page = crowd(marks)
        # What waits to be collected is no memory of the page's.
        gc.collect()
        tracemalloc.start()
        spent(page, format, options)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    # To know where pieces begin and in which order takes some 60 bytes for each mark, but its corners, which
    # take 768, are never all there.
    assert peaks[2] <= peaks[1] + 700 * 100
