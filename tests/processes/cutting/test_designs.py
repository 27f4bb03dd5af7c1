"""Random designs are cut whole: in order, and as large as they are drawn, by a beam and by a knife."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Outlines, to_polygons
from batik_vector.machines import Machine
from batik_vector.processes.options import CutProcess
from batik_vector.processes.prepared import Prepared
from tests.distances import distances
from tests.thorough import examples, long

from .designs import NESTED, covered, design, nested
from .trailing import trailed

BEAM = 0.15
"""The kerf of a laser in card, in mm (PRODUCTION: laserengravingservice)."""
BLADE = 0.25
"""The offset of a common blade, in mm (Graphtec CB09U)."""
AREA = 0.001
CORNER = 0.05
STEPS = 0.002
LEAST = 25
"""mm² of an ink that are a design: of less, a micrometre beside their contours is more than a thousandth."""

QUICK = (2, 3, 4, 5, 8, 9, 11, 14, 17, 20, 22, 23)
NUMBERS = [*QUICK, *(each for each in range(300) if each not in QUICK)][: examples(12, 300)]


def cut(page: Artwork, **told: object) -> Prepared:
    return CutProcess(**told).apply(page, Machine())  # type: ignore[arg-type]


def within_reach(page: Artwork, key: str, value: float, **told: object) -> tuple[Prepared, float]:
    """Cut with a value, or with the one that a refusal offers."""
    try:
        return cut(page, **{key: value}, **told), value
    except GeometryError as refused:
        words = str(refused)
    offered = re.match(rf"{key} = [\d.]+ mm, expected at most ([\d.e-]+) mm", words)
    assert offered, words
    value = float(offered[1])
    # What belongs to the value does nothing without it, and is refused.
    return cut(page, **{key: value}, **(told if value else {})), value


def strokes_of(prepared: Prepared) -> list[Outlines]:
    return [tool.strokes for tool in prepared.tools if len(tool.strokes)]


def outside_first(strokes: Outlines) -> int:
    """Return how many closed strokes are cut before one that lies within them."""
    regions = to_polygons(strokes.taken(np.flatnonzero(strokes.closed)))
    outer, inner = shapely.STRtree(regions).query(regions, predicate="contains_properly")
    return int((inner > outer).sum())


@pytest.fixture(scope="module", params=NUMBERS)
def page(request: pytest.FixtureRequest) -> Artwork:
    """One design at a time for all tests."""
    return design(request.param)


@long
def test_inside_before_outside_and_all_of_it(page: Artwork) -> None:
    whole = 0.0
    for strokes in strokes_of(cut(page)):
        assert outside_first(strokes) == 0
        rings = to_polygons(strokes.taken(np.flatnonzero(strokes.closed)))
        # Every other ring from the outside in is a hole; shared edges part what is inside one.
        faces = shapely.get_parts(shapely.polygonize(list(shapely.boundary(rings))))
        whole += float(shapely.area(faces).sum())
    assert whole > 0


@long
def test_what_a_beam_leaves_is_what_was_drawn(page: Artwork) -> None:
    for layer in page.layers:
        one = replace(page, layers=(layer,), borders=frozenset())
        drawn = covered(one)
        if drawn.area < LEAST:
            continue
        prepared, kerf = within_reach(one, "kerf", BEAM)
        if kerf < 0.01:
            continue
        (strokes,) = strokes_of(prepared)
        assert outside_first(strokes) == 0
        beam = shapely.buffer(shapely.boundary(to_polygons(strokes, 1000)), kerf / 2, quad_segs=24)
        sheet = shapely.box(*shapely.buffer(drawn, 5).bounds)
        fallen = shapely.get_parts(shapely.difference(sheet, shapely.union_all(beam)))
        mostly = shapely.area(shapely.intersection(fallen, drawn)) > shapely.area(fallen) / 2
        kept = shapely.union_all(fallen[mostly])
        reached = within_a_beam(drawn, kerf)
        assert kept.area == pytest.approx(reached.area, rel=AREA)
        corners, angles = turns_of(without_hairs(drawn))
        off = distances(shapely.boundary(kept), corners)
        if page.title == NESTED:
            assert kept.area == pytest.approx(drawn.area, rel=AREA)
            # Into a corner of angle a the middle of a disc of radius r comes as near as r / sin(a / 2).
            beyond = kerf / 2 * (1 / np.cos(np.minimum(angles, 0) / 2) - 1)
            # Whole steps move either side of a corner, and its point by up to two.
            assert off[beyond < CORNER - STEPS].max() <= CORNER
        assert (off - distances(shapely.boundary(reached), corners)).max() <= CORNER


def within_a_beam(drawn: shapely.MultiPolygon, kerf: float) -> shapely.Polygon:
    """Return what a round beam can leave of areas: their outer corners, and their inner ones rounded."""
    return drawn.buffer(kerf / 2, quad_segs=48).buffer(-kerf / 2, quad_segs=48)


def without_hairs(drawn: shapely.MultiPolygon) -> shapely.Polygon:
    """Return areas without what is narrower than a few steps."""
    return drawn.buffer(-0.003, join_style="mitre", mitre_limit=2).buffer(
        0.003, join_style="mitre", mitre_limit=2
    )


def turns_of(drawn: shapely.Polygon) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices of polygons, and how far their borders turn there: what is drawn is left."""
    places, angles = [], []
    for polygon in shapely.get_parts(shapely.normalize(drawn)):
        polygon = shapely.orient_polygons(polygon)
        for ring in (polygon.exterior, *polygon.interiors):
            points = shapely.get_coordinates(ring)[:-1]
            into, out = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
            cross = into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0]
            angles.append(np.arctan2(cross, (into * out).sum(axis=1)))
            places.append(points)
    return np.concatenate(places), np.concatenate(angles)


