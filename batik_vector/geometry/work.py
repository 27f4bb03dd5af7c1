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
from typing import Any, TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.sampling import Array, Geometries, Indices

LIMIT = 20_000_000.0
"""What one compilation may do, in vertices that go through a union: about a millionth of a second each."""

PER_CROSSING = 15.0
"""What a crossing costs whose place is a vertex of the result: five where shapes are small, and twenty
where they have thousands of holes."""

PER_LOST_CROSSING = 0.05
"""What a crossing costs that lies inside a third shape: as areas are united most of them never come about."""

PER_SELF_CROSSING = 80.0
"""What a crossing of lines costs, by which a region is divided into faces."""

PER_CUTTER_VERTEX = 0.07
"""What a vertex costs of what cuts a mark, or of what a window cuts: most lie far from the cut."""

PER_PAIR, PER_PAIR_VERTEX = 3.0, 0.006
"""What it costs to find two shapes whose bounds meet and to ask whether they do, and each vertex of one."""

PER_BENT_VERTEX = 4.0
"""What a vertex costs of a motif that a layout bends: it is one of the many points that are tried."""

PER_TRACED_POINT, PER_TOLD_POINT = 0.6, 2.0
"""What a point costs that is tried on the image of a curve under a map, and one where the tolerance has to be
worked out at that place."""

PER_RELATED_VERTEX = 0.1
"""What a vertex costs of shapes that are asked whether their insides meet."""

PER_GROWN_VERTEX = 2.5
"""What a vertex costs of a shape that is grown."""

PER_MENDED_VERTEX, PER_ROUNDED_VERTEX = 12.0, 5.0
"""What a vertex costs that is mended or overlaid on the grid, and one that GEOS only rounds there."""

PER_CELL_CORNER = 30.0
"""What a corner costs of merged cells: their holes are laid into them, and asked whether they are sound."""

PER_DART = 15.0
"""What a dart of a toss costs, and each of its images."""

PER_PACKED = 4.0
"""What a place costs that is tried for a mark of a packing, and each of its images."""

BATCH = 200_000
"""Vertices of the overlays that are done at one go; what they have cost is counted after each."""

MAX_PAIRS = 10_000_000
"""Pairs of shapes whose bounds meet: they are held in memory all at once."""

SMALL, FEW = 20_000, 500
"""Vertices of shapes, and of lines that cross themselves, whose crossings are not worth counting."""

SAMPLED = 96
"""Edges, or shapes, that are asked how often others cross them."""

ASKED = 24
"""Areas about a crossing, about, that are asked whether it lies in them."""

SAMPLED_VERTICES = 100_000
"""Vertices of the pairs of shapes that are asked for their crossings, about."""


class _Account:
    """What was spent, and on how many vertices, crossings and pairs."""

    def __init__(self) -> None:
        self.spent = self.vertices = self.crossings = self.pairs = 0.0

    def take(self, cost: float, vertices: float = 0.0, crossings: float = 0.0, pairs: float = 0.0) -> None:
        self.vertices += vertices
        self.crossings += crossings
        self.pairs += pairs
        self.spent += cost
        if self.spent > LIMIT:
            counted = (("cross", self.crossings), ("meet", self.pairs))
            often = " and ".join(f"{do} about {_about(times)} times" for do, times in counted if times >= 1)
            raise TooLargeError(
                f"shapes of about {_about(self.vertices)} vertices{' that ' if often else ''}{often} to "
                "bend or overlay, more than fits: expected fewer or smaller ones, fewer contours, "
                "or a larger tile"
            )


_open: contextvars.ContextVar[_Account | None] = contextvars.ContextVar("open", default=None)


@contextlib.contextmanager
def account() -> Iterator[None]:
    """Count all work inside together; what is in no account is counted by itself."""
    if _open.get() is not None:
        yield
        return
    token = _open.set(_Account())
    try:
        yield
    finally:
        _open.reset(token)


Share: TypeAlias = tuple[float, float, float, float]
"""What was spent, and on how many vertices, crossings and pairs."""


def counted() -> Share | None:
    """Return what has been counted so far, or None where no account is open."""
    now = _open.get()
    return None if now is None else (now.spent, now.vertices, now.crossings, now.pairs)


def spend_again(share: Share) -> None:
    """Take up work that was done before, as :func:`spend` does: its result is known."""
    (_open.get() or _Account()).take(*share)


def spend(
    vertices: float, crossings: float = 0.0, *, per_vertex: float = 1.0, per_crossing: float = PER_CROSSING
) -> None:
    """Take up work that is about to be done, or has been.

    Args:
        vertices: that go through an overlay.
        crossings: of their edges.
        per_vertex, per_crossing: what each costs, in vertices that go through a union.

    Raises:
        TooLargeError: where all work comes to more than ``LIMIT``, with the counts.
    """
    cost = per_vertex * vertices + per_crossing * crossings
    (_open.get() or _Account()).take(cost, vertices, crossings)


