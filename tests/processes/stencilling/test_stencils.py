from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.certificate import certify
from batik_vector.errors import GeometryError
from batik_vector.processes.cutting.choices import LineBodies
from batik_vector.processes.stencilling.bridges import Orbit
from batik_vector.processes.stencilling.choosing import fewest, joined, price
from batik_vector.processes.stencilling.clusters import Clusters
from batik_vector.processes.stencilling.openings import openings_of
from batik_vector.processes.stencilling.planning import ground_of, planned
from batik_vector.processes.stencilling.sheets import Torus
from tests.thorough import examples, long

from .tiles import (
    bridges,
    endless,
    framed,
    on_torus,
    openings,
    random_tile,
    stencilled,
    symmetric_tile,
    tile_of,
    without,
)

SQUARE = Cell(40_000, 40_000)
BRIDGE = 0.8


def ring(x: float, y: float, inner: float, outer: float) -> shapely.Geometry:
    at = shapely.Point(x, y)
    return at.buffer(outer).difference(at.buffer(inner))


def sheet(stencil: Artwork) -> dict[str, object]:
    (found,) = stencil.facts["stencil"]["sheets"]
    return dict(found)


def tried(tile: Artwork, **told: object) -> Artwork | None:
    """Return a stencil, or None where no bridges of that breadth hold the sheet."""
    try:
        return stencilled(tile, bridge=BRIDGE, drop=1.6, **told)
    except GeometryError as error:
        if "bridge = 0.8 mm, expected" in str(error):
            return None
        raise


@long
@settings(max_examples=examples(3, 100), deadline=None, derandomize=True)
@given(seed=st.integers(0, 100_000))
def test_sheets_are_one_piece_and_no_bridge_is_needless(seed: int) -> None:
    tile = random_tile(seed)
    stencil = tried(tile, symmetric=False)
    if stencil is None:
        return
    areas = openings(stencil)
    assert on_torus(areas, tile.cell) == framed(areas, tile.cell) == endless(areas, tile.cell) == 1
    assert certify(stencil, symmetry=False).passed
    # What was dropped is no bridge, and would be taken for one.
    if sheet(stencil)["dropped"]:
        return
    for each in bridges(tile, stencil):
        left = without(stencil, [each])
        assert on_torus(left, tile.cell) > 1 or endless(left, tile.cell) > 1
    whole = shapely.union_all(areas)
    for place in sheet(stencil)["places"]:  # type: ignore[attr-defined]
        assert shapely.distance(shapely.Point(place), whole) >= BRIDGE / 2 - 0.002


@long
@pytest.mark.parametrize("name", ["p4m", "p6m", "p4g", "pgg", "cmm"])
@settings(max_examples=examples(1, 8), deadline=None, derandomize=True)
@given(seed=st.integers(0, 100_000))
def test_bridges_have_the_group(name: str, seed: int) -> None:
    tile = symmetric_tile(seed, name)
    stencil = tried(tile)
    if stencil is None:
        return
    areas = openings(stencil)
    assert on_torus(areas, tile.cell) == endless(areas, tile.cell) == 1
    before, after = certify(tile), certify(stencil)
    assert after.passed
    assert after.group == before.group


@long
@settings(max_examples=examples(2, 15), deadline=None, derandomize=True)
@given(seed=st.integers(0, 100_000), name=st.sampled_from(["p4m", "p6m", "pmm"]))
def test_of_orbits_none_is_needless_and_few_are_found(seed: int, name: str) -> None:
    tile = symmetric_tile(seed, name)
    (layer,) = tile.layers
    ground = ground_of(openings_of(layer, Torus(tile.cell), LineBodies.BODY), tile.cell, 20, True)
    plan = planned(ground, 800)
    if not plan.made.whole or ground.whole:
        return
    start = ground.sheet.clusters
    for left in itertools.combinations(plan.orbits, len(plan.orbits) - 1):
        assert not joined(start, left, range(len(left))).whole
    offers = sorted(plan.offers, key=lambda orbit: (len(orbit.bridges), orbit.cost))[:11]
    least = exhaustively(start, offers)
    if least is not None:
        found, made = fewest(start, offers, lambda number, chosen: False)
        assert made.whole
        assert price(offers, found)[0] <= 1.1 * least


def exhaustively(start: Clusters, offers: list[Orbit]) -> int | None:
    """Return the least number of bridges that hold, by trying all sets of orbits."""
    best: int | None = None
    for count in range(1, len(offers) + 1):
        for chosen in itertools.combinations(range(len(offers)), count):
            number = price(offers, chosen)[0]
            if (best is None or number < best) and joined(start, offers, chosen).whole:
                best = number
    return best


def shortest_tree(points: list[tuple[float, float]], radius: float, side: float) -> float:
    """Return the least length of bridges between discs on a torus, by Prim's way."""

    def gap(one: int, other: int) -> float:
        ways = [(points[one][axis] - points[other][axis] + side / 2) % side - side / 2 for axis in (0, 1)]
        return math.hypot(*ways) - 2 * radius

    inside, total = {0}, 0.0
    while len(inside) < len(points):
        length, new = min((gap(a, b), b) for a in inside for b in range(len(points)) if b not in inside)
        inside.add(new)
        total += length
    return total


