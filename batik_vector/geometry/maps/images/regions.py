"""Regions under a map that does not fold: shells and holes, about branch points and poles."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import TornRingError
from batik_vector.geometry.congruence import distinct
from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.images.chains import Angles, Chains, prepare, unwrap
from batik_vector.geometry.maps.images.polygons import (
    chains_of,
    points_of,
    polygons_of,
    settle,
)
from batik_vector.geometry.maps.images.result import NO_IMAGES, Images, Tolerance
from batik_vector.geometry.maps.images.thinning import ever_finer
from batik_vector.geometry.maps.images.traces import Traced, trace_images
from batik_vector.geometry.sampling import Geometries, Indices, Points


def regions(flame: FlameMap, polygons: Geometries, tolerance: Tolerance, thinning: bool) -> Images:
    """Map regions whose boundaries are mapped without folding."""
    chains, holes = chains_of(polygons)
    chains, holes = _with_area(prepare(chains, flame), holes)
    if not len(chains):
        return NO_IMAGES
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


def _with_area(chains: Chains, holes: NDArray[np.bool_]) -> tuple[Chains, NDArray[np.bool_]]:
    """Leave out rings that shrank into the origin: slivers no wider than a rounding step."""
    gone = np.diff(chains.offsets) < 4
    if not gone.any():
        return chains, holes
    gone |= np.isin(chains.owner, chains.owner[gone & ~holes])
    return chains.take(~gone), holes[~gone]


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
        images, owner = _built(flame, traced, chains.owner, tolerance if thinning else None)
        for turn in range(flame.branches if single else 1):
            spin = flame.terms[0][1].spin(turn) if single else 1 + 0j
            turned, kept = _spun(images, owner, spin)
            found.append(turned)
            source.append(kept)
            branches.append(np.full(len(kept), max(branch, turn), np.intp))
    return Images(np.concatenate(found), np.concatenate(source), np.concatenate(branches))


def _built(
    flame: FlameMap, traced: Traced, owner: Indices, tolerance: Tolerance | None
) -> tuple[Geometries, Indices]:
    """Return valid polygons from traced rings, and their owners."""
    by_size = bool(flame.poles)
    polygons = polygons_of(*traced.thinned(), owner, by_size)
    index = distinct(owner)
    bad = ~shapely.is_valid(polygons)
    if bad.any() and tolerance is not None and not callable(tolerance):
        # What the thinning broke is whole before it.
        part = Chains(traced.image, traced.offsets, owner)
        for keep in ever_finer(part.z, part.offsets, tolerance, np.ones(len(owner), bool)):
            which = np.isin(owner, index[bad])
            offsets = np.concatenate([[0], np.cumsum(keep)]).astype(np.intp)[part.offsets]
            finer = Chains(part.z[keep], offsets, owner).take(which)
            polygons[bad] = polygons_of(finer.z, finer.offsets, finer.owner, by_size)
            bad[bad] = ~shapely.is_valid(polygons[bad])
            if not bad.any():
                break
    return valid_parts(polygons, index, injective=len(flame.terms) == 1)


def valid_parts(polygons: Geometries, index: Indices, injective: bool) -> tuple[Geometries, Indices]:
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
        points: Points,
    ) -> Points:
        return points_of(points_as_complex(points) * spin)

    turned = np.asarray(shapely.transform(polygons, turn), dtype=object)
    return valid_parts(turned, index, injective=True)


def points_as_complex(points: Points) -> Complexes:
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
    return round(float(angles.middle[nearest] - np.angle(at)) / (2 * math.pi))


def _round_origin(
    flame: FlameMap, chains: Chains, turns: Indices, tolerance: Tolerance, thinning: bool
) -> Images:
    """Map regions whose shell winds round the branch point: one image each, on all branches together."""
    variation = flame.terms[0][1]
    spins = [variation.spin(k) for k in range(variation.sheets)]
    traced = trace_images(flame, chains, unwrap(chains), 0, tolerance, thinning)

    found, source = [], []
    for owner in distinct(chains.owner):
        which = np.flatnonzero(chains.owner == owner)
        image = _wound(flame, [traced.chain(int(i)) for i in which], turns[which], spins)
        if not image.is_valid and thinning and not callable(tolerance):
            part = Chains(traced.image, traced.offsets, chains.owner).take(which)
            for keep in ever_finer(part.z, part.offsets, tolerance, turns[which] == 0):
                rings = [part.z[a:b][keep[a:b]] for a, b in pairwise(part.offsets)]
                image = _wound(flame, rings, turns[which], spins)
                if image.is_valid:
                    break
        parts = np.array([image], dtype=object) if image.is_valid else settle(image, injective=True)
        found.append(parts)
        source += [owner] * len(parts)
    return Images(np.concatenate(found), np.array(source, np.intp), np.zeros(len(source), np.intp))


def _wound(flame: FlameMap, rings: list[Complexes], turns: Indices, spins: list[complex]) -> shapely.Polygon:
    """Return the one image of a region round the branch point from one turn of each of its rings.

    A ring that winds is as many turns long as there are branches; one that does not has an image on each.
    """
    found = []
    for ring, turn in zip(rings, turns, strict=True):
        if turn == 0:
            found += [points_of(ring * spin) for spin in spins]
        else:
            turned = [ring[:-1] * spins[turn * k % len(spins)] for k in range(len(spins))]
            found.append(points_of(np.concatenate([*turned, ring[:1]])))
    if flame.poles:
        found.sort(key=lambda points: -abs(shapely.area(shapely.Polygon(points))))
    return shapely.Polygon(found[0], found[1:])
