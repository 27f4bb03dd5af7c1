"""How well an operation maps a pattern onto itself, measured along its whole outline.

Only one direction is measured, the image against the pattern. An operation of finite order on the torus
that carries the outline into itself carries it onto itself: its inverse is one of its powers.

Hairs and slits do not count: where marks nearly touch, or cross at a sharp angle, a rounding decides whether
a sliver of a micrometre stands or not, and how far a needle runs. Points that have the other side of their
ink, or of the ground beside it, within the breadth of a hair are not asked of. Nor do the last bits of
lines count, and crumbs that are nothing else: a line cut off at a sharp angle ends here or there.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.certificate.symmetry.lattice import Matrix
from batik_vector.certificate.symmetry.nearest_edges import Nearest, spread
from batik_vector.certificate.symmetry.outline import Edges, Indices, Points, simplified
from batik_vector.certificate.symmetry.same_places import SamePlaces
from batik_vector.geometry.congruence import distinct
from batik_vector.values import frozen

FEW = 600
"""Points, evenly strewn over the outline, by which an operation is placed and most false ones are refused."""

FIRST = 3
"""One in so many of the few serves for a first guess."""

MANY = 20_000
"""Points strewn along long edges, besides one at each vertex and in the middle of each edge."""

TELLING = 64
"""Points remembered because an earlier operation failed there: what breaks one symmetry breaks most."""

NEAR = 4
"""How many times the slack an image is looked for around a point, at the least; limits stay below it."""

FINE = 0.5
"""The share of the outline of an ink up to which it may be hairs or ends; where more is, all of it counts."""

CHUNK = 16_384
"""Points looked up in one go, which keeps them in the processor's cache."""

MEASURED = 64
"""Points beyond reach whose distance is worked out one by one where a failure is reported."""


@frozen(eq=False)
class Samples:
    """Points on the outline: ``xy`` (n, 2) in mm, ``kind`` (n,), ``heading`` (n, 2), zero on lines.

    ``along`` (n, 2) is the way of the edge of each, however short it is.
    """

    xy: Points
    kind: Indices
    heading: Points
    along: Points

    def __getitem__(self, rows: Indices | slice) -> Samples:
        return Samples(self.xy[rows], self.kind[rows], self.heading[rows], self.along[rows])


@frozen
class Fit:
    """How an operation fits: the ``share`` of the outline met, the ``worst`` distance (mm) if it holds."""

    holds: bool
    share: float
    worst: float = np.inf


