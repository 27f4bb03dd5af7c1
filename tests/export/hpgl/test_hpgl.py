from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry.base import BaseGeometry

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.errors import ExportError, GeometryError
from batik_vector.export import HpglOptions, Pages, Turn, render
from batik_vector.export.hpgl import parts
from batik_vector.export.hpgl.sheets import crosses, planned
from batik_vector.machines.hpgl import Hpgl, HpglPage, Origin
from batik_vector.recipe.reading.machines import read_machine
from tests.export.drawings import geometries, line, sample

from .plotter import Drawn, plotted

A3 = HpglPage(name="a3", high=(16158, 11040))
SMALL = Hpgl(page=(HpglPage(name="s", high=(400, 300)), HpglPage(name="l", high=(900, 700))))


def page_of(width: float, height: float, *lines: BaseGeometry) -> Artwork:
    cell = Cell(round(width * 1000), round(height * 1000))
    return Artwork("Page", cell, (Layer(Ink("ink", "#000"), lines=geometries(*lines)),))


def flag(width: float = 20, height: float = 10) -> Artwork:
    """A page with strokes along its edges that no turn and no mirror maps to themselves."""
    return page_of(
        width, height, line((0, 0), (width, 0), (width, height)), line((0, 0), (0, height), (3, height))
    )


def drawn(artwork: Artwork, **options: Any) -> Drawn:
    return plotted(render(artwork, "hpgl", HpglOptions(**options)))


def length(paper: Drawn, pen: int) -> float:
    return sum(float(np.hypot(*np.diff(np.array(places), axis=0).T).sum()) for places in paper.of(pen))


@pytest.mark.parametrize("encoded", [False, True])
@pytest.mark.parametrize("bleed", [0.0, 3.0])
def test_each_ink_is_drawn_by_its_pen_as_long_as_it_is(bleed: float, encoded: bool) -> None:
    artwork = sample(bleed)
    paper = drawn(artwork, encoded=encoded)
    assert paper.pens == [1, 2, 3]
    for pen, layer in enumerate(artwork.layers, start=1):
        marks = [*shapely.boundary(layer.areas), *layer.lines]
        bounds = np.array(shapely.total_bounds(np.array(marks)))
        places = np.array([place for places in paper.of(pen) for place in places])
        found = np.array([*places.min(axis=0), *places.max(axis=0)])
        assert found == pytest.approx((bounds + bleed) * 40, abs=0.5)
        assert length(paper, pen) / 40 == pytest.approx(sum(mark.length for mark in marks), rel=0.002)


def test_a_file_is_as_a_plotter_wants_it() -> None:
    edges = b"PU120,400;PD0,400,0,0,800,0,800,400"
    assert render(flag(), "hpgl") == b"IN;\nSP1;\n" + edges + b";\nPU;\nSP0;\n"
    data = render(flag(), "hpgl", HpglOptions(speed=100, force=3))
    assert data.startswith(b"IN;VS10;FS3;\nSP1;\nPU")
    assert data.endswith(b";\nPU;\nSP0;\n")


def test_the_7550a_is_not_taken_for_a_7475a() -> None:
    """vpype issue 848: its unit is 0.48 % larger, 2 mm on A3."""
    wide = flag(390, 200)
    older, newer = (
        drawn(wide, device=read_machine(name).hpgl_device).bounds[2] for name in ("hp7475a", "hp7550a")
    )
    assert older == round(390 / 0.02488) == 15675
    assert newer == 390 * 40 == 15600
    assert (older - newer) * 0.025 == pytest.approx(1.9, abs=0.05)


@pytest.mark.parametrize("encoded", [False, True])
def test_short_steps_do_not_add_up_to_an_error(encoded: bool) -> None:
    """vpype pull request 335: 1,200 steps of 0.11 mm are as long as one of 132 mm."""
    steps = line(*((10, 0.11 * number) for number in range(1201)))
    art = page_of(20, 132, steps, line((1, 0), (1, 132)))
    for name in ("hp7475a", "hp7550a"):
        paper = drawn(
            art, device=replace(read_machine(name).hpgl_device, encoded=True), encoded=encoded, turn=Turn.NONE
        )
        tops = {max(y for _, y in places) for places in paper.of(1)}
        assert len(paper.strokes) == 2
        assert tops == {round(132 / read_machine(name).hpgl.unit)}


