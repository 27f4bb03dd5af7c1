"""The cracks of wax: a network on the torus, grown one crack after another.

Wax breaks where it is under the most tension, in the midst of the largest piece, and a crack runs on in both
ways until it meets an older one: it ends there at a T, and never crosses. See B. Wyvill, K. van Overveld and
S. Carpendale, "Rendering cracks in batik", NPAR 2004, who follow the gradient of a distance transform from
pixel to pixel. Here a piece is a convex polygon, the crack its chord across the longer way, and since a crack
is held by its piece alone, all pieces of a generation break at once. Then a smooth shift of all places (see
:mod:`~batik_vector.processes.handwork.waver`) bends the network, and keeps every T.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index, Offsets, Steps
from batik_vector.geometry.sampling import Array
from batik_vector.processes.handwork.splitting import Cells, Chords, chords, halves, moments, together
from batik_vector.processes.handwork.waver import Wave, Waver, folded
from batik_vector.values import frozen

BOTTOM, RIGHT, TOP, LEFT = range(4)
"""What bounds the first piece: the first crack runs once round the torus and is its bottom and its top, the
second goes from the first one back to it, and is its sides."""
JITTER = 0.7
"""Tangent of the most by which a crack leaves the shortest way across its piece."""
ASIDE = 0.5
"""The most by which it passes the middle, over how far the piece reaches on average along its longer way."""
UNEVEN = 0.6
"""By how much of a piece's size chance decides which breaks next."""
LONGER = 3.0
"""How many times longer than broad pieces are where a direction is followed altogether, less 1."""

BENDS = ((5.0, 2.2), (2.0, 0.8), (0.8, 0.28), (0.35, 0.10))
"""The waves that bend a network one after another: how far bumps stand apart, and their push, over the mean
size of pieces."""
STRAIN = 0.75
"""How much each may part places at most: below 1 they keep every T."""
STRIDES = 7
"""Corners of a crack for the length of a piece."""
STEP, ASUNDER = 3, 20
"""Steps by which one of two cracks that end in one place is moved, then twice as many, and so on; tries."""
AGED = 2.0
"""The power of a crack's age by which it has grown wide: most are hairs, and few are broad."""


@frozen(eq=False)
class Network:
    """Cracks, the oldest first, as polylines in steps that may reach beyond the cell.

    Crack i is ``points[offsets[i]:offsets[i + 1]]``; where a younger one meets it both have a corner. ``age``
    falls from nearly 1 to nearly 0; ``pieces`` is how many pieces of cloth lie between all of them.
    """

    points: Steps
    offsets: Offsets
    age: Array
    pieces: int

    def __len__(self) -> int:
        return len(self.age)


def count_of(cell: Cell, size: float) -> int:
    """Return how many pieces of a mean size (steps) fill the cell."""
    return round(cell.columns * cell.rows / (size * size))


def widths(age: Array, least: float, greatest: float) -> Array:
    """Return how wide cracks of an age are: least + (greatest - least) · age².

    Dye and bending wear the edges of a crack away for as long as it is there. As cracks are born evenly in
    time, a share √((w - least) / (greatest - least)) of them is narrower than w.
    """
    return least + (greatest - least) * age * age


def grown(cell: Cell, size: float, seed: int, direction: float | None = None, along: float = 0.0) -> Network:
    """Return a network.

    Args:
        cell: of the torus.
        size: mean size of pieces in steps: the side of a square as large.
        seed: what chance gives.
        direction: in degrees, along which cracks run rather than across.
        along: how much rather, 0 to 1.
    """
    pieces = max(count_of(cell, size), 1)
    dice = np.random.default_rng([seed, 0])
    shift, root = _root(cell, dice)
    metric = _Metric.of(direction, along)
    cracks = _Cracks.of_root(root.corners[0])
    cells, key = root, np.array([np.inf])
    known = np.empty(0)
    while len(cells):
        area, middle, spread = moments(metric.shrunk(cells.corners.astype(float)))
        chance = dice.random((3, len(cells)))
        key = np.minimum(key, area * (1 + UNEVEN * (2 * chance[0] - 1)))
        known = np.sort(np.concatenate([known, key]))[::-1]
        # What is not among the first so many to break never will be, nor will its parts.
        breaks = key >= known[pieces - 2] if 2 <= pieces <= len(known) + 1 else np.full(len(key), pieces > 1)
        cells, key = cells.taken(breaks), key[breaks]
        if not len(cells):
            break
        way = _way(middle[breaks], spread[breaks], chance[1:, breaks])
        cut = chords(cells, metric.stretched(way[0]), metric.stretched(way[1]))
        number = cracks.take(cells, cut, key)
        cells = together(*halves(cells, cut, number))
        key = np.concatenate([key, key])
    return cracks.network(cell, shift, size, seed, pieces)


