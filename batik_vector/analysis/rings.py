"""Rings: marks of one kind that stand evenly round a point, and the points that have most of them.

A mark may stand in a ring about several points: the petal of a flower, about the flower's centre and, four
flowers round it, about the middle between them. It belongs to the ring in which its like stands nearest.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import shapely

from batik_vector.analysis.marks import Indices, Marks, Numbers, Place, Points
from batik_vector.values import frozen

LEAST = 3
"""Marks that make a ring, at the least."""

MOST = 256
"""Marks that a ring may have; and of a kind that has more than twice as many, so many vote for centres."""

SEEDS = 24
"""Centres looked into, those first for which most triples of neighbours speak."""

SAME_RADIUS = 0.045
"""Steps between radii, as a share of them, past which marks stand in two rings."""

COMB, FITTING = (0.03, 0.2), 0.7
"""How far a mark of a ring may stand from where a turn brings its neighbour, in steps of the ring, drawn
exactly or by hand; and how many of the marks have to fit a turn."""

TURNED = 0.2
"""How far the cosine of twice the angle between a mark's long axis and its radius may be from the ring's."""

OBLONG = 0.85
"""Marks below this ratio of axes have a direction."""

CLOSED = 3.2
"""How many times the mean gap the largest gap in a ring may be: one mark or two may be missing."""

COVER = 0.2
"""The share of the whole turn that marks have to cover for their ring to be a flower's outermost."""

TOGETHER, SAME_CENTRE = 0.02, 0.05
"""Centres nearer to each other than this share of their ring's radius are one: guessed, and worked out."""

EXACT = 1e-3
"""How far off a guess may be for its rings to be the centre's, as a share of the innermost ring's radius."""


@frozen(eq=False)
class Ring:
    """Marks of one kind round a centre: their numbers, ordered by angle.

    ``order`` is the highest turn that most of them fit, ``radius`` (mm) where their centroids stand,
    ``outer`` how far they reach, about, and ``cover`` the share of the whole turn that they fill.
    """

    kind: int
    members: Indices
    order: int
    radius: float
    outer: float
    cover: float

    @property
    def spacing(self) -> float:
        """How far along the ring the like of a mark stands, in mm."""
        return 2 * math.pi * self.radius / self.order


@frozen(eq=False)
class Rosette:
    """A point (mm) with the rings that stand about it, the innermost first."""

    centre: Place
    rings: tuple[Ring, ...]

    @property
    def reach(self) -> float:
        """How far (mm) its outermost ring reaches that is closed enough to bound a flower; 0 without any."""
        return max((ring.outer for ring in self.rings if ring.cover >= COVER), default=0.0)

    def like(self, other: Rosette) -> bool:
        """Whether another has the same rings at the same radii, as far as it reaches."""
        both = [
            sorted(
                (ring.kind, len(ring.members), ring.radius) for ring in each.rings if ring.outer <= each.reach
            )
            for each in (self, other)
        ]
        return len(both[0]) == len(both[1]) and all(
            one[:2] == two[:2] and abs(one[2] - two[2]) <= SAME_RADIUS * one[2]
            for one, two in zip(*both, strict=True)
        )


