"""Gaps: where the sheet comes near to itself across an opening, so that a bridge might span it.

Places along the contours are triangulated (Delaunay): the edges between two pieces of the sheet that lie in
an opening show which pieces face one another, and where they do so closely.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.sampling import Array, Geometries, Points
from batik_vector.processes.stencilling.clusters import Clusters
from batik_vector.processes.stencilling.contours import Field, Places
from batik_vector.processes.stencilling.sheets import Torus
from batik_vector.processes.stencilling.symmetry import Symmetry, repeats_of
from batik_vector.values import frozen

PLAIN, MIRRORED = 6, 4
"""How many gaps between two pieces are tried, in general and on each set of mirrors and centres."""
GOINGS = 2
"""How often a gap is made shorter from where it is."""
GENERIC = np.array([0.3819660112, 0.2360679775])
"""A place that no symmetry leaves where it is, in parts of the tile."""


@frozen(eq=False)
class Gaps:
    """Gaps between pieces: ``middle`` and ``way`` (of length 1) of shape (n, 2), ``length`` (n,), in steps.

    ``one`` and ``other`` name the pieces at the two ends, as :meth:`Clusters.piece` does.
    """

    middle: Points
    way: Points
    length: Array
    one: Index
    other: Index

    def __len__(self) -> int:
        return len(self.middle)

    def taken(self, which: Index) -> Gaps:
        """Return some of the gaps."""
        return Gaps(
            self.middle[which], self.way[which], self.length[which], self.one[which], self.other[which]
        )


def together(several: list[Gaps]) -> Gaps:
    """Return gaps of several kinds as one."""
    return Gaps(
        np.concatenate([each.middle for each in several]),
        np.concatenate([each.way for each in several]),
        np.concatenate([each.length for each in several]),
        np.concatenate([each.one for each in several]),
        np.concatenate([each.other for each in several]),
    )


def triangulated(places: Places) -> Index:
    """Return pairs of places that are neighbours, shape (n, 2), by the Delaunay triangulation."""
    spots = places.points[:, 0] + 1j * places.points[:, 1]
    unique, first = np.unique(spots, return_index=True)
    if len(unique) < 3:
        return np.array([first], np.intp).reshape(-1, 2) if len(unique) == 2 else np.empty((0, 2), np.intp)
    many = shapely.multipoints(np.stack([unique.real, unique.imag], axis=1))
    edges = shapely.get_parts(shapely.delaunay_triangles(many, only_edges=True))
    ends = shapely.get_coordinates(edges)
    rows = first[np.searchsorted(unique, ends[:, 0] + 1j * ends[:, 1])].reshape(-1, 2)
    rows = np.sort(rows, axis=1)
    return np.asarray(rows[np.lexsort(rows.T[::-1])])


def pieces_at(clusters: Clusters, part: Index, gain: Steps, names: dict[tuple[int, int, int], int]) -> Index:
    """Return a number for the piece of the cloth to which each copy of a part belongs; new ones are added."""
    rows = np.column_stack([part, gain])
    unique, into = np.unique(rows, axis=0, return_inverse=True)
    found = [names.setdefault(clusters.piece(each, (x, y)), len(names)) for each, x, y in unique.tolist()]
    return np.array(found, np.intp)[into.ravel()]


def facing(places: Places, edges: Index, side: int) -> Array:
    """Return which edges leave both of their ends towards openings (side -1) or into the sheet (side 1)."""
    p, q = edges.T
    way = places.points[q] - places.points[p]
    return np.asarray(
        (side * _cross(places.heading[p], way) > 0) & (side * _cross(places.heading[q], -way) > 0)
    )


def _cross(one: Points, other: Points) -> Array:
    return np.asarray(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])


def gaps_between(
    places: Places, piece: Index, torus: Torus, symmetry: Symmetry, near: float, most: int = PLAIN
) -> Gaps:
    """Return the gaps between pieces that are worth trying, of each orbit under the symmetry at least one.

    Args:
        places: along the contours, in and around the tile.
        piece: the piece of each.
        torus: the lattice.
        symmetry: of the sheet.
        near: how near, in steps, bridges are so that one has to stand for both.
        most: how many gaps between two pieces are tried.
    """
    edges = triangulated(places)
    edges = edges[piece[edges[:, 0]] != piece[edges[:, 1]]]
    edges = edges[facing(places, edges, -1)]
    middle = places.points[edges].mean(axis=1)
    home = (torus.home(middle)[1] == 0).all(axis=1)
    home[home] &= _first_of_orbit(middle[home], torus, symmetry, near)
    edges, middle = edges[home], middle[home]
    way = places.points[edges[:, 1]] - places.points[edges[:, 0]]
    length = np.sqrt((way**2).sum(axis=1))
    gaps = Gaps(middle, way / np.maximum(length, 1e-9)[:, None], length, *piece[edges].T)
    return gaps.taken(_chosen(gaps, _stays(gaps, torus, symmetry, near), near, most))


def _first_of_orbit(middle: Points, torus: Torus, symmetry: Symmetry, near: float) -> Array:
    """Return which places are of all their images the nearest to a generic one, or nearly so."""
    if len(symmetry) == 1 or not len(middle):
        return np.ones(len(middle), bool)
    target = GENERIC * [torus.cell.columns, torus.cell.rows]
    away = [np.sqrt((torus.nearest(image - target)[0] ** 2).sum(axis=1)) for image in symmetry.images(middle)]
    return np.asarray(away[0] <= np.min(away, axis=0) + near)


def _stays(gaps: Gaps, torus: Torus, symmetry: Symmetry, near: float) -> NDArray[np.bool_]:
    """Return under which symmetries each middle stays about where it is, shape (k, n)."""
    _, ways = repeats_of(symmetry, torus, gaps.middle)
    return np.asarray((ways**2).sum(axis=2) < near**2)


def _chosen(gaps: Gaps, stays: NDArray[np.bool_], near: float, most: int) -> Index:
    """Return the shortest gaps of each two pieces, apart from one another, some on every set of mirrors."""
    kept: dict[tuple[int, int, bytes], list[int]] = {}
    signs = np.packbits(stays, axis=0).T
    apart = near**2
    for each in np.lexsort([gaps.middle[:, 1], gaps.middle[:, 0], gaps.length]).tolist():
        pair = sorted((int(gaps.one[each]), int(gaps.other[each])))
        known = kept.setdefault((pair[0], pair[1], signs[each].tobytes()), [])
        if len(known) >= (most if stays[:, each].sum() == 1 else MIRRORED):
            continue
        if len(known) and (((gaps.middle[known] - gaps.middle[each]) ** 2).sum(axis=1) < apart).any():
            continue
        known.append(each)
    return np.array(sorted(each for known in kept.values() for each in known), np.intp)


def shortened(gaps: Gaps, field: Field, piece: Index, reach: float) -> Gaps:
    """Return gaps and, beside each, the one that is shortest near by.

    Args:
        gaps: as found among places.
        field: the contours as chains.
        piece: the piece of each chain.
        reach: how far the ends may move at a time, in steps.
    """
    if not len(gaps):
        return gaps
    half = gaps.way * (gaps.length / 2)[:, None]
    ends = np.stack([gaps.middle - half, gaps.middle + half])
    for _ in range(GOINGS):
        sides = [
            near_contours(place, of, field, piece, reach)
            for place, of in zip(ends, (gaps.one, gaps.other), strict=True)
        ]
        found = ~(shapely.is_empty(sides[0]) | shapely.is_empty(sides[1]))
        lines = shapely.shortest_line(sides[0][found], sides[1][found])
        ends[:, found] = shapely.get_coordinates(lines).reshape(-1, 2, 2).swapaxes(0, 1)
    way = ends[1] - ends[0]
    length = np.sqrt((way**2).sum(axis=1))
    good = length > 0
    way, length = way[good] / length[good][:, None], length[good]
    middle, old = ends.mean(axis=0)[good], gaps.middle[good]
    one, other = gaps.one[good], gaps.other[good]
    # Between parallel sides the shortest is anywhere: it stays beside where it was found.
    across = np.stack([-way[:, 1], way[:, 0]], axis=1)
    slid = middle + across * ((old - middle) * across).sum(axis=1)[:, None]
    return together([Gaps(middle, way, length, one, other), Gaps(slid, way, length, one, other)])


def near_contours(
    places: Points, of: Index, field: Field, piece: Index | Array, reach: float | Array
) -> Geometries:
    """Return of each piece the contours near a place, as one geometry each."""
    row, chain = field.tree.query(shapely.points(places), predicate="dwithin", distance=reach)
    mine = piece[chain] == of[row]
    row, chain = row[mine], chain[mine]
    order = np.lexsort([chain, row])
    found = np.full(len(places), shapely.MultiLineString(), dtype=object)
    if len(order):
        unique, into = np.unique(row[order], return_inverse=True)
        found[unique] = shapely.multilinestrings(field.chains[chain[order]], indices=into.ravel())
    return found


def settled(gaps: Gaps, torus: Torus, symmetry: Symmetry, near: float) -> Gaps:
    """Return gaps moved onto the mirrors and centres near them, so that no image of one lies half upon it.

    Those for which there is no such place are left out.
    """
    if len(symmetry) == 1 or not len(gaps):
        return gaps
    for _ in range(2):
        images, ways = repeats_of(symmetry, torus, gaps.middle)
        stays = (ways**2).sum(axis=2) < near**2
        middle = (images * stays[:, :, None]).sum(axis=0) / stays.sum(axis=0)[:, None]
        turned = symmetry.turned(gaps.way)
        # Opposite directions are one and the same gap.
        double = ((turned[:, :, 0] + 1j * turned[:, :, 1]) ** 2 * stays).sum(axis=0)
        clear = np.abs(double) > 0.1 * stays.sum(axis=0)
        angle = np.angle(double) / 2
        way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        way *= np.where((way * gaps.way).sum(axis=1) < 0, -1, 1)[:, None]
        gaps = Gaps(middle, way, gaps.length, gaps.one, gaps.other).taken(np.flatnonzero(clear))
    images, ways = repeats_of(symmetry, torus, gaps.middle)
    stays = (ways**2).sum(axis=2) < near**2
    turned = symmetry.turned(gaps.way)
    aslant = np.abs(turned[:, :, 0] * gaps.way[:, 1] - turned[:, :, 1] * gaps.way[:, 0])
    moved = np.sqrt((ways**2).sum(axis=2))
    sound = (~stays | ((moved < STILL) & (aslant < STRAIGHT))).all(axis=0)
    return gaps.taken(np.flatnonzero(sound))


STILL, STRAIGHT = 8.0, 1e-3
"""Steps, and sine of the angle, by which the image of a gap may miss it that counts as the same."""
