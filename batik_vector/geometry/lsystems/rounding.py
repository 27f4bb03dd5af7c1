"""Corners rounded: strands as outlines of lines and arcs, or as polylines that keep to a tolerance."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.lsystems.turtle import Complex
from batik_vector.geometry.paths.outline import CONTROL, CURVE, LINE, MOVE, Outline
from batik_vector.geometry.sampling import Array, Indices

CLOSE = 1e-9
"""Ends of a strand this near to one another, as a share of its size, are one point."""

BACK = 3.1
"""Turns of more (radians) run back on themselves: nothing is left to round."""


def closed_strands(points: Complex, offsets: Indices) -> NDArray[np.bool_]:
    """Return which strands end where they begin."""
    size = max(float(np.ptp(points.real)), float(np.ptp(points.imag)))
    gap = np.abs(points[offsets[1:] - 1] - points[offsets[:-1]])
    return np.asarray((gap <= CLOSE * size) & (np.diff(offsets) > 3))


def outlined(points: Complex, offsets: Indices, share: float) -> Outline:
    """Return strands as an outline, their corners rounded by arcs that take ``share`` of each edge's half.

    An edge of more than a step counts as one: long ones stay straight in their middle.
    """
    closed = closed_strands(points, offsets)
    points, _, offsets = _opened(points, np.ones(len(points)), offsets, closed, share)
    begin, end, handle, inner = _corners(points, offsets, share)
    points = _from_middle(points, offsets, closed, share)
    if not share:
        kinds = np.full(len(points), LINE, np.uint8)
        kinds[offsets[:-1]] = MOVE
        return Outline(np.column_stack([points.real, points.imag]), kinds, closed)
    size = np.where(inner, 4, 1)
    first = np.cumsum(size) - size
    z = np.empty(int(size.sum()), complex)
    kinds = np.full(len(z), LINE, np.uint8)
    z[first[~inner]] = points[~inner]
    kinds[first[offsets[:-1]]] = MOVE
    for place, (value, kind) in enumerate(
        ((begin, LINE), (begin + handle[0], CONTROL), (end - handle[1], CONTROL), (end, CURVE))
    ):
        z[first[inner] + place] = value[inner]
        kinds[first[inner] + place] = kind
    return Outline(np.column_stack([z.real, z.imag]), kinds, closed)


def sampled(
    points: Complex, offsets: Indices, widths: Array, share: float, tolerance: float
) -> tuple[Complex, Indices, Array]:
    """Return strands as polylines with their widths, corners rounded as :func:`outlined` has them."""
    closed = closed_strands(points, offsets)
    points, widths, offsets = _opened(points, widths, offsets, closed, share)
    begin, end, handle, inner = _corners(points, offsets, share)
    if not share:
        return points, offsets, widths
    ends = np.concatenate([offsets[:-1], offsets[1:] - 1])
    begin[ends] = end[ends] = _from_middle(points, offsets, closed, share)[ends]
    turn = np.abs(np.angle((end - points) / np.where(inner, points - begin, 1)))
    cut = np.abs(points - begin)
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = cut / np.tan(turn / 2)
        step = 2 * np.arccos(np.clip(1 - tolerance / radius, -1, 1))
        pieces = np.where(inner & (turn > 1e-6), np.ceil(turn / np.maximum(step, 0.02)), 1)
    pieces = np.where(inner, np.clip(pieces, 1, 64), 0).astype(np.intp)
    owner = np.repeat(np.arange(len(points)), pieces + 1)
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(pieces + 1) - pieces - 1, pieces + 1)
    t = rank / np.maximum(pieces[owner], 1)
    p = [each[owner] for each in (begin, begin + handle[0], end - handle[1], end)]
    z = p[0] * (1 - t) ** 3 + 3 * p[1] * (1 - t) ** 2 * t + 3 * p[2] * (1 - t) * t**2 + p[3] * t**3
    moved = np.append(True, np.abs(np.diff(z)) > 1e-12 * np.abs(z).max())
    starts = (np.cumsum(pieces + 1) - pieces - 1)[offsets[:-1]]
    moved[starts] = True
    return (
        z[moved],
        np.append((np.cumsum(moved) - 1)[starts], moved.sum()).astype(np.intp),
        widths[owner][moved],
    )


def _opened(
    points: Complex, widths: Array, offsets: Indices, closed: NDArray[np.bool_], share: float
) -> tuple[Complex, Array, Indices]:
    """Return strands with closed ones led on to their second point again: all their corners are inner."""
    if not share or not closed.any():
        return points, widths, offsets
    parts, breadths = np.split(points, offsets[1:-1]), np.split(widths, offsets[1:-1])
    for number in np.flatnonzero(closed).tolist():
        z, w = parts[number], breadths[number]
        parts[number] = np.concatenate([z[:-1], z[:2]])
        breadths[number] = np.concatenate([w, w[1:2]])
    offsets = np.append(0, np.cumsum([len(part) for part in parts])).astype(np.intp)
    return np.concatenate(parts), np.concatenate(breadths), offsets


def _from_middle(points: Complex, offsets: Indices, closed: NDArray[np.bool_], share: float) -> Complex:
    """Return strands with closed ones beginning and ending in the middle of their first edge."""
    if not share or not closed.any():
        return points
    first, last = offsets[:-1][closed], offsets[1:][closed] - 1
    points = points.copy()
    points[first] = points[last] = (points[first] + points[first + 1]) / 2
    return points


def _corners(
    points: Complex, offsets: Indices, share: float
) -> tuple[Complex, Complex, tuple[Complex, Complex], NDArray[np.bool_]]:
    """Return where the arc of each corner begins and ends, its handles, and which points are corners."""
    inner = np.ones(len(points), bool)
    inner[offsets[:-1]] = inner[offsets[1:] - 1] = False
    before, behind = points - np.roll(points, 1), np.roll(points, -1) - points
    long_before, long_behind = np.abs(before), np.abs(behind)
    cut = share / 2 * np.minimum(np.minimum(long_before, long_behind), 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        arrive, leave = before / long_before, behind / long_behind
        turn = np.abs(np.angle(leave / arrive))
        factor = np.where(turn > 1e-6, 4 / 3 * np.tan(turn / 4) / np.tan(turn / 2), 2 / 3)
    inner &= np.isfinite(turn) & (turn < BACK)
    cut = np.where(inner, cut, 0.0)
    handle = np.where(inner, factor, 0.0) * cut
    arrive, leave = np.where(inner, arrive, 0), np.where(inner, leave, 0)
    return points - arrive * cut, points + leave * cut, (arrive * handle, leave * handle), inner
