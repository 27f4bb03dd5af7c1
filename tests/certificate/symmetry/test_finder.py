"""The group of a tile is found from its geometry: patterns made by the textbook, and what breaks them."""

from __future__ import annotations

import itertools
from fractions import Fraction
from math import cos, pi, sin

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Cell, DropAxis, Geometries, Ink, Layer
from batik_vector.certificate.symmetry.finder import found_group
from batik_vector.certificate.symmetry.lattice import IDENTITY, closed
from batik_vector.certificate.symmetry.operations import FoundGroup, OperationKind
from tests.certificate.positions import (
    BLUE,
    HEXAGONAL,
    ORDERS,
    POSITIONS,
    RED,
    SQUARE,
    Repeat,
    dropped,
    orbit,
    random_tile,
    upright,
    with_dot,
)
from tests.thorough import rarely

SQUARE_CELL = Cell(100_000, 100_000)
STRETCHABLE = (*SQUARE, *HEXAGONAL)


def marks(*shapes: shapely.Geometry) -> Geometries:
    found = np.empty(len(shapes), dtype=object)
    found[:] = shapes
    return found


def group_of(cell: Cell, *areas: shapely.Geometry) -> FoundGroup:
    return found_group([Layer(RED, marks(*areas))], cell)


def expected_copies(group: str, repeat: Repeat) -> int:
    centred = 2 if group in ("cm", "cmm") else 1
    return round(ORDERS[group] * centred * repeat.cells)


@pytest.mark.parametrize(
    ("group", "across", "up"),
    rarely([(group, *size) for group in POSITIONS for size in ((1, 1), (2, 1), (1, 3), (2, 2))], 3),
)
def test_each_group_is_found_in_any_supercell(group: str, across: int, up: int) -> None:
    repeat = upright(group, across=across, up=up)
    found = found_group(random_tile(group, repeat, seed=31 * across + up), repeat.cell)
    assert (found.name, found.copies) == (group, expected_copies(group, repeat))
    assert found.deviation < 0.01
    assert found.stretch < 0.01


@pytest.mark.parametrize("group", rarely(list(POSITIONS), 3))
def test_each_group_is_found_in_a_cell_with_a_drop(group: str) -> None:
    repeat = dropped(group)
    found = found_group(random_tile(group, repeat, seed=5), repeat.cell)
    assert (found.name, found.copies) == (group, expected_copies(group, repeat))


@pytest.mark.parametrize("drop", [Fraction(1, 3), Fraction(2, 5)])
@pytest.mark.parametrize("axis", DropAxis)
def test_a_drop_of_any_part_is_a_lattice_like_another(drop: Fraction, axis: DropAxis) -> None:
    plain = upright("p2", 60_000)
    repeat = Repeat(plain.cell, plain.basis)
    cell = Cell(repeat.cell.columns, 49_800, drop, axis)
    (a, b), (c, d) = cell.lattice
    oblique = Repeat(cell, np.array([[a, c], [b, d]]) / 1000)
    found = found_group(random_tile("p2", oblique, seed=8), cell)
    assert (found.name, found.copies) == ("p2", 2)


@pytest.mark.parametrize("group", STRETCHABLE)
def test_a_stretched_lattice_keeps_its_group_and_tells_the_stretch(group: str) -> None:
    repeat = upright(group, stretch=0.006)
    found = found_group(random_tile(group, repeat, seed=3), repeat.cell)
    assert found.name == group
    assert found.stretch == pytest.approx(0.6, abs=0.01)


def test_too_large_a_stretch_makes_another_group() -> None:
    repeat = upright("p6m", stretch=0.03)
    layers = random_tile("p6m", repeat, seed=3)
    assert found_group(layers, repeat.cell).name == "cmm"
    assert found_group(layers, repeat.cell, stretch=0.04).name == "p6m"


