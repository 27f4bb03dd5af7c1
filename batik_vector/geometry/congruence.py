"""Which marks are moved copies of one another, so that work is done once for all of them.

Copies that stand on the grid are translates of one another to the bit. Fingerprints find the candidates.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps, runs

_MIX = tuple(np.uint64(k) for k in (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB))
"""Odd multipliers of a 64-bit mixer: Steele, Lea and Flood, "Fast splittable generators" (2014)."""


FEW = 400
"""Runs of rows that are told apart one by one."""


def distinct(values: NDArray[Any]) -> NDArray[Any]:
    """Return the values that occur in an array, each once and ascending; none may be "not a number".

    NumPy's own function looks whether any are masked, and for that imports what takes longer than a design
    that is compiled.
    """
    values = np.sort(values, axis=None)
    first = np.ones(len(values), bool)
    first[1:] = values[1:] != values[:-1]
    return values[first]


def alike(rows: Steps, offsets: Offsets | None = None) -> tuple[Index, Index]:
    """Return which runs of rows equal none before them, and for each run which of those it equals.

    Args:
        rows: shape (m, c), whole numbers.
        offsets: where each of the n runs begins, and at last where the last one ends; none is empty. None
            means that each row is a run.

    Returns:
        Shapes (k,), ascending, and (n,), numbers of the former. Fingerprints find the candidates, and each
        is compared with its first in full.
    """
    count = len(rows) if offsets is None else len(offsets) - 1
    if not count:
        return np.empty(0, np.intp), np.empty(0, np.intp)
    if count <= FEW:
        return _alike_few(rows, np.arange(count + 1) if offsets is None else offsets)
    prints = _fingerprints(rows, offsets)
    order = np.argsort(prints, kind="stable")
    begins = np.ones(len(order), bool)
    begins[1:] = prints[order][1:] != prints[order][:-1]
    first = np.empty(len(order), np.intp)
    first[order] = order[begins][np.cumsum(begins) - 1]
    again = np.flatnonzero(first != np.arange(len(first)))
    if len(again):
        other = again[~_equal(rows, offsets, again, first[again])]
        first[other] = other
    heads = np.flatnonzero(first == np.arange(len(first)))
    return heads, np.searchsorted(heads, first)


def _alike_few(rows: Steps, offsets: Offsets) -> tuple[Index, Index]:
    """Do the work of :func:`alike` in a dictionary, which is sooner done with few."""
    raw, width = np.ascontiguousarray(rows).tobytes(), rows.shape[1] * rows.itemsize
    ends = (offsets * width).tolist()
    first: dict[bytes, int] = {}
    at = first.setdefault
    numbers = [at(raw[ends[n] : ends[n + 1]], n) for n in range(len(ends) - 1)]
    heads = np.fromiter(first.values(), np.intp, len(first))
    return heads, np.searchsorted(heads, numbers)


def different(steps: Outlines) -> tuple[Index, Index, Steps]:
    """Return marks that equal none before them, which of those each mark is, and its lower left corner.

    Marks are alike when one is the other moved, wherever their rings begin. Raw outlines are compared first,
    so that only the different ones need their rings turned.
    """
    corner = steps.bounds()[:, :2]
    steps = replace(steps, points=steps.points - np.repeat(corner, steps.sizes(), axis=0))
    heads, number = alike(_rows(steps), _spans(steps))
    turned = _begun_low(steps.taken(heads))
    chosen, again = alike(_rows(turned), _spans(turned))
    return heads[chosen], again[number], corner


def same_points(a: Steps, b: Steps) -> NDArray[np.bool_]:
    """Return which rows are equal: column by column, since NumPy's loop along short rows is dear."""
    same = a[:, 0] == b[:, 0]
    for column in range(1, a.shape[1]):
        same &= a[:, column] == b[:, column]
    return np.asarray(same)


def _fingerprints(rows: Steps, offsets: Offsets | None) -> NDArray[np.uint64]:
    if offsets is None:
        mixed = np.zeros(len(rows), np.uint64)
    else:
        place = np.arange(len(rows)) - np.repeat(offsets[:-1], np.diff(offsets))
        mixed = place.astype(np.uint64) * _MIX[0]
    for column in rows.T:
        mixed ^= column.astype(np.uint64)
        mixed *= _MIX[1]
        mixed ^= mixed >> np.uint64(29)
    mixed *= _MIX[2]
    mixed ^= mixed >> np.uint64(32)
    return mixed if offsets is None else np.add.reduceat(mixed, offsets[:-1])


def _equal(rows: Steps, offsets: Offsets | None, a: Index, b: Index) -> NDArray[np.bool_]:
    """Return whether runs a[i] and b[i] are equal."""
    if offsets is None:
        return same_points(rows[a], rows[b])
    sizes = np.diff(offsets)
    same = np.asarray(sizes[a] == sizes[b])
    mine, ends = runs(offsets, a[same])
    if len(mine):
        equal = same_points(rows[mine], rows[runs(offsets, b[same])[0]])
        same[same] = np.logical_and.reduceat(equal, ends[:-1])
    return same


def _spans(steps: Outlines) -> Offsets:
    ends: Offsets = steps.rings[steps.marks]
    return ends


def _rows(steps: Outlines) -> Steps:
    """Return the points, with where a ring begins written into the lowest bit."""
    rows = steps.points.copy()
    rows[:, 0] *= 2
    rows[steps.rings[:-1], 0] += 1
    return rows


def _begun_low(steps: Outlines) -> Outlines:
    """Return the same rings, each begun at its leftmost, lowest point."""
    sizes = np.diff(steps.rings)
    key = (steps.points[:, 0] << 32) + steps.points[:, 1]
    least = np.repeat(np.minimum.reduceat(key, steps.rings[:-1]), sizes)
    ring = np.repeat(np.arange(len(sizes)), sizes)
    low = np.flatnonzero(key == least)
    _, first = np.unique(ring[low], return_index=True)
    begin = low[first] - steps.rings[:-1]
    place = np.arange(len(ring)) - steps.rings[ring]
    order = steps.rings[ring] + (place + begin[ring]) % sizes[ring]
    return Outlines(steps.points[order], steps.rings, steps.marks, steps.closed)
