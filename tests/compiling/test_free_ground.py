"""A ground filled round what is placed: at its margin, evenly, each mark once, over the seam as elsewhere."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import shapely

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, Geometries, Ink
from batik_vector.certificate import certify
from batik_vector.compiling.free_ground import Given, free_ground
from batik_vector.errors import BatikError
from batik_vector.geometry.fills.periodic import Period
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.recipe.fills import FILLS, Cecek, Fill, Follow, Galaran, Rows, Ukel
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.layouts import FreeGround
from batik_vector.tiling.symmetry.repeats import TileSpec
from batik_vector.tiling.symmetry.spread import Spread
from batik_vector.tiling.torus.torus import Lattice, to_mm, to_step_grid
from batik_vector.tiling.welding.congruent import polygons
from batik_vector.tiling.welding.sheets import Sheet
from tests.geometry.fills.regions import region
from tests.thorough import examples, long, rarely

HAIR = 1e-3
INKS = {"cotton": Ink("cotton", "#f4efe2"), "light": Ink("light", "#7d9fc6")}
LATTICES: dict[str, Lattice] = {
    "grid": ((60_000, 0), (0, 50_000)),
    "half-drop": ((60_000, 25_000), (0, 50_000)),
    "brick": ((57_000, 0), (19_000, 50_000)),
}


def kinds() -> Iterator[Fill]:
    """Yield every fill that a ground can have, with everything that its rows can follow."""
    for name, cls in FILLS.items():
        follow = {"cecek": Rows, "cacah-gori": Rows, "galaran": Follow}.get(name, ())
        for each in follow:
            if each not in ("centre", "axis"):
                yield cls(follow=each)  # type: ignore[call-arg]
        if not follow and name not in ("veins", "ukel"):
            yield cls()
    yield Ukel(spacing=4.2)
    yield Galaran(angle=33, spacing=1.3, width=0.5, margin=0.2)


ALL = list(kinds())
NAMES = [f"{fill.kind}-{getattr(fill, 'follow', '')}" for fill in ALL]


def placed(seed: int, lattice: Lattice) -> Geometries:
    """Return some random regions with holes, somewhere on the cloth."""
    chance = np.random.default_rng(seed)
    size = np.array([lattice[0][0], lattice[1][1]]) / 1000
    found = [region(seed * 10 + k, 9.0) for k in range(int(chance.integers(1, 4)))]
    moves = chance.random((len(found), 2)) * size
    moved = [
        Affine.translation((x, y)).apply(parts) for parts, (x, y) in zip(found, moves.tolist(), strict=True)
    ]
    return np.concatenate(moved)


def laid(fill: Fill, motifs: Geometries, lattice: Lattice) -> Geometries:
    placement = Placement(layout=FreeGround(), fill_with=fill, ink="light")
    sheets = [Sheet("m", INKS["cotton"], motifs)]
    return polygons(free_ground(placement, sheets, Given(lattice, INKS, 0.02, 3, 10_000_000)).areas)


def around(shapes: Geometries, lattice: Lattice, reach: int = 2) -> Geometries:
    """Return shapes and their translates, themselves first."""
    (ax, ay), (bx, by) = lattice
    steps = range(-reach, reach + 1)
    shifts = [(i * ax + j * bx, i * ay + j * by) for i in steps for j in steps if i or j]
    moved = [Affine.translation((x / 1000, y / 1000)).apply(shapes) for x, y in shifts]
    return np.concatenate([shapes, *moved])


def rows_close_on(fill: Fill) -> list[Lattice]:
    """Return the lattices on which a fill is tried; the wide pairs of spirals close on the straight one."""
    return [LATTICES["grid"]] if fill.kind == "ukel" else list(LATTICES.values())


def holds(fill: Fill, seed: int, lattice: Lattice) -> None:
    """Assert what is true of every ground."""
    motifs = placed(seed, lattice)
    marks = laid(fill, motifs, lattice)
    assert len(marks) > 0
    assert shapely.is_valid(marks).all()
    _, far = shapely.STRtree(around(motifs, lattice)).query_nearest(
        marks, return_distance=True, all_matches=False
    )
    assert far.min() >= fill.margin - HAIR
    there = around(marks, lattice)
    a, b = shapely.STRtree(there).query(marks, predicate="intersects")
    shared = shapely.area(shapely.intersection(marks[a], there[b]))
    assert shared[a != b].max(initial=0) < 1e-6
    if fill.whole:
        assert not (a != b).any()


@pytest.mark.parametrize("fill", rarely(ALL, 2), ids=NAMES)
def test_marks_keep_the_margin_and_never_overlap_over_the_seam_either(fill: Fill) -> None:
    for seed, lattice in enumerate(rows_close_on(fill)[: examples(2, 3)]):
        holds(fill, seed, lattice)


@long
@pytest.mark.parametrize("fill", ALL, ids=NAMES)
def test_so_they_do_round_many_motifs(fill: Fill) -> None:
    for seed in range(100, 100 + examples(0, 12)):
        lattices = rows_close_on(fill)
        holds(fill, seed, lattices[seed % len(lattices)])


POINTS = 4000
"""Places of a repeat that are looked at."""

FREE_OF_ROWS = [fill for fill in ALL if not fill.basis() and fill.kind != "isen"]
GROUPS = {
    name: TileSpec(size=(60, 103.923 if name[1] in "36" else 60), repeat=name)
    for name in ("p2", "pg", "cm", "pmg", "cmm", "p4", "p4g", "p4m", "p3", "p31m", "p3m1", "p6", "p6m")
}


def keeps(fill: Fill, seed: int, tile: TileSpec) -> None:
    """Assert that a ground round motifs that keep a group keeps it too, and all that is true of others."""
    cell = tile.repeating()
    free, cut = tile.orbit(), tile.orbit(spread=Spread.CUT)
    images = np.concatenate([each.apply(placed(seed, LATTICES["grid"])) for each in free.operations])
    united = np.asarray(shapely.get_parts(shapely.union_all(images)), dtype=object)
    motifs = oriented(to_mm(polygonal(to_step_grid(united))))
    placement = Placement(layout=FreeGround(), fill_with=fill, ink="light", symmetry=tile.repeat)
    given = Given(cell.lattice, INKS, 0.02, 3, 10_000_000, cut)
    marks = polygons(free_ground(placement, [Sheet("m", INKS["cotton"], motifs)], given).areas)
    assert shapely.is_valid(marks).all()
    tree = shapely.STRtree(around(motifs, cell.lattice))
    _, far = tree.query_nearest(marks, return_distance=True, all_matches=False)
    assert far.min() >= fill.margin - HAIR
    there = shapely.STRtree(around(marks, cell.lattice, 1))
    points = np.random.default_rng(seed).random((POINTS, 2)) * [cell.width, cell.height]
    hits, _ = there.query(shapely.points(points), predicate="intersects")
    drawn = np.bincount(hits, minlength=POINTS)
    # Bands that are cut at an edge of the region lap over it, and are welded with the rest of their ink.
    assert (drawn > 1).mean() <= (0 if fill.whole else 0.001)
    lattice = np.array(cell.lattice) / 1000
    for operation in cut.operations:
        images = Period(lattice, 0.0).home(operation.at(points))
        hits, _ = there.query(shapely.points(images), predicate="intersects")
        # Polygons that stand for discs are turned against one another.
        assert ((drawn > 0) != (np.bincount(hits, minlength=POINTS) > 0)).mean() < 0.004, operation


@pytest.mark.parametrize(
    "fill", rarely(FREE_OF_ROWS, 2), ids=[f"{f.kind}-{getattr(f, 'follow', '')}" for f in FREE_OF_ROWS]
)
def test_a_ground_keeps_the_group_of_what_lies_there(fill: Fill) -> None:
    keeps(fill, 5, TileSpec(size=(60, 60), repeat="pgg"))


@long
@pytest.mark.parametrize("name", GROUPS)
def test_so_it_does_in_every_group(name: str) -> None:
    for seed in range(40, 40 + examples(0, 4)):
        keeps(FREE_OF_ROWS[seed % len(FREE_OF_ROWS)], seed, GROUPS[name])


@pytest.mark.parametrize("lattice", LATTICES.values(), ids=LATTICES)
@pytest.mark.parametrize("angle", [0, 17, 45])
def test_dots_in_rows_stand_evenly_within_5_per_cent_over_the_seam(lattice: Lattice, angle: float) -> None:
    fill = Cecek(angle=angle)
    dots = laid(fill, np.array([shapely.Point(20, 20).buffer(8)], dtype=object), lattice)
    middles = shapely.get_coordinates(shapely.centroid(dots))
    around_all = shapely.centroid(around(dots, lattice, 1))
    _, far = shapely.STRtree(around_all).query_nearest(
        shapely.centroid(dots), return_distance=True, exclusive=True, all_matches=False
    )
    assert far.min() > 0.95 * fill.spacing
    assert far.max() < 1.05 * fill.spacing
    free = lattice[0][0] * lattice[1][1] / 1e6 - np.pi * (8 + fill.margin + fill.width / 2) ** 2
    assert len(middles) == pytest.approx(free / (fill.spacing**2 * np.sqrt(0.75)), rel=0.06)


def test_a_tossed_ground_has_no_thinner_strip_along_the_seam() -> None:
    fill, lattice = Cecek(follow=Rows.SCATTER), LATTICES["grid"]
    dots = laid(fill, np.array([shapely.Point(30, 25).buffer(4)], dtype=object), lattice)
    x, y = shapely.get_coordinates(shapely.centroid(dots)).T
    beside = (x % 60 < 3) | (x % 60 > 57) | (y % 50 < 3) | (y % 50 > 47)
    strip = 60 * 50 - 54 * 44
    assert beside.sum() / strip == pytest.approx((~beside).sum() / (54 * 44 - np.pi * 25), rel=0.15)


@pytest.mark.parametrize("lattice", LATTICES.values(), ids=LATTICES)
def test_rows_that_run_on_over_the_repeat_leave_no_lane_bare(lattice: Lattice) -> None:
    fill = Cecek(follow=Rows.CONTOUR)
    motif = np.array([shapely.Point(20, 20).buffer(4)], dtype=object)
    dots = shapely.STRtree(around(laid(fill, motif, lattice), lattice, 1))
    x, y = np.meshgrid(np.arange(0.5, lattice[0][0] / 1000), np.arange(0.5, lattice[1][1] / 1000))
    places = shapely.points(x.ravel(), y.ravel())
    _, bare = dots.query_nearest(places, return_distance=True, all_matches=False)
    near = shapely.STRtree(around(motif, lattice)).query(places, predicate="dwithin", distance=3.0)[0]
    assert np.delete(bare, near).max() < 1.5 * fill.spacing


RECIPE = """
[ink.light]
width = 0.8
[ink.cotton]
[motif.m]
kind = "rosette"
elements = [{ curve = { kind = "petal", n = 2, length = 14 }, count = 5 }]
[[place]]
motif = "m"
ink = "cotton"
scale = 1
at = [8, 12]
[[place]]
layout = { kind = "ground" }
GROUND
[tile]
size = [60, 60]
repeat = "REPEAT"
"""


def made(ground: str, repeat: str = "grid") -> Artwork:
    return compile_recipe(read_recipe(RECIPE.replace("GROUND", ground).replace("REPEAT", repeat)))


@pytest.mark.parametrize("repeat", ["half-drop", "p4m"])
@pytest.mark.parametrize("fill", ['kind = "hatching"', 'kind = "cecek", follow = "contour"'])
def test_the_certificate_holds(fill: str, repeat: str) -> None:
    artwork = made(f'fill_with = {{ {fill}, ink = "light" }}', repeat)
    assert {layer.ink.name for layer in artwork.layers} == {"light", "cotton"}
    assert certify(artwork).passed


REFUSED = {
    "no fill": ("", r"fill_with is missing: a ground is filled with marks"),
    "a width": ('fill_with = { kind = "cecek" }\nwidth = 30', r"width: 30: a ground .* expected no width"),
    "a motif": ('fill_with = { kind = "cecek" }\nmotif = "m"', r'motif: "m": a ground .* expected no motif'),
    "veins": ('fill_with = { kind = "veins" }', r'kind = "veins": a ground has no centre'),
    "a centre": ('fill_with = { kind = "cecek", follow = "centre" }', r'follow = "centre": a ground has no'),
    "no ink": ('fill_with = { kind = "cecek" }', r"place\[1\]\.ink: missing"),
    "no room": ('ink = "light"\nfill_with = { kind = "cecek", margin = 40 }', r"margin = 40: no mark of"),
    "rows": (
        'ink = "light"\nfill_with = { kind = "cecek", spacing = 45 }',
        r"spacing = 45: rows so far apart",
    ),
    "dense": (
        'ink = "light"\nfill_with = { kind = "cecek", spacing = 0.06, width = 0.05 }',
        r"spacing = 0\.06: about .* marks, past the limit",
    ),
}


@pytest.mark.parametrize(("ground", "words"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_is_told_with_key_and_value(ground: str, words: str) -> None:
    with pytest.raises(BatikError, match=words):
        made(ground)
