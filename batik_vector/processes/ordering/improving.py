"""A better order: stretches are turned round (2-opt) or moved elsewhere (or-opt) as long as that saves way.

All changes among near neighbours are weighed at once; those that save are made one after another, the best
first, where they still save. Only where something changed is weighed again.

J. L. Bentley, Fast algorithms for geometric traveling salesman problems, ORSA Journal on Computing 4 (1992);
I. Or, thesis, Northwestern University (1976).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.processes.ordering.distances import PARTS, Distances, lengths
from batik_vector.processes.ordering.neighbours import NOBODY, neighbours
from batik_vector.values import frozen

NEAREST = 6
"""Neighbours of an end that are weighed."""
LONGEST = 3
"""Strokes in a row that are moved together at most."""
LEAST = PARTS
"""What a change has to save: a grid step."""
ROUNDS = 40
"""Rounds of weighing at most."""
MOST_MOVED = 50_000
"""Ends that one change may move: turning round half of a long order costs more than it saves."""

TURN = 0
"""A change that turns a stretch round; others are how many strokes are moved."""


@frozen(eq=False)
class _Changes:
    """Changes that save: what each is, the ends about it, and what it saves.

    Turning joins u to v and what was joined to them. Moving takes the strokes from v to w and puts them
    between u and what was joined to u.
    """

    kind: Index
    u: Index
    v: Index
    w: Index
    saves: Distances


class _Tour:
    """Strokes in an order: the ends as they are passed, where each stands, and which is joined to which."""

    def __init__(self, order: Index, ends: Steps, group: Index) -> None:
        self.order = order.copy()
        self.x, self.y, self.group = ends[:, 0].copy(), ends[:, 1].copy(), group
        self.place = np.empty_like(order)
        self.place[order] = np.arange(len(order))
        self.mate = np.full(len(order), NOBODY, np.intp)
        out, into = order[1:-1:2], order[2::2]
        same = group[out >> 1] == group[into >> 1]
        self.mate[out[same]], self.mate[into[same]] = into[same], out[same]
        self.way = self.gap(np.arange(len(order)), self.mate)
        """How far each end is from the one that it is joined to."""

    def gap(self, a: Index, b: Index) -> Distances:
        """Return how far ends lie apart, 0 where one of them is nobody."""
        apart = lengths(self.x[a] - self.x[b], self.y[a] - self.y[b])
        apart[(a < 0) | (b < 0)] = 0
        return apart

    def turns(self, u: Index, v: Index, apart: Distances) -> _Changes:
        """Return what turning round saves that joins these ends."""
        place = self.place
        # Only what is passed the same way can be joined so.
        alike = np.flatnonzero(((place[u] ^ place[v]) & 1) == 0)
        u, v = u[alike], v[alike]
        saves = self.way[u] + self.way[v] - apart[alike] - self.gap(self.mate[u], self.mate[v])
        return self._saving(TURN, u, v, v, saves)

    def moves(self, u: Index, v: Index, apart: Distances, size: int) -> _Changes:
        """Return what moving saves: the strokes from v on, away from what v is joined to, to behind u."""
        order, place, mate, way = self.order, self.place, self.mate, self.way
        at, from_ = place[u], place[v]
        last = from_ + np.where(from_ & 1, 1 - 2 * size, 2 * size - 1)
        inside = (last >= 0) & (last < len(order))
        inside &= (at < np.minimum(from_, last)) | (at > np.maximum(from_, last))
        w = order[np.where(inside, last, 0)]
        inside &= self.group[v >> 1] == self.group[w >> 1]
        inside &= (u != mate[v]) & (u != mate[w])
        # No way is shorter than none.
        inside &= way[u] + way[v] + way[w] - apart >= LEAST
        some = np.flatnonzero(inside)
        u, v, w = u[some], v[some], w[some]
        saves = way[u] + way[v] + way[w] - apart[some]
        saves -= self.gap(w, mate[u]) + self.gap(mate[v], mate[w])
        return self._saving(size, u, v, w, saves)

    def _saving(self, kind: int, u: Index, v: Index, w: Index, saves: Distances) -> _Changes:
        good = np.flatnonzero(saves >= LEAST)
        return _Changes(np.full(len(good), kind), u[good], v[good], w[good], saves[good])

    def turn(self, u: int, v: int) -> None:
        """Turn round what lies between two ends that are passed the same way."""
        p, q = sorted((int(self.place[u]), int(self.place[v])))
        first, stop = (p + 1, q + 1) if p & 1 else (p, q)
        self.put(first, self.order[first:stop][::-1].copy())

    def move(self, u: int, v: int, w: int) -> None:
        """Move what lies from v to w to beside u, v next to it."""
        order = self.order
        p, i, j = int(self.place[u]), int(self.place[v]), int(self.place[w])
        low, stop = min(i, j), max(i, j) + 1
        moved = order[low:stop]
        if (p & 1) != (i < j):
            moved = moved[::-1]
        gap = p + (p & 1)
        if gap <= low:
            self.put(gap, np.concatenate([moved, order[gap:low]]))
        else:
            self.put(low, np.concatenate([order[stop:gap], moved]))

    def put(self, first: int, ends: Index) -> None:
        """Put ends at places from ``first`` on."""
        stop = first + len(ends)
        self.order[first:stop] = ends
        self.place[ends] = np.arange(first, stop)


def improved(order: Index, ends: Steps, group: Index, rounds: int = ROUNDS) -> Index:
    """Return an order that is no longer than this one.

    Args:
        order: as :func:`~batik_vector.processes.ordering.chaining.chained` gives it.
        ends, group: as it takes them.
        rounds: of weighing, at most.
    """
    if len(group) < 3:
        return order
    tour = _Tour(order, ends, group)
    u, v, apart = _pairs(ends, group)
    asked = np.ones(len(ends), bool)
    for _ in range(rounds):
        some = np.flatnonzero(asked[u] | asked[v])
        changes = _weighed(tour, u[some], v[some], apart[some])
        if not len(changes.u):
            break
        asked = _made(tour, changes)
        changed = np.flatnonzero(asked)
        tour.way[changed] = tour.gap(changed, tour.mate[changed])
    return tour.order


def _pairs(ends: Steps, group: Index) -> tuple[Index, Index, Distances]:
    """Return pairs of ends that lie near each other, one way and the other, and how far apart they are."""
    round_ = (ends[0::2] == ends[1::2]).all(axis=1)
    site = np.ones(len(ends), bool)
    site[1::2] = ~round_
    sites = np.flatnonzero(site)
    other, apart = neighbours(ends[sites], group[sites >> 1], sites >> 1, NEAREST)
    one = np.repeat(sites, other.shape[1])
    there = other.ravel() != NOBODY
    u, v, apart = one[there], sites[other.ravel()[there]], apart.ravel()[there]
    # Both ends of a closed stroke are where its one site is.
    for mine in (True, False):
        twin = round_[(u if mine else v) >> 1]
        more = (u[twin] ^ 1, v[twin]) if mine else (u[twin], v[twin] ^ 1)
        u, v = np.concatenate([u, more[0]]), np.concatenate([v, more[1]])
        apart = np.concatenate([apart, apart[twin]])
    return u, v, apart


def _weighed(tour: _Tour, u: Index, v: Index, apart: Distances) -> _Changes:
    """Return the changes that save way, those that save most first."""
    mine, theirs = tour.way[u], tour.way[v]
    # A new gap has to be shorter than one of those that it is for, or one of an end that is joined to nobody.
    short, free = (apart < mine) & (tour.mate[u] != v), tour.mate[u] < 0
    near = np.flatnonzero(short | free)
    parts = [tour.turns(u[near], v[near], apart[near])]
    near = np.flatnonzero(short | (apart < theirs) & (tour.mate[u] != v))
    u, v, apart = u[near], v[near], apart[near]
    parts += [tour.moves(u, v, apart, size) for size in range(1, LONGEST + 1)]
    kind, a, b, c, saves = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("kind", "u", "v", "w", "saves")
    )
    best = np.lexsort([c, b, a, kind, -saves])
    return _Changes(kind[best], a[best], b[best], c[best], saves[best])


def _made(tour: _Tour, changes: _Changes) -> NDArray[np.bool_]:
    """Make changes where what they are about is still there; return the ends to be asked again."""
    mate, place = tour.mate, tour.place
    asked = np.zeros(len(place), bool)
    rows = zip(
        changes.kind.tolist(),
        *(each.tolist() for end in (changes.u, changes.v, changes.w) for each in (end, mate[end])),
        strict=True,
    )
    for kind, u, a, v, b, w, c in rows:
        if mate[u] != a or mate[v] != b or mate[w] != c:
            asked[u] = asked[v] = True
            continue
        if kind == TURN:
            if (place[u] ^ place[v]) & 1 or abs(place[u] - place[v]) > MOST_MOVED:
                asked[u] = asked[v] = True
                continue
            tour.turn(u, v)
            joined: tuple[tuple[int, int], ...] = ((u, v), (a, b))
        else:
            low, high = sorted((place[v], place[w]))
            whole = high - low == 2 * kind - 1 and (place[v] < place[w]) == (not place[v] & 1)
            if not whole or low <= place[u] <= high or abs(place[u] - low) > MOST_MOVED:
                asked[u] = asked[v] = True
                continue
            tour.move(u, v, w)
            joined = ((u, v), (w, a), (b, c))
        for one, two in joined:
            if one >= 0:
                mate[one] = two
                asked[one] = True
            if two >= 0:
                mate[two] = one
                asked[two] = True
    return asked
