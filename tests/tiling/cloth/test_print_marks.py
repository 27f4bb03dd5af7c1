"""Marks for printers: where they stand, and on which plates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.geometry import lettering
from batik_vector.geometry.outlines import to_polygons, together
from batik_vector.making.pages import page_size, size_of
from batik_vector.recipe.outputs import PdfOutput
from batik_vector.tiling.cloth.field import field_page
from batik_vector.tiling.cloth.print_marks import with_print_marks
from batik_vector.tiling.cloth.spec import YardageSpec
from batik_vector.tiling.cloth.yardage import Yardage, compile_yardage


def artwork(width: int = 60, names: tuple[str, ...] = ("wax", "soga brown", "Indigo/2 ünïcode")) -> Artwork:
    areas = np.array([shapely.box(1, 1, 5, 5), None], dtype=object)[:-1]
    layers = tuple(Layer(Ink(name, "#a03020"), areas) for name in names)
    return Artwork("Kawung", Cell(width * 1000, 40_000), layers)


def outside(page: Yardage, number: int) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """The areas of a plate that stand in the margin."""
    areas = to_polygons(together(list(page.areas(number))), 1000)
    trim = shapely.box(-page.bleed, -page.bleed, page.cell.width + page.bleed, page.cell.height + page.bleed)
    return np.asarray(areas[~shapely.intersects(areas, trim)], dtype=object)


@pytest.mark.parametrize("bleed", [0.0, 3.0])
@pytest.mark.parametrize("width", [12, 60, 300])
def test_every_plate_has_its_patch_and_its_name_and_they_are_apart(bleed: float, width: int) -> None:
    page = with_print_marks(field_page(artwork(width), bleed=bleed))
    margins = page.margins
    sheet = shapely.box(
        -margins.left / 1000,
        -margins.bottom / 1000,
        page.cell.width + margins.right / 1000,
        page.cell.height + margins.top / 1000,
    )
    marks = [outside(page, number) for number in range(3)]
    for each in marks:
        assert shapely.is_valid(each).all()
        assert sorted(shapely.area(each))[-1] == pytest.approx(36)
        assert len(each) > 2
        assert shapely.contains_properly(sheet, each).all()
    hulls = [shapely.union_all(each).envelope for each in marks]
    guides = page.guides.outlines() if page.guides else None
    assert guides is not None
    lines = shapely.union_all([shapely.LineString(part) for part in guides.points.reshape(-1, 2, 2) / 1000])
    for number, hull in enumerate(hulls):
        assert hull.disjoint(lines)
        assert all(hull.disjoint(other) for other in hulls[:number])


def test_no_two_guides_are_the_same_stroke() -> None:
    page = with_print_marks(field_page(artwork(), bleed=3.0))
    assert page.guides is not None
    ends = page.guides.outlines().points.reshape(-1, 4)
    assert len(np.unique(ends, axis=0)) == len(ends)
    assert page.plates[-1].guide


@pytest.mark.parametrize("marks", [False, True])
@pytest.mark.parametrize("width", [12, 60])
def test_the_size_that_is_told_is_the_pages(width: int, marks: bool) -> None:
    output = PdfOutput(bleed=2.5, marks=marks)
    page = field_page(artwork(width), bleed=2.5)
    found = page_size(with_print_marks(page) if marks else page)
    assert size_of(artwork(width), output) == pytest.approx(found)


@pytest.mark.parametrize("marks", [False, True])
def test_a_cloth_keeps_its_own_marks(marks: bool) -> None:
    cloth = compile_yardage(artwork(), YardageSpec(width=200, length=300, marks=marks))
    page = with_print_marks(cloth)
    if marks:
        assert page.guides == cloth.guides
        assert page.margins == replace(cloth.margins, bottom=page.margins.bottom)
    assert page.margins.bottom > cloth.margins.bottom
    assert len(outside(page, 0)) > 2


def test_letters_stand_on_their_grid() -> None:
    for letter in lettering._STROKES:
        for stroke in lettering.lettered(letter, 6.0):
            assert len(stroke) > 1
            assert (stroke >= 0).all()
            assert (stroke <= (4, 6)).all()
            assert np.hypot(*np.diff(stroke, axis=0).T).min() > 0
    assert lettering.length_of("AB", 6.0) == 10
    assert max(stroke[:, 0].max() for stroke in lettering.lettered("AB", 6.0)) == 10
    assert lettering.length_of("", 6.0) == 0


def test_what_is_not_in_the_alphabet_is_told() -> None:
    def shown(words: str) -> list[list[float]]:
        return [stroke.ravel().tolist() for stroke in lettering.lettered(words, 3.0)]

    assert shown("Öl") == shown("OL")
    assert shown("蠟") == shown("?")
