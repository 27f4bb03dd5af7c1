"""Darts: marks thrown at the torus where there is room left, until it is full or there are enough.

All that a round throws is tested at once, and of those that fit the earlier go before the later: the
outcome is that of throwing one after another. Where nothing more fits is kept on a grid of places, so that
late darts aim at the holes (maximal Poisson-disc sampling: White, Cline & Egbert, "Poisson disk point sets by
hierarchical dart throwing", 2007).
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.nearness import boxes
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.tiling.tossing.marks import Complexes, Field, Poses
from batik_vector.tiling.tossing.scatter import Scatter
from batik_vector.values import frozen

FEW_DARTS, LEAST_BATCH, MOST_BATCH = 48, 256, 4096
"""Darts thrown at once: as many as marks lie there, within the last two bounds; where a number is wanted at
most some times that number, and no fewer than the first."""

WASTE = 12
"""Darts thrown for one that is wanted."""

AT_ONCE = 64
"""Darts that fit, beside as many as marks lie there, that are compared with one another; the rest of a
throw is as if it had not been thrown."""

MOST_CELLS = 12_000
"""Places at which room is looked for."""


class Dice:
    """Uniform numbers in [0, 1), the same on every machine: the stream of Python's own generator."""

    def __init__(self, seed: int) -> None:
        self._bytes = random.Random(seed).randbytes

    def __call__(self, count: int) -> Array:
        """Return the next numbers, shape (count,)."""
        # As random.random() makes each of 53 of the generator's next 64 bits.
        words = np.frombuffer(self._bytes(8 * count), "<u4").reshape(-1, 2)
        high, low = words[:, 0] >> 5, words[:, 1] >> 6
        return np.asarray((high * float(1 << 26) + low) / (1 << 53))


@frozen
class Rules:
    """What darts look like. ``size`` counts from the kit's least size, so it begins at 1."""

    turn: tuple[float, float]
    turns: tuple[float, ...]
    size: tuple[float, float]
    flip: bool
    weights: Array

    def turned(self, chance: Array) -> Array:
        """Return turns in degrees for numbers in [0, 1)."""
        if self.turns:
            steps = np.array(self.turns)
            return np.asarray(steps[(chance * len(steps)).astype(np.intp)])
        low, high = self.turn
        return np.round(low + (high - low) * chance, 3)


@frozen
class Spacing:
    """How far marks stand apart, in grid steps: from all others, and from those of the same motif."""

    distance: float
    kin: float


class Room:
    """Which places of the torus can still be the heart of a mark."""

    def __init__(self, scatter: Scatter, least: float, spacing: Spacing) -> None:
        """Look at the torus as it is; ``least`` is the radius that every dart needs round its heart."""
        window = scatter.torus.window
        step = max(0.7 * least, spacing.kin / 4, math.sqrt(scatter.torus.area / MOST_CELLS))
        across, up = (max(1, math.ceil(side / step)) for side in (window.right, window.top))
        self.sides = window.right / across, window.top / up
        x, y = np.meshgrid((np.arange(across) + 0.5), (np.arange(up) + 0.5))
        self.places: Complexes = (x * self.sides[0] + 1j * y * self.sides[1]).ravel()
        self.free = np.ones(len(self.places), bool)
        # Nearer than this to a mark no place of a cell will do.
        self._reach = least - math.hypot(*self.sides) / 2
        self._points = np.asarray(shapely.points(self.places.real, self.places.imag), dtype=object)
        self._tree = shapely.STRtree(self._points)

    def take(self, shapes: Geometries, distance: float) -> None:
        """Give away the room of shapes, and of all that is nearer to them than a distance."""
        if not len(shapes):
            return
        reach = self._reach + distance
        if reach > 0:
            # Only what is still free is measured.
            shape, cells = self._tree.query(boxes(shapes, reach))
            shape, cells = shape[self.free[cells]], cells[self.free[cells]]
            shapely.prepare(shapes)
            cells = cells[shapely.dwithin(shapes[shape], self._points[cells], reach)]
        else:
            _, cells = self._tree.query(shapely.buffer(shapes, reach), predicate="contains")
        self.free[cells] = False

    def hearts(self, dice: Dice, count: int) -> Complexes:
        """Return places by chance in the cells that are free."""
        cells = np.flatnonzero(self.free)
        chosen = self.places[cells[(dice(count) * len(cells)).astype(np.intp)]]
        return np.asarray(
            chosen + (dice(count) - 0.5) * self.sides[0] + 1j * (dice(count) - 0.5) * self.sides[1]
        )


