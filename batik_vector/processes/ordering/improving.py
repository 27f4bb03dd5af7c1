"""A better order: stretches are turned round (2-opt) or moved elsewhere (or-opt) as long as that saves way.

All changes among near neighbours are weighed at once; those that save are made one after another, the best
first, where they still save. Only where something changed is weighed again.

J. L. Bentley, Fast algorithms for geometric traveling salesman problems, ORSA Journal on Computing 4 (1992);
I. Or, thesis, Northwestern University (1976).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index
from batik_vector.processes.ordering.distances import PARTS, Distances, lengths
from batik_vector.processes.ordering.neighbours import NOBODY, Pairs
from batik_vector.processes.ordering.sites import Sites
from batik_vector.values import frozen

LONGEST = 3
"""Strokes in a row that are moved together at most."""
LEAST = PARTS
"""What a change has to save: a grid step."""
ROUNDS = 40
"""Rounds of weighing at most."""
WORTH = 1 / 150
"""The share of the way that a round has to save, or none follows."""
MOST_MOVED = 50_000
"""Ends that one change may move: turning round half of a long order costs more than it saves."""

SIZES = np.arange(1, LONGEST + 1)[:, None]
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

    def __init__(self, order: Index, sites: Sites) -> None:
        self.order = order.copy()
        # Nobody's place, the last, is no number, and so is every distance to it.
        self.x, self.y = np.append(sites.x, np.nan), np.append(sites.y, np.nan)
        self.group, self.parted = sites.group, bool(sites.group.any())
        self.place = np.empty_like(order)
        self.counted = np.arange(len(order))
        self.place[order] = self.counted
        self.mate = np.full(len(order), NOBODY, np.intp)
        out, into = order[1:-1:2], order[2::2]
        if self.parted:
            same = self.group[out >> 1] == self.group[into >> 1]
            out, into = out[same], into[same]
        self.mate[out], self.mate[into] = into, out
        self.way = np.empty(len(order))
        """How far each end is from the one that it is joined to."""
        self.reach = np.empty(len(order))
        """The same, and for an end that is joined to none, beyond all."""
        self.measure(self.counted)

    def measure(self, ends: Index) -> None:
        """Measure how far ends are from those that they are joined to."""
        mate = self.mate[ends]
        self.way[ends] = way = self.gap(ends, mate)
        way[mate < 0] = np.inf
        self.reach[ends] = way

    def gap(self, a: Index, b: Index) -> Distances:
        """Return how far ends lie apart, 0 where one of them is nobody."""
        x, y = self.x.take(a), self.y.take(a)
        x -= self.x.take(b)
        y -= self.y.take(b)
        apart = lengths(x, y)
        return np.fmax(apart, 0, out=apart)

    def turns(self, u: Index, v: Index, apart: Distances) -> _Changes:
        """Return what turning round would save, but for the second gap, that joins these ends."""
        # Only what is passed the same way can be joined so.
        alike = np.flatnonzero(((self.place.take(u) ^ self.place.take(v)) & 1) == 0)
        u, v = u[alike], v[alike]
        saves = self.way.take(u)
        saves += self.way.take(v)
        saves -= apart[alike]
        return _Changes(np.full(len(u), TURN), u, v, v, saves)

    def moves(self, u: Index, v: Index, apart: Distances) -> _Changes:
        """Return what moving would save, but for the gaps beside what moves and where it was.

        Moved are the strokes from v on, away from what v is joined to, to behind u.
        """
        order, place, mate, way = self.order, self.place, self.mate, self.way
        from_ = place.take(v)
        toward = 1 - 2 * (from_ & 1)
        along = (place.take(u) - from_) * toward
        last = from_ + toward * (2 * SIZES - 1)
        w = order.take(last, mode="clip")
        # No way is shorter than none.
        most = way.take(w)
        most += way.take(u) + way.take(v) - apart
        able = most >= LEAST
        able &= (along < 0) | (along >= 2 * SIZES)
        able &= (last >= 0) & (last < len(order)) & (mate.take(w) != u)
        if self.parted:
            able &= self.group[v >> 1] == self.group[w >> 1]
        found = np.flatnonzero(able)
        size, some = np.divmod(found, len(u)) if len(u) else (found, found)
        return _Changes(size + 1, u[some], v[some], w.ravel()[found], most.ravel()[found])

    def turn(self, p: int, q: int) -> None:
        """Turn round what lies between two places that are passed the same way."""
        if p > q:
            p, q = q, p
        first, stop = (p + 1, q + 1) if p & 1 else (p, q)
        self.put(first, stop, self.order[first:stop][::-1].copy())

    def move(self, p: int, i: int, j: int) -> None:
        """Move what lies from place i to place j to beside place p, i next to it."""
        order = self.order
        low, stop = (i, j + 1) if i < j else (j, i + 1)
        moved = order[low:stop]
        if (p & 1) != (i < j):
            moved = moved[::-1]
        gap = p + (p & 1)
        if gap <= low:
            self.put(gap, stop, np.concatenate((moved, order[gap:low])))
        else:
            self.put(low, gap, np.concatenate((order[stop:gap], moved)))

    def put(self, first: int, stop: int, ends: Index) -> None:
        """Put ends at places from ``first`` on."""
        self.order[first:stop] = ends
        self.place[ends] = self.counted[first:stop]


def improved(order: Index, sites: Sites, pairs: Pairs, rounds: int = ROUNDS) -> Index:
    """Return an order that is no longer than this one.

    Args:
        order: as :func:`~batik_vector.processes.ordering.chaining.chained` gives it.
        sites: as it takes them.
        pairs: of ends that lie near one another.
        rounds: of weighing, at most.
    """
    if len(sites.group) < 3:
        return order
    tour = _Tour(order, sites)
    u, v, apart = _both_ends(pairs, sites.round)
    asked = np.ones(len(order), bool)
    whole = tour.way.sum()
    for _ in range(rounds):
        some = np.flatnonzero(asked.take(u) | asked.take(v))
        changes = _weighed(tour, u[some], v[some], apart[some])
        if not len(changes.u):
            break
        asked = _made(tour, changes)
        tour.measure(np.flatnonzero(asked))
        before, whole = whole, tour.way.sum()
        if before - whole < WORTH * before:
            break
    return tour.order


def _both_ends(pairs: Pairs, round_: NDArray[np.bool_]) -> tuple[Index, Index, Distances]:
    """Return the ends of pairs and how far apart they are; both ends of a closed stroke are where one is."""
    u, v, apart = pairs.one, pairs.two, pairs.apart
    if not round_.any():
        return u, v, apart
    for mine in (True, False):
        twin = np.flatnonzero(round_[(u if mine else v) >> 1])
        more = (u[twin] ^ 1, v[twin]) if mine else (u[twin], v[twin] ^ 1)
        u, v = np.concatenate([u, more[0]]), np.concatenate([v, more[1]])
        apart = np.concatenate([apart, apart[twin]])
    return u, v, apart


def _weighed(tour: _Tour, u: Index, v: Index, apart: Distances) -> _Changes:
    """Return the changes that save way, those that save most first."""
    # A new gap has to be shorter than one of those that it is for, or one of an end that is joined to nobody.
    mine, theirs = tour.reach.take(u), tour.reach.take(v)
    near = np.flatnonzero((apart < np.maximum(mine, theirs)) & (tour.mate.take(u) != v))
    u, v, apart = u[near], v[near], apart[near]
    turns = tour.turns(u, v, apart)
    short, close = np.flatnonzero(apart < mine[near]), np.flatnonzero(apart < theirs[near])
    moves = tour.moves(
        np.concatenate((u[short], v[close])),
        np.concatenate((v[short], u[close])),
        np.concatenate((apart[short], apart[close])),
    )
    kind, a, b, c, saves = (
        np.concatenate((getattr(turns, name), getattr(moves, name)))
        for name in ("kind", "u", "v", "w", "saves")
    )
    # Turning leaves a gap between what was joined to the two, moving one beside what
    # moves and one where it was.
    turned = len(turns.u)
    before = tour.mate.take(b)
    gaps = tour.gap(
        np.concatenate((before[:turned], c[turned:], before[turned:])),
        np.concatenate((tour.mate.take(a), tour.mate.take(c[turned:]))),
    )
    saves -= gaps[: len(a)]
    saves[turned:] -= gaps[len(a) :]
    good = np.flatnonzero(saves >= LEAST)
    best = good[np.argsort(-saves[good], kind="stable")]
    return _Changes(kind[best], a[best], b[best], c[best], saves[best])


def _made(tour: _Tour, changes: _Changes) -> NDArray[np.bool_]:
    """Make changes where what they are about is still there; return the ends to be asked again."""
    mates = tour.mate
    asked = np.zeros(len(mates), bool)
    rows = zip(
        changes.kind.tolist(),
        *(each.tolist() for end in (changes.u, changes.v, changes.w) for each in (end, mates[end])),
        strict=True,
    )
    # Single numbers are read and written through views in a third of the time.
    mate, place, ask = mates.data, tour.place.data, asked.data
    for kind, u, a, v, b, w, c in rows:
        ask[u] = ask[v] = True
        at, first = place[u], place[v]
        if mate[u] != a or mate[v] != b or mate[w] != c or abs(at - first) > MOST_MOVED:
            continue
        if kind == TURN:
            if (at ^ first) & 1:
                continue
            tour.turn(at, first)
            _join(mate, ask, a, b)
        else:
            last = first + (1 - 2 * kind if first & 1 else 2 * kind - 1)
            if place[w] != last or first <= at <= last or last <= at <= first:
                continue
            tour.move(at, first, last)
            _join(mate, ask, w, a)
            _join(mate, ask, b, c)
        mate[u], mate[v] = v, u
    return asked


def _join(mate: memoryview, ask: memoryview, one: int, two: int) -> None:
    """Note that two ends are joined and are to be asked again; one of them may be nobody."""
    if one >= 0:
        mate[one] = two
        ask[one] = True
    if two >= 0:
        mate[two] = one
        ask[two] = True
