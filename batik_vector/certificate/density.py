"""Striping: how unevenly ink is spread over the columns and rows of a pattern.

A pattern that looks even in one tile may show stripes in a length of cloth. What the eye sees of them is
what is left of the mean of every column (or row) when it is blurred to a degree of sight: that is what
squinting does. The means are exact: the breadth that areas cover at every abscissa is summed edge by
edge, and lines count with their breadth.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import DropAxis
from batik_vector.certificate.drawing import Edges, Frame, InkDrawing

ARM_MM = 650.0
"""Arm's length: from where cloth is looked at."""

BLUR_MM = ARM_MM * np.tan(np.radians(1.0)) / 2.3548
"""Standard deviation (mm) of the blur: its breadth at half height is one degree of sight. Contrast is seen
best at a few periods per degree, and patterns finer than that are texture and no stripes."""

BINS = 512
"""Into how many columns, or rows, the page is divided."""

Floats = NDArray[np.float64]


def profile(ink: InkDrawing, frame: Frame, axis: int) -> Floats:
    """Return the share of each column (axis 0) or row (axis 1) of the page that an ink covers."""
    sides = np.array([frame.cell.columns, frame.cell.rows], np.float64)
    # In units of a bin across and of the whole page along, areas are shares of a bin.
    scale = 1 / sides
    scale[axis] *= BINS
    return _areas(ink.rings, scale, axis) + _lines(ink.strokes, ink.ink.width * frame.per_mm, scale, axis)


def _areas(rings: Edges, scale: Floats, axis: int) -> Floats:
    """Return the area that rings enclose, bin by bin: what lies between their edges and the axis."""
    begin, end = rings.begin * scale, rings.end * scale
    x0, x1, y0, y1 = begin[:, axis], end[:, axis], begin[:, 1 - axis], end[:, 1 - axis]
    row, number, low, high = _by_bin(x0, x1)
    run = (x1 - x0)[row]
    slope = (y1 - y0)[row] / np.where(run == 0, 1.0, run)
    height = y0[row] + slope * ((low + high) / 2 - x0[row])
    # Ink lies on the left of an edge: beyond one that runs right, before one that runs up.
    sign = -np.sign(run) if axis == 0 else np.sign(run)
    return np.asarray(np.bincount(number, sign * (high - low) * height, minlength=BINS), np.float64)


def _lines(strokes: Edges, width: float, scale: Floats, axis: int) -> Floats:
    """Return the area of lines of some width (steps), bin by bin, as if it all lay on their centre lines."""
    begin, end = strokes.begin * scale, strokes.end * scale
    row, number, low, high = _by_bin(begin[:, axis], end[:, axis])
    run = np.abs(end[:, axis] - begin[:, axis])[row]
    share = np.where(run > 0, (high - low) / np.where(run > 0, run, 1.0), 1.0)
    area = np.hypot(*(strokes.end - strokes.begin).astype(np.float64).T)[row] * width * scale.prod()
    return np.asarray(np.bincount(number, share * area, minlength=BINS), np.float64)


def _by_bin(x0: Floats, x1: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats, Floats]:
    """Cut edges from x0 to x1 where bins meet: (edge, bin, low, high); what lies in one bin stays one."""
    low, high = np.minimum(x0, x1), np.maximum(x0, x1)
    first = np.clip(np.floor(low), 0, BINS - 1).astype(np.intp)
    last = np.clip(np.ceil(high) - 1, first, BINS - 1).astype(np.intp)
    counts = last - first + 1
    row = np.repeat(np.arange(len(counts)), counts)
    number = first[row] + np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    return row, number, np.maximum(low[row], number), np.minimum(high[row], number + 1)


def unevenness(covered: Floats, frame: Frame, axis: int) -> float:
    """Return the spread of a blurred profile, its greatest less its least value, in percent of its mean.

    The profile is of one tile; of a field with a drop, whose neighbours stand against each other, it is
    the mean of theirs: only every q-th harmonic is left of a drop p/q.
    """
    mean = float(covered.mean())
    if mean <= 0:
        return 0.0
    cell = frame.cell
    side = (cell.columns, cell.rows)[axis] / frame.per_mm
    waves = np.fft.rfft(covered)
    number = np.arange(len(waves))
    waves *= np.exp(-2 * (np.pi * BLUR_MM * number / side) ** 2)
    dropped = cell.axis == (DropAxis.COLUMN if axis == 1 else DropAxis.ROW)
    if dropped:
        waves[number % cell.drop.denominator != 0] = 0
    smooth = np.fft.irfft(waves, BINS)
    return float((smooth.max() - smooth.min()) / mean * 100)