def thrown(
    scatter: Scatter,
    rules: Rules,
    dice: Dice,
    spacing: Spacing,
    tries: int,
    wanted: Callable[[Poses], Array],
) -> int:
    """Throw darts until nothing more is wanted, or ``tries`` miss in a row, or no room is left.

    Args:
        scatter: what lies there; it gains the darts that fit.
        rules: what darts look like.
        dice: the chances.
        spacing: how far they stand apart.
        tries: darts that must miss in a row.
        wanted: from what lies there to how many more of each motif are wanted, shape (k,); may be infinite.

    Returns:
        How many darts were thrown.

    Raises:
        TooLargeError: where they are more than one compilation may throw.
    """
    scatter.set(scatter.poses, scatter.field, spacing.kin)
    want = wanted(scatter.poses)
    if not (want > 0).any():
        return 0
    kinds = np.flatnonzero(want > 0)
    room = Room(scatter, float(scatter.kit.radii[kinds, 0].min()), spacing)
    _give_away(room, scatter.there, spacing, kinds)
    missed = total = 0
    while missed < tries and room.free.any() and (want > 0).any():
        batch = _batch(len(scatter), want)
        _spend(batch, scatter, tries, total)
        darts = _drawn(scatter, rules, dice, room, _shares(scatter, rules, want), batch)
        fit, marks = scatter.fitting(darts, spacing.distance, spacing.kin)
        most = AT_ONCE + len(scatter)
        batch = batch if len(fit) <= most else int(fit[most - 1]) + 1
        fit, marks = fit[:most], marks.take(slice(most))
        both = scatter.compatible(marks, spacing.distance, spacing.kin)
        both = both[ranks(darts.motif[fit[both]]) < want[darts.motif[fit[both]]]]
        fit, more = fit[both], marks.take(both)
        total += batch
        missed = missed + batch if not len(fit) else batch - 1 - int(fit[-1])
        if len(fit):
            before = len(scatter.there)
            scatter.add(darts.take(fit), more, spacing.kin)
            _give_away(room, scatter.there.take(slice(before, None)), spacing, kinds)
            want = wanted(scatter.poses)
    return total


def _spend(batch: int, scatter: Scatter, tries: int, thrown: int) -> None:
    images = len(scatter.torus.operations)
    try:
        work.spend_on_darts(batch * images)
    except TooLargeError:
        times = f" of {images} images each" if images > 1 else ""
        raise TooLargeError(
            f"tries = {tries:,}: after {thrown:,} darts{times} there are {len(scatter):,} marks and still "
            "room for chance, which is more work than fits: expected fewer tries, or a count"
        ) from None


def _batch(there: int, want: Array) -> int:
    batch = min(max(there, LEAST_BATCH), MOST_BATCH)
    wanted = float(want.clip(0).sum())
    return batch if WASTE * wanted >= batch else max(int(WASTE * wanted), FEW_DARTS)


def _give_away(room: Room, there: Field, spacing: Spacing, kinds: Indices) -> None:
    """Take the room of marks, and that round those of the only motif that is thrown."""
    room.take(there.shapes, spacing.distance)
    if len(kinds) == 1 and spacing.kin > spacing.distance:
        room.take(there.shapes[there.kinds == kinds[0]], spacing.kin)


def _shares(scatter: Scatter, rules: Rules, want: Array) -> Array:
    """Return how likely each motif is drawn: by what is wanted, or by its weight and what it lacks of it."""
    if np.isfinite(want).all():
        # The larger of those that are wanted need the more darts.
        lacks = want * shapely.area(scatter.kit.outlines)
        return np.asarray(lacks / lacks.sum())
    weights = np.where(want > 0, rules.weights, 0.0)
    have = np.bincount(scatter.poses.motif, minlength=len(weights))
    # A motif that has its share still gets a chance, lest the holes that only it would fill stay open.
    lacks = np.maximum(weights * (1.25 * len(scatter) + 8) - have, 0.2 * weights)
    return np.asarray(lacks / lacks.sum())


def ranks(motif: Indices) -> Indices:
    """Return how many earlier ones of the same motif each has."""
    order = np.argsort(motif, kind="stable")
    _, start, sizes = np.unique(motif[order], return_index=True, return_counts=True)
    ranks = np.empty(len(motif), np.intp)
    ranks[order] = np.arange(len(motif)) - np.repeat(start, sizes)
    return ranks


def _drawn(scatter: Scatter, rules: Rules, dice: Dice, room: Room, shares: Array, count: int) -> Poses:
    kit = scatter.kit
    motif = np.minimum(np.searchsorted(np.cumsum(shares), dice(count), side="right"), len(shares) - 1)
    low, high = rules.size
    size = np.round(low + (high - low) * dice(count), 4)
    flip = dice(count) < 0.5 if rules.flip else np.zeros(count, bool)
    poses = Poses(motif, size, rules.turned(dice(count)), flip, np.zeros(count, np.complex128))
    heart = poses.carry(kit.discs[motif, 0], scatter.torus.stretch)
    return replace(poses, place=scatter.torus.within(room.hearts(dice, count) - heart))