@given(
    st.integers(1000, 1_000_000),
    st.lists(st.tuples(st.integers(0, 200_000), st.integers(0, 100_000)), min_size=2, max_size=6),
    st.sampled_from([Turn.NONE, Turn.LEFT, Turn.OVER, Turn.RIGHT]),
    st.booleans(),
)
@settings(deadline=None)
def test_every_place_is_at_most_half_a_unit_off(
    unit: int, places: list[tuple[int, int]], turn: Turn, downwards: bool
) -> None:
    size = 200_000, 100_000
    mm = np.array(places) / 1000
    if len(np.unique(mm, axis=0)) < 2:
        return
    art = page_of(200, 100, line(*mm))
    device = Hpgl(unit=unit / 1_000_000, downwards=downwards)
    data = render(art, "hpgl", HpglOptions(device=device, turn=turn, order=False), check=False)
    quarters = [Turn.NONE, Turn.LEFT, Turn.OVER, Turn.RIGHT].index(turn)
    middle = mm - np.array(size) / 2000
    for _ in range(quarters):
        middle = np.column_stack([-middle[:, 1], middle[:, 0]])
    sides = np.array(size if quarters % 2 == 0 else size[::-1]) / 1000
    wanted = middle + sides / 2
    if downwards:
        wanted[:, 1] = sides[1] - wanted[:, 1]
    found = np.array([place for _, stroke in plotted(data).strokes for place in stroke])
    if not len(found):
        # Less than a unit long: nothing to draw.
        assert np.ptp(wanted, axis=0).max() <= unit / 1_000_000
        return
    for place in wanted:
        off = np.abs(found * unit / 1_000_000 - place).max(axis=1).min()
        assert off <= unit / 2_000_000 + 1e-9