def _root(cell: Cell, dice: np.random.Generator) -> tuple[Steps, Cells]:
    """Return the translations across the first piece and along it, and the piece: the torus cut open."""
    a, b = (np.array(each, np.int64) for each in cell.lattice)
    across, along = ((a + b, b), (a - b, b), (b - a, -a), (a + b, -a))[int(4 * dice.random())]
    start = np.floor(dice.random(2) * (cell.columns, cell.rows)).astype(np.int64)
    # Where the second crack meets the first again is not where it began.
    side = along + np.floor((dice.random() - 0.5) * across).astype(np.int64)
    corners = np.stack([start, start + across, start + across + side, start + side])
    return np.stack([across, along]), Cells(
        corners[None], np.array([4]), np.array([[BOTTOM, RIGHT, TOP, LEFT]])
    )


@frozen
class _Metric:
    """Places as they are where a direction is shortened: pieces broken there as any other are longer here."""

    x: float
    y: float
    times: float

    @classmethod
    def of(cls, direction: float | None, along: float) -> _Metric:
        turn = math.radians(direction or 0.0)
        return cls(
            round(math.cos(turn), 9),
            round(math.sin(turn), 9),
            1.0 if direction is None else 1 + LONGER * along,
        )

    def shrunk(self, xy: Array) -> Array:
        return self._scaled(xy, 1 / self.times - 1)

    def stretched(self, xy: Array) -> Array:
        return self._scaled(xy, self.times - 1)

    def _scaled(self, xy: Array, by: float) -> Array:
        far = (xy[..., 0] * self.x + xy[..., 1] * self.y) * by
        return np.stack([xy[..., 0] + far * self.x, xy[..., 1] + far * self.y], axis=-1)


def _way(middle: Array, spread: Array, chance: Array) -> tuple[Array, Array]:
    """Return a place about the middle of each piece, and a direction about across its longer way."""
    xx, xy, yy = spread.T
    apart = xx - yy
    root = np.sqrt(apart * apart + 4 * xy * xy)
    wide = apart >= 0
    long = np.stack([np.where(wide, apart + root, 2 * xy), np.where(wide, 2 * xy, root - apart)], axis=1)
    length = np.sqrt(long[:, 0] * long[:, 0] + long[:, 1] * long[:, 1])
    long = np.where(length[:, None] > 0, long / np.where(length > 0, length, 1.0)[:, None], (1.0, 0.0))
    reach = np.sqrt(np.maximum((xx + yy + root) / 2, 0.0))
    aside = ASIDE * (2 * chance[0] - 1) * reach
    lean = JITTER * (2 * chance[1] - 1)
    across = np.stack([-long[:, 1], long[:, 0]], axis=1)
    return middle + long * aside[:, None], across + long * lean[:, None]


class _Cracks:
    """Cracks as straight lines, as they come: where each begins and ends, and on which others."""

    def __init__(self, begin: Steps, end: Steps, on: Steps) -> None:
        self.begin, self.end, self.on = [begin], [end], [on]
        self.key = [np.full(len(begin), np.inf)]
        self.count = len(begin)

    @classmethod
    def of_root(cls, corners: Steps) -> _Cracks:
        """Return what bounds the first piece: the side to the right, and the top, are there twice."""
        left = [[BOTTOM, TOP]]
        none = [[-1, -1]]
        return cls(corners[[0, 1, 3, 0]], corners[[1, 2, 2, 3]], np.array(none * 3 + left))

    def take(self, cells: Cells, cut: Chords, key: Array) -> Index:
        """Add a crack for each of some cells, and return their numbers."""
        row = np.arange(len(cells))
        self.begin.append(cut.ends[0])
        self.end.append(cut.ends[1])
        self.on.append(np.stack([cells.side[row, each] for each in cut.sides], axis=1))
        self.key.append(key)
        self.count += len(cells)
        return np.arange(self.count - len(cells), self.count)

    def network(self, cell: Cell, shift: Steps, size: float, seed: int, pieces: int) -> Network:
        """Return the first so many as they are bent."""
        begin, end, on = (np.concatenate(each) for each in (self.begin, self.end, self.on))
        order = np.argsort(-np.concatenate(self.key), kind="stable")
        order = order[(order != RIGHT) & (order != TOP)]
        # The bottom is the oldest, the left side next.
        order = order[: pieces + 1]
        number = np.full(len(begin), -1)
        number[order] = np.arange(len(order))
        number[[RIGHT, TOP]] = number[[LEFT, BOTTOM]]
        back = np.zeros((len(begin), 2), np.int64)
        back[RIGHT], back[TOP] = shift
        ends = np.stack([begin, end], axis=1)[order]
        on = on[order]
        met = on >= 0
        where = ends[met] - back[on[met]]
        bends = [
            Waver.drawn(cell, [Wave(reach * size, push * size)], (seed, 1, times)).eased(STRAIN)
            for times, (reach, push) in enumerate(BENDS)
        ]
        where = _apart(ends, met, number[on[met]], where, cell, bends)
        points, offsets = _lines(ends, number[on[met]], where, size / STRIDES)
        points = _bent(points, bends)
        age = 1 - (np.arange(len(order)) + 0.5) / len(order)
        return Network(points, offsets, age, pieces)


