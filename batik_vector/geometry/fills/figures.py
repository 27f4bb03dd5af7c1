"""The figures of isen: crosses, fragments, linked spirals, scales and veins."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.fills.bodies import bodies, chords, stamped
from batik_vector.geometry.fills.insets import Parts, inset
from batik_vector.geometry.fills.midribs import axes
from batik_vector.geometry.fills.rows import lattice, placed
from batik_vector.geometry.fills.thinning import by_length, clear
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.sampling import Array, Geometries, Indices

ARM = 0.34
"""Length of a cross's arm, as a share of the spacing."""

TURNS, HEART = 1.5, 0.12
"""Turns of a spiral, and the share of its radius at which it begins."""


def cross(spacing: float, width: float, tolerance: float) -> Array:
    """Return the corners of a cross of two strokes with round ends (*cacah gori*), shape (n, 2)."""
    arm = max(ARM * spacing - width / 2, width / 2)
    lines = shapely.multilinestrings([[(-arm, 0), (arm, 0)], [(0, -arm), (0, arm)]])
    body = shapely.buffer(lines, width / 2, quad_segs=chords(width / 2, tolerance) // 4)
    return shapely.get_coordinates(body)[:-1][::-1]


def fragment(length: float, width: float, tolerance: float) -> Array:
    """Return the corners of a bent splinter (*herangan*), shape (n, 2)."""
    half, bow = (length - width) / 2, 0.22 * (length - width)
    line = shapely.LineString([(-half, -bow / 2), (-0.1 * half, bow / 2), (half, -bow / 4)])
    body = shapely.buffer(line, width / 2, quad_segs=chords(width / 2, tolerance) // 4)
    return shapely.get_coordinates(body)[:-1][::-1]


def spirals(
    parts: Parts, margin: float, angle: float, spacing: float, width: float, tolerance: float
) -> tuple[Geometries, Indices]:
    """Return spirals (*ukel*) in rows, linked two and two where both have room, and the region of each.

    Args:
        parts: whole regions.
        margin: from the edge to the spirals.
        angle: of the rows, in degrees.
        spacing: from spiral to spiral.
        width: of their line.
        tolerance: of their outlines.
    """
    gap = max(0.6 * width, 0.1 * spacing)
    radius = (spacing - gap) / 2  # to the line's outer edge
    within = inset(parts, margin + radius)
    shapely.prepare(within.shapes)
    # The two of a pair touch in its middle, where their lines are one.
    half = radius - width / 2
    centres, part = _pairs(within, angle, 2 * half, 2 * spacing - width, spacing)
    at = centres.reshape(-1, 2)
    there = shapely.contains_xy(within.shapes[np.repeat(part, 2)], *at.T).reshape(-1, 2)
    curl = _spiral(half, tolerance)
    linked = np.vstack([curl, -curl[-2::-1]])
    turn = math.radians(angle)
    found, region = [], []
    for shape, kept, where in (
        (linked, there.all(axis=1), centres.mean(axis=1)),
        (curl + [half, 0.0], there[:, 0] & ~there[:, 1], centres[:, 0]),
        (-curl - [half, 0.0], there[:, 1] & ~there[:, 0], centres[:, 1]),
    ):
        body = bodies(np.array([shapely.LineString(shape)], dtype=object), width, tolerance)[0]
        found.append(_set_down(body, where[kept], turn))
        region.append(within.region[part[kept]])
    return np.concatenate(found), np.concatenate(region)


def _pairs(parts: Parts, angle: float, apart: float, period: float, pitch: float) -> tuple[Array, Indices]:
    """Return places two and two in rows, shape (n, 2, 2), one of each pair within a part at least."""
    found, of = [], []
    for side in (-0.5, 0.5):
        dx, dy = placed(np.array([-side * apart]), np.zeros(1), angle)[0].tolist()
        moved = Parts(Affine.translation((dx, dy)).apply(parts.shapes), parts.region)
        middle, part = lattice(moved, angle, period, pitch, stagger=0.25)
        found.append(middle)
        of.append(part)
    middles, part = np.concatenate(found), np.concatenate(of)
    # What both have found is there once.
    cells = np.column_stack([part, np.rint(middles / (pitch / 16)).astype(np.int64)])
    _, first = np.unique(cells, axis=0, return_index=True)
    first.sort()
    ends = placed(np.array([-apart / 2, apart / 2]), np.zeros(2), angle)
    return middles[first][:, None] + ends[None], part[first]


def _spiral(radius: float, tolerance: float) -> Array:
    """Return a spiral about (-radius, 0) that ends in the origin, where it runs along +y, shape (n, 2)."""
    turns = 2 * np.pi * TURNS
    count = max(math.ceil(turns / (2 * math.acos(1 - min(tolerance / radius, 0.2)))), 24)
    share = np.linspace(0, 1, count + 1)
    # Its last quarter keeps the radius, so that it runs straight into its mirror image.
    away = radius * np.minimum(HEART + (1 - HEART) * share / (1 - 0.25 / TURNS), 1.0)
    angle = turns * (share - 1)
    return np.column_stack([away * np.cos(angle) - radius, away * np.sin(angle)])


def _set_down(body: shapely.Polygon, places: Array, turn: float) -> Geometries:
    """Return a polygon, which may have holes, at places, all turned alike."""
    shapes = [np.asarray(ring.coords)[:-1] for ring in (body.exterior, *body.interiors)]
    turns = np.full(len(places), turn)
    outer, *inner = (stamped(shape, places, turns) for shape in shapes)
    if not inner or not len(places):
        return outer
    holes = np.column_stack([shapely.get_exterior_ring(each) for each in inner])
    return np.asarray(shapely.polygons(shapely.get_exterior_ring(outer), holes), dtype=object)


def scales(
    parts: Parts, margin: float, angle: float, spacing: float, width: float, tolerance: float
) -> tuple[Geometries, Indices]:
    """Return scales (*sisik*): arcs in rows, each row moved by half a scale, cut off where they would leave.

    Args:
        parts: whole regions.
        margin: from the edge to the arcs.
        angle: of the rows, in degrees: scales open towards their right.
        spacing: breadth of a scale.
        width: of its line.
        tolerance: of their outlines.
    """
    # Each end of an arc stands over the crown of one beneath: with r = s/2 - d the distance there is
    # √(d² + s²/4) - r, which shall leave bare ground between them.
    bare, half = 1.4 * width, spacing / 2
    radius = half - bare * (bare + spacing) / (2 * bare + spacing)
    near = inset(Parts(parts.shapes, parts.region), margin + width / 2)
    # What GEOS makes broader has now and then a crumb beside it.
    wide, of = shapely.get_parts(shapely.buffer(near.shapes, spacing, quad_segs=4), return_index=True)
    centres, part = lattice(Parts(wide, near.region[of]), angle, spacing, spacing / 2)
    part = of[part]
    count = chords(radius, tolerance) // 2
    bow = np.pi * np.linspace(0, 1, count + 1)
    arc = placed(radius * np.cos(bow), radius * np.sin(bow), angle)
    lines = shapely.linestrings(centres[:, None] + arc[None])
    return _cut(np.asarray(lines, dtype=object), near, part, width, spacing / 4, tolerance)


def _cut(
    lines: Geometries, within: Parts, part: Indices, width: float, least: float, tolerance: float
) -> tuple[Geometries, Indices]:
    """Return the bodies of what lies of lines within their parts, crumbs left out, and the region of each."""
    shapely.prepare(within.shapes)
    inside = shapely.contains_properly(within.shapes[part], lines)
    crossed = ~inside & shapely.intersects(within.shapes[part], lines)
    # A ring that is cut is one line over its beginning.
    cut = shapely.line_merge(shapely.intersection(lines[crossed], within.shapes[part[crossed]]))
    pieces, of = shapely.get_parts(cut, return_index=True)
    good = (shapely.get_type_id(pieces) == shapely.GeometryType.LINESTRING) & (
        shapely.length(pieces) >= least
    )
    kept = np.concatenate([lines[inside], pieces[good]])
    region = within.region[np.concatenate([part[inside], part[crossed][of[good]]])]
    alone = clear(kept, region, 1.2 * width, by_length(kept))
    return bodies(kept[alone], width, tolerance), region[alone]


def arcs(
    parts: Parts,
    radius: NDArray[Any],
    centre: Array,
    part: Indices,
    width: float,
    least: float,
    tolerance: float,
) -> tuple[Geometries, Indices]:
    """Return the bodies of circles about centres as far as they lie within parts, and the region of each."""
    lines = []
    for r in np.unique(radius).tolist():
        count = max(math.ceil(math.pi / math.acos(1 - min(tolerance / max(r, 1e-9), 0.3))), 16)
        turn = 2 * np.pi * (np.arange(count + 1) % count) / count  # closed to the bit
        mine = np.flatnonzero(radius == r)
        # Begun on the far side, where the parts that lie along +x do not reach.
        ring = -r * np.column_stack([np.cos(turn), np.sin(turn)])
        lines += list(
            zip(mine.tolist(), shapely.linestrings(centre[mine][:, None] + ring[None]), strict=True)
        )
    ordered = np.array([line for _, line in sorted(lines, key=lambda each: each[0])], dtype=object)
    return _cut(ordered, parts, part, width, least, tolerance)


def veins(
    parts: Parts, margin: float, angle: float, spacing: float, width: float, tolerance: float
) -> tuple[Geometries, Indices]:
    """Return the veins of leaves: for each region a midrib along its axis, and side veins that leave it.

    Args:
        parts: whole regions; their axis is the longer side of their narrowest rectangle.
        margin: from the edge to the veins.
        angle: in degrees, between the midrib and a side vein where it leaves it.
        spacing: from side vein to side vein along the midrib.
        width: of their lines.
        tolerance: of their outlines.
    """
    within = inset(parts, margin + width / 2)
    if not len(within.shapes):
        return within.shapes, within.region
    root, ahead, length, half = axes(parts.shapes)
    lean = 1.4 / math.tan(math.radians(angle))
    # The first leave the midrib's line before it begins, so that the base is filled too.
    before = np.ceil(half * lean / spacing).astype(np.intp)
    count = np.maximum(np.floor(length / spacing).astype(np.intp), 1) + before
    leaf = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(leaf)) - np.repeat(np.cumsum(count) - count, count)
    start = (number - before[leaf] + 0.5) * spacing
    share = np.linspace(0, 1, 9)
    up = share[None] * half[leaf][:, None]
    # They bend towards the tip.
    on = start[:, None] + up * lean * (3 + 4 * share[None]) / 7
    sides = [
        root[leaf][:, None]
        + on[..., None] * ahead[leaf][:, None]
        + sign * up[..., None] * _left(ahead[leaf])[:, None]
        for sign in (1.0, -1.0)
    ]
    ribs = np.stack([root, root + length[:, None] * ahead], axis=1)
    lines = np.concatenate([shapely.linestrings(ribs), *(shapely.linestrings(side) for side in sides)])
    of = np.concatenate([np.arange(len(count)), leaf, leaf])
    return _joined(np.asarray(lines, dtype=object), of, within, width, tolerance)


def _left(ahead: Array) -> Array:
    return np.column_stack([-ahead[:, 1], ahead[:, 0]])


def _joined(
    lines: Geometries, leaf: Indices, within: Parts, width: float, tolerance: float
) -> tuple[Geometries, Indices]:
    """Return for each part one body of the lines of its leaf that hang together."""
    part_of = np.argsort(within.region, kind="stable")
    low = np.searchsorted(within.region[part_of], leaf)
    count = np.searchsorted(within.region[part_of], leaf, side="right") - low
    line = np.repeat(np.arange(len(leaf)), count)
    part = part_of[low[line] + np.arange(len(line)) - np.repeat(np.cumsum(count) - count, count)]
    pieces, of = shapely.get_parts(shapely.intersection(lines[line], within.shapes[part]), return_index=True)
    good = shapely.length(pieces) > width
    pieces, of = pieces[good], part[of[good]]
    order = np.argsort(of, kind="stable")
    names, number = np.unique(of[order], return_inverse=True)
    if not len(names):
        return pieces, of
    together = np.asarray(shapely.multilinestrings(pieces[order], indices=number), dtype=object)
    shapes, whose = shapely.get_parts(bodies(together, width, tolerance), return_index=True)
    return np.asarray(shapes, dtype=object), within.region[names[whose]]
