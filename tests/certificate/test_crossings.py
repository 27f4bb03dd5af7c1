"""Borders and lines that do not meet across the seam are told of, with their place."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Layer
from batik_vector.certificate import Kind, Limits, certify
from tests.certificate.tiles import (
    AREAS,
    PEN,
    WAX,
    Points,
    accused,
    kinds,
    marks,
    moved,
    only,
    tile,
    vertex_moved,
    with_layers,
)


def test_an_edge_moved_by_a_twentieth_of_a_millimetre() -> None:
    broken = vertex_moved(tile(), "wax", (100, 26), (0, 0.05))
    fault = accused(broken, Kind.OFFSET, (100, 26))
    assert fault.amount == pytest.approx(0.05)
    assert "left edge at y = 26" in fault.words
    assert "right edge at y = 26.05" in fault.words
    assert certify(broken).worst.mismatch == pytest.approx(0.05)


def test_less_than_the_limit_is_measured_and_let_pass() -> None:
    nearly = vertex_moved(tile(), "wax", (100, 26), (0, 0.00007))
    certificate = certify(nearly)
    assert certificate.faults == ()
    assert certificate.worst.mismatch == pytest.approx(0.00007, abs=1e-6)
    assert not certify(nearly, limits=Limits(position=0.00005)).passed


def shrunk(artwork: Artwork, side: float, by: float) -> Artwork:
    """The tile whose bar stops short of an edge at x = side."""

    def change(xy: Points) -> Points:
        hit = (xy[:, 0] == side) & (xy[:, 1] > 10) & (xy[:, 1] < 30)
        assert hit.any() or len(xy) < 6
        xy[hit, 0] -= by
        return xy

    return moved(artwork, "wax", change)


def test_a_gap_of_a_hundredth_of_a_millimetre() -> None:
    fault = accused(shrunk(tile(), 100, 0.01), Kind.UNPAIRED, (100, 23))
    assert "right edge" in fault.words
    assert "stops 0.01 mm short" in fault.words
    assert fault.where[0] == 100


def test_a_wrong_drop_is_told_as_one_shift() -> None:
    broken = replace(tile(Fraction(1, 4)), cell=tile().cell)
    fault = accused(broken, Kind.SHIFT, (0, 3))
    assert 'repeats as "drop 1/4"' in fault.words
    assert fault.amount == pytest.approx(20)
    assert kinds(certify(broken)) == {"shift"}
    back = accused(replace(tile(), cell=tile(Fraction(1, 4)).cell), Kind.SHIFT, (0, 23))
    assert 'repeats as "grid"' in back.words


def test_half_a_drawing_moved_along_the_seam_is_told_as_one_shift() -> None:
    def lifted(geometries: Geometries) -> Geometries:
        right = shapely.bounds(geometries).reshape(-1, 4)[:, 0] > 64
        geometries = geometries.copy()
        geometries[right] = shapely.transform(geometries[right], lambda xy: xy + (0, 1.3))
        return geometries

    artwork = tile(areas=[AREAS[0], [(-20, 40), (20, 40), (20, 45), (-20, 45)]])
    layers = [Layer(layer.ink, lifted(layer.areas), lifted(layer.lines)) for layer in artwork.layers]
    fault = accused(with_layers(artwork, layers), Kind.SHIFT, (0, 20.65))
    assert fault.amount == pytest.approx(1.3)
    assert "if the right edge were moved 1.3 mm down" in fault.words


def test_a_motif_clipped_at_the_edge() -> None:
    def keep(bounds: Points) -> bool:
        return not (bounds[0] == 0 and bounds[1] > 10)

    fault = accused(only(tile(), "wax", keep), Kind.UNPAIRED, (100, 23))
    assert fault.amount == pytest.approx(6)
    assert "bare at the left edge" in fault.words
    assert "short" not in fault.words


def test_a_page_one_pixel_too_wide() -> None:
    pixel = 25.4 / 96
    artwork = tile()
    broken = replace(artwork, cell=Cell(100_000 + round(1000 * pixel), 80_000))
    for place in ((100, 23), (100, 60)):
        fault = accused(broken, Kind.UNPAIRED, place)
        assert "stops 0.265 mm short" in fault.words


def test_a_page_one_pixel_too_narrow() -> None:
    broken = replace(tile(), cell=Cell(100_000 - 265, 80_000))
    fault = accused(broken, Kind.OFFSET, (99.7, 26))
    assert fault.amount == pytest.approx(0.0265, abs=0.0006)


def test_a_mark_without_its_other_half() -> None:
    fault = accused(only(tile(), "pen", lambda bounds: bool(bounds[0] != 80)), Kind.UNPAIRED, (0, 60))
    assert "none goes on at the right edge at y = 60" in fault.words


def test_a_vertex_pushed_in_at_one_edge() -> None:
    def dented(mark: shapely.Polygon) -> shapely.Polygon:
        if mark.bounds[:3:2] != (70, 100) or mark.bounds[1] != 17:
            return mark
        return shapely.Polygon(
            [(70, 17), (100, 20), (100, 22.5), (99.98, 23), (100, 23.5), (100, 26), (70, 23)]
        )

    artwork = tile()
    layers = [
        replace(layer, areas=marks([dented(each).exterior.coords for each in layer.areas]))
        for layer in artwork.layers
    ]
    fault = accused(with_layers(artwork, layers), Kind.UNPAIRED, (100, 23))
    assert fault.amount == pytest.approx(1)
    assert "stops 0.02 mm short" in fault.words


def test_a_line_that_stops_short() -> None:
    fault = accused(vertex_moved(tile(), "pen", (100, 60), (-0.1, -0.02)), Kind.UNPAIRED, (99.9, 59.98))
    assert "one stops 0.102 mm short" in fault.words
    assert fault.amount == pytest.approx(0.102, abs=0.001)


def test_a_line_out_of_register() -> None:
    fault = accused(vertex_moved(tile(), "pen", (30, 80), (0.03, 0)), Kind.OFFSET, (30, 80))
    assert fault.amount == pytest.approx(0.03)
    assert "upper edge at x = 30.03" in fault.words


def test_lines_may_meet_branch_and_touch_on_the_seam() -> None:
    lines = [
        [(-9, 40), (0, 40), (9, 44)],
        [(0, 40), (9, 36)],
        # It runs along the seam for a while; and one only touches it.
        [(-5, 50), (0, 52), (0, 55), (5, 57)],
        [(6, 68), (0, 70), (6, 72)],
        # It leaves by one corner of the page and comes in by the one across.
        [(-4, -4), (5, 5)],
    ]
    assert certify(tile(lines=lines)).faults == ()


def test_inks_are_not_taken_for_one_another() -> None:
    artwork = tile()
    half = artwork.layers[0]
    left = shapely.bounds(half.areas)[:, 0] < 1
    other = replace(WAX, name="other")
    parts = [Layer(WAX, half.areas[left]), Layer(other, half.areas[~left])]
    broken = with_layers(artwork, [*parts, Layer(PEN, lines=artwork.layers[1].lines)])
    assert {fault.ink for fault in certify(broken).faults} == {"wax", "other"}
