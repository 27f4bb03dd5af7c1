"""Tossed marks: clear of one another across every seam, evenly spread, and the same for the same seed."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Cell, DropAxis, Geometries
from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.maps.affine import Affine
from batik_vector.tiling.layouts import Toss
from batik_vector.tiling.tossing.darts import Dice
from batik_vector.tiling.tossing.marks import Field, Kit, Poses
from batik_vector.tiling.tossing.scatter import Torus, in_steps
from batik_vector.tiling.tossing.toss import Marks, Tossed, toss
from tests.thorough import examples, long, rarely

NOTHING = Field.of(np.empty(0, dtype=object))


def bean(length: float, width: float, bend: float = 0.0) -> shapely.Polygon:
    t = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    x, y = length * np.cos(t), width * np.sin(t)
    return shapely.Polygon(np.column_stack([x, y + bend * x**2 / length]))


BEAN, DOT = bean(6, 2, 0.4), bean(1.5, 1.5)
SQUARE = Cell(40_000, 36_000)
CELLS = [
    SQUARE,
    Cell(30_000, 40_000, Fraction(1, 2)),
    Cell(39_000, 30_000, Fraction(1, 3), DropAxis.ROW),
    Cell(20_000, 60_000, Fraction(2, 5)),
]


def marks(*bodies: shapely.Geometry) -> Marks:
    return Marks(tuple("abcdef"[: len(bodies)]), np.array(bodies, dtype=object), 0.01)


def torus(cell: Cell = SQUARE, operations: Sequence[Affine] = (Affine(),)) -> Torus:
    return Torus(cell.lattice, in_steps(operations, 1000))


def drawn(tossed: Tossed, bodies: Sequence[shapely.Polygon]) -> Geometries:
    """The marks in mm, drawn by the maps that a recipe would be drawn by."""
    found = [
        copy.apply(np.array([body], dtype=object))
        for body, copies in zip(bodies, tossed.copies, strict=True)
        for copy in copies
    ]
    return np.concatenate(found)


def moved(shapes: Geometries, shift: tuple[float, float]) -> Geometries:
    return Affine.translation(shift).apply(shapes)


def least_gap(shapes: Geometries, cell: Cell, operations: Sequence[Affine] = (Affine(),)) -> float:
    """The least distance between two marks of the infinite field, by setting out all that is near."""
    (ax, ay), (bx, by) = ((x / 1000, y / 1000) for x, y in cell.lattice)
    images = np.concatenate([operation.apply(shapes) for operation in operations])
    shifts = [(i * ax + j * bx, i * ay + j * by) for i in range(-3, 4) for j in range(-3, 4)]
    found = np.concatenate([moved(images, shift) for shift in shifts])
    i, j = shapely.STRtree(found).query(shapes, predicate="dwithin", distance=8.0)
    same = shapely.equals_exact(shapes[i], found[j], 1e-9)
    gap = np.asarray(shapely.distance(shapes[i], found[j]))[~same]
    return float(gap.min(initial=8.0))


@long
@pytest.mark.parametrize("begin", rarely(range(0, 200, 25), 3))
def test_no_two_marks_come_nearer_than_asked(begin: int) -> None:
    for seed in range(begin, begin + examples(10, 25)):
        cell = CELLS[seed % len(CELLS)]
        bodies = [BEAN, DOT] if seed % 5 == 0 else [BEAN]
        spec = Toss(distance=1.0, size=(0.7, 1.1), flip=True, tries=30, settle=1)
        shapes = drawn(toss(spec, marks(*bodies), torus(cell), NOTHING, seed), bodies)
        assert len(shapes) >= 5
        assert least_gap(shapes, cell) >= 1.0


@pytest.mark.parametrize("cell", CELLS, ids=str)
def test_the_report_says_what_is_there(cell: Cell) -> None:
    tossed = toss(Toss(distance=1.5), marks(BEAN, DOT), torus(cell), NOTHING, 3)
    shapes = drawn(tossed, [BEAN, DOT])
    report = tossed.report
    area = cell.width * cell.height
    assert report.counts == tuple(len(copies) for copies in tossed.copies)
    assert report.covers == pytest.approx(shapely.area(shapes).sum() / area, abs=1e-6)
    assert report.per_m2 == pytest.approx(len(shapes) / area * 1e6, abs=0.1)
    assert report.distance == pytest.approx(least_gap(shapes, cell), abs=2e-3)
    assert report.distance >= 1.5


def places(tossed: Tossed) -> list[tuple[float, float]]:
    return [(copy.e, copy.f) for copies in tossed.copies for copy in copies]


def test_a_seed_falls_the_same_way_always_and_another_seed_another_way() -> None:
    one, again, other = (toss(Toss(), marks(BEAN), torus(), NOTHING, seed) for seed in (1, 1, 2))
    assert one.copies == again.copies
    assert places(one) != places(other)


def test_a_seed_of_its_own_goes_before_the_recipes() -> None:
    own = [toss(Toss(seed=7), marks(BEAN), torus(), NOTHING, seed) for seed in (1, 2)]
    assert own[0].copies == own[1].copies


def test_a_count_is_kept_and_shared_out_by_weight() -> None:
    spec = Toss(count=13, weights=(1, 2, 3))
    tossed = toss(spec, marks(DOT, bean(2, 1), BEAN), torus(), NOTHING, 1)
    assert tossed.report.counts == (2, 4, 7)


def test_every_motif_comes_where_no_count_is_asked() -> None:
    for seed in range(3):
        counts = toss(Toss(), marks(BEAN, bean(3, 1.5), DOT), torus(), NOTHING, seed).report.counts
        assert min(counts) >= 0.5 * np.mean(counts)


def test_turns_and_sizes_are_those_allowed() -> None:
    spec = Toss(turns=(0, 90, 180), size=(0.5, 2.0), distance=0.5)
    copies = toss(spec, marks(BEAN), torus(), NOTHING, 1).copies[0]
    sizes = np.array([math.hypot(copy.a, copy.c) for copy in copies])
    turns = np.degrees([math.atan2(copy.c, copy.a) for copy in copies])
    # Sizes count from the least.
    assert (sizes >= 1).all()
    assert (sizes <= 4).all()
    assert np.ptp(sizes) > 1
    assert set(np.round(turns)) == {0, 90, 180}
    leaning = toss(Toss(turn=(10, 40)), marks(BEAN), torus(), NOTHING, 1).copies[0]
    turns = np.degrees([math.atan2(copy.c, copy.a) for copy in leaning])
    assert (turns > 9.99).all()
    assert (turns < 40.01).all()


def test_one_mark_in_two_is_flipped() -> None:
    copies = toss(Toss(flip=True, distance=0.5), marks(bean(2, 1, 0.4)), torus(), NOTHING, 1).copies[0]
    flipped = sum(copy.determinant < 0 for copy in copies)
    assert 0.25 < flipped / len(copies) < 0.75


def test_a_full_repeat_has_no_room_left() -> None:
    tossed = toss(Toss(distance=1.0), marks(DOT), torus(), NOTHING, 1)
    shapes = drawn(tossed, [DOT])
    around = np.concatenate([moved(shapes, (40 * i, 36 * j)) for i in (-1, 0, 1) for j in (-1, 0, 1)])
    x, y = np.meshgrid(np.linspace(0, 40, 200), np.linspace(0, 36, 200))
    spots = shapely.points(x.ravel(), y.ravel())
    _, room = shapely.STRtree(around).query_nearest(spots, return_distance=True, all_matches=False)
    # A dot of 1.5 mm and 1 mm of ground; outlines are rounded outwards by some hundredths.
    assert room.max() < 2.6


def holes(tossed: Tossed, cell: Cell) -> float:
    """The radius of the largest empty circle between the middles, as a share of the spacing of marks."""
    xy = np.array(places(tossed))
    size = np.array([cell.width, cell.height])
    around = np.concatenate([xy + size * [i, j] for i in (-1, 0, 1) for j in (-1, 0, 1)])
    x, y = np.meshgrid(np.linspace(0, size[0], 120), np.linspace(0, size[1], 120))
    spots = np.column_stack([x.ravel(), y.ravel()])
    far = np.hypot(*(spots[:, None] - around[None]).transpose(2, 0, 1)).min(axis=1).max()
    return float(far / math.sqrt(size.prod() / len(xy)))


def test_few_marks_are_spread_over_the_whole_repeat() -> None:
    # Chance alone leaves holes of 1.3 to 1.6; a square lattice's are 0.71.
    for seed in range(4):
        assert holes(toss(Toss(count=30, distance=0.5), marks(DOT), torus(), NOTHING, seed), SQUARE) < 0.95


def test_settling_evens_out_the_gaps() -> None:
    for seed in range(3):
        raw, even = (
            toss(Toss(count=12, distance=0.5, settle=settle), marks(BEAN), torus(), NOTHING, seed)
            for settle in (0, 12)
        )
        assert even.report.distance > raw.report.distance


def test_a_share_of_the_repeat_is_covered_where_it_is_asked() -> None:
    tossed = toss(Toss(fill=0.2), marks(bean(2, 1), DOT), torus(), NOTHING, 1)
    assert tossed.report.covers == pytest.approx(0.2, abs=0.01)


def test_what_lies_there_is_kept_clear_of() -> None:
    first = toss(Toss(count=6, distance=2), marks(BEAN), torus(), NOTHING, 1)
    second = toss(Toss(distance=1), marks(DOT), torus(), first.field, 2)
    together = np.concatenate([drawn(first, [BEAN]), drawn(second, [DOT])])
    assert least_gap(together, SQUARE) >= 1
    assert second.report.distance >= 1


P4M = [turn @ image for turn in map(Affine.turn, (0, 90, 180, 270)) for image in (Affine(), Affine.mirror())]


def test_marks_keep_clear_of_their_images_under_a_symmetry() -> None:
    cell = Cell(60_000, 60_000)
    for seed in range(2):
        tossed = toss(
            Toss(distance=1.2, tries=30, settle=1), marks(BEAN, DOT), torus(cell, P4M), NOTHING, seed
        )
        shapes = drawn(tossed, [BEAN, DOT])
        assert len(shapes) > 4
        assert least_gap(shapes, cell, P4M) >= 1.2
        assert sum(tossed.report.counts) == 8 * len(shapes)


def test_stretched_cloth_stretches_the_marks_and_keeps_the_distance() -> None:
    stretch = np.array([[1.05, 0.0], [0.0, 0.96]])
    tossed = toss(Toss(distance=1.0), marks(BEAN), Torus(SQUARE.lattice, stretch=stretch), NOTHING, 1)
    copy = tossed.copies[0][0]
    assert copy.determinant == pytest.approx(1.05 * 0.96)
    assert least_gap(drawn(tossed, [BEAN]), SQUARE) >= 1.0


def test_marks_do_not_nest_in_holes_and_notches_of_others() -> None:
    ring = bean(9, 9).difference(bean(8, 8))
    assert isinstance(ring, shapely.Polygon)
    tossed = toss(Toss(count=1), marks(ring), torus(), NOTHING, 1)
    middle = shapely.centroid(drawn(tossed, [ring]))
    after = toss(Toss(distance=0.5), marks(DOT), torus(), tossed.field, 1)
    assert shapely.distance(drawn(after, [DOT]), middle).min() > 8


@pytest.mark.parametrize(
    ("count", "shape", "words"),
    [
        (500, BEAN, r"by their area alone no more than 26 fit"),
        # Of discs no more lie in a plane than in the densest lattice, and chance comes not near that.
        (94, shapely.Point(0, 0).buffer(2), r"by their area alone no more than 6\d fit"),
        (60, shapely.Point(0, 0).buffer(2), r"no toss is so close that more than 4\d fit"),
    ],
)
def test_counts_that_cannot_fit_are_refused_before_any_is_thrown(
    monkeypatch: pytest.MonkeyPatch, count: int, shape: shapely.Polygon, words: str
) -> None:
    monkeypatch.delattr("batik_vector.tiling.tossing.toss.thrown")
    with pytest.raises(GeometryError, match=f"count = {count}: {words} at a distance of 1 mm"):
        toss(Toss(count=count), marks(shape), torus(), NOTHING, 1)


@pytest.mark.parametrize(
    ("count", "side"),
    [
        # One disc that all but fills the repeat, and the first count at which chance decides.
        (1, 10.2),
        (24, 55.0),
    ],
)
def test_what_can_fit_is_tried(count: int, side: float) -> None:
    disc = shapely.Point(0, 0).buffer(4)
    cell = Cell(round(side * 1000), round(side * 1000))
    tossed = toss(Toss(count=count, tries=5000), marks(disc), torus(cell), NOTHING, 1)
    assert sum(tossed.report.counts) == count


def test_what_falls_far_short_is_refused_before_it_is_settled(monkeypatch: pytest.MonkeyPatch) -> None:
    disc, cell = shapely.Point(0, 0).buffer(1.0), Cell(50_000, 50_000)
    # Discs with half the distance round them would cover 0.57 of the repeat, then 0.42.
    fits = toss(Toss(count=150), marks(disc), torus(cell), NOTHING, 1)
    assert sum(fits.report.counts) == 150
    monkeypatch.delattr("batik_vector.tiling.tossing.toss.settled")
    with pytest.raises(
        GeometryError, match=r"count = 200: about 1[678]\d fit at a distance of 1 mm"
    ) as caught:
        toss(Toss(count=200), marks(disc), torus(cell), NOTHING, 1)
    assert "expected that many, or smaller marks" in str(caught.value)


def test_what_cannot_fit_is_refused_with_what_does() -> None:
    with pytest.raises(GeometryError, match=r"count = 22: only (\d+) fit") as caught:
        toss(Toss(count=22, tries=200, settle=0), marks(BEAN), torus(), NOTHING, 1)
    fit = int(str(caught.value).split("only ")[1].split(" fit")[0])
    assert 8 < fit < 22
    assert f"at most {fit}" in str(caught.value)
    with pytest.raises(GeometryError, match="only 36 mm round"):
        toss(Toss(distance=37), marks(BEAN), torus(), NOTHING, 1)
    with pytest.raises(GeometryError, match=r"the nearest 36 mm away: expected a smaller width"):
        toss(Toss(), marks(bean(30, 30)), torus(), NOTHING, 1)
    everywhere = Field.of(np.array([shapely.box(0, 0, 40_000, 36_000)], dtype=object))
    with pytest.raises(GeometryError, match="fits between what lies there already"):
        toss(Toss(), marks(DOT), torus(), everywhere, 1)


def test_marks_without_number_are_refused_at_once() -> None:
    with pytest.raises(TooLargeError, match="marks would fit"):
        toss(Toss(), marks(DOT), torus(Cell(20_000_000, 20_000_000)), NOTHING, 1)


@pytest.mark.parametrize(
    ("spec", "words"),
    [
        ({"size": (2.0, 1.0)}, "the lesser number first"),
        ({"turn": (90.0, 0.0)}, "the lesser number first"),
        ({"count": 0}, "expected 1 to 20000"),
        ({"distance": -1.0}, "expected 0 to 1000"),
        ({"clear": "everything"}, "unknown clear"),
    ],
)
def test_specs_that_make_no_sense_are_refused(spec: dict[str, object], words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        Toss(**spec)  # type: ignore[arg-type]


def test_weights_are_one_for_each_motif() -> None:
    with pytest.raises(GeometryError, match=r"weights = \[1, 2, 3\]: expected one for each motif, 2 in all"):
        toss(Toss(weights=(1, 2, 3)), marks(BEAN, DOT), torus(), NOTHING, 1)


def test_tries_that_never_end_are_refused_with_their_number(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "LIMIT", work.PER_DART * 2000)
    spec = Toss(distance=1.0, tries=100_000)
    with pytest.raises(TooLargeError, match=r"tries = 100,000: after [\d,]+ darts"), work.account():
        toss(spec, marks(BEAN), torus(), NOTHING, 1)


def test_the_dice_are_pythons_own() -> None:
    one, dice = random.Random(7), Dice(7)
    thrown = np.concatenate([dice(count) for count in (1, 0, 5, 300)])
    assert thrown.tolist() == [one.random() for _ in range(306)]


def poses_given(monkeypatch: pytest.MonkeyPatch, name: str) -> list[int]:
    """Return a list that gets how many poses each call of a method of :class:`Kit` is given."""
    given = list[int]()
    method = getattr(Kit, name)

    def counted(kit: Kit, poses: Poses, stretch: None) -> Field:
        given.append(len(poses))
        field: Field = method(kit, poses, stretch)
        return field

    monkeypatch.setattr(Kit, name, counted)
    return given


def test_outlines_are_drawn_of_few_of_the_darts(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = poses_given(monkeypatch, "marks")
    found = toss(Toss(distance=0.8, settle=0), marks(BEAN, DOT), torus(), NOTHING, 3)
    # Most darts miss, and that their discs tell.
    assert sum(drawn) < 0.3 * found.report.darts


def test_what_is_far_too_crowded_is_refused_by_a_few_marks_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = poses_given(monkeypatch, "undrawn")
    dense = Toss(distance=0.5, count=5000)
    with pytest.raises(GeometryError, match=r"count = 5000: about 4\d{3} fit at a distance of 0.5 mm"):
        toss(dense, marks(DOT), torus(Cell(260_000, 300_000)), NOTHING, 1)
    assert 0 < sum(seen) < 40_000