def test_a_turn_never_mirrors() -> None:
    """The mast of the flag is on the left of who walks from its longer stroke's beginning to its end."""
    for turn in Turn:
        for stroke in drawn(flag(), turn=turn, order=False).of(1):
            if len(stroke) == 3:
                (ax, ay), (bx, by), (cx, cy) = stroke
                signs = (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
                assert abs(signs) in (800 * 400, 400 * 120)
                assert (signs > 0) == (abs(signs) == 800 * 400)


def test_where_a_drawing_lies_does_not_hang_on_what_is_drawn() -> None:
    """vpype-gcode issue 37."""
    whole = flag()
    part = replace(whole, layers=(replace(whole.layers[0], lines=whole.layers[0].lines[:1], line_names=()),))
    for place in Origin:
        device = Hpgl(page=(A3,), origin=place)
        first, second = (drawn(art, device=device, order=False).of(1)[0] for art in (whole, part))
        assert first == second


def test_machines_that_count_from_the_middle_get_the_drawing_there() -> None:
    """vpype issue 269."""
    device = read_machine("hp7580b").hpgl_device
    assert drawn(flag(), device=device).bounds == (-400, -200, 400, 200)
    assert drawn(flag(), device=device, place="corner").bounds == (-3120, -5340, -2320, -4940)
    assert drawn(flag(), place="centre").bounds == (-400, -200, 400, 200)


def test_a_drawing_lies_on_the_first_sheet_that_it_fits_and_is_turned_where_it_must() -> None:
    assert drawn(flag(10, 7), device=SMALL).bounds == (0, 0, 400, 280)
    assert drawn(flag(7, 10), device=SMALL).bounds == (0, 0, 400, 280)
    assert drawn(flag(20, 10), device=SMALL).bounds == (0, 0, 800, 400)
    assert drawn(flag(10, 7), device=SMALL, page="L", place="centre").bounds == (250, 210, 650, 490)
    assert drawn(flag(10, 7), page="30 x 20 mm", place="centre").bounds == (400, 260, 800, 540)


def test_a_sheet_of_the_very_size_is_large_enough() -> None:
    device = read_machine("hp7475a").hpgl_device
    width, height = (round(side * 24.88) / 1000 for side in (11040, 7721))
    art = page_of(width, height, line((0, 0), (width, height)))
    assert drawn(art, device=device, page="a4").bounds == (0, 0, 11040, 7721)
    with pytest.raises(ExportError, match="the machine can draw on a4"):
        drawn(page_of(width + 0.025, height), device=device, page="a4")


OLD = read_machine("hp7475a").hpgl_device
TILES: dict[str, Any] = {"device": SMALL, "page": "s", "pages": "tile", "overlap": 1}
REFUSED: list[tuple[dict[str, Any], str]] = [
    ({"device": SMALL, "margin": 5}, r'is 30 x 20 mm, .* s \(10 x 7.5 mm\), l \(22.5 x 17.5 mm\): .*"tile"'),
    ({"device": SMALL, "page": "s"}, r'expected page = "l", or pages = "tile"'),
    ({"device": SMALL, "page": "xl"}, r'page = "xl": the machine has s, l'),
    ({"page": "a4"}, r'no sheets of its own; expected one of them, or a size as "420 x 297 mm"'),
    ({"pages": "tile"}, r'"tile" needs to know the page'),
    (TILES | {"overlap": 4}, r"overlap = 4 mm, expected at most 3.75 mm"),
    (TILES, r"divided over 1 x 3 pages, .*sheet"),
    (TILES | {"turn": "none"}, r"divided over 3 x 2 pages, .*sheet"),
    (TILES | {"sheet": (2, 1)}, r"at most \[1, 3\]"),
    ({"encoded": True, "device": OLD}, r"encoded = true, expected false"),
    ({"speed": 400, "device": OLD}, r"speed = 400 mm/s, expected at most 381"),
    ({"force": 3, "device": OLD}, r"force = 3, expected none: it takes no FS"),
    ({"pens": (1, 2)}, r"pens names 2, expected 1: one for each of ink"),
    ({"pens": (9,)}, r"pens = \[9\], expected at most 8"),
]


@pytest.mark.parametrize(("options", "words"), REFUSED)
def test_what_a_machine_cannot_do_is_refused(options: dict[str, Any], words: str) -> None:
    with pytest.raises(ExportError, match=words):
        drawn(flag(), **options)


def test_more_inks_than_pens_want_to_be_told() -> None:
    one = Hpgl(pens=1)
    with pytest.raises(ExportError, match=r"3 inks, and the machine changes 1 pen by itself: .*\[1, 1, 1\]"):
        drawn(sample(), device=one)
    assert drawn(sample(), device=one, pens=(1, 1, 1)).pens == [1]
    assert drawn(sample(), device=one, pens=(0, 1, 0)).of(1) == drawn(sample()).of(2)
    assert drawn(sample(), pens=(3, 2, 1)).pens == [3, 2, 1]


def test_strokes_outside_the_drawing_are_not_cut_off_unseen() -> None:
    art = flag()
    beyond = replace(art, layers=(Layer(Ink("i", "#000"), lines=geometries(line((-1, 5), (5, 5)))),))
    device = Hpgl(page=(A3,))
    with pytest.raises(ExportError, match=r'strokes go 1 mm beyond .*: expected margin = "1 mm", or more'):
        render(beyond, "hpgl", HpglOptions(device=device), check=False)
    found = plotted(render(beyond, "hpgl", HpglOptions(device=device, margin=1), check=False))
    assert found.bounds == (0, 240, 240, 240)


def test_without_a_known_page_nothing_is_written_below_the_origin() -> None:
    art = flag()
    beyond = replace(art, layers=(Layer(Ink("i", "#000"), lines=geometries(line((-1, 5), (5, 5)))),))
    with pytest.raises(ExportError, match=r'go 1 mm beyond the origin.*: expected margin = "1 mm", or more'):
        render(beyond, "hpgl", HpglOptions(), check=False)
    found = plotted(render(beyond, "hpgl", HpglOptions(margin=1), check=False))
    assert found.bounds == (0, 240, 240, 240)
    # Counted from the middle of a sheet, half of all lies below.
    centred = plotted(render(beyond, "hpgl", HpglOptions(place=Origin.CENTRE), check=False))
    assert centred.bounds[0] < 0


def test_an_overlap_belongs_to_pages() -> None:
    with pytest.raises(GeometryError, match=r'overlap = 5, expected pages = "tile" beside it'):
        HpglOptions(overlap=5)
    assert HpglOptions(overlap=5, pages=Pages.TILE).overlap == 5


def test_the_margin_that_would_do_is_that_of_all_pens() -> None:
    lines = [line((-near, 5), (5, 5)) for near in (1, 3, 2)]
    layers = tuple(Layer(Ink(f"i{n}", "#000"), lines=geometries(each)) for n, each in enumerate(lines))
    with pytest.raises(ExportError, match=r'strokes go 3 mm beyond .*: expected margin = "3 mm", or more'):
        render(replace(flag(), layers=layers), "hpgl", HpglOptions(device=Hpgl(page=(A3,))), check=False)


@pytest.mark.parametrize("encoded", [False, True])
@pytest.mark.parametrize("overlap", [0.0, 2.0, 3.7])
def test_tiles_laid_by_their_marks_show_the_drawing(overlap: float, encoded: bool) -> None:
    art = sample()
    device = Hpgl(page=(HpglPage(name="s", low=(-100, 50), high=(500, 450)),))
    options = HpglOptions(device=device, pages=Pages.TILE, overlap=overlap, encoded=encoded, turn=Turn.NONE)
    found: dict[int, list[shapely.Geometry]] = {}
    names = []
    for name, own in parts(art, options):
        names.append(name)
        paper = plotted(render(art, "hpgl", replace(options, **own)))
        assert paper.bounds[0] >= -100
        assert paper.bounds[1] >= 50
        assert paper.bounds[2] <= 500
        assert paper.bounds[3] <= 450
        column, row = own["sheet"]
        units = round(overlap * 40)
        move = np.array([100 + (column - 1) * (600 - units), -50 + (row - 1) * (400 - units)])
        for pen, places in paper.strokes:
            found.setdefault(pen, []).append(shapely.LineString(np.array(places) + move))
    assert names[:2] == ["p1x1", "p2x1"]
    plan = planned(art, options)
    ends, offsets = crosses(plan, plan.sheets[0])
    marks = shapely.union_all([shapely.LineString(each) for each in np.split(ends, offsets[1:-1])]).buffer(1)
    whole = drawn(art)
    for pen in (1, 2, 3):
        one = shapely.union_all([shapely.LineString(places) for places in whole.of(pen)])
        many = shapely.union_all(found[pen])
        # Where a stroke passes an edge its place there is rounded, half a unit at most.
        assert shapely.hausdorff_distance(many.difference(marks), one.difference(marks)) < 1.5


def test_neighbouring_tiles_share_their_crosses() -> None:
    bare = page_of(25, 9, line((0, 0), (0.1, 0)))
    device = Hpgl(page=(HpglPage(name="s", high=(600, 400)),))
    options = HpglOptions(device=device, pages=Pages.TILE, overlap=5)
    sheets = [plotted(render(bare, "hpgl", replace(options, **own))) for _, own in parts(bare, options)]
    assert len(sheets) == 2
    step = 600 - 200
    for left, right in itertools.pairwise(sheets):
        ours = {tuple((x, y) for x, y in sorted(places)) for places in left.of(1) if max(places)[0] > 300}
        theirs = {
            tuple((x + step, y) for x, y in sorted(places)) for places in right.of(1) if max(places)[0] < 300
        }
        assert len(ours) == 4
        assert ours == theirs


def test_the_recipe_is_carried_where_that_is_asked_for(tmp_path: Any) -> None:
    from batik_vector.export.provenance import read_provenance

    path = tmp_path / "flag.hpgl"
    path.write_bytes(render(sample(), "hpgl", HpglOptions(comment=True)))
    assert read_provenance(path) == sample().provenance
    assert plotted(path.read_bytes()).strokes == drawn(sample()).strokes
    assert b"CO" not in render(sample(), "hpgl")