@settings(max_examples=examples(2, 15), deadline=None, derandomize=True)
@given(seed=st.integers(0, 100_000))
def test_bridges_are_about_as_short_as_can_be(seed: int) -> None:
    chance = np.random.default_rng(seed)
    points: list[tuple[float, float]] = []
    while len(points) < 7:
        x, y = chance.uniform(0, 40, 2)
        if all(math.hypot((x - a + 20) % 40 - 20, (y - b + 20) % 40 - 20) > 7 for a, b in points):
            points.append((float(x), float(y)))
    # All is open but for discs: one joint less than discs, and two round the torus besides.
    discs = [
        shapely.Point(x + dx, y + dy).buffer(2, quad_segs=32)
        for x, y in points
        for dx in (-40, 0, 40)
        for dy in (-40, 0, 40)
    ]
    tile = tile_of([shapely.box(0, 0, 40, 40).difference(shapely.union_all(discs))], SQUARE)
    stencil = stencilled(tile, bridge=BRIDGE, symmetric=False)
    assert sheet(stencil)["islands"] == 7
    assert sheet(stencil)["bridges"] == 7 - 1 + 2
    lengths = sorted(_lengths(tile))
    tree = shortest_tree(points, 2, 40)
    assert sum(lengths[:6]) <= 1.1 * tree


def _lengths(tile: Artwork) -> list[float]:
    (layer,) = tile.layers
    ground = ground_of(openings_of(layer, Torus(tile.cell), LineBodies.BODY), tile.cell, 20, False)
    return [bridge.length / 1000 for bridge in planned(ground, 800).bridges]


def test_a_ring_has_one_bridge_and_by_its_symmetry_two() -> None:
    oval = shapely.affinity.scale(ring(20, 20, 6, 9), 1.5, 1.0)
    alone = stencilled(tile_of([oval], SQUARE), bridge=1, symmetric=False)
    both = stencilled(tile_of([oval], SQUARE), bridge=1)
    assert (sheet(alone)["bridges"], sheet(both)["bridges"]) == (1, 2)
    # On the mirror, where the gap is shortest.
    low, high = sorted(sheet(both)["places"])  # type: ignore[call-overload]
    assert low + high == pytest.approx([20, 12.5, 20, 27.5], abs=0.05)
    assert sheet(both)["closed_mm2"] == pytest.approx(2 * 3 * 1, rel=0.05)


def test_a_line_round_the_torus_is_bridged_once_a_repeat() -> None:
    stripe = shapely.box(0, 18, 40, 20)
    tile = tile_of([stripe], SQUARE)
    # In a frame the strips hold, and out of it they are apart.
    assert framed(openings(tile), SQUARE) == 1
    assert endless(openings(tile), SQUARE) == 2
    stencil = stencilled(tile, bridge=1)
    assert sheet(stencil)["bridges"] == 1
    assert sheet(stencil)["islands"] == 0
    assert endless(openings(stencil), SQUARE) == 1


def test_large_islands_get_two_bridges_far_apart() -> None:
    marks = [ring(11, 20, 7, 9), ring(31, 20, 2, 4)]
    one = stencilled(tile_of(marks, SQUARE), bridge=1, symmetric=False)
    two = stencilled(tile_of(marks, SQUARE), bridge=1, symmetric=False, large=10)
    assert (sheet(one)["bridges"], sheet(two)["bridges"], sheet(two)["extra_bridges"]) == (2, 3, 1)
    held = [place for place in sheet(two)["places"] if place[0] < 22]  # type: ignore[attr-defined]
    assert math.dist(*held) > 14 / 3
    with pytest.raises(GeometryError, match=r"large_bridges = 8, expected at most \d: an island at"):
        stencilled(tile_of(marks, SQUARE), bridge=2.4, symmetric=False, large=3, large_bridges=8)


def test_the_narrowest_member_is_told() -> None:
    def narrowest(*marks: shapely.Geometry, **told: object) -> dict[str, object]:
        found = sheet(stencilled(tile_of(list(marks), SQUARE), bridge=1, **told))["narrowest_member"]
        assert isinstance(found, dict)
        return found

    discs = [shapely.Point(12, 20).buffer(5, quad_segs=64), shapely.Point(22.6, 20).buffer(5, quad_segs=64)]
    between = narrowest(*discs)
    assert between["mm"] == pytest.approx(0.6, abs=0.01)
    assert between["at_mm"] == pytest.approx([17.3, 20], abs=0.2)
    # Across the seam, and within one opening that comes back to itself.
    assert narrowest(shapely.box(-3, 5, 39.6, 9))["mm"] == 1.002
    hook = shapely.box(5, 5, 25, 25).difference(shapely.box(8, 8, 22, 25)).union(shapely.box(8.7, 20, 22, 25))
    assert narrowest(hook.difference(shapely.box(22, 15, 25, 25)))["mm"] == pytest.approx(0.7, abs=0.01)