def foretell(vertices: float, crossings: float, lost: float = 0, per_crossing: float = PER_CROSSING) -> None:
    """Raise where work that is going to be taken up step by step would come to more than ``LIMIT``.

    Args:
        vertices, crossings, per_crossing: as for :func:`spend`, counted on a sample.
        lost: crossings that will lie inside a third shape.
    """
    ahead, now = _Account(), _open.get() or _Account()
    ahead.take(now.spent, now.vertices, now.crossings, now.pairs)
    ahead.take(vertices + per_crossing * crossings + PER_LOST_CROSSING * lost, vertices, crossings + lost)


def spend_on_union(given: Geometries, made: Geometries, *, per_crossing: float = PER_CROSSING) -> int:
    """Take up the work of overlays that are done, with the crossings that came about; return how many."""
    count, out = (int(shapely.get_num_coordinates(each).sum()) for each in (given, made))
    crossings = _come_about(given, made) if max(count, out) > SMALL else 0
    spend(count, crossings, per_crossing=per_crossing)
    return crossings


def spend_on_cuts(marks: Geometries, away: Geometries, left: Geometries) -> None:
    """Take up the work of cutting marks that is done, each by what was taken away from it."""
    before, cutting, after = (float(shapely.get_num_coordinates(each).sum()) for each in (marks, away, left))
    spend(cutting, per_vertex=PER_CUTTER_VERTEX)
    more = max(after - before, 0.0)
    # Most vertices of many holes are those of what was cut out, and no crossings.
    crossings = min(more, _come_about(np.concatenate([marks, away]), left, 0)) if more > SMALL else more
    spend(before + more - crossings, crossings)


def spend_on_pairs(count: int) -> None:
    """Take up the work of looking at pairs of shapes whose bounds meet."""
    (_open.get() or _Account()).take(PER_PAIR * count, pairs=count)


def spend_on_asking(shapes: Geometries, asked: Indices, per_vertex: float = PER_PAIR_VERTEX) -> None:
    """Take up the work of asking shapes, given by their numbers, how they lie to others."""
    vertices = float(shapely.get_num_coordinates(shapes[asked]).sum())
    (_open.get() or _Account()).take(per_vertex * vertices)


def spend_on_cells(corners: int) -> None:
    """Take up the work of merging cells whose outlines have so many corners.

    Raises:
        TooLargeError: as :func:`spend`.
    """
    spend(corners, per_vertex=PER_CELL_CORNER)


def spend_on_darts(count: int) -> None:
    """Take up the work of throwing darts, images under the symmetry counted."""
    (_open.get() or _Account()).take(PER_DART * count)


def batches(sizes: NDArray[np.int64], most: int = BATCH) -> Iterator[slice]:
    """Yield runs of rows of at most so many vertices together; a row of more is a run by itself."""
    total = np.cumsum(sizes)
    first, before = 0, 0
    while first < len(sizes):
        end = max(int(np.searchsorted(total, before + most, side="right")), first + 1)
        yield slice(first, end)
        first, before = end, int(total[end - 1])


def _come_about(given: Geometries, made: Geometries, least: int | None = None) -> int:
    """Return about how many vertices of results were none before: what is given lies on whole steps mostly,
    and crossings do not. There are no fewer than ``least``, by how many they have become more if left out.
    """
    more = int(shapely.get_num_coordinates(made).sum()) - int(shapely.get_num_coordinates(given).sum())
    return max(_between_steps(made) - _between_steps(given), more if least is None else least, 0)


def _between_steps(shapes: Geometries) -> int:
    xy = shapely.get_coordinates(shapes)
    return int(np.count_nonzero((np.rint(xy) != xy).any(axis=1)))