def test_marks_that_kept_their_shape_on_a_stretched_lattice_are_put_up_with() -> None:
    # 26 : 15 for √3 : 1, a rosette drawn unstretched in it.
    cell = Cell(60_000, 104_000)
    spokes = [shapely.Point(24 * cos(k * pi / 3), 24 * sin(k * pi / 3)).buffer(4, 64) for k in range(6)]
    rosette = [shapely.affinity.translate(s, x, y) for s in spokes for x, y in ((30, 26), (0, 78), (60, 78))]
    found = found_group([Layer(RED, marks(*rosette))], cell, tolerance=0.005)
    assert found.name == "p6m"
    assert found.stretch == pytest.approx(0.074, abs=0.001)
    assert 0.014 < found.deviation < 0.035


@pytest.mark.parametrize("group", rarely([group for group in POSITIONS if group != "p1"], 3))
def test_one_small_dot_breaks_every_group(group: str) -> None:
    repeat = upright(group, 100_000)
    layers = random_tile(group, repeat, seed=11, reach=12)
    covered = shapely.union_all(layers[0].areas)
    bare = [(x + 0.37, y + 0.61) for x in range(5, 95, 9) for y in range(5, 75, 9)]
    at = next(place for place in bare if covered.distance(shapely.Point(place)) > 1)
    found = found_group(with_dot(layers, at), repeat.cell)
    assert (found.name, found.copies) == ("p1", 1)
    assert found.misses, "nothing is said of the symmetry that is nearly there"
    miss = found.misses[0]
    assert miss.ink == "red"
    assert miss.share > 0.97
    assert np.hypot(miss.place[0] - at[0], miss.place[1] - at[1]) < 0.2 or miss.deviation > 0.5


def test_a_dot_on_a_mirror_leaves_the_mirror() -> None:
    repeat = upright("pmm", 100_000)
    discs = orbit(shapely.Point(17, 11).buffer(5, 16), "pmm", repeat, (0.0, 0.0))
    shape = orbit(shapely.box(20, 22, 30, 24), "pmm", repeat, (0.0, 0.0))
    dot = shapely.Point(50, 30).buffer(0.15)
    found = group_of(repeat.cell, *discs, *shape, dot)
    assert found.name == "pm"
    (mirror,) = found.operations
    assert mirror.kind == OperationKind.MIRROR
    assert mirror.axis == pytest.approx(90)
    assert mirror.place[0] % 50 == pytest.approx(0, abs=0.01)


def test_a_place_where_a_translation_breaks_is_told() -> None:
    discs = [shapely.Point(5 + 10 * i, 5 + 10 * j).buffer(3, 16) for i in range(10) for j in range(10)]
    assert group_of(SQUARE_CELL, *discs).copies == 800
    discs[37] = shapely.affinity.translate(discs[37], 0.1, 0.03)
    found = group_of(SQUARE_CELL, *discs)
    assert (found.name, found.copies) == ("p1", 1)
    moved = discs[37].centroid
    for miss in found.misses:
        assert miss.deviation == pytest.approx(0.1, abs=0.06)
        x, y = miss.place
        # The mark that was moved, or the one that has no image because of it.
        assert min(abs(np.hypot(x - moved.x, y - moved.y) - 3), miss.deviation) < 0.2


def regular(sides: int, radius: float, turn: float, at: tuple[float, float]) -> shapely.Polygon:
    angles = [turn + 2 * pi * k / sides for k in range(sides)]
    return shapely.Polygon([(at[0] + radius * cos(t), at[1] + radius * sin(t)) for t in angles])


@pytest.mark.parametrize(
    ("shape", "group"),
    [
        (shapely.Point(0, 0).buffer(9, 32), "p6m"),
        (regular(3, 10, 0.0, (0, 0)), "p31m"),
        (regular(3, 10, pi / 2, (0, 0)), "p3m1"),
        (regular(6, 10, 0.2, (0, 0)), "p6"),
        (regular(4, 10, 0.0, (0, 0)), "cmm"),
        (regular(5, 10, pi / 2, (0, 0)), "cm"),
        (regular(5, 10, 0.3, (0, 0)), "p1"),
    ],
)
def test_a_symmetric_mark_may_bring_more_than_was_asked_for(shape: shapely.Polygon, group: str) -> None:
    repeat = upright("p6m", 48_000)
    assert found_group([Layer(BLUE, orbit(shape, "p1", repeat, (3, 4)))], repeat.cell).name == group


