"""Clips cut for real, and a page that a pattern fills is the pattern's cell."""

from __future__ import annotations

import math

import pytest
import shapely

from batik_vector.certificate import certify
from batik_vector.importing import clips
from batik_vector.importing.svg import DrawingError, read_svg, read_tile
from tests.importing.drawings import svg

BARS = '<g {}><path d="M0 10h100v4H0zM0 48h100v4H0z"/></g>'


def area(inner: str) -> float:
    (layer,) = read_tile(svg(inner)).layers
    assert not len(layer.lines)
    return float(shapely.area(layer.areas).sum())


@pytest.mark.parametrize(
    ("clip", "expected"),
    [
        ('<clipPath id="c"><rect x="20" width="30" height="100"/></clipPath>', 240),
        ('<clipPath id="c" transform="translate(5)"><rect x="20" width="30" height="100"/></clipPath>', 240),
        ('<clipPath id="c"><path d="M0 0h9v99H0zM20 0h9v99h-9z"/></clipPath>', 144),
        ('<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/></clipPath>', 400),
        ('<clipPath id="c"><path clip-rule="evenodd" d="M0 0h40v99H0zM9 0h9v99H9z"/></clipPath>', 248),
        ('<clipPath id="d"><rect width="9" height="99"/></clipPath>'
         '<clipPath id="c" clip-path="url(#d)"><rect x="5" width="9" height="99"/></clipPath>', 32),
        ('<path id="m" d="M0 0h9v99H0z"/><clipPath id="c"><use href="#m" x="5"/></clipPath>', 72 + 72),
    ],
)  # fmt: skip
def test_areas_are_cut(clip: str, expected: float) -> None:
    found = area(
        clip.replace('<path id="m" d', '<path id="m" fill="none" d') + BARS.format('clip-path="url(#c)"')
    )
    assert found == pytest.approx(expected if 'id="m"' not in clip else 72, abs=1e-6)


def test_a_stroke_that_is_cut_becomes_its_body() -> None:
    clip = '<clipPath id="c"><path d="M0 0h60v100z"/></clipPath>'
    line = '<path d="M10 50H90" stroke="red" stroke-width="4" clip-path="url(#c)"/>'
    assert area(clip + line) == pytest.approx(4 * 30, abs=0.01)
    whole = clip.replace("M0 0h60v100z", "M0 0h100v100H0z")
    (layer,) = read_tile(svg(whole + line)).layers
    assert len(layer.lines) == 1


def test_nested_pages_cut_what_hangs_over() -> None:
    assert area('<svg width="10" height="10"><circle r="8"/></svg>') == pytest.approx(math.pi * 16, rel=1e-3)


def test_too_much_cutting_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clips, "MAX_CUT", 10)
    with pytest.raises(DrawingError, match="cutting its marks to their clips comes to more than 10 points"):
        area('<clipPath id="c"><circle r="30"/></clipPath>' + BARS.format('clip-path="url(#c)"'))


CELL = '<path d="M12 5l5 13-5 13-5-13z"/><circle cy="18" r="3"/><circle cx="24" cy="18" r="3"/>'
FULL = '<rect width="100%" height="100%" fill="url(#p)"/>'


@pytest.mark.parametrize(
    ("more", "size"),
    [
        ("", (6.35, 9.525)),
        ('patternTransform="scale(2)"', (12.7, 19.05)),
        ('patternTransform="translate(3 4) rotate(30) scale(2 1)"', (12.7, 9.525)),
        ('patternTransform="skewX(0)" x="7"', (6.35, 9.525)),
    ],
)
def test_a_page_filled_by_a_pattern_is_its_cell(more: str, size: tuple[float, float]) -> None:
    pattern = f'<pattern id="p" width="24" height="36" patternUnits="userSpaceOnUse" {more}>{CELL}</pattern>'
    reading = read_svg(svg(pattern + FULL, 'width="100%" height="100%"'))
    assert reading.page == pytest.approx(size)
    assert any('<pattern id="p">: its cell of' in note for note in reading.notes)
    assert certify(reading.artwork).passed


def test_cells_are_cut_to_the_mark_that_they_fill() -> None:
    pattern = (
        '<pattern id="p" width="10" height="10" patternUnits="userSpaceOnUse"><circle cx="10" cy="5" r="3"/>'
    )
    mark = '</pattern><rect x="20" y="20" width="40" height="35" fill="url(#p)"/>'
    assert area(pattern + mark) == pytest.approx(4 * 3.5 * math.pi * 4.5, rel=2e-3)