def foretell_union(groups: Sequence[Geometries]) -> None:
    """Look ahead at the work of uniting each of several groups of areas.

    Raises:
        TooLargeError: as :func:`spend`.
    """
    areas = np.concatenate([np.empty(0, dtype=object), *groups])
    group = np.repeat(np.arange(len(groups)), [len(each) for each in groups])
    vertices = shapely.get_num_coordinates(areas)
    total = float(vertices.sum())
    if total < SMALL:
        return
    # Of many groups some stand for all.
    asked = np.isin(group, _some(len(groups), SAMPLED // 8))
    share = total / max(float(vertices[asked].sum()), 1.0)
    left, lost = _crossings(areas[asked], group[asked])
    foretell(total, left * share, lost * share)


def spend_on_lines(lines: Geometries, *, each: bool = False) -> None:
    """Take up the work of noding lines together, or each by itself.

    Raises:
        TooLargeError: as :func:`spend`.
    """
    count = int(shapely.get_num_coordinates(lines).sum())
    spend(count, self_crossings(lines, each=each) if count > FEW else 0.0, per_crossing=PER_SELF_CROSSING)


def spend_on_growth(shapes: Geometries, reach: float, close: float | None = None) -> None:
    """Take up the work of growing shapes, whose new outlines cross where strands lie nearer than both reach.

    Args:
        shapes: areas and lines.
        reach: how far they are grown, in their unit.
        close: what :func:`close_strands` found, where that is known.

    Raises:
        TooLargeError: as :func:`spend`.
    """
    count = int(shapely.get_num_coordinates(shapes).sum())
    spend(count, close_strands(shapes, reach) if close is None else close, per_vertex=PER_GROWN_VERTEX)


def close_strands(shapes: Geometries, reach: float) -> float:
    """Return about how often vertices come near others of their shape that lie far off along the outline.

    Of few it is not asked.
    """
    reach = abs(reach)
    if not reach or shapely.get_num_coordinates(shapes).sum() <= FEW:
        return 0.0
    xy, shape = shapely.get_coordinates(shapes, return_index=True)
    step = np.hypot(*np.diff(xy, axis=0, prepend=xy[:1]).T)
    step[np.append(True, shape[1:] != shape[:-1])] = 0.0
    along = np.cumsum(step)
    spacing = along[-1] / len(xy)
    if not spacing:
        return 0.0
    close = 0
    for one in _some(len(xy), SAMPLED):
        first, stop = np.searchsorted(shape, (shape[one], shape[one] + 1))
        near = np.hypot(*(xy[first:stop] - xy[one]).T) < 2 * reach
        close += int(np.count_nonzero(near & (np.abs(along[first:stop] - along[one]) > 4 * reach)))
    # Strands side by side are close all along, and their outlines cross once in a while.
    share = 1.0 if 2 * spacing >= reach else 2 * spacing / reach
    return float(close * len(xy) / min(len(xy), SAMPLED) / 2 * share)


def refuse_pairs(tree: shapely.STRtree, boxes: Geometries, within: float = 0.0) -> None:
    """Raise where far more shapes meet than can be looked at.

    Args:
        tree: of the bounds of some shapes.
        boxes: bounds of others.
        within: how far apart two are that count as meeting; if 0, their bounds must meet.

    Raises:
        TooLargeError: with how many pairs there would be, about.
    """
    if len(tree) * len(boxes) <= MAX_PAIRS:
        return
    asked = _some(len(boxes), 8 * SAMPLED)
    near: dict[str, Any] = {"predicate": "dwithin", "distance": within} if within else {}
    pairs = tree.query(boxes[asked], **near).shape[1] * len(boxes) / len(asked)
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


def _crossings(areas: Geometries, group: Indices) -> tuple[float, float]:
    """Return about how often the outlines of areas cross those of others in their group.

    The first number is of crossings on the outline of all together, the second of those inside a third area.
    """
    asked = _some(len(areas), SAMPLED)
    tree = shapely.STRtree(areas)
    mine, other = tree.query(areas[asked])
    mine = asked[mine]
    met = (mine != other) & (group[mine] == group[other])
    mine, other = mine[met], other[met]
    if not len(mine):
        return 0.0, 0.0
    vertices = shapely.get_num_coordinates(areas)
    each = float((vertices[mine] + vertices[other]).mean())
    pairs = _some(len(mine), min(4 * SAMPLED, max(4, int(SAMPLED_VERTICES / each))))
    crossed = shapely.intersection(
        shapely.boundary(areas[mine[pairs]]), shapely.boundary(areas[other[pairs]])
    )
    share = len(mine) / len(pairs) * len(areas) / len(asked) / 2
    # Stretches that two outlines share dissolve, and add nothing to what goes in.
    points, pair = shapely.get_parts(crossed, return_index=True)
    there = shapely.get_type_id(points) == shapely.GeometryType.POINT
    points, pair = points[there], pair[there]
    some = _some(len(points), SAMPLED)
    at, over = _covers(tree, points[some])
    of = pairs[pair[some]][at]
    third = (over != mine[of]) & (over != other[of]) & (group[over] == group[mine[of]])
    inside = np.bincount(at[third], minlength=len(some)) > 0
    left = len(points) * float((~inside).mean()) if len(some) else 0.0
    return left * share, (len(points) - left) * share


def _covers(tree: shapely.STRtree, points: Geometries) -> tuple[Indices, Indices]:
    """Return points, by their numbers, and areas that hold them; of many about a point some are asked."""
    at, over = tree.query(points)
    count = np.bincount(at, minlength=len(points))
    place = np.arange(len(at)) - np.repeat(np.cumsum(count) - count, count)
    asked = place * ASKED % np.maximum(count[at], 1) < ASKED
    at, over = at[asked], over[asked]
    held = shapely.within(points[at], tree.geometries[over])
    return at[held], over[held]


def _some(count: int, most: int) -> Indices:
    """Return the numbers of some of ``count`` things, evenly spaced."""
    places = np.linspace(0, count - 1, min(count, most)).astype(np.intp)
    return places[np.diff(places, prepend=-1) > 0]


def _about(count: float) -> str:
    """Return a count in two figures."""
    size = 10.0 ** max(math.floor(math.log10(max(count, 1))) - 1, 0)
    return f"{round(count / size) * size:,.0f}"