def rosettes(marks: Marks, kinds: Indices) -> list[Rosette]:
    """Return the points about which marks stand in rings, those with the most area first.

    Args:
        marks: of the drawing.
        kinds: of each the number of its kind.
    """
    found: list[Rosette] = []
    for seed in _seeds(marks, kinds):
        if any(np.hypot(*(seed - other.centre)) <= SAME_CENTRE * other.reach for other in found):
            continue
        rings = list(rings_about(marks, kinds, seed))
        if rings:
            centre = _centre(marks, rings)
            if np.hypot(*(centre - seed)) > EXACT * min(ring.radius for ring in rings):
                rings = list(rings_about(marks, kinds, centre))
            if not any(np.hypot(*(centre - other.centre)) <= SAME_CENTRE * other.reach for other in found):
                found.append(Rosette(centre, tuple(rings)))
    spacing = np.full(len(marks), np.inf)
    for each in found:
        for ring in each.rings:
            np.minimum.at(spacing, ring.members, ring.spacing)
    kept = []
    for each in found:
        own = [
            ring for ring in each.rings if (spacing[ring.members] >= 0.98 * ring.spacing).mean() >= FITTING
        ]
        kept.append(Rosette(each.centre, tuple(ring for ring in own)))

    # Flowers that are alike come in reading order, whatever the last bits of their areas.
    def rank(rosette: Rosette) -> tuple[float, float, float]:
        x, y = rosette.centre.tolist()
        return -float(f"{_covered(marks, rosette):.3g}"), round(-y, 1), round(x, 1)

    return sorted((each for each in kept if each.reach), key=rank)


def _covered(marks: Marks, rosette: Rosette) -> float:
    within = [ring for ring in rosette.rings if ring.outer <= 1.02 * rosette.reach]
    return sum(float((marks.sizes[ring.members] ** 2).sum()) for ring in within)


def _seeds(marks: Marks, kinds: Indices) -> list[Place]:
    """Return the likeliest centres: middles of circles through neighbours of a kind, and of marks."""
    places, radii, weights = [marks.places], [marks.sizes / 2], [np.zeros(len(marks))]
    for kind in range(int(kinds.max(initial=-1)) + 1):
        mine = np.flatnonzero(kinds == kind)
        if len(mine) < LEAST:
            continue
        mine = mine[: 2 * MOST]
        centre, radius = _circles(marks.places[mine])
        usable = radius < 64 * marks.sizes[mine].max()
        places.append(centre[usable])
        radii.append(radius[usable])
        weights.append(np.broadcast_to(marks.sizes[mine].mean(), int(usable.sum())))
    every, reach, weight = np.concatenate(places), np.concatenate(radii), np.concatenate(weights)
    near = shapely.STRtree(np.asarray(shapely.points(every))).query(
        shapely.points(every), predicate="dwithin", distance=TOGETHER * reach
    )
    votes: Numbers = np.bincount(near[0], weight[near[1]], len(every)).astype(np.float64)
    chosen: list[Place] = []
    for index in np.argsort(-votes, kind="stable").tolist():
        if len(chosen) == SEEDS or votes[index] <= 0:
            break
        if all(np.hypot(*(every[index] - other)) > TOGETHER * reach[index] for other in chosen):
            mine = near[1][near[0] == index]
            share = weight[mine] if weight[mine].any() else np.ones(len(mine))
            chosen.append(np.asarray(np.average(every[mine], axis=0, weights=share)))
    return chosen


def _centre(marks: Marks, rings: Sequence[Ring]) -> Place:
    """Return the middle of the circles through the marks of rings about one point, by least squares.

    Each ring has a circle of its own (Kåsa, "A circle fitting procedure and its error analysis", 1976); it
    does not matter to it where marks are missing.
    """
    square, right = np.zeros((2, 2)), np.zeros(2)
    for ring in rings:
        xy = marks.places[ring.members]
        middle = xy.mean(axis=0)
        away = xy - middle
        lengths: Numbers = (away * away).sum(axis=1)
        normal = away.T @ away
        weight = float((marks.sizes[ring.members] ** 2).sum()) / float(lengths.sum())
        square += weight * normal
        right += weight * (normal @ middle + away.T @ (lengths - lengths.mean()) / 2)
    return np.asarray(np.linalg.solve(square, right))


