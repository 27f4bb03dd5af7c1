"""Sampling by error: how many vertices a curve, or the image of an edge, needs to keep a tolerance.

Two steps do all of it, each in bulk over any number of pieces at once:

* :func:`refine` bisects pieces where their chord still stands off the true curve, until a fine
  tolerance holds: a dense polyline that knows where the curve bends;
* :func:`thin` keeps of a dense polyline the vertices that a coarser tolerance needs, spaced by the
  curve's bending. A chord over an arc of curvature κ and length s stands off by κs²/8, so
  ∫ √(κ/8ε) ds vertices are needed and their density along the arc is the integrand.

The tolerance is split between the two: ``REFINE_SHARE`` of it to the first, the rest to the second.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError, TooLargeError

Array: TypeAlias = NDArray[np.float64]
Points: TypeAlias = NDArray[np.float64]
"""Shape (n, 2), y up."""
Indices: TypeAlias = NDArray[np.intp]
Geometries: TypeAlias = NDArray[np.object_]
"""Shape (n,): shapely geometries."""

REFINE_SHARE = 1 / 48
"""Share of the tolerance spent on the dense polyline: it then has √48 ≈ 7 vertices for each one kept, so
that choosing among them loses little against placing vertices freely."""

CORNER_TURN = 0.45
"""A turn sharper than this (radians) between dense edges is a corner and always kept. Smooth curves
refined as above turn by less, unless their radius is below twice the tolerance."""

PROBES = np.array([0.2113, 0.5, 0.7887])
"""Where inside a piece its deviation is measured: the middle, and the two Gauss points, at which an
S-shaped piece that crosses its chord in the middle stands off the most."""

MAX_ROUNDS = 64
MAX_POINTS = 6_000_000


def deviation(points: Points, start: Points, end: Points) -> Array:
    """Return each point's distance to the segment from ``start`` to ``end``.

    Args:
        points: shape (n, 2), or (k, n, 2) for k points to each segment.
        start, end: shape (n, 2).
    """
    along = end - start
    away = points - start
    square = np.einsum("ij,ij->i", along, along)
    part = np.einsum("...j,...j->...", away, along)
    # A segment of no length is its start.
    part = np.divide(part, square, out=np.zeros_like(part), where=square > 0)
    away -= along * np.minimum(np.maximum(part, 0.0), 1.0)[..., None]
    return np.asarray(np.hypot(away[..., 0], away[..., 1]))


def refine(
    evaluate: Callable[[Indices, Array], Points],
    piece: Indices,
    start: Array,
    end: Array,
    tolerance: float | Callable[[Points], Array],
) -> tuple[Indices, Array]:
    """Bisect pieces of curves until every chord is within the tolerance of its curve.

    Args:
        evaluate: ``evaluate(piece, t)`` returns the points, shape (n, 2), of the curve pieces at ``t``.
        piece, start, end: the initial pieces in drawing order, shape (k,): which curve, from which
            parameter to which.
        tolerance: in the units of the points; or a function of points where it varies over the plane.

    Returns:
        ``(piece, t)``: the start of every final piece, in drawing order.

    Raises:
        GeometryError: where the curve is not finite.
        TooLargeError: where the curve would need more than ``MAX_POINTS`` vertices.
    """
    piece, t0, t1 = np.asarray(piece, np.intp), np.asarray(start, float), np.asarray(end, float)
    open_ = np.ones(len(piece), bool)
    for _ in range(MAX_ROUNDS):
        todo = np.flatnonzero(open_)
        if not len(todo):
            break
        parts = _pieces_needed(evaluate, piece[todo], t0[todo], t1[todo], tolerance)
        open_[todo] = parts > 1
        counts = np.ones(len(piece), np.intp)
        counts[todo] = parts
        if counts.sum() > MAX_POINTS:
            raise TooLargeError(f"a curve would need more than {MAX_POINTS:,} vertices at this tolerance")
        piece, t0, t1, open_ = _split(piece, t0, t1, open_, counts)
    return piece, t0


def _pieces_needed(
    evaluate: Callable[[Indices, Array], Points],
    piece: Indices,
    t0: Array,
    t1: Array,
    tolerance: float | Callable[[Points], Array],
) -> Indices:
    """Return into how many parts to cut each piece: 1 where it is within the tolerance."""
    span, count = t1 - t0, len(piece)
    # Most pieces end where the next one starts.
    alone = np.append((piece[1:] != piece[:-1]) | (t0[1:] != t1[:-1]), True)
    t = np.concatenate([t0, *(t0 + span * probe for probe in PROBES), t1[alone]])
    points = evaluate(np.concatenate([*[piece] * (1 + len(PROBES)), piece[alone]]), t)
    a, last = points[:count], points[(1 + len(PROBES)) * count :]
    probes = points[count : (1 + len(PROBES)) * count].reshape(len(PROBES), count, 2)
    b = np.empty_like(a)
    b[:-1], b[alone] = a[1:], last
    if not np.isfinite(probes).all():
        raise GeometryError("the curve is not finite everywhere: it runs through a pole")
    worst = deviation(probes, a, b).max(axis=0)
    allowed = tolerance((a + b) / 2) if callable(tolerance) else tolerance
    # Parameters that no float lies between cannot be split further.
    middle = t0 + span / 2
    splittable = (middle > t0) & (middle < t1)
    return np.where(
        (worst > allowed) & splittable, np.clip(np.ceil(np.sqrt(worst / allowed) * 0.8), 2, 8), 1
    ).astype(np.intp)


def _split(
    piece: Indices, t0: Array, t1: Array, open_: NDArray[np.bool_], counts: Indices
) -> tuple[Indices, Array, Array, NDArray[np.bool_]]:
    """Cut each piece into its count of equal parts, keeping the order."""
    owner = np.repeat(np.arange(len(piece)), counts)
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    step = (t1 - t0) / counts
    start = t0[owner] + step[owner] * rank
    last = rank == counts[owner] - 1
    end = np.where(last, t1[owner], t0[owner] + step[owner] * (rank + 1))
    return piece[owner], start, end, open_[owner]


def thin(
    points: Points, offsets: Indices, tolerance: float, keep: NDArray[np.bool_] | None = None
) -> NDArray[np.bool_]:
    """Choose the vertices of dense polylines that a tolerance needs.

    Args:
        points: shape (n, 2), the polylines one after another; a ring repeats its first point at its end.
        offsets: shape (k + 1,): polyline i is ``points[offsets[i]:offsets[i + 1]]``.
        tolerance: how far a vertex left out may stand from the chord that passes it.
        keep: vertices that must stay, beside the ends and the corners, which always do.

    Returns:
        A mask of the vertices kept, shape (n,).
    """
    n = len(points)
    if n < 3:
        return np.ones(n, bool)
    fixed = np.zeros(n, bool) if keep is None else keep.copy()
    fixed[offsets[:-1]] = True
    fixed[offsets[1:] - 1] = True
    step = np.diff(points, axis=0)
    length = np.hypot(step[:, 0], step[:, 1])
    turn = np.abs(
        np.arctan2(
            step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0],
            np.einsum("ij,ij->i", step[:-1], step[1:]),
        )
    )
    fixed[1:-1] |= turn > CORNER_TURN
    need = np.zeros(n)
    need[1:-1] = np.sqrt(turn * (length[:-1] + length[1:]) / (16 * tolerance))
    need[fixed] = 0.0
    chosen = fixed | _spaced(need, fixed)
    return _mend(points, chosen, tolerance)


def _spaced(need: Array, fixed: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Space vertices between fixed ones evenly in the integral of ``need``, rounded up to whole chords."""
    total = np.cumsum(need)
    ends = np.flatnonzero(fixed)
    span = np.cumsum(fixed) - 1
    before = total[ends]
    width = np.diff(before, append=total[-1])
    chords = np.maximum(np.ceil(width * 1.04), 1)
    wide = width[span]
    share = np.divide(total - before[span], wide, out=np.zeros_like(wide), where=wide > 0)
    bucket = np.minimum(np.floor(share * chords[span] + 1e-9), chords[span] - 1)
    crossing = np.zeros(len(need), bool)
    crossing[1:] = (bucket[1:] > bucket[:-1]) & (span[1:] == span[:-1])
    return crossing


def _mend(points: Points, chosen: NDArray[np.bool_], tolerance: float) -> NDArray[np.bool_]:
    """Add the worst vertex of every chord that passes one farther off than the tolerance, until none does."""
    chosen = chosen.copy()
    skipped = np.flatnonzero(~chosen)
    for _ in range(MAX_ROUNDS):
        if not len(skipped):
            break
        at = np.flatnonzero(chosen)
        own = np.searchsorted(at, skipped) - 1
        off = deviation(points[skipped], points[at[own]], points[at[own + 1]])
        worst = np.zeros(len(at))
        np.maximum.at(worst, own, off)
        bad = (off > tolerance) & (off == worst[own])
        if not bad.any():
            break
        # Of several vertices equally far off, the first is enough.
        first = np.r_[True, own[bad][1:] != own[bad][:-1]]
        chosen[skipped[bad][first]] = True
        # Chords that pass nothing too far off stay as they are.
        again = np.zeros(len(at), bool)
        again[own[bad]] = True
        skipped = skipped[again[own]]
        skipped = skipped[~chosen[skipped]]
    return chosen
