"""Images of regions: what becomes of shells and holes, about branch points and poles and across folds."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError, TornRingError
from batik_vector.geometry.maps.affine import Complexes, Geometries
from batik_vector.geometry.maps.chains import Angles, Chains, prepare, unwrap
from batik_vector.geometry.maps.flame import FlameMap, Images, Tolerance, core_tolerance
from batik_vector.geometry.maps.settle import (
    chains_of,
    parts_of,
    points_of,
    polygons_of,
    settle,
    thin_polygons,
)
from batik_vector.geometry.maps.trace import Traced, trace_images
from batik_vector.geometry.sampling import REFINE_SHARE, Indices

MAX_CELLS = 1_000_000
"""Pieces into which folds may cut the regions of one call."""

UNION_GRID = 1 / 1000
"""Relative to the tolerance: pieces on the two sides of a fold are welded on this grid, so that the
rounding of their common edge leaves no slit."""


def area_images(flame: FlameMap, polygons: Geometries, tolerance: Tolerance) -> Images:
    """Return the images of polygons under a map: see :meth:`FlameMap.areas`."""
    if not len(polygons):
        none = np.empty(0, np.intp)
        return Images(polygons, none, none)
    tolerance = core_tolerance(flame, tolerance)
    inner = flame.pre.apply(polygons)
    if any(variation.folds for _, variation in flame.terms):
        images = _folded(flame, inner, tolerance)
    else:
        images = _regions(flame, inner, tolerance, thinning=not callable(tolerance))
    found = shapely.orient_polygons(flame.post.apply(images.geometries))
    order = np.lexsort((images.source, images.branch))
    return Images(found[order], images.source[order], images.branch[order])


def _regions(flame: FlameMap, polygons: Geometries, tolerance: Tolerance, thinning: bool) -> Images:
    """Map regions whose boundaries are mapped without folding."""
    chains, holes = chains_of(polygons)
    chains = prepare(chains, flame)
    angles, around = None, np.zeros(len(polygons), bool)
    if flame.poles or flame.sheets > 1:
        chains, touching = _from_origin(chains)
        angles = unwrap(chains)
        turns = np.where(touching, 0, angles.turns)
        around[chains.owner[~holes & (turns != 0)]] = True
        _refuse_poles(flame, chains, touching, around, turns)
        if flame.sheets > 1 and len(flame.terms) > 1 and around.any():
            raise TornRingError(
                "a region winds round the centre of julian (root), whose branches a sum with other "
                "variations would tear: move it off the centre, or give julian a map of its own"
            )
    if flame.sheets == 1:
        return _plain(flame, chains, None, tolerance, thinning)
    assert angles is not None
    whole = around[chains.owner]
    found = []
    if not whole.all():
        part = chains.take(~whole)
        unwrapped = _same_sheet(part, unwrap(part), holes[~whole])
        found.append(_plain(flame, part, unwrapped, tolerance, thinning))
    if whole.any():
        found.append(_round_origin(flame, chains.take(whole), turns[whole], tolerance, thinning))
    return Images(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _from_origin(chains: Chains) -> tuple[Chains, NDArray[np.bool_]]:
    """Let every ring through the origin begin there; say which do."""
    zero = np.flatnonzero(chains.z == 0)
    chain = np.searchsorted(chains.offsets, zero, side="right") - 1
    touching, first = np.unique(chain, return_index=True)
    begin = np.zeros(len(chains), np.intp)
    begin[touching] = zero[first] - chains.first[touching]
    # The last vertex repeats the first, so a ring of n + 1 vertices turns modulo n.
    counts = np.diff(chains.offsets)
    rank = np.arange(len(chains.z)) - np.repeat(chains.first, counts)
    rank = (rank + np.repeat(begin, counts)) % np.repeat(counts - 1, counts)
    z = chains.z[np.repeat(chains.first, counts) + rank]
    return Chains(z, chains.offsets, chains.owner), np.isin(np.arange(len(chains)), touching)


def _refuse_poles(
    flame: FlameMap,
    chains: Chains,
    touching: NDArray[np.bool_],
    around: NDArray[np.bool_],
    turns: Indices,
) -> None:
    """Raise where a region contains or touches a point that goes to infinity."""
    if not flame.poles:
        return
    winding = np.bincount(chains.owner, turns != 0, len(around))
    # The shell and a hole both wind round an origin that lies in the hole.
    contains = around & (winding == 1)
    contains[chains.owner[touching]] = True
    if contains.any():
        raise TornRingError(
            f"{int(contains.sum())} of {len(contains)} regions contain or touch the centre of "
            f"{' + '.join(flame.poles)}, which goes to infinity: their images would not be bounded"
        )


def _plain(
    flame: FlameMap, chains: Chains, angles: Angles | None, tolerance: Tolerance, thinning: bool
) -> Images:
    """Map regions that have one image on each branch."""
    single = len(flame.terms) == 1
    found, source, branches = [], [], []
    for branch in range(1 if single else flame.branches):
        traced = trace_images(flame, chains, angles, branch, tolerance, thinning)
        images, owner = _built(flame, traced, chains.owner)
        for turn in range(flame.branches if single else 1):
            spin = flame.terms[0][1].spin(turn) if single else 1 + 0j
            turned, kept = _spun(images, owner, spin)
            found.append(turned)
            source.append(kept)
            branches.append(np.full(len(kept), max(branch, turn), np.intp))
    return Images(np.concatenate(found), np.concatenate(source), np.concatenate(branches))


def _built(flame: FlameMap, traced: Traced, owner: Indices) -> tuple[Geometries, Indices]:
    """Return valid polygons from traced rings, and their owners."""
    by_size = bool(flame.poles)
    polygons = polygons_of(*traced.thinned(), owner, by_size)
    index = np.unique(owner)
    bad = ~shapely.is_valid(polygons)
    if not bad.any():
        return polygons, index
    # What the thinning broke is whole before it.
    dense = Chains(traced.image, traced.offsets, owner).take(np.isin(owner, index[bad]))
    polygons[bad] = polygons_of(dense.z, dense.offsets, dense.owner, by_size)
    return _valid(polygons, index, injective=len(flame.terms) == 1)


def _valid(polygons: Geometries, index: Indices, injective: bool) -> tuple[Geometries, Indices]:
    """Settle the invalid ones among polygons."""
    bad = np.flatnonzero(~shapely.is_valid(polygons))
    if not len(bad):
        return polygons, index
    parts = [settle(polygons[i], injective) for i in bad]
    good = np.delete(np.arange(len(polygons)), bad)
    counts = [len(part) for part in parts]
    return (
        np.concatenate([polygons[good], *parts]),
        np.concatenate([index[good], np.repeat(index[bad], counts)]),
    )


def _spun(polygons: Geometries, index: Indices, spin: complex) -> tuple[Geometries, Indices]:
    """Turn polygons about the origin."""
    if spin == 1:
        return polygons, index

    def turn(
        points: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    ) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
        return points_of(points_as_complex(points) * spin)

    turned = np.asarray(shapely.transform(polygons, turn), dtype=object)
    return _valid(turned, index, injective=True)


def points_as_complex(points: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> Complexes:
    """Return points, shape (n, 2), as complex numbers."""
    return np.ascontiguousarray(points, np.float64).view(np.complex128)[:, 0]


def _same_sheet(chains: Chains, angles: Angles, holes: NDArray[np.bool_]) -> Angles:
    """Give each hole the angles, of all that differ by whole turns, that continue its shell's."""
    if not holes.any():
        return angles
    shell = np.flatnonzero(~holes)
    own = shell[np.searchsorted(chains.owner[shell], chains.owner)]
    full = 2 * math.pi
    low, high = angles.low[own], angles.high[own]
    begin = np.where(chains.z[chains.first] == 0, (angles.low + angles.high) / 2, angles.start)
    shift = np.ceil((low - begin) / full - 1e-12)
    # A shell that spirals round the origin has several; a ray tells which.
    for i in np.flatnonzero(holes & (begin + full * (shift + 1) <= high)):
        shift[i] = _sheet_by_ray(chains, angles, int(i), int(own[i])) - np.floor(begin[i] / full + 0.5)
    shift = np.where(holes, shift, 0.0) * full
    along = np.repeat(shift, np.diff(chains.offsets))
    return Angles(angles.middle + along, angles.start + shift, angles.end + shift, angles.low, angles.high)