@pytest.mark.parametrize(
    ("shape", "group"),
    [
        (shapely.Point(30, 20).buffer(8, 32), "p4m"),
        (shapely.box(10, 10, 40, 20), "pmm"),
        (shapely.Polygon([(10, 10), (30, 10), (40, 20), (20, 20)]), "p2"),
        (regular(4, 9, 0.4, (50, 50)), "p4"),
    ],
)
def test_a_plain_repeat_of_a_symmetric_mark(shape: shapely.Polygon, group: str) -> None:
    found = group_of(SQUARE_CELL, shape)
    assert (found.name, found.copies) == (group, ORDERS[group])


def test_a_mark_across_the_seam_has_no_edge_there() -> None:
    disc = shapely.Point(0, 0).buffer(20, 32)
    corners = [shapely.affinity.translate(disc, x, y) for x in (0, 100) for y in (0, 100)]
    pieces = shapely.get_parts(shapely.intersection(np.array(corners), shapely.box(0, 0, 100, 100)))
    assert group_of(SQUARE_CELL, *pieces).name == "p4m"
    assert group_of(SQUARE_CELL, *pieces[:3]).name == "cm"


def test_inks_are_told_apart() -> None:
    squares = [shapely.box(10 * i, 10 * j, 10 * i + 10, 10 * j + 10) for i in range(10) for j in range(10)]
    black = [square for k, square in enumerate(squares) if (k + k // 10) % 2]
    white = [square for k, square in enumerate(squares) if not (k + k // 10) % 2]
    board = [Layer(RED, marks(*black)), Layer(BLUE, marks(*white))]
    found = found_group(board, SQUARE_CELL)
    assert (found.name, found.copies) == ("p4m", 400)
    # Squares of a lattice half as fine: changing black and white is no symmetry.
    assert found.translations == ((10.0, 10.0), (-10.0, 10.0))
    assert group_of(SQUARE_CELL, *black).translations == found.translations


def test_the_covered_side_must_stay_covered() -> None:
    # A shift by one square brings every edge onto an edge, in all inks, but black onto white.
    middles = [(10 * i + 5, 10 * j + 5) for i in range(6) for j in range(6)]
    black = [shapely.box(x - 5, y - 5, x + 5, y + 5) for x, y in middles if (x + y) % 20]
    layers = [Layer(RED, marks(*black))]
    for number in range(4):
        discs = shapely.buffer(shapely.points(middles), 1 + number, quad_segs=8)
        layers.append(Layer(Ink(f"ring {number}", "#a86f3a"), np.asarray(discs)))
    found = found_group(layers, Cell(60_000, 60_000))
    assert (found.name, found.copies) == ("p4m", 18 * 8)
    assert found.misses[0].ink == "red"


@pytest.mark.parametrize("group", ["p1", "p2", "pg", "cm", "pgg", "p4g", "p31m"])
def test_a_pattern_of_lines_alone(group: str) -> None:
    repeat = upright(group)
    stroke = shapely.LineString([(20, 3), (31, 9), (24, 15), (27, 21)])
    found = orbit(stroke, group, repeat, (7.3, 2.9))
    lines = found[shapely.get_type_id(found) == shapely.GeometryType.LINESTRING]
    assert found_group([Layer(RED, lines=lines)], repeat.cell).name == group


def bars(cell: Cell, *bands: tuple[float, float]) -> list[shapely.Polygon]:
    return [shapely.box(0, low, cell.width, high) for low, high in bands]


@pytest.mark.parametrize(
    ("bands", "group", "period"),
    [
        ([(10, 20)], "pmm", 100.0),
        ([(10, 20), (60, 70)], "pmm", 50.0),
        ([(10, 20), (30, 33), (40, 41)], "pm", 100.0),
        ([(0, 5), (95, 100)], "pmm", 100.0),
    ],
)
def test_plain_stripes(bands: list[tuple[float, float]], group: str, period: float) -> None:
    found = group_of(SQUARE_CELL, *bars(SQUARE_CELL, *bands))
    assert found.name == group
    assert found.continuous == pytest.approx((1, 0))
    assert found.note
    assert min(abs(y) for x, y in found.translations if abs(y) > 1) == pytest.approx(period)


def test_slanting_stripes_and_broken_ones() -> None:
    slant = Layer(RED, lines=marks(shapely.LineString([(0, 0), (60, 40)])))
    found = found_group([slant], Cell(60_000, 80_000, Fraction(1, 2)))
    assert found.name == "pmm"
    assert found.continuous == pytest.approx((0.83205, 0.5547), abs=1e-4)
    dashes = Layer(RED, lines=marks(*(shapely.LineString([(0, y), (99, y)]) for y in (5, 30, 70))))
    broken = found_group([dashes], SQUARE_CELL)
    assert (broken.name, broken.continuous) == ("pm", None)


def test_bars_that_cross_the_whole_tile() -> None:
    across = shapely.box(0, 10, 100, 20)
    assert group_of(SQUARE_CELL, across, shapely.box(40, 0, 50, 100)).name == "p4m"
    assert group_of(SQUARE_CELL, across, shapely.box(40, 0, 55, 100)).name == "pmm"


@pytest.mark.parametrize(
    "layers", [[], [Layer(RED)], [Layer(RED, marks(shapely.box(0, 0, 100, 100)))]], ids=str
)
def test_a_blank_tile_is_said_to_be_one(layers: list[Layer]) -> None:
    found = found_group(layers, SQUARE_CELL)
    assert (found.name, found.copies, found.misses) == ("p1", 1, ())
    assert "blank" in found.note


def test_a_foreign_tile_need_not_be_in_the_normal_form() -> None:
    repeat = upright("p4g", 50_000)
    layers = random_tile("p4g", repeat, seed=21)
    rough = np.random.default_rng(2)

    def foreign(area: shapely.Polygon) -> shapely.Polygon:
        ring = np.asarray(area.exterior.coords)[::-1].copy()
        ring[:-1] += rough.uniform(-0.003, 0.003, (len(ring) - 1, 2))
        ring[-1] = ring[0]
        return shapely.Polygon(ring)

    # Wrong way round, off the grid, each area twice, one reaching beyond the page.
    loose = [Layer(layer.ink, marks(*map(foreign, [*layer.areas, *layer.areas]))) for layer in layers]
    found = found_group(loose, repeat.cell)
    assert found.name == "p4g"
    bowtie = shapely.Polygon([(10, 10), (30, 30), (30, 10), (10, 30)])
    assert group_of(Cell(40_000, 40_000), bowtie).name == "pmm"


def test_curves_sampled_differently_in_every_copy_agree_within_the_tolerance() -> None:
    repeat = upright("p4", 60_000)
    angles = np.linspace(0, 2 * pi, 60, endpoint=False)
    copies = []
    for number, turn in enumerate((0.0, pi / 2, pi, -pi / 2)):
        t = angles + 0.03 * number
        r = 6 + 1.5 * np.cos(t) + np.sin(2 * t)
        x, y = 12 + r * np.cos(t), 14 + r * np.sin(t)
        across, up = x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn)
        copies.append(shapely.Polygon(np.column_stack([30 + across, 30 + up])))
    found = found_group([Layer(RED, marks(*copies))], repeat.cell, tolerance=0.02)
    assert found.name == "p4"
    assert 0.001 < found.deviation < 0.044
    assert found_group([Layer(RED, marks(*copies))], repeat.cell, tolerance=0.0).name == "p1"


def test_operations_map_the_pattern_onto_itself() -> None:
    repeat = upright("p4g", 50_000)
    layers = random_tile("p4g", repeat, seed=4)
    found = found_group(layers, repeat.cell)
    assert len(found.operations) == 7
    kinds = sorted(operation.kind for operation in found.operations)
    assert kinds == ["glide"] * 2 + ["mirror"] * 2 + ["rotation"] * 3
    window = shapely.box(15, 15, 35, 35)
    steps = [(50 * i, 50 * j) for i in range(-3, 4) for j in range(-3, 4)]
    for layer in layers:
        field = shapely.union_all(
            [shapely.affinity.translate(area, dx, dy) for area in layer.areas for dx, dy in steps]
        )
        here = shapely.intersection(field, window)
        for operation in found.operations:
            (a, b), (c, d) = operation.linear
            image = shapely.affinity.affine_transform(field, [a, b, c, d, *operation.shift])
            assert shapely.intersection(image, window).symmetric_difference(here).area < 0.05


def test_the_answer_does_not_depend_on_where_the_tile_was_cut() -> None:
    repeat = upright("pmg", 50_000)
    shape = shapely.Polygon([(3, 4), (14, 6), (9, 13)])
    found = [
        found_group([Layer(RED, orbit(shape, "pmg", repeat, origin))], repeat.cell)
        for origin in ((0.0, 0.0), (12.5, 10.4), (49.999, 0.001))
    ]
    assert {each.name for each in found} == {"pmg"}
    assert {each.copies for each in found} == {4}


@pytest.mark.parametrize(
    ("ratio", "group"), rarely(list(itertools.product([1000, 50, 20], ["pm", "p1", "pmm", "cmm"])), 4)
)
def test_a_long_tile_is_answered_and_has_its_group(ratio: int, group: str) -> None:
    # A shear by one short side all but keeps a long lattice; with a mirror it makes operations without end.
    places = {
        "p1": [(0.3, 0.2, 1.0), (0.62, 0.35, 0.7)],
        "pm": [(0.1, 0.5, 1.0), (0.3, 0.5, 1.0), (0.6, 0.5, 0.7)],
        "pmm": [(0.25, 0.5, 1.0), (0.75, 0.5, 1.0), (0.0, 0.5, 0.5), (1.0, 0.5, 0.5)],
        "cmm": [(0.25, 0.25, 0.6), (0.75, 0.75, 0.6), (0.25, 0.75, 0.4), (0.75, 0.25, 0.4)],
    }[group]
    dots = [shapely.Point(6 * ratio * x, 6 * y).buffer(size) for x, y, size in places]
    assert group_of(Cell(6000 * ratio, 6000), *dots).name == group


def test_operations_that_make_up_no_group_are_none() -> None:
    mirror, sheared = ((-1, 0), (0, 1)), ((-1, 1), (0, 1))
    none = np.zeros(2)
    assert closed({IDENTITY: none, mirror: none}, sheared, none) is None
    assert len(closed({IDENTITY: none, mirror: none}, ((1, 0), (0, -1)), none) or ()) == 4


def test_a_hair_on_one_side_of_a_mirror_alone_does_not_count() -> None:
    body = shapely.box(20, 20, 80, 60)
    whole = shapely.difference(body, shapely.box(49, 20, 51, 30))
    needle = shapely.Polygon([(30, 60), (30.004, 60), (30.002, 61.5)])
    slit = shapely.Polygon([(70, 60), (70.004, 60), (70.002, 58)])
    assert group_of(SQUARE_CELL, whole).name == "pm"
    assert group_of(SQUARE_CELL, shapely.difference(shapely.union(whole, needle), slit)).name == "pm"
    # What is broader than a hair is drawn.
    tooth = shapely.Polygon([(30, 60), (30.3, 60), (30.15, 61.5)])
    assert group_of(SQUARE_CELL, shapely.union(whole, tooth)).name == "p1"


def test_specks_in_a_page_that_is_covered_all_over_do_not_count() -> None:
    page = shapely.difference(shapely.box(0, 0, 100, 100), shapely.box(30, 30, 30.002, 30.003))
    assert group_of(SQUARE_CELL, page).note == "blank, or covered all over"
