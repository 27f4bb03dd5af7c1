"""Marks that lie whole in another ink are trapped by parallels: as overlays would, and without them."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Cell, Ink, Layer, violations
from batik_vector.geometry.outlines import of_polygons, to_polygons
from batik_vector.processes import trap
from batik_vector.processes.trapping import enclosed, parallels
from benchmarks.trapping import design
from tests.thorough import examples, long

from .designs import COLOURS, thick, trapped

SIDE = 60.0


def spotted(seed: int) -> Artwork:
    """Return a ground with spots of three inks, some in spots, some near others or across the seam."""
    chance = Random(seed)
    inks = list(COLOURS)
    chance.shuffle(inks)
    ground, *others = inks
    spots: dict[str, list[shapely.Geometry]] = {ink: [] for ink in inks}
    taken: list[shapely.Geometry] = []
    for _ in range(40):
        at = chance.uniform(0, SIDE), chance.uniform(0, SIDE)
        outer = _spot(chance, at, chance.uniform(1, 5))
        if any(shapely.intersects(outer, each) for each in taken):
            continue
        taken.append(outer)
        whose = chance.sample(others, 2)
        inner = _spot(chance, at, chance.uniform(0.2, 0.9) * math.sqrt(outer.area / math.pi))
        if outer.contains(inner):
            spots[whose[0]].append(shapely.Polygon(outer.exterior, [inner.exterior]))
            spots[whose[1]].append(inner)
        else:
            spots[whose[0]].append(outer)
    box = shapely.box(0, 0, SIDE, SIDE)
    spots[ground] = [shapely.difference(box, shapely.union_all(taken), grid_size=0.001)]
    layers = []
    for ink, shapes in spots.items():
        parts = shapely.get_parts(shapely.intersection(shapes, box, grid_size=0.001))
        areas = parts[(shapely.get_type_id(parts) == 3) & ~shapely.is_empty(parts)]
        if len(areas):
            layers.append(Layer(Ink(ink, COLOURS[ink]), shapely.orient_polygons(areas)))
    return Artwork("spots", Cell(int(SIDE * 1000), int(SIDE * 1000)), tuple(layers))


def _spot(chance: Random, at: tuple[float, float], radius: float) -> shapely.Polygon:
    corners = chance.randint(5, 120)
    turn = np.arange(corners) * (2 * math.pi / corners)
    wave = 1 + chance.uniform(0, 0.6) * np.sin(chance.randint(2, 9) * turn)
    points = np.c_[at[0] + radius * wave * np.cos(turn), at[1] + radius * wave * np.sin(turn)]
    made = shapely.Polygon(np.round(points, 3))
    return made if made.is_valid and made.area > 0.01 else shapely.box(*at, at[0] + 0.5, at[1] + 0.5)


def by_overlays(tile: Artwork, width: float, patch: pytest.MonkeyPatch) -> Artwork:
    """Return a tile of which no outline is done by its parallel."""
    with patch.context() as context:
        context.setattr(
            trap,
            "enclosed",
            lambda layers, *_: enclosed.Enclosed(
                list(layers), [np.zeros(len(each.closed), bool) for each in layers], {}
            ),
        )
        return trapped(tile, width, covered="accept")


@long
@settings(max_examples=examples(4, 20), deadline=None, derandomize=True)
@given(seed=st.integers(0, 100_000), width=st.sampled_from([0.05, 0.2, 0.5, 1.0]))
def test_parallels_and_overlays_agree(seed: int, width: float) -> None:
    tile = spotted(seed)
    one = trapped(tile, width, covered="accept")
    assert not violations(one)
    with pytest.MonkeyPatch.context() as patch:
        two = by_overlays(tile, width, patch)
    assert one.facts["trap"]["pairs"] == two.facts["trap"]["pairs"]
    assert one.facts["trap"]["covered"] == two.facts["trap"]["covered"]
    for mine, theirs in zip(one.layers, two.layers, strict=True):
        assert len(mine.areas) == len(theirs.areas)
        odd = shapely.symmetric_difference(shapely.union_all(mine.areas), shapely.union_all(theirs.areas))
        assert not len(thick(odd, 0.006))


def test_a_design_of_spots_needs_no_buffer(monkeypatch: pytest.MonkeyPatch) -> None:
    """What 10^5 vertices cost by overlays is ten times as much."""
    monkeypatch.setattr(trap, "broadened", lambda *_: pytest.fail("a buffer"))
    done = trapped(design(10_000), 0.3)
    (gain,) = done.facts["trap"]["gains"]
    (pair,) = done.facts["trap"]["pairs"]
    # 196 bands about outlines that turn once each: their length by the breadth, and a circle each.
    assert gain["area_mm2"] == pytest.approx(0.3 * pair["length_mm"] + 196 * math.pi * 0.09, rel=1e-3)


@long
@settings(max_examples=examples(20, 300), deadline=None, derandomize=True)
@given(seed=st.integers(0, 100_000), width=st.sampled_from([10.0, 100.0, 700.0]), inwards=st.booleans())
def test_a_parallel_is_the_boundary_of_the_buffer(seed: int, width: float, inwards: bool) -> None:
    chance = Random(seed)
    spot = shapely.transform(_spot(chance, (0.0, 0.0), chance.uniform(0.5, 6)), lambda xy: np.rint(xy * 1000))
    ring = shapely.orient_polygons(spot, exterior_cw=inwards)
    outlines = of_polygons(np.array([ring], dtype=object))
    made = parallels.parallels(outlines.points, outlines.rings, width, 1.0)
    exact = shapely.buffer(spot, -width if inwards else width, quad_segs=64)
    if not made.sound.all():
        # What is left to overlays has something to cut away.
        assert inwards or not shapely.equals(spot, shapely.convex_hull(spot))
        return
    assert exact.geom_type == "Polygon"
    assert len(exact.interiors) == 0
    (shape,) = to_polygons(type(outlines)(made.points, made.rings, np.array([0, 1]), outlines.closed))
    assert shapely.hausdorff_distance(exact.exterior, shape.exterior) < 1 + 2
