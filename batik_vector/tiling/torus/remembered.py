"""Results remembered: what was made of the very same shapes before is not made again.

Who turns one knob, or sweeps over one key, compiles a hundred tiles in which most shapes are those of the
tile before, bit for bit. GEOS makes the same of the same, and so what it made is kept row by row: the union
of this group, what that cutter leaves of this mark. Shapes that are equal to the bit are one object here, and
what is made of them is known by these objects and by whatever else it hangs on, such as where they lie.

Nothing but geometries, which nobody can change, and plain values are kept. The work is counted each time as
it was the first: a recipe is refused everywhere or nowhere.
"""

from __future__ import annotations

import itertools
import threading
from collections import defaultdict
from collections.abc import Callable, Hashable, Sequence
from typing import Any, Generic, TypeAlias, TypeVar

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry import work

KEPT_BYTES = 64_000_000
"""About how much memory what is remembered may take up."""

KEPT_VERTICES = 200_000
"""Shapes of more vertices together are not remembered: they would drive out all others."""

PER_ENTRY, PER_VERTEX = 300, 16
"""About how many bytes an entry takes up with its key, and each vertex of a shape."""

HELD = 16
"""Entries that hold their shapes together. Python's collector looks through every tuple that holds a shape,
but not into arrays; and where one entry stays, the shapes of so many do."""

Made = TypeVar("Made")
Identities = NDArray[np.int64]


Entry: TypeAlias = tuple[Any, int, Any]
"""A value, about how many bytes it takes up, and what must live as long."""


class Memory:
    """Dictionaries of bounded size in two generations: what the younger one lacks is looked up in the older.

    When the younger one is half of all that may be kept it becomes the older one, and what nobody asked for
    meanwhile goes.
    """

    def __init__(self, most: int) -> None:
        self.most = most
        self._lock = threading.Lock()
        self.clear()

    def clear(self) -> None:
        """Forget everything."""
        self._young: defaultdict[Hashable, dict[Any, Entry]] = defaultdict(dict)
        self._old: defaultdict[Hashable, dict[Any, Entry]] = defaultdict(dict)
        self._held = 0

    def __len__(self) -> int:
        kinds = self._young.keys() | self._old.keys()
        return sum(len(self._young[kind].keys() | self._old[kind].keys()) for kind in kinds)

    def get(self, kind: Hashable, keys: Sequence[Any]) -> list[Any]:
        """Return what is kept under each of some keys, or None."""
        young, old = self._young[kind], self._old.get(kind, {})
        found: list[Any] = [each and each[0] for each in map(young.get, keys)]
        for number, each in enumerate(found) if old else ():
            if each is None and (entry := old.get(keys[number])) is not None:
                self._keep(kind, (keys[number],), (entry,))
                found[number] = entry[0]
        return found

    def keep(self, kind: Hashable, key: Any, value: Any, size: int, held: Any = None) -> None:
        """Keep a value, which is not None, of about so many bytes; and hold what its key stands for."""
        self._keep(kind, (key,), ((value, size + PER_ENTRY, held),))

    def keep_all(
        self,
        kind: Hashable,
        keys: Sequence[Any],
        values: Sequence[Any],
        sizes: Sequence[int],
        held: Any = None,
    ) -> None:
        """Keep several values, and hold what their keys stand for together."""
        entries = [(value, size + PER_ENTRY, held) for value, size in zip(values, sizes, strict=True)]
        self._keep(kind, keys, entries)

    def _keep(self, kind: Hashable, keys: Sequence[Any], entries: Sequence[Entry]) -> None:
        with self._lock:
            self._young[kind].update(zip(keys, entries, strict=True))
            self._held += sum(entry[1] for entry in entries)
            if self._held > self.most / 2:
                self._old, self._young, self._held = self._young, defaultdict(dict), 0


_memory = Memory(KEPT_BYTES)


def clear() -> None:
    """Forget everything."""
    _memory.clear()


def interned(shapes: Geometries) -> Geometries:
    """Return shapes, each as the one object that stands for all that equal it to the bit."""
    found = shapes.tolist()
    known = _memory.get("object", list(map(id, found)))
    fresh = [row for row, each in enumerate(known) if each is None]
    if not fresh:
        return shapes
    written = shapely.to_wkb(shapes[fresh]).tolist()
    new: dict[bytes, shapely.Geometry] = {}
    for row, key, shape in zip(fresh, written, _memory.get("shape", written), strict=True):
        # Of several that are equal the first is kept, and found by those that follow.
        found[row] = new.setdefault(key, found[row]) if shape is None else shape
    if new:
        fresh_shapes = list(new.values())
        _memory.keep_all("shape", list(new), fresh_shapes, [2 * len(key) for key in new])
        _memory.keep_all("object", list(map(id, fresh_shapes)), fresh_shapes, [0] * len(new))
    return as_array(found)