def test_thin_necks_need_not_hold() -> None:
    # A slit leaves a neck of 0.3 mm to what the frame encloses.
    frame = shapely.box(8, 8, 32, 32).difference(shapely.box(11, 11, 29, 29))
    slit = tile_of([frame.difference(shapely.box(28, 19.85, 40, 20.15))], SQUARE)
    assert sheet(stencilled(slit, bridge=1, symmetric=False))["bridges"] == 0
    moved = tile_of(
        [shapely.affinity.translate(each, 10.1, 0) for each in shapely.get_parts(openings(slit))], SQUARE
    )
    for each in (slit, moved):  # within the tile, and across its edge
        told = sheet(stencilled(each, bridge=1, symmetric=False, neck=0.4))
        assert (told["islands"], told["bridges"]) == (1, 1)
    held = sheet(stencilled(slit, bridge=1, symmetric=False, neck=0.4))
    assert (held["islands"], held["bridges"]) == (1, 1)
    assert sheet(stencilled(slit, bridge=1, symmetric=False, neck=0.2))["bridges"] == 0
    assert shapely.area(
        openings(stencilled(slit, bridge=1, symmetric=False, neck=0.4))
    ).sum() == pytest.approx(shapely.area(openings(slit)).sum() - 3, abs=0.05)


def test_the_weakest_neck_bears_most() -> None:
    # What hangs in an island hangs on its bridges too.
    marks = [ring(20, 20, 8, 10), ring(20, 20, 3, 4.5)]
    found = sheet(stencilled(tile_of(marks, SQUARE), bridge=1, symmetric=False))["weakest_neck"]
    assert isinstance(found, dict)
    assert found["bridges"] == 1
    assert found["holds_mm2"] == pytest.approx(math.pi * (64 - 4.5**2 + 9), rel=0.01)


def test_a_net_holds_islands() -> None:
    tile = tile_of([ring(20, 20, 5, 8)], SQUARE)
    stencil = stencilled(tile, backing="net")
    assert sheet(stencil)["bridges"] == 0
    assert sheet(stencil)["islands"] == 1
    assert shapely.area(openings(stencil)).sum() == pytest.approx(shapely.area(openings(tile)).sum())


def test_small_islands_may_fall_out() -> None:
    tile = tile_of([ring(12, 20, 0.7, 4), ring(28, 20, 3, 5)], SQUARE)
    with pytest.raises(GeometryError, match=r"bridge = 3 mm, expected at most [0-9.]+ mm: an island of ink"):
        stencilled(tile, bridge=3)
    stencil = stencilled(tile, bridge=1, drop=1.5)
    assert (sheet(stencil)["dropped"], sheet(stencil)["islands"], sheet(stencil)["bridges"]) == (1, 1, 1)


def test_what_would_do_does() -> None:
    tile = tile_of([ring(20, 20, 0.7, 4)], SQUARE)
    with pytest.raises(GeometryError) as told:
        stencilled(tile, bridge=3, symmetric=False)
    fits = float(str(told.value).split("at most ")[1].split(" mm")[0])
    assert 0.5 < fits < 1.4
    assert framed(openings(stencilled(tile, bridge=fits, symmetric=False)), SQUARE) == 1


def test_what_leaves_no_sheet_is_refused() -> None:
    with pytest.raises(GeometryError, match="inks, expected openings that leave a sheet"):
        stencilled(tile_of([shapely.box(-1, -1, 41, 41)], SQUARE))


def test_lines_are_open_as_broad_as_their_ink() -> None:
    across = shapely.LineString([(0, 39.8), (40, 39.8)])
    tile = Artwork("line", SQUARE, (Layer(Ink("ink", "#000000", width=1.0), lines=[across]),))  # type: ignore[arg-type]
    stencil = stencilled(tile, bridge=1)
    # Half of its body lies over the upper edge, and opens the lower one.
    assert shapely.total_bounds(openings(stencil))[[1, 3]].tolist() == [0, 40]
    assert sheet(stencil)["open_mm2"] == pytest.approx(40 - 1, abs=0.05)
    assert certify(stencil).passed


def test_bridges_keep_away_from_corners() -> None:
    # The gap is shortest at a thorn that is narrower than the bridge.
    island = shapely.box(12, 12, 28, 28)
    thorn = shapely.Polygon([(12, 19.7), (11.2, 20), (12, 20.3)])
    around = shapely.box(8, 8, 32, 32)
    assert place_of(around.difference(island.union(thorn))) != pytest.approx(20, abs=1.2)


def place_of(*marks: shapely.Geometry) -> float:
    """Return how high the only bridge of a stencil stands, in mm."""
    found = sheet(stencilled(tile_of(list(marks), SQUARE), bridge=1, symmetric=False))["places"]
    assert isinstance(found, list)
    ((_, y),) = found
    return float(y)