def _circles(places: Points) -> tuple[Points, Numbers]:
    """Return the circles through each place and its two nearest: centres and radii (inf on lines)."""
    away: Numbers = np.hypot(*(places[:, None, :] - places[None, :, :]).transpose(2, 0, 1))
    np.fill_diagonal(away, np.inf)
    near = np.argsort(away, axis=1, kind="stable")[:, :2]
    p, q = places[near[:, 0]] - places, places[near[:, 1]] - places
    twice = 2 * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])
    pp, qq = (p * p).sum(axis=1), (q * q).sum(axis=1)
    flat = np.abs(twice) <= 1e-3 * np.sqrt(pp * qq)
    twice = np.where(flat, 1.0, twice)
    middle = np.column_stack([q[:, 1] * pp - p[:, 1] * qq, p[:, 0] * qq - q[:, 0] * pp]) / twice[:, None]
    radius: Numbers = np.where(flat, np.inf, np.hypot(*middle.T))
    return places + middle, radius


def rings_about(marks: Marks, kinds: Indices, centre: Place) -> Iterator[Ring]:
    """Yield the rings of marks about a point (mm), those of each kind from the inside outwards."""
    x, y = (marks.places - centre).T
    radius, angle = np.hypot(x, y), np.arctan2(y, x)
    for kind in range(int(kinds.max(initial=-1)) + 1):
        mine = np.flatnonzero(kinds == kind)
        mine = mine[np.argsort(radius[mine], kind="stable")]
        mine = mine[radius[mine] > 0.1 * marks.sizes[mine]]
        if len(mine) < LEAST:
            continue
        far = radius[mine]
        cuts = np.flatnonzero(np.diff(far) > SAME_RADIUS * far[:-1]) + 1
        for group in np.split(mine, cuts):
            ring = _ring(marks, kind, group, radius, angle)
            if ring is not None:
                yield ring


def _ring(marks: Marks, kind: int, group: Indices, radius: Numbers, angle: Numbers) -> Ring | None:
    """Return marks at about one radius as a ring, or None where they are none."""
    if not LEAST <= len(group) <= MOST:
        return None
    group = group[np.argsort(angle[group], kind="stable")]
    theta = angle[group]
    gaps = np.diff(theta, append=theta[0] + 2 * math.pi)
    if gaps.max() > min(CLOSED * 2 * math.pi / len(group), 0.97 * math.pi):
        return None
    order = _order(theta)
    if order < LEAST:
        return None
    way = marks.ways[group]
    lean = np.arctan2(way[:, 1], way[:, 0]) - theta
    oblong = marks.slimness[group] < OBLONG
    if oblong.mean() > 0.5:
        cosine = np.cos(2 * lean[oblong])
        if np.median(np.abs(cosine - np.median(cosine))) > TURNED:
            return None
    long = marks.sizes[group] / np.sqrt(math.pi * np.maximum(marks.slimness[group], 1e-3))
    short = marks.slimness[group] * long
    out = np.hypot(long * np.cos(lean), short * np.sin(lean))
    half = np.hypot(long * np.sin(lean), short * np.cos(lean))
    far = radius[group]
    cover = float((2 * half / far).sum()) / (2 * math.pi)
    return Ring(kind, group, order, float(np.median(far)), float(np.median(far + out)), min(cover, 1.0))


def _order(theta: Numbers) -> int:
    """Return the highest turn by which most angles (radians, ascending) come upon one another."""
    count = len(theta)
    around = np.concatenate([theta - 2 * math.pi, theta, theta + 2 * math.pi])
    orders = np.arange(min(count + 2, MOST), 1, -1)
    turned = theta + (2 * math.pi / orders)[:, None]
    at = np.searchsorted(around, turned)
    near = np.minimum(np.abs(around[at] - turned), np.abs(around[at - 1] - turned)) * (count / (2 * math.pi))
    for slack in COMB:
        share: Numbers = (near <= slack).mean(axis=1)
        if share.max() >= FITTING:
            return int(orders[np.argmax(share >= FITTING)])
    return 1


def members(rings: Sequence[Ring]) -> Indices:
    """Return the numbers of all marks in some rings."""
    return np.concatenate([ring.members for ring in rings]) if rings else np.empty(0, np.intp)