def identities(shapes: Geometries) -> Identities:
    """Return for each shape a number that stands for the object, as long as that is held."""
    return np.fromiter(map(id, shapes.tolist()), np.int64, len(shapes))


class Asked(Generic[Made]):
    """What is asked of some shapes, row by row, and what is known of it.

    Args:
        how: what is made of them, and all that it hangs on beside the rows.
        rows: whole numbers, shape (m, c): :func:`identities` of interned shapes, and all else that matters.
        shapes: those whose identities the rows have. They are held as long as what is made of them.
        ends: where each run of rows begins that is one question, and where the last ends; each row is one
            where left out.
    """

    def __init__(
        self,
        how: Hashable,
        rows: Identities,
        shapes: Sequence[Geometries],
        ends: NDArray[np.int64] | None = None,
    ) -> None:
        self._how, self._shapes, self._single = how, shapes, ends is None
        self._ends = list(range(len(rows) + 1)) if ends is None else ends.tolist()
        self.keeps = how is not None
        """Whether anything is known, and kept: not where ``how`` is None."""
        self.found: list[Made | None] = [None] * (len(self._ends) - 1)
        if self.keeps:
            raw, width = np.ascontiguousarray(rows).tobytes(), rows.shape[1] * rows.itemsize
            places = [end * width for end in self._ends]
            self._keys = [raw[first:last] for first, last in itertools.pairwise(places)]
            self.found = _memory.get(how, self._keys)

    def fresh(self, rows: Sequence[int] | None = None) -> list[int]:
        """Return which questions have no answer yet: of all, or of some."""
        return [row for row in (range(len(self.found)) if rows is None else rows) if self.found[row] is None]

    def keep(self, rows: Sequence[int], made: Sequence[Made], vertices: Sequence[int] | None = None) -> None:
        """Take up the answers to some questions: what was made, which has about so many vertices."""
        for row, each in zip(rows, made, strict=True):
            self.found[row] = each
        if not self.keeps:
            return
        sizes = [PER_VERTEX * each for each in vertices or [0] * len(rows)]
        for first in range(0, len(rows), HELD):
            part = slice(first, first + HELD)
            some = rows[part]
            keys, values = [self._keys[row] for row in some], [self.found[row] for row in some]
            _memory.keep_all(self._how, keys, values, sizes[part], self._of(some))

    @classmethod
    def together(cls, how: Hashable, rows: Identities, shapes: Sequence[Geometries]) -> Asked[Made]:
        """Ask one question of all rows."""
        return cls(how, rows, shapes, np.array([0, len(rows)]))

    def _of(self, rows: Sequence[int]) -> Geometries:
        """Return the shapes that some questions are about, in an array of their own."""
        if self._single:
            return np.concatenate([each[rows] for each in self._shapes])
        runs = [slice(self._ends[row], self._ends[row + 1]) for row in rows]
        return np.concatenate([each[run] for each in self._shapes for run in runs])

    def answers(self, make: Callable[[list[int]], Sequence[Made]] | None = None) -> list[Made]:
        """Return all answers; those that are not known yet are made."""
        fresh = self.fresh()
        if fresh and make is not None:
            self.keep(fresh, make(fresh))
        return self.found  # type: ignore[return-value]


def remembered(how: Hashable, shapes: Geometries, make: Callable[[], Geometries]) -> Geometries:
    """Return what is made of shapes all together, an array of one's own.

    Args:
        how: what is made of them, and all that it hangs on beside the shapes.
        shapes: what it is made of.
        make: makes it, and counts its work.

    Raises:
        TooLargeError: where the work comes to too much.
    """
    before = work.counted()
    if before is None or not len(shapes) or shapely.get_num_coordinates(shapes).sum() > KEPT_VERTICES:
        return make()
    try:
        hash(how)
    except TypeError:
        # What is built in Python may hold lists.
        return make()
    shapes = interned(shapes)
    asked = Asked[tuple[work.Share, list[shapely.Geometry]]].together(
        how, identities(shapes)[:, None], (shapes,)
    )
    (known,) = asked.found
    if known is not None:
        work.spend_again(known[0])
        return as_array(known[1])
    made = make()
    spent, vertices, crossings, pairs = np.subtract(work.counted() or before, before).tolist()
    size = int(shapely.get_num_coordinates(made).sum())
    if size <= KEPT_VERTICES:
        asked.keep([0], [((spent, vertices, crossings, pairs), made.tolist())], [size])
    return made


def as_array(found: Sequence[Any]) -> Geometries:
    """Return objects as an array."""
    made = np.empty(len(found), dtype=object)
    made[:] = found
    return made