def _bent(points: Steps, bends: Sequence[Waver]) -> Steps:
    for bend in bends:
        points = bend.moved(points)
    return points


def _apart(
    ends: Steps, met: NDArray[np.bool_], onto: Index, where: Steps, cell: Cell, bends: Sequence[Waver]
) -> Steps:
    """Move the ends of cracks that come to lie where another ends, on the other side: these were no Ts.

    Args:
        ends: shape (n, 2, 2); they are moved along what they end on by a few steps, the youngest of those in
            one place.
        met: shape (n, 2): which of them end on another crack.
        onto, where: on which those do, and where, as :func:`_lines` takes them.
        cell, bends: of the network; where places are told apart is after it is bent.

    Returns:
        where they end now.
    """
    crack = np.nonzero(met)[0]
    way = (ends[onto, 1] - ends[onto, 0]).astype(float)
    way /= np.maximum(np.abs(way).max(axis=1), 1.0)[:, None]
    for times in range(1, ASUNDER + 1):
        places = folded(_bent(ends[met], bends), cell)
        order = np.lexsort([crack, places[:, 1], places[:, 0]])
        again = (places[order[1:]] == places[order[:-1]]).all(axis=1)
        if not again.any():
            break
        twice = order[1:][again]
        by = np.floor(way[twice] * (STEP * times) + 0.5).astype(np.int64)
        # Away from the nearer end of what they end on.
        middle = (ends[onto[twice], 0] + ends[onto[twice], 1]) / 2
        by[((middle - where[twice]) * by).sum(axis=1) < 0] *= -1
        where = where.copy()
        where[twice] += by
        moved = ends[met]
        moved[twice] += by
        ends[met] = moved
    return where


def _lines(ends: Steps, onto: Index, where: Steps, stride: float) -> tuple[Steps, Offsets]:
    """Return straight cracks with corners every stride or so, and where others meet them.

    Args:
        ends: shape (n, 2, 2).
        onto, where: which are met, and where; on the first, give or take times round the torus.
        stride: in steps.
    """
    begin, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    squares = (way[:, 0].astype(float) ** 2 + way[:, 1].astype(float) ** 2).clip(1)
    to = where - begin[onto]
    share = (to[:, 0] * way[onto, 0].astype(float) + to[:, 1] * way[onto, 1].astype(float)) / squares[onto]
    round_ = np.where(onto == 0, np.floor(share), 0.0)
    share, where = share - round_, where - (way[0] * round_[:, None]).astype(np.int64)
    # The first goes on a little past where it began, over itself.
    counts = np.maximum(np.ceil(np.sqrt(squares) / stride).astype(np.int64), 2)
    steps = counts + 1
    steps[0] += 1
    first = np.cumsum(steps) - steps
    crack = np.repeat(np.arange(len(ends)), steps)
    k = np.arange(len(crack)) - first[crack]
    own = k / counts[crack]
    places = begin[crack] + np.floor(way[crack] * own[:, None] + 0.5).astype(np.int64)
    fixed = (k == 0) | (k == counts[crack])
    # Past its end the first repeats itself bit by bit.
    again = own > 1
    places[again] = places[1] + way[0]
    over = (onto == 0) & (share < 1 / counts[0])
    crack = np.concatenate([crack, onto, onto[over]])
    own = np.concatenate([own, share, share[over] + 1])
    places = np.concatenate([places, where, where[over] + way[0]])
    fixed = np.concatenate([fixed, np.ones(len(onto) + int(over.sum()), bool)])
    order = np.lexsort([own, crack])
    crack, own, places, fixed = crack[order], own[order], places[order], fixed[order]
    # A corner of no need close to one where another crack ends would bend the line by its rounding alone.
    gap = np.where(np.diff(crack) == 0, np.diff(own) * counts[crack[1:]], np.inf)
    before = np.append(np.inf, np.where(fixed[:-1], gap, np.inf))
    after = np.append(np.where(fixed[1:], gap, np.inf), np.inf)
    keep = fixed | (np.minimum(before, after) > 0.4)
    crack, places = crack[keep], places[keep]
    again = np.append(False, (np.diff(crack) == 0) & (places[1:] == places[:-1]).all(axis=1))
    crack, places = crack[~again], places[~again]
    return places, np.searchsorted(crack, np.arange(len(ends) + 1))
