"""Work foretold: what overlays will cost, counted before they are made and refused past a limit.

What an overlay costs hangs on the vertices that go in and on the places where edges cross, and these can be
far more than the vertices: a thousand random chords cross a quarter of a million times. Crossings are counted
on some of the edges or shapes, always the same, so that a recipe is refused everywhere or nowhere.
"""

from __future__ import annotations

import contextlib
import contextvars
import math
from collections.abc import Iterator, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.sampling import Array, Geometries, Indices

LIMIT = 20_000_000.0
"""What one compilation may do. What is counted goes through several overlays of one recipe, and most of it
through fast ones: a recipe at half of the limit takes some ten seconds, others at it a minute."""

PER_CROSSING, PER_SELF_CROSSING = 0.05, 80.0
"""What a crossing of two areas, and one of lines, costs in vertices that go through a union: areas that lie
over one another dissolve as they are united, and lines do not."""

MAX_PAIRS = 10_000_000
"""Pairs of shapes whose bounds meet: they are held in memory all at once."""

SMALL, FEW = 20_000, 500
"""Vertices of shapes, and of lines that cross themselves, whose crossings are not worth counting."""

SAMPLED = 96
"""Edges, or shapes, that are asked how often others cross them."""

SAMPLED_VERTICES = 100_000
"""Vertices of the pairs of shapes that are asked for their crossings, about."""

_spent: contextvars.ContextVar[list[float] | None] = contextvars.ContextVar("spent", default=None)


@contextlib.contextmanager
def account() -> Iterator[None]:
    """Count all work inside together; what is in no account is counted by itself."""
    token = _spent.set([0.0])
    try:
        yield
    finally:
        _spent.reset(token)


def spend(vertices: float, crossings: float = 0.0, each: float = PER_CROSSING) -> None:
    """Take up work that is about to be done.

    Args:
        vertices: that go through an overlay.
        crossings: of their edges.
        each: what a crossing costs, in vertices.

    Raises:
        TooLargeError: where all work comes to more than ``LIMIT``, with the counts.
    """
    spent = _spent.get()
    spent = [0.0] if spent is None else spent
    spent[0] += vertices + each * crossings
    if spent[0] > LIMIT:
        crossing = f" that cross about {_about(crossings)} times" if crossings >= 1 else ""
        raise TooLargeError(
            f"shapes of about {_about(vertices)} vertices{crossing} to overlay, more than fits: "
            "expected fewer or smaller ones, fewer contours, or a larger tile"
        )


def spend_on_shapes(groups: Sequence[Geometries]) -> None:
    """Take up the work of uniting each of several groups of areas.

    Raises:
        TooLargeError: as :func:`spend`.
    """
    areas = np.concatenate([np.empty(0, dtype=object), *groups])
    group = np.repeat(np.arange(len(groups)), [len(each) for each in groups])
    vertices = shapely.get_num_coordinates(areas)
    total = float(vertices.sum())
    if total < SMALL:
        spend(total)
        return
    # Of many groups some stand for all.
    asked = np.isin(group, _some(len(groups), SAMPLED // 8))
    share = total / max(float(vertices[asked].sum()), 1.0)
    spend(total, _crossings(areas[asked], group[asked]) * share)


def spend_on_lines(lines: Geometries, *, each: bool = False) -> None:
    """Take up the work of noding lines together, or each by itself.

    Raises:
        TooLargeError: as :func:`spend`.
    """
    count = int(shapely.get_num_coordinates(lines).sum())
    spend(count, self_crossings(lines, each=each) if count > FEW else 0.0, PER_SELF_CROSSING)


def refuse_pairs(tree: shapely.STRtree, boxes: Geometries) -> None:
    """Raise where far more shapes meet than can be looked at.

    Args:
        tree: of the bounds of some shapes.
        boxes: bounds of others.

    Raises:
        TooLargeError: with how many pairs there would be, about.
    """
    if len(tree) * len(boxes) <= MAX_PAIRS:
        return
    asked = _some(len(boxes), 8 * SAMPLED)
    pairs = tree.query(boxes[asked]).shape[1] * len(boxes) / len(asked)
    if pairs > MAX_PAIRS:
        raise TooLargeError(
            f"{len(boxes):,} shapes meet about {_about(pairs)} times, past the limit of {MAX_PAIRS:,}: "
            "expected fewer or smaller ones, or a larger tile"
        )


def self_crossings(lines: Geometries, *, each: bool = False) -> float:
    """Return about how often lines cross themselves, and one another if not looked at each by itself."""
    xy, line = shapely.get_coordinates(lines, return_index=True)
    edges = np.flatnonzero(line[1:] == line[:-1])
    if len(edges) < 2:
        return 0.0
    asked = edges[_some(len(edges), SAMPLED)]
    crossed = 0
    for part in np.array_split(edges, 1 + len(edges) * SAMPLED // 2_000_000):
        found = _crossing(xy[asked], xy[asked + 1], xy[part], xy[part + 1])
        if each:
            found &= line[asked][:, None] == line[part]
        crossed += int(found.sum())
    return crossed * len(edges) / len(asked) / 2


def _crossing(a: Array, b: Array, c: Array, d: Array) -> NDArray[np.bool_]:
    """Return which edges from a to b, one a row, cross which from c to d, in the inside of both."""
    a, b, c, d = a[:, None], b[:, None], c[None], d[None]
    across = _side(a, b, c) * _side(a, b, d) < 0
    return np.asarray(across & (_side(c, d, a) * _side(c, d, b) < 0))


def _side(p: Array, q: Array, r: Array) -> Array:
    found: NDArray[np.float64] = (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1])
    found -= (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])
    return found


def _crossings(areas: Geometries, group: Indices) -> float:
    """Return about how often the outlines of areas cross those of others in their group."""
    asked = _some(len(areas), SAMPLED)
    mine, other = shapely.STRtree(areas).query(areas[asked])
    mine = asked[mine]
    met = (mine != other) & (group[mine] == group[other])
    mine, other = mine[met], other[met]
    if not len(mine):
        return 0.0
    vertices = shapely.get_num_coordinates(areas)
    each = float((vertices[mine] + vertices[other]).mean())
    pairs = _some(len(mine), min(4 * SAMPLED, max(4, int(SAMPLED_VERTICES / each))))
    crossed = shapely.intersection(
        shapely.boundary(areas[mine[pairs]]), shapely.boundary(areas[other[pairs]])
    )
    share = len(mine) / len(pairs) * len(areas) / len(asked) / 2
    # Stretches that two outlines share dissolve, and add nothing to what goes in.
    points = int((shapely.get_type_id(shapely.get_parts(crossed)) == shapely.GeometryType.POINT).sum())
    return points * share


def _some(count: int, most: int) -> Indices:
    """Return the numbers of some of ``count`` things, evenly spaced."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).astype(np.intp))


def _about(count: float) -> str:
    """Return a count in two figures."""
    size = 10.0 ** max(math.floor(math.log10(max(count, 1))) - 1, 0)
    return f"{round(count / size) * size:,.0f}"
