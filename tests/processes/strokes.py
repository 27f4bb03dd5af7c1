"""Strokes to order, and what is true of an order."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines

Place = tuple[int, int]


def strokes(*parts: tuple[bool, Sequence[Place]]) -> Outlines:
    """Strokes from (closed, points), in µm."""
    sizes = [len(points) for _, points in parts]
    return Outlines(
        np.array([place for _, points in parts for place in points], np.int64).reshape(-1, 2),
        np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
        np.arange(len(parts) + 1),
        np.array([closed for closed, _ in parts], bool),
        [f"s{number}" for number in range(len(parts))],
    )


def box(x: int, y: int, side: int) -> tuple[bool, list[Place]]:
    """A closed square about a middle."""
    half = side // 2
    return True, [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]


def line(*points: Place) -> tuple[bool, list[Place]]:
    return False, list(points)


def random_lines(count: int, seed: int, reach: float = 0.3) -> Outlines:
    """Short lines all over a square metre: ``reach`` is their length as a share of their spacing, about."""
    draw = np.random.default_rng(seed)
    begin = draw.integers(0, 1_000_000, (count, 2))
    step = draw.normal(size=(count, 2)) * (reach * 1_000_000 / count**0.5)
    ends = np.stack([begin, begin + np.rint(step).astype(np.int64)], axis=1)
    return strokes(*(line(*map(tuple, pair)) for pair in ends.tolist()))


def parts_of(drawn: Outlines) -> list[list[Place]]:
    """The points of each stroke."""
    if not len(drawn):
        return []
    cut = np.split(drawn.points, drawn.rings[1:-1])
    return [[(int(x), int(y)) for x, y in part.tolist()] for part in cut]


def alike(drawn: Outlines) -> list[tuple[bool, tuple[Place, ...], str]]:
    """The strokes whatever their order, closed ones from their least point on, others from the lesser end."""
    found = []
    for number, points in enumerate(parts_of(drawn)):
        closed = bool(drawn.closed[number])
        turns = [points[k:] + points[:k] for k in range(len(points))] if closed else [points, points[::-1]]
        found.append((closed, tuple(min(turns)), drawn.names[number] if len(drawn.names) else ""))
    return sorted(found)


def spanning_tree(ends: NDArray[np.int64]) -> float:
    """The length of the shortest tree that joins strokes, each given by its two ends, by Prim: (n, 2, 2).

    No way through all strokes can have shorter ways between them.
    """
    count = len(ends)
    best, total = np.full(count, np.inf), 0.0
    left: NDArray[np.bool_] = np.ones(count, bool)
    at = 0
    for _ in range(count - 1):
        left[at] = False
        apart = ends[:, :, None].astype(float) - ends[at][None, None].astype(float)
        best = np.minimum(best, np.sqrt((apart**2).sum(axis=-1)).min(axis=(1, 2)))
        at = int(np.where(left, best, np.inf).argmin())
        total += float(best[at])
    return total


def valid(order: Index, count: int) -> bool:
    """Whether an order passes each stroke once, in at one end and out at the other."""
    return sorted(order.tolist()) == list(range(2 * count)) and bool((order[::2] ^ 1 == order[1::2]).all())