class Matcher:
    """Measures operations x → M x + t on one pattern.

    Args:
        edges: the outline, in mm.
        basis: the lattice of the torus, as columns in mm.
        slack: how far (mm) an image may stand from the pattern.
        reach: how far (mm) a first guess of t may be out.
        thin: the breadth (mm) below which areas, and the ground between them, are hairs.
    """

    def __init__(self, edges: Edges, basis: Matrix, slack: float, reach: float, thin: float) -> None:
        self.edges, self.basis, self.slack, self.thin = edges, basis, slack, thin
        self.all = self.whole = _samples(edges, slack)
        self.few = _strewn(edges, FEW, slack)
        self.telling = np.empty(0, np.intp)
        self.trees: dict[int, shapely.STRtree] = {}
        self.near = Nearest(edges, basis, NEAR * slack, slack)
        # A first guess needs neither every point nor every edge.
        self.far = Nearest(simplified(edges, NEAR * slack / 2), basis, max(reach, NEAR * slack), slack)

    def keep_one_cell(self, lattice: Matrix) -> None:
        """Measure from now on by the points of one cell of a finer lattice, on which the pattern repeats."""
        (a, b), (c, d) = np.linalg.inv(lattice)
        x, y = self.whole.xy.T
        column, row = np.floor(a * x + b * y), np.floor(c * x + d * y)
        (a, b), (c, d) = np.linalg.inv(self.basis) @ lattice
        across, up = a * column + b * row, c * column + d * row
        kept = (np.abs(across - np.rint(across)) < 1e-6) & (np.abs(up - np.rint(up)) < 1e-6)
        self.all = self.whole[np.flatnonzero(kept)]
        self.telling = np.empty(0, np.intp)

    def placed(self, matrix: Matrix, shift: Points) -> Points:
        """Return the translation part near ``shift`` that brings the image nearest to the pattern.

        Point-to-line least squares over the points within a shrinking reach (Chen & Medioni, "Object
        modelling by registration of multiple range images", 1992).
        """
        every, some = (
            moved(self.few, matrix),
            moved(self.few[np.arange(0, len(self.few.kind), FIRST)], matrix),
        )
        reach = self.far.reach
        for _ in range(10):
            near, image = (self.far, some) if reach > self.near.reach else (self.near, every)
            feet = near.feet(image.xy + shift, image.kind, image.heading)
            used = feet.distance <= reach
            if used.sum() < 3:
                break
            normal = feet.normal[used]
            gap = (normal * feet.offset[used]).sum(axis=1)
            square = normal.T @ normal + 1e-6 * len(gap) * np.eye(2)
            step = np.linalg.solve(square, normal.T @ gap)
            shift = shift + step
            if reach <= NEAR * self.slack and np.hypot(*step) < self.slack / 100:
                break
            reach = max(reach / 2, NEAR * self.slack)
        return shift

    def fit(self, matrix: Matrix, shift: Points, limit: float) -> Fit:
        """Measure whether an operation holds within ``limit`` mm: by a few points first, then by all."""
        missed = np.flatnonzero(self._distances(self.few, matrix, shift) > limit)
        # More than a fair share of hairs excuses nothing, and need not be looked for.
        if len(missed) <= FINE * len(self.few.kind):
            missed = missed[~self._on_hairs(self.few[missed])]
        share = 1 - len(missed) / len(self.few.kind)
        if len(missed) or (self._distances(self.all[self.telling], matrix, shift) > limit).any():
            return Fit(False, share)
        distance = self._distances_of_all(matrix, shift)
        missed = np.flatnonzero(distance > limit)
        missed = missed[~self._on_hairs(self.all[missed])]
        if not len(missed):
            return Fit(True, share, float(distance[distance <= limit].max(initial=0.0)))
        self.telling = np.r_[missed[:: max(1, len(missed) // 8)], self.telling][:TELLING]
        return Fit(False, share)

    def failure(self, matrix: Matrix, shift: Points) -> tuple[float, tuple[float, float], int]:
        """Return by how much (mm) an operation that does not hold fails most, where, and on which kind."""
        distance = self._distances_of_all(matrix, shift, at_most=MANY)
        alone = np.flatnonzero(np.isinf(distance))
        distance[alone] = 0
        alone = alone[~self._on_hairs(self.all[alone])]
        alone = alone[:: -(-len(alone) // MEASURED) or 1]
        for kind in distinct(self.all.kind[alone]):
            mine = alone[self.all.kind[alone] == kind]
            distance[mine] = self._alone(self.all.xy[mine] @ matrix.T + shift, int(kind))
        worst = int(distance.argmax())
        x, y = self.all.xy[worst].tolist()
        return float(distance[worst]), (x, y), int(self.all.kind[worst])

    @cached_property
    def _sides(self) -> Nearest:
        """The edges, each in its direction, however short."""
        return Nearest(self.edges, self.basis, self.thin, 0.0)

    @cached_property
    def _fine(self) -> Indices:
        """The kinds that are drawn in hairs, of which every point counts."""
        thin = self._thin(self.few)
        kinds = distinct(self.few.kind)
        return kinds[[bool(thin[self.few.kind == kind].mean() > FINE) for kind in kinds]]

    def _on_hairs(self, samples: Samples) -> NDArray[np.bool_]:
        """Return which points stand on the border of a hair or a slit, or where a line ends."""
        if not len(samples.kind):
            return np.zeros(0, bool)
        return self._thin(samples) & ~np.isin(samples.kind, self._fine)

    def _thin(self, samples: Samples) -> NDArray[np.bool_]:
        return self._narrow(samples) | self._ending(samples)

    def _ending(self, samples: Samples) -> NDArray[np.bool_]:
        """Return which points stand on a centre line within the slack of where one ends."""
        found = np.zeros(len(samples.kind), bool)
        for kind, tree in self._ends.items():
            mine = np.flatnonzero(samples.kind == kind)
            near = tree.query(shapely.points(samples.xy[mine]), predicate="dwithin", distance=self.slack)
            found[mine[near[0]]] = True
        return found

    @cached_property
    def _ends(self) -> dict[int, shapely.STRtree]:
        """Where the centre lines of each kind end: the vertices that only one edge has."""
        found = {}
        for kind in distinct(self.edges.kind[self.edges.kind % 2 == 1]).tolist():
            mine = self.edges.kind == kind
            vertices = np.concatenate([self.edges.begin[mine], self.edges.end[mine]])
            places, times = np.unique(vertices, axis=0, return_counts=True)
            found[kind] = shapely.STRtree(shapely.points(places[times == 1]))
        return found

    def _narrow(self, samples: Samples) -> NDArray[np.bool_]:
        """Return which points have an edge that runs the other way within reach."""
        facing = self._sides.distances(samples.xy, samples.kind, -samples.along)
        return np.asarray((facing <= self.thin) & (samples.kind % 2 == 0))

    @cached_property
    def _places(self) -> SamePlaces:
        whole = self.whole
        return SamePlaces(whole.xy, whole.kind, whole.heading, whole.along, self.basis, self.slack / 2)

    def _distances_of_all(
        self, matrix: Matrix, shift: Points, at_most: int | None = None
    ) -> NDArray[np.float64]:
        """Return how far all points stand from the pattern: those that fall on others are soon told.

        Of the rest, ``at_most`` so many are measured, one in so many; the others count as falling on it.
        """
        count = len(self.all.kind)
        distance = np.empty(count)
        for begin in range(0, count, CHUNK):
            part = slice(begin, begin + CHUNK)
            image = moved(self.all[part], matrix)
            distance[part] = self._places.distances(image.xy + shift, image.kind, image.heading)
        rest = np.flatnonzero(np.isinf(distance))
        if at_most is not None:
            distance[rest] = 0
            rest = rest[:: -(-len(rest) // at_most) or 1]
        distance[rest] = self._distances(self.all[rest], matrix, shift)
        return distance

    def _distances(self, samples: Samples, matrix: Matrix, shift: Points) -> NDArray[np.float64]:
        image = moved(samples, matrix)
        return self.near.distances(image.xy + shift, image.kind, image.heading)

    def _alone(self, xy: Points, kind: int) -> NDArray[np.float64]:
        """Return how far points are from all edges of a kind, whichever way these run."""
        if kind not in self.trees:
            mine = self.edges.kind == kind
            ends = np.stack([self.edges.begin[mine], self.edges.end[mine]], axis=1)
            self.trees[kind] = shapely.STRtree(np.asarray(shapely.linestrings(ends)))
        inverse = np.linalg.inv(self.basis)
        steps = np.stack(np.meshgrid((-2, -1, 0, 1, 2), (-2, -1, 0, 1, 2)), axis=-1).reshape(-1, 2)
        home = (self.edges.begin.mean(axis=0) @ inverse.T)[None, :]
        place = xy @ inverse.T
        place = place - np.rint(place - home)
        around = (place[:, None, :] + steps) @ self.basis.T
        points = shapely.points(around.reshape(-1, 2))
        _, distance = self.trees[kind].query_nearest(points, return_distance=True, all_matches=False)
        return np.asarray(distance.reshape(len(xy), -1).min(axis=1))


def moved(samples: Samples, matrix: Matrix) -> Samples:
    """Return points turned by a linear part; a reflection would leave the covered side on the right."""
    sign = np.sign(np.linalg.det(matrix))
    return replace(samples, xy=samples.xy @ matrix.T, heading=sign * (samples.heading @ matrix.T))


def _samples(edges: Edges, short: float) -> Samples:
    """Return the ends and the middle of every edge, and more points along the long ones."""
    length = np.hypot(*(edges.end - edges.begin).T)
    pieces = np.maximum(2, np.ceil(length * (MANY / length.sum()))).astype(np.intp)
    row, number = spread(pieces)
    inner = _at(edges, row, number / pieces[row], short)
    # Beginnings are the ends of other edges, but for the last ends of open lines.
    lines = np.flatnonzero(edges.kind % 2 == 1)
    ends = _at(edges, lines, np.ones(len(lines)), short)
    return Samples(*(np.concatenate(pair) for pair in zip(_parts(inner), _parts(ends), strict=True)))


def _parts(samples: Samples) -> tuple[Points, Indices, Points, Points]:
    return samples.xy, samples.kind, samples.heading, samples.along


def _at(edges: Edges, row: Indices, part: NDArray[np.float64], short: float) -> Samples:
    step = edges.end[row] - edges.begin[row]
    aimless = (edges.kind[row] % 2 == 1) | (np.hypot(*step.T) <= short)
    heading = np.where(aimless[:, None], 0.0, step)
    return Samples(edges.begin[row] + part[:, None] * step, edges.kind[row], heading, step)


def _strewn(edges: Edges, count: int, short: float) -> Samples:
    """Return points spread evenly along each kind of edges, each kind with a fair number of them."""
    length = np.hypot(*(edges.end - edges.begin).T)
    kinds = distinct(edges.kind)
    total = np.bincount(edges.kind, length)
    rows, parts = [], []
    for kind in kinds:
        mine = np.flatnonzero(edges.kind == kind)
        share = 0.5 / len(kinds) + 0.5 * total[kind] / length.sum()
        reached = np.cumsum(length[mine])
        # Steps in the golden ratio fall in with no period of the pattern.
        place = ((np.arange(1, int(count * share) + 1) * 0.6180339887498949) % 1) * reached[-1]
        at = np.minimum(np.searchsorted(reached, place), len(mine) - 1)
        rows.append(mine[at])
        parts.append(np.clip(1 - (reached[at] - place) / length[mine[at]], 0, 1))
    return _at(edges, np.concatenate(rows), np.concatenate(parts), short)