def _sheet_by_ray(chains: Chains, angles: Angles, hole: int, shell: int) -> int:
    """Return how many turns a hole's principal angle lies behind its shell's.

    Outwards from a point of the hole the angle stays the same; where that ray first meets the shell, the
    shell's angle is the point's own.
    """
    part = slice(chains.offsets[hole], chains.offsets[hole + 1])
    # Holes may touch the shell in a point: start from the vertex furthest inside, by radius.
    at = chains.z[part][np.argmin(np.where(chains.z[part] == 0, np.inf, np.abs(chains.z[part])))]
    ray = at / abs(at)
    e = np.arange(chains.offsets[shell], chains.offsets[shell + 1] - 1)
    a, b = chains.z[e] / ray, chains.z[e + 1] / ray
    crossing = (a.imag <= 0) != (b.imag <= 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = a.real - a.imag * (b.real - a.real) / (b.imag - a.imag)
    crossing &= radius >= abs(at) * (1 - 1e-12)
    nearest = e[crossing][np.argmin(radius[crossing])]
    return round((angles.middle[nearest] - float(np.angle(at))) / (2 * math.pi))


def _round_origin(
    flame: FlameMap, chains: Chains, turns: Indices, tolerance: Tolerance, thinning: bool
) -> Images:
    """Map regions whose shell winds round the branch point: one image each, on all branches together."""
    variation = flame.terms[0][1]
    traced = trace_images(flame, chains, unwrap(chains), 0, tolerance, thinning)
    spins = [variation.spin(k) for k in range(variation.sheets)]

    def polygon(which: Indices, dense: bool) -> shapely.Polygon:
        rings = []
        for i in which:
            ring = traced.chain(int(i), dense)
            if turns[i] == 0:
                rings += [points_of(ring * spin) for spin in spins]
            else:
                turned = [ring[:-1] * spins[turns[i] * k % len(spins)] for k in range(len(spins))]
                rings.append(points_of(np.concatenate([*turned, ring[:1]])))
        if flame.poles:
            rings.sort(key=lambda ring: -abs(shapely.area(shapely.Polygon(ring))))
        return shapely.Polygon(rings[0], rings[1:])

    found, source = [], []
    for owner in np.unique(chains.owner):
        which = np.flatnonzero(chains.owner == owner)
        image = polygon(which, dense=False)
        if not image.is_valid:
            image = polygon(which, dense=True)
        parts = np.array([image], dtype=object) if image.is_valid else settle(image, injective=True)
        found.append(parts)
        source += [owner] * len(parts)
    return Images(np.concatenate(found), np.array(source, np.intp), np.zeros(len(source), np.intp))


def _folded(flame: FlameMap, polygons: Geometries, tolerance: Tolerance) -> Images:
    """Cut regions at the folds, map the pieces, and weld the images of each region."""
    pieces, owner = _cut_at_creases(flame, polygons)
    images = _regions(flame, pieces, tolerance, thinning=False)
    source = owner[images.source]
    found, sources, branches = [], [], []
    vertices = points_of(chains_of(images.geometries)[0].z)
    finest = tolerance
    if callable(tolerance):
        finest = float(tolerance(vertices).min(initial=np.inf))
    order = np.lexsort((source, images.branch))
    key = np.column_stack([images.branch, source])[order]
    starts = np.flatnonzero(np.r_[True, (key[1:] != key[:-1]).any(axis=1)]) if len(key) else []
    for group in np.split(order, starts[1:]) if len(key) else []:
        parts = images.geometries[group]
        if len(parts) > 1:
            parts = parts_of(shapely.union_all(parts, grid_size=finest * UNION_GRID))
        if not callable(tolerance):
            parts = thin_polygons(parts, tolerance * (1 - REFINE_SHARE - UNION_GRID))
        found.append(parts)
        sources.append(np.full(len(parts), source[group[0]], np.intp))
        branches.append(np.full(len(parts), images.branch[group[0]], np.intp))
    if not found:
        none = np.empty(0, np.intp)
        return Images(np.empty(0, object), none, none)
    return Images(np.concatenate(found), np.concatenate(sources), np.concatenate(branches))


def _cut_at_creases(flame: FlameMap, polygons: Geometries) -> tuple[Geometries, Indices]:
    """Return the pieces of regions between creases, and the region each comes from."""
    owner = np.arange(len(polygons), dtype=np.intp)
    for _, variation in flame.terms:
        if variation.folds:
            for axis in (0, 1):
                bounds = shapely.bounds(polygons)
                creases = variation.creases(float(bounds.min()) - 1e-9, float(bounds.max()) + 1e-9)
                polygons, kept = _cut_across(polygons, creases, axis)
                owner = owner[kept]
    return polygons, owner


def _cut_across(
    polygons: Geometries, creases: np.ndarray[tuple[int], np.dtype[np.float64]], axis: int
) -> tuple[Geometries, Indices]:
    """Cut polygons at x = c (axis 0) or y = c (axis 1)."""
    bounds = shapely.bounds(polygons)
    low, high = bounds[:, axis], bounds[:, axis + 2]
    first = np.searchsorted(creases, low, side="right")
    count = np.maximum(np.searchsorted(creases, high, side="left") - first, 0) + 1
    if count.sum() > MAX_CELLS:
        raise TooLargeError(f"a shape is folded into {int(count.sum()):,} pieces: make it smaller")
    index = np.repeat(np.arange(len(polygons)), count)
    rank = np.arange(len(index)) - np.repeat(np.cumsum(count) - count, count)
    walls = np.concatenate([creases, [np.inf]])
    start = np.where(rank == 0, low[index] - 1, walls[np.maximum(first[index] + rank - 1, 0)])
    stop = np.where(rank == count[index] - 1, high[index] + 1, walls[first[index] + rank])
    other_low, other_high = bounds[index, 1 - axis] - 1, bounds[index, 3 - axis] + 1
    boxes = (
        shapely.box(start, other_low, stop, other_high)
        if axis == 0
        else shapely.box(other_low, start, other_high, stop)
    )
    cut = count[index] > 1
    pieces = polygons[index]
    pieces[cut] = shapely.intersection(pieces[cut], boxes[cut])
    parts, own = shapely.get_parts(pieces, return_index=True)
    inner, again = shapely.get_parts(parts, return_index=True)
    own = own[again]
    solid = (shapely.get_dimensions(inner) == 2) & (shapely.area(inner) > 0)
    return np.asarray(inner[solid], dtype=object), index[own[solid]].astype(np.intp)
