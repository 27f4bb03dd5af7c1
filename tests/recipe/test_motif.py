"""Flowers and rosettes: the elements that the paper counts, and line and region that agree."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.curves import Circle, Hypocycloid, Rose, Spiral, Star, Superellipse, trace
from batik_vector.geometry.regions import FillRule, settle
from batik_vector.recipe import figures as drawing
from batik_vector.recipe.figures import draw
from batik_vector.recipe.motif import (
    Core,
    Element,
    Flower,
    Leaf,
    PathMotif,
    Petals,
    Pistil,
    Rosette,
    Treatment,
    most_contours,
)
from tests.budgets import cold, counted

TOLERANCE = 1e-3


def region(element_of: Rosette | Flower, name: str) -> shapely.Geometry:
    figure = next(f for f in draw(element_of, TOLERANCE) if f.element.name == name)
    return shapely.union_all(figure.areas)


def test_the_papers_flower_has_eight_leaves_eight_petals_sixteen_pistils_and_a_core() -> None:
    figures = {figure.element.name: figure for figure in draw(Flower(), TOLERANCE)}
    assert list(figures) == ["leaf", "petal", "pistil", "core", "disc"]
    assert len(figures["leaf"].areas) == 4  # each superellipse is two opposite leaves
    assert len(figures["petal"].areas) == 8
    assert len(figures["core"].areas) == 8
    assert len(figures["disc"].areas) == 1
    reach = [shapely.total_bounds(figures[name].lines)[2] for name in ("petal", "pistil", "core", "disc")]
    assert reach == pytest.approx([1.0, 0.8, 0.5, 0.1], abs=TOLERANCE)


def test_eight_petals_are_the_four_petal_rose_and_its_copy_turned() -> None:
    petals = region(Flower(), "petal")
    rose = settle(trace(Rose(2), TOLERANCE).rings)
    turned = shapely.transform(rose, lambda p: p @ np.array([[1, 1], [-1, 1]]) / np.sqrt(2))
    both = shapely.union_all(np.concatenate([rose, turned]))
    assert shapely.area(shapely.symmetric_difference(petals, both)) < 4 * TOLERANCE


@pytest.mark.parametrize("count", [1, 2, 3, 5, 6, 7, 8, 12])
def test_every_count_of_leaves_petals_and_core_petals_is_drawn(count: int) -> None:
    flower = Flower(leaf=Leaf(count=count), petal=Petals(count=count), core=Core(count=count))
    for name, reach in (("leaf", 1.2), ("petal", 1.0), ("core", 0.5)):
        shape = region(flower, name)
        radius = np.hypot(*shapely.get_coordinates(shape).T)
        assert radius.max() == pytest.approx(reach, abs=2 * TOLERANCE)
        tips = shapely.difference(shape, shapely.Point(0, 0).buffer(0.985 * reach, quad_segs=64))
        assert len(shapely.get_parts(tips)) == count


def test_leaves_stand_between_the_petals() -> None:
    tips = shapely.get_coordinates(region(Flower(), "leaf"))
    tip = tips[np.argmax(np.hypot(*tips.T))]
    assert np.degrees(np.arctan2(tip[1], tip[0])) % 45 == pytest.approx(22.5, abs=0.1)


@pytest.mark.parametrize(
    ("flower", "name"),
    [
        (Flower(leaf=Leaf(count=0)), "leaf"),
        (Flower(petal=Petals(count=0)), "petal"),
        (Flower(pistil=Pistil(count=0)), "pistil"),
        (Flower(core=Core(count=0)), "core"),
        (Flower(core=Core(radius=0)), "disc"),
    ],
)
def test_a_count_of_nothing_leaves_the_element_out(flower: Flower, name: str) -> None:
    drawn = [element.name for element in flower.parts()]
    assert name not in drawn
    assert len(drawn) == 4


def test_a_flower_of_nothing_and_a_wrong_order_are_refused() -> None:
    with pytest.raises(GeometryError, match="no elements"):
        Flower(
            leaf=Leaf(count=0), petal=Petals(count=0), pistil=Pistil(count=0), core=Core(count=0, radius=0)
        )
    with pytest.raises(GeometryError, match='did you mean "petal"'):
        Flower(order=("petall",))
    with pytest.raises(GeometryError, match="twice"):
        Flower(order=("petal", "petal"))


@pytest.mark.parametrize("curve", [Rose(4), Rose(7, 3), Hypocycloid(16, 5), Superellipse(), Circle(), Star()])
@pytest.mark.parametrize("rule", list(FillRule))
def test_line_and_region_share_their_vertices_and_regions_are_valid(curve: object, rule: FillRule) -> None:
    traced = trace(curve, TOLERANCE)  # type: ignore[arg-type]
    areas = settle(traced.rings, rule)
    assert shapely.is_valid(areas).all()
    assert shapely.is_ccw(shapely.get_exterior_ring(areas)).all()
    drawn = {tuple(p) for strand in traced.strands for p in strand.tolist()}
    corners = shapely.get_coordinates(areas)
    crossings = [p for p in corners.tolist() if tuple(p) not in drawn]
    # Whatever is no vertex of the line is a crossing of two of its chords.
    if crossings:
        lines = shapely.union_all([shapely.LineString(strand) for strand in traced.strands])
        assert shapely.distance(shapely.points(crossings), lines).max() < 1e-12
    assert len(crossings) < len(drawn)


def test_fill_rules_of_a_star_are_those_of_the_books() -> None:
    # {5/2}: the pentagon in the middle is wound round twice.
    angle = np.radians(90 + 144 * np.arange(6))
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    ring[-1] = ring[0]
    area = {rule: shapely.area(settle([ring], rule)).sum() for rule in FillRule}
    pentagon = 5 / 2 * np.sin(np.radians(72)) * ((3 - np.sqrt(5)) / 2) ** 2
    assert area[FillRule.NONZERO] == pytest.approx(area[FillRule.OUTLINE])
    assert area[FillRule.NONZERO] - area[FillRule.EVENODD] == pytest.approx(pentagon)


def test_nested_contours_alternate() -> None:
    rings = Rosette(elements=(Element(curve=Circle(1.0), name="target", contours=4),))
    assert shapely.area(region(rings, "target")) == pytest.approx(
        np.pi * (1 - 9 / 16 + 4 / 16 - 1 / 16), rel=1e-2
    )
    assert len(draw(rings, TOLERANCE)[0].lines) == 4


def test_many_contours_are_put_together_in_few_overlays() -> None:
    rings = Rosette(elements=(Element(curve=Circle(1.0), contours=64),))
    with counted([(shapely, "symmetric_difference")]) as done:
        areas = draw(rings, TOLERANCE)[0].areas
    assert done.calls() == 6
    assert len(areas) == 32


def test_contours_of_many_crossings_are_settled_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Those of a comb beside the origin cross, and make the same bands as overlays two by two."""
    xy = [(1, -1), *((1 + k // 2 * 0.1, 1 - k % 2 * 1.9) for k in range(2, 34)), (3, -1)]
    comb = PathMotif(d="M" + "L".join(f"{x:.3f} {y:.3f}" for x, y in xy) + "Z", centre=(0, 0), contours=8)

    def bands() -> shapely.Geometry:
        cold()
        return shapely.union_all(draw(comb, TOLERANCE)[0].areas)

    monkeypatch.setattr(drawing, "MANY_CROSSINGS", 100)
    with counted([(shapely, "symmetric_difference")]) as done:
        at_once = bands()
    assert not done.calls()
    monkeypatch.setattr(drawing, "MANY_CROSSINGS", np.inf)
    two_by_two = bands()
    size = float(shapely.area(two_by_two))
    assert size > 1
    assert shapely.area(shapely.symmetric_difference(at_once, two_by_two)) < 1e-6 * size
    monkeypatch.setattr(drawing, "MANY_CROSSINGS", 100)
    monkeypatch.setattr(work, "LIMIT", 50_000)
    with work.account(), pytest.raises(TooLargeError, match=r"contours = 8\).*cross about"):
        bands()


def test_contours_that_will_cross_too_often_are_refused_before_they_are_overlaid(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tangle = Rosette(elements=(Element(curve=Star(points=32, inner=0.5), contours=16),))
    monkeypatch.setattr(work, "SMALL", 0)
    cold()
    with work.account(), counted([(shapely, "symmetric_difference")]) as whole:
        draw(tangle, TOLERANCE)
        share = work.counted()
    assert share is not None
    cold()
    monkeypatch.setattr(work, "LIMIT", 0.6 * share[0])
    overlays = counted([(shapely, "symmetric_difference")])
    with overlays as done, work.account(), pytest.raises(TooLargeError, match="cross"):
        draw(tangle, TOLERANCE)
    assert 0 < done.calls() < whole.calls()


def test_the_key_that_asks_for_the_most_contours_is_known() -> None:
    assert most_contours(Flower(core=Core(contours=64), leaf=Leaf(contours=3))) == ("core.contours", 64)
    rings = Rosette(elements=(Element(curve=Circle(1.0)), Element(curve=Circle(2.0), contours=5)))
    assert most_contours(rings) == ("elements[1].contours", 5)


def test_copies_are_spun_set_out_turned_and_mirrored() -> None:
    element = Element(curve=Spiral(), count=3, radius=2.0, turn=30, spin=90, mirror=True)
    lines = draw(Rosette(elements=(element,)), TOLERANCE)[0].lines
    assert len(lines) == 6
    first = np.array(lines[0].coords)[-1]
    # The outer end (1, 0), turned by 90° about itself, moved 2 out, turned by 30°.
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    assert first == pytest.approx([2 * c - s, 2 * s + c])
    assert np.array(lines[1].coords)[-1] == pytest.approx([2 * c + s, 2 * s - c])


DISC = shapely.Point(0, 0).buffer(3)
RING = DISC - shapely.box(-1, -1, 1, 1)


def test_geometry_of_shapely_is_an_element() -> None:
    element = Element.from_geometry(RING, name="ring", ink="wax", gap=1.0)
    assert (element.name, element.ink, element.gap) == ("ring", "wax", 1.0)
    (figure,) = draw(Rosette(elements=(element,)), TOLERANCE)
    (ring,) = figure.areas
    assert ring.equals(RING)
    both = [RING, shapely.Point(9, 0).buffer(1), shapely.MultiPolygon([shapely.box(20, 0, 21, 1)])]
    (figure,) = draw(Rosette(elements=(Element.from_geometry(both),)), TOLERANCE)
    assert shapely.area(figure.areas).sum() == pytest.approx(sum(each.area for each in both))


@pytest.mark.parametrize("turned", [False, True])
def test_holes_stay_holes_whichever_way_they_run(turned: bool) -> None:
    shape = shapely.reverse(RING) if turned else RING
    for fill in FillRule:
        (figure,) = draw(Rosette(elements=(Element.from_geometry(shape, fill=fill),)), TOLERANCE)
        hole = 0 if fill == FillRule.OUTLINE else 4
        assert shapely.area(figure.areas).sum() == pytest.approx(DISC.area - hole)


def test_lines_of_shapely_are_lines() -> None:
    lines = shapely.MultiLineString([[(0, 0), (3, 0), (3, 2)], [(5, 5), (6, 6)]])
    element = Element.from_geometry(lines, treatment=Treatment.LINE)
    (figure,) = draw(Rosette(elements=(element,)), TOLERANCE)
    assert len(figure.areas) == 0
    assert shapely.length(figure.lines).tolist() == [5, pytest.approx(2**0.5)]
    with pytest.raises(GeometryError, match="an open line has no area to fill"):
        Element.from_geometry(lines)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (shapely.Point(1, 2), "a geometry of points, expected polygons or lines"),
        (shapely.Polygon(), "an empty geometry"),
        ([], "an empty geometry"),
        (shapely.from_wkt("LINESTRING (0 0, 1 inf)"), "coordinates that are not finite"),
        ("a leaf", 'a leaf", expected geometry of shapely'),
        (None, "None, expected geometry of shapely"),
    ],
)
def test_what_is_no_shape_is_refused(wrong: object, words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        Element.from_geometry(wrong)


def test_a_path_is_a_motif_about_its_middle() -> None:
    motif = PathMotif(d="M10 10H14V12H10Z", ink="wax", gap=0.5)
    (part,) = motif.parts()
    assert (part.ink, part.gap) == ("wax", 0.5)
    (figure,) = draw(motif, TOLERANCE)
    assert shapely.total_bounds(figure.areas).tolist() == [-2, -1, 2, 1]
    (figure,) = draw(PathMotif(d="M10 10H14V12H10Z", centre=(10, 12)), TOLERANCE)
    assert shapely.total_bounds(figure.areas).tolist() == [0, 0, 4, 2]
    assert most_contours(PathMotif(d=motif.d, contours=3)) == ("contours", 3)