@long
def test_what_a_knife_leaves_is_what_was_drawn(page: Artwork) -> None:
    for layer in page.layers:
        one = replace(page, layers=(layer,), borders=frozenset())
        if covered(one).area < LEAST:
            continue
        prepared, offset = within_reach(one, "blade_offset", BLADE, overcut=0.0, swivel=90.0)
        if offset < 0.01:
            continue
        (asked,) = strokes_of(cut(one, start="straight"))
        (way,) = strokes_of(prepared)
        tracks = tracked(way, offset)[1:]
        assert len(tracks) == len(asked)
        rings = to_polygons(asked, 1000)
        loops = np.array([shapely.Polygon(track) for track in tracks], dtype=object)
        assert signed_area(rings, loops) == pytest.approx(shapely.area(evenodd(rings)), rel=AREA)
        for ring, track in zip(rings, tracks, strict=True):
            corners = shapely.get_coordinates(ring)
            assert distances(shapely.LineString(track), corners).max() <= CORNER


def tracked(way: Outlines, offset: float) -> list[np.ndarray]:
    """Return where the tip goes in each stroke, in mm; the blade keeps its direction in between."""
    tracks, heading = [], math.pi / 2
    for first, stop in zip(way.rings[:-1].tolist(), way.rings[1:].tolist(), strict=True):
        holder = [complex(x, y) / 1000 for x, y in way.points[first:stop].tolist()]
        tip = trailed(holder, offset, heading, 0.03)
        end = holder[-1] - tip[-1]
        heading = math.atan2(end.imag, end.real)
        tracks.append(np.array([(place.real, place.imag) for place in tip]))
    return tracks


def depth_signs(rings: np.ndarray) -> np.ndarray:
    """Return 1 for rings about what is drawn, and -1 for holes; rings may touch."""
    places = shapely.point_on_surface(rings)
    outer, inside = shapely.STRtree(rings).query(rings, predicate="intersects")
    larger = shapely.area(rings[outer]) > shapely.area(rings[inside])
    about = larger & np.asarray(shapely.contains(rings[outer], places[inside]), bool)
    inside = inside[about]
    return np.where(np.bincount(inside, minlength=len(rings)) % 2, -1, 1)


def signed_area(rings: np.ndarray, loops: np.ndarray) -> float:
    return float((depth_signs(rings) * shapely.area(loops)).sum())


def evenodd(rings: np.ndarray) -> np.ndarray:
    found = shapely.Polygon()
    for ring in rings:
        found = shapely.symmetric_difference(found, ring)
    return np.array([found], dtype=object)


def test_nested_designs_are_deep() -> None:
    depths = [len(nested(number).layers[0].areas) for number in range(2, 60, 3)]
    assert max(depths) > 3
