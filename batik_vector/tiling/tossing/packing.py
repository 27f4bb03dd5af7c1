"""Packing: marks set down one beside another so that their outlines nestle, as close as a distance allows.

For every mark many places and turns are tried at once on a grid of distances, the best are shifted and turned
a little again and again, and of those that hold outline to outline the one stays that lies closest to what
is there. First all motifs in turn, and then into the holes the largest that fit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.tiling.tossing.clearance import Clearance, Whole
from batik_vector.tiling.tossing.darts import Dice, Rules, ranks
from batik_vector.tiling.tossing.marks import Complexes, Field, Flags, Poses
from batik_vector.tiling.tossing.scatter import Scatter
from batik_vector.values import frozen

POINTS = 56
"""Points along an outline at which a mark is asked for."""

CHOSEN, SHIFTS, ROUNDS = 10, 14, 7
"""Of the places tried for a mark, those that are bettered; how often in a round, and in how many rounds."""

FIRST_SHIFT, FIRST_TURN, COOLING = 0.5, 24.0, 0.62
"""How far a mark is shifted at first, as a share of its inner radius, and turned (degrees); what each round
leaves of it."""

AT_ONCE = 6
"""Marks that are looked for at once."""

MISSES = 3
"""Times in a row that no place is found for a motif before it is given up."""

TIERS = 5
"""Sizes, large to small, in which holes are filled."""


@frozen
class Asked:
    """What packing is asked for: ``distance`` in grid steps, ``wanted`` as for darts."""

    rules: Rules
    distance: float
    tries: int
    wanted: Callable[[Poses], Array]


def packed_on(scatter: Scatter, asked: Asked, dice: Dice) -> int:
    """Pack marks on a torus; return how many places were tried.

    Raises:
        TooLargeError: where they are more than one compilation may try.
    """
    packing = Packing(scatter, asked, dice)
    packing.fill()
    return packing.tried


class Packing:
    """Marks on a torus as they are packed."""

    def __init__(self, scatter: Scatter, asked: Asked, dice: Dice) -> None:
        """Begin with what lies there."""
        kit = scatter.kit
        self.scatter, self.asked, self.dice = scatter, asked, dice
        rings = [_evenly(outline) for outline in kit.outlines]
        self.rings: Complexes = np.array(rings)
        """Points along the outline of each motif, from its middle, shape (k, POINTS)."""
        between = float(np.abs(np.roll(self.rings, 1, axis=1) - self.rings).mean())
        reach = asked.distance + float(kit.radii[:, 0].max()) * asked.rules.size[1] * 1.1
        self.clearance = Clearance(scatter.torus, max(between / 2, asked.distance / 2), reach)
        self.tried = 0
        scatter.set(scatter.poses, scatter.field, asked.distance)
        self.clearance.take(scatter.there.shapes)
        self.places = self.clearance.nodes()

    def fill(self) -> None:
        """Set down all motifs side by side, and then what fits into the holes."""
        self._grow()
        self._fill_holes()

    def _grow(self) -> None:
        kinds = len(self.rings)
        missed = np.zeros(kinds, np.intp)
        low, high = self.asked.rules.size
        while True:
            want = np.where(missed < MISSES, self.asked.wanted(self.scatter.poses), 0.0)
            if not (want > 0).any():
                return
            chances = np.cumsum(self._shares(want))
            count = AT_ONCE if len(self.scatter) else 1
            motif = np.searchsorted(chances, self.dice(count) * chances[-1], side="right")
            motif = np.minimum(motif, kinds - 1)
            size = np.round(high - (high - low) * 0.6 * self.dice(count), 4)
            found = self._set_down(motif, size)
            missed[motif[~found]] += 1
            missed[motif[found]] = 0

    def _shares(self, want: Array) -> Array:
        """Return how likely each motif is drawn: by its weight, and by what it lacks of it."""
        weights = np.where(want > 0, self.asked.rules.weights, 0.0)
        have = np.bincount(self.scatter.poses.motif, minlength=len(weights))
        lacks = weights * (1.1 * len(self.scatter) + len(weights)) - have
        return np.asarray(np.maximum(lacks, 0.05 * weights))

    def _fill_holes(self) -> None:
        low, high = self.asked.rules.size
        areas = shapely.area(self.scatter.kit.outlines)
        sizes = np.round(np.linspace(high, low, TIERS), 4) if high > low else np.array([high])
        steps = [(float(areas[kind]) * size**2, kind, size) for size in sizes for kind in range(len(areas))]
        for _, kind, size in sorted(steps, key=lambda each: (-each[0], each[1])):
            missed = 0
            while missed < 1 and self.asked.wanted(self.scatter.poses)[kind] > 0:
                count = int(min(4, self.asked.wanted(self.scatter.poses)[kind]))
                found = self._set_down(np.full(count, kind), np.full(count, size))
                missed = 0 if found.any() else missed + 1

    def _set_down(self, motif: Indices, size: Array) -> Flags:
        """Look for places for marks, all at once; return for which there was one, though others took it."""
        found = np.zeros(len(motif), bool)
        poses, which = self._begun(motif, size)
        if not len(poses):
            return found
        self._spend(len(poses) + CHOSEN * len(motif) * SHIFTS * ROUNDS)
        score = self._score(poses)
        best = _best_of(score, which, CHOSEN)
        poses, which, score = poses.take(best), which[best], score[best]
        for number in range(ROUNDS):
            poses, score = self._bettered(poses, score, COOLING**number)
        good = np.flatnonzero(score < NEVER)
        good = good[np.lexsort((good, score[good]))]
        poses, which = poses.take(good), which[good]
        marks = self.scatter.marks(poses)
        distance = self.asked.distance
        clear = np.flatnonzero(self.scatter.clear(marks, distance, distance))
        found[which[clear]] = True
        _, first = np.unique(which[clear], return_index=True)
        clear = clear[np.sort(first)]
        clear = clear[self.scatter.compatible(marks.take(clear), distance, distance)]
        want = self.asked.wanted(self.scatter.poses)
        clear = clear[ranks(poses.motif[clear]) < want[poses.motif[clear]]]
        if len(clear):
            self._add(poses.take(clear), marks.take(clear))
        return found

    def _add(self, poses: Poses, marks: Field) -> None:
        scatter, distance = self.scatter, self.asked.distance
        scatter.set(scatter.poses.joined(poses), Field.joined([scatter.field, marks]), distance)
        self.clearance.take(scatter.torus.images(marks, scatter.largest + self.clearance.reach).shapes)

    def _spend(self, count: int) -> None:
        self.tried += count
        try:
            work.spend(count * len(self.scatter.torus.operations), per_vertex=work.PER_PACKED)
        except TooLargeError:
            raise TooLargeError(
                f"tries = {self.asked.tries:,}: after {self.tried:,} places there are {len(self.scatter):,} "
                "marks and still room, which is more work than fits: expected fewer tries, larger marks or "
                "a smaller repeat"
            ) from None

    def _begun(self, motif: Indices, size: Array) -> tuple[Poses, Indices]:
        """Return poses to begin with for each mark, by chance, where its heart has room, near to others."""
        asked, dice = self.asked, self.dice
        found, of = [], []
        far = self.clearance.far
        for number in range(len(motif)):
            kind = int(motif[number])
            need = asked.distance + float(self.scatter.kit.radii[kind, 0] * size[number])
            free = np.flatnonzero(far >= need - 0.35 * self.clearance.step)
            if not len(free):
                continue
            # Beside others; in one try of four anywhere, for there may be no room beside any.
            near = free[far[free] < far.max()] if len(self.scatter) else free
            free = near if len(near) and number % 4 != 3 else free
            count = asked.tries
            heart = self.places[free[(dice(count) * len(free)).astype(np.intp)]]
            flip = dice(count) < 0.5 if asked.rules.flip else np.zeros(count, bool)
            poses = Poses(
                np.full(count, kind),
                np.full(count, size[number]),
                asked.rules.turned(dice(count)),
                flip,
                np.zeros(count, np.complex128),
            )
            away = poses.carry(self.scatter.kit.discs[poses.motif, 0], self.scatter.torus.stretch)
            found.append(replace(poses, place=self.scatter.torus.within(heart - away)))
            of.append(np.full(count, number))
        if not found:
            return Poses.none(), np.empty(0, np.intp)
        joined = found[0]
        for more in found[1:]:
            joined = joined.joined(more)
        return joined, np.concatenate(of)

    def _score(self, poses: Poses) -> Whole:
        """Return how far poses are from lying close to others: the less, the better.

        That is the mean distance along their outlines, and far more where they come too near.
        """
        points = poses.carry(self.rings[poses.motif], self.scatter.torus.stretch)
        far = self.clearance.at(points)
        lacks = (math.ceil(self.asked.distance) - far).clip(0)
        near = lacks.max(axis=1)
        return np.asarray(far.clip(0).sum(axis=1) + np.where(near > 0, NEVER + lacks.sum(axis=1) * POINTS, 0))

    def _bettered(self, poses: Poses, score: Whole, heat: float) -> tuple[Poses, Whole]:
        """Return poses shifted and turned to where they lie closer, if that is found."""
        asked, dice = self.asked, self.dice
        index = np.repeat(np.arange(len(poses)), SHIFTS)
        tried = poses.take(index)
        count = len(index)
        step = FIRST_SHIFT * heat * self.scatter.kit.radii[tried.motif, 0] * tried.size
        shift = (dice(count) * 2 - 1 + 1j * (dice(count) * 2 - 1)) * step
        low, high = asked.rules.turn
        turn = tried.turn
        if not asked.rules.turns and high > low:
            turn = np.round(tried.turn + (dice(count) * 2 - 1) * min(FIRST_TURN, high - low) * heat, 3)
            turn = turn if high - low >= 360 else np.clip(turn, low, high)
        tried = replace(tried, turn=turn, place=self.scatter.torus.within(tried.place + shift))
        fresh = self._score(tried).reshape(-1, SHIFTS)
        best = fresh.argmin(axis=1)
        rows = np.arange(len(poses))
        better = fresh[rows, best] < score
        chosen = tried.take(rows * SHIFTS + best)
        turn = np.where(better, chosen.turn, poses.turn)
        place = np.where(better, chosen.place, poses.place)
        return replace(poses, turn=turn, place=place), np.where(better, fresh[rows, best], score)


NEVER = 10**12
"""Beyond every score of a mark that has room."""


def _evenly(outline: shapely.Geometry) -> Complexes:
    """Return points at even steps along the outer rings of an outline, shape (POINTS,)."""
    rings = shapely.get_exterior_ring(shapely.get_parts(outline))
    length = shapely.length(rings)
    at = (np.arange(POINTS) + 0.5) / POINTS * float(length.sum())
    ring = np.searchsorted(np.cumsum(length), at, side="right").clip(0, len(rings) - 1)
    along = at - (np.cumsum(length) - length)[ring]
    points = shapely.get_coordinates(shapely.line_interpolate_point(rings[ring], along))
    return np.asarray(np.rint(points[:, 0]) + 1j * np.rint(points[:, 1]))


def _best_of(score: Whole, which: Indices, count: int) -> Indices:
    """Return the best few of each mark's poses, in the order of the marks."""
    order = np.lexsort((np.arange(len(score)), score, which))
    of = which[order]
    first = np.searchsorted(of, of)
    return order[np.arange(len(of)) - first < count]
