"""Chains of edges on their way through a map: cut where the map is not smooth, angles unwrapped.

A chain is a polyline, or a ring that repeats its first point; any number of them lie one after another
in one array of complex numbers, so that each step below is one call for a whole drawing.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.sampling import MAX_POINTS, Array, Indices
from batik_vector.values import frozen

NEAR = 1e-14
"""Relative to the drawing's reach: a curve that passes the branch point closer than this passes through
it. Some fifty rounding steps, so a petal's tip that was shifted away and back is still at 0."""

STATION_RATIO = 4.0
"""Long edges that pass near a singular point are cut at distances growing by this factor, so that
samples see the bend however close and short it is."""


@frozen
class Chains:
    """Polylines as arrays.

    ``z``: all vertices; ``offsets``: chain i is ``z[offsets[i]:offsets[i + 1]]``; ``owner[i]``: its mark.
    """

    z: Complexes
    offsets: Indices
    owner: Indices

    def __len__(self) -> int:
        return len(self.owner)

    @property
    def edges(self) -> Indices:
        """Index of the start of every edge: all vertices but the last of each chain."""
        return np.delete(np.arange(len(self.z), dtype=np.intp), self.offsets[1:] - 1)

    @property
    def first(self) -> Indices:
        """Index of each chain's first vertex."""
        return self.offsets[:-1]

    @property
    def last(self) -> Indices:
        """Index of each chain's last vertex."""
        return self.offsets[1:] - 1

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Which chains end where they begin."""
        return np.asarray(self.z[self.first] == self.z[self.last])

    def take(self, which: Indices | NDArray[np.bool_]) -> Chains:
        """Return some of the chains."""
        which = np.arange(len(self), dtype=np.intp)[which]
        counts = np.diff(self.offsets)[which]
        offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.intp)
        at = np.arange(offsets[-1]) - np.repeat(offsets[:-1] - self.first[which], counts)
        return Chains(self.z[at], offsets, self.owner[which])


@frozen
class Angles:
    """Unwrapped polar angles of chains about the origin.

    ``middle``: for each vertex, the angle halfway along the edge that starts there; angles on that edge
    are within a quarter turn of it. ``start``, ``end``: per chain. ``low``, ``high``: per chain, the range.
    """

    middle: Array
    start: Array
    end: Array
    low: Array
    high: Array

    @property
    def turns(self) -> Indices:
        """Winding numbers of closed chains that do not touch the origin."""
        return np.rint((self.end - self.start) / (2 * math.pi)).astype(np.intp)


def unwrap(chains: Chains) -> Angles:
    """Follow the polar angle along every chain; the origin itself has the angle of its neighbour.

    Chains may touch the origin at their ends only.
    """
    z = chains.z
    sweep = np.zeros(len(z))
    e = chains.edges
    along = z[e + 1] * np.conj(z[e])
    sweep[e] = np.where(along == 0, 0.0, np.angle(along))
    # An edge that starts in the origin has one direction, its end's.
    own = np.where(z == 0, np.roll(z, -1), z)
    own[chains.last] = np.where(z[chains.last] == 0, z[chains.last - 1], z[chains.last])
    principal = np.angle(own)
    total = np.cumsum(sweep) - sweep
    chain = np.repeat(np.arange(len(chains)), np.diff(chains.offsets))
    begin = principal[chains.first]
    rough = begin[chain] + total - total[chains.first][chain]
    # Sums round; the principal angle plus whole turns does not.
    angle = principal + 2 * math.pi * np.rint((rough - principal) / (2 * math.pi))
    low = np.minimum.reduceat(angle, chains.first)
    high = np.maximum.reduceat(angle, chains.first)
    return Angles(angle + sweep / 2, angle[chains.first], angle[chains.last], low, high)


def prepare(chains: Chains, flame: FlameMap) -> Chains:
    """Add the vertices a map asks for: at creases, about its singular point, and along waves.

    A chain that passes through the singular point then has a vertex at exactly 0.
    """
    reach = float(np.abs(chains.z).max(initial=0.0))
    if flame.singular:
        z = np.where(np.abs(chains.z) <= NEAR * reach, 0, chains.z)
        chains = _single_zeros(Chains(z, chains.offsets, chains.owner))
        chains = _insert_stations(chains, NEAR * reach)
    for _, variation in flame.terms:
        creases = variation.creases(-reach, reach)
        for turned in (False, True):
            chains = _insert_creases(chains, creases, turned)
    parts = np.ones(len(chains.edges), np.intp)
    for _, variation in flame.terms:
        e = chains.edges
        parts = np.maximum(parts, variation.parts(chains.z[e], chains.z[e + 1]))
    return _cut_evenly(chains, parts)


def _single_zeros(chains: Chains) -> Chains:
    """Leave one of several vertices in a row that lie in the origin."""
    again = np.zeros(len(chains.z), bool)
    again[1:] = (chains.z[1:] == 0) & (chains.z[:-1] == 0)
    again[chains.first] = False
    if not again.any():
        return chains
    gone = np.concatenate([[0], np.cumsum(again)])
    return Chains(chains.z[~again], chains.offsets - gone[chains.offsets], chains.owner)


def _insert(chains: Chains, edge: Indices, part: Array, value: Complexes) -> Chains:
    """Insert vertices: ``value`` on the edge that starts at vertex ``edge``, ``part`` of the way along."""
    if not len(edge):
        return chains
    order = np.lexsort((part, edge))
    edge, value = edge[order], value[order]
    z = np.insert(chains.z, edge + 1, value)
    before = np.searchsorted(edge, chains.offsets, side="left")
    return Chains(z, chains.offsets + before, chains.owner)


def _insert_stations(chains: Chains, near: float) -> Chains:
    """Cut edges that pass the origin closer than they are long: at the foot, and away from it in steps.

    Where the image bends, which is within some distances of the origin about the foot, the steps are as
    short as the distance; further out they grow with it.
    """
    e = chains.edges
    start, step = chains.z[e], chains.z[e + 1] - chains.z[e]
    length = np.abs(step)
    with np.errstate(divide="ignore", invalid="ignore"):
        foot = np.nan_to_num(-(start * np.conj(step)).real / length**2)
        distance = np.abs((start * np.conj(step)).imag) / length
    passing = (distance < length) & (length > 0)
    inside = passing & (foot > 0) & (foot < 1)
    through = inside & (distance <= near)
    # An edge with an end in the origin runs straight out of it.
    through |= (chains.z[e] == 0) | (chains.z[e + 1] == 0)
    at = inside & (chains.z[e] != 0) & (chains.z[e + 1] != 0)
    edges, parts = [e[at]], [foot[at]]
    values = [np.where(through[at], 0, start[at] + foot[at] * step[at])]
    steep = np.flatnonzero(passing & ~through & (length > STATION_RATIO * distance))
    for power in range(int(np.ceil(math.log(1 / NEAR, STATION_RATIO)))):
        if not len(steep):
            break
        for side in (-1, 1):
            part = foot[steep] + side * distance[steep] * STATION_RATIO**power / length[steep]
            ok = (part > 0) & (part < 1)
            edges.append(e[steep[ok]])
            parts.append(part[ok])
            values.append(start[steep[ok]] + part[ok] * step[steep[ok]])
        steep = steep[distance[steep] * STATION_RATIO**power < length[steep] * (1 + np.abs(foot[steep]))]
    return _insert(chains, np.concatenate(edges), np.concatenate(parts), np.concatenate(values))


def _insert_creases(chains: Chains, creases: Array, turned: bool) -> Chains:
    """Cut edges at x = c, or y = c when ``turned``, for all creases c, with vertices exactly on them."""
    if not len(creases):
        return chains
    e = chains.edges
    value = chains.z.imag if turned else chains.z.real
    other = chains.z.real if turned else chains.z.imag
    low, high = np.minimum(value[e], value[e + 1]), np.maximum(value[e], value[e + 1])
    first = np.searchsorted(creases, low, side="right")
    count = np.maximum(np.searchsorted(creases, high, side="left") - first, 0)
    if count.sum() + len(chains.z) > MAX_POINTS:
        raise TooLargeError("a shape is folded too often to be drawn: make it smaller")
    edge = np.repeat(e, count)
    rank = np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
    crease = creases[np.repeat(first, count) + rank]
    part = (crease - value[edge]) / (value[edge + 1] - value[edge])
    across = other[edge] + part * (other[edge + 1] - other[edge])
    return _insert(chains, edge, part, across + 1j * crease if turned else crease + 1j * across)


def _cut_evenly(chains: Chains, parts: Indices) -> Chains:
    extra = parts - 1
    if extra.sum() + len(chains.z) > MAX_POINTS:
        raise TooLargeError("a shape winds too tightly to be drawn: make it smaller")
    if not extra.any():
        return chains
    edge = np.repeat(chains.edges, extra)
    rank = np.arange(len(edge)) - np.repeat(np.cumsum(extra) - extra, extra) + 1
    part = rank / np.repeat(parts, extra)
    return _insert(chains, edge, part, chains.z[edge] + part * (chains.z[edge + 1] - chains.z[edge]))
