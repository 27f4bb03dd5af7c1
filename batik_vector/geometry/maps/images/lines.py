"""Images of polylines: closed ones that wind round a branch point, and those that run through it."""

from __future__ import annotations

import math

import numpy as np
import shapely

from batik_vector.errors import TornRingError
from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.images.chains import Angles, Chains, prepare, unwrap
from batik_vector.geometry.maps.images.polygons import chains_of, points_of
from batik_vector.geometry.maps.images.result import (
    NO_IMAGES,
    Images,
    Tolerance,
    affine_images,
    core_tolerance,
)
from batik_vector.geometry.maps.images.traces import trace_images
from batik_vector.geometry.sampling import Geometries, Indices


def line_images(flame: FlameMap, lines: Geometries, tolerance: Tolerance) -> Images:
    """Return the images of polylines under a map; closed ones stay closed.

    A closed line that winds w times round the branch point of a JuliaN ``root`` has gcd(|w|, P1) images of
    P1/gcd turns each. A line through the branch point is split there.

    Args:
        flame: the map.
        lines: LineStrings, shape (n,).
        tolerance: how far an edge may stand from the exact image of the given edges.

    Raises:
        TornRingError: where a line runs through a point that goes to infinity, or winds round a
            branch point under a sum of variations.
    """
    lines = np.asarray(lines, dtype=object)
    exact = affine_images(flame, lines)
    if exact is not None:
        return exact
    if not len(lines):
        return NO_IMAGES
    tolerance = core_tolerance(flame, tolerance)
    chains = prepare(chains_of(flame.pre.apply(lines))[0], flame)
    if flame.poles and (chains.z == 0).any():
        raise TornRingError(
            f"a line runs through the centre of {' + '.join(flame.poles)}, which goes to infinity"
        )
    # A line no longer than a rounding step may have shrunk into the origin.
    chains = chains.take(np.diff(chains.offsets) > 1)
    if not len(chains):
        return NO_IMAGES
    single = len(flame.terms) == 1
    angles = None
    turns = np.zeros(len(chains), np.intp)
    if flame.sheets > 1:
        chains = _split_at_origin(chains)
        angles = unwrap(chains)
        turns = np.where(chains.closed & (chains.z[chains.first] != 0), angles.turns, 0)
        if not single and turns.any():
            raise TornRingError(
                "a closed line winds round the centre of julian (root), whose branches a sum with other "
                "variations would tear: move it off the centre, or give julian a map of its own"
            )
    found = _traced(flame, chains, angles, turns, tolerance)
    geometries, source, branches = (np.concatenate(column) for column in zip(*found, strict=True))
    drawn = shapely.length(geometries) > 0
    geometries, source, branches = geometries[drawn], source[drawn], branches[drawn]
    order = np.lexsort((source, branches))
    return Images(flame.post.apply(geometries[order]), source[order], branches[order])


def _traced(
    flame: FlameMap, chains: Chains, angles: Angles | None, turns: Indices, tolerance: Tolerance
) -> list[Images]:
    """Return the images under the core: those of lines that do not wind branch by branch, then the rest."""
    single = len(flame.terms) == 1
    found: list[Images] = []
    for branch in range(1 if single else flame.branches):
        traced = trace_images(flame, chains, angles, branch, tolerance)
        flat = turns == 0
        if flat.any():
            part = Chains(*traced.thinned(), chains.owner).take(flat)
            for turn in range(flame.branches if single else 1):
                spin = flame.terms[0][1].spin(turn) if single else 1 + 0j
                which = np.full(len(part), max(branch, turn), np.intp)
                found.append(Images(_linestrings(part.z * spin, part.offsets), part.owner, which))
        for i in np.flatnonzero(~flat):
            found.append(_wound(flame, traced.chain(int(i)), int(turns[i]), chains.owner[i]))
    return found


def _linestrings(z: Complexes, offsets: Indices) -> Geometries:
    index = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    return np.asarray(shapely.linestrings(points_of(z), indices=index), dtype=object)


def _wound(flame: FlameMap, turn: Complexes, winding: int, owner: Indices) -> Images:
    """Return the images of a closed line that winds round the branch point.

    ``turn`` is the image of going round it once: it ends ``winding`` branches further on.
    """
    variation = flame.terms[0][1]
    sheets = variation.sheets
    images = math.gcd(abs(winding), sheets)
    found = np.empty(images, dtype=object)
    for first in range(images):
        spins = [variation.spin((first + winding * k) % sheets) for k in range(sheets // images)]
        z = np.concatenate([turn[:-1] * spin for spin in spins] + [turn[:1] * spins[0]])
        found[first] = shapely.LineString(points_of(z))
    return Images(found, np.full(images, owner, np.intp), np.arange(images, dtype=np.intp))


def _split_at_origin(chains: Chains) -> Chains:
    """Cut polylines wherever they pass the origin; closed ones that do begin there."""
    zero = chains.z == 0
    chain = np.repeat(np.arange(len(chains)), np.diff(chains.offsets))
    passing = np.isin(np.arange(len(chains)), chain[zero]) & chains.closed
    z = chains.z
    if passing.any():
        z = z.copy()
        for i in np.flatnonzero(passing):
            part = slice(chains.offsets[i], chains.offsets[i + 1])
            ring = z[part][:-1]
            ring = np.roll(ring, -int(np.argmax(ring == 0)))
            z[part] = np.append(ring, ring[0])
    cut = np.flatnonzero(z == 0)
    cut = cut[~np.isin(cut, chains.first) & ~np.isin(cut, chains.last)]
    # Each cut vertex ends one piece and begins the next.
    added = np.searchsorted(cut, chains.offsets, side="left")
    offsets = np.sort(np.concatenate([chains.offsets + added, cut + np.arange(1, len(cut) + 1)]))
    owner = chains.owner[np.searchsorted(chains.offsets + added, offsets[:-1], side="right") - 1]
    return Chains(np.insert(z, cut, 0), offsets.astype(np.intp), owner)
