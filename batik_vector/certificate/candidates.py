"""Where a rotation or reflection of a pattern may stand: peaks of a correlation on the torus.

The pattern is laid out as coverage on a grid in lattice coordinates. There a linear part that keeps the
lattice is a matrix of whole numbers, so it permutes the grid and its spectrum without any interpolation,
and one Fourier transform shows for all translation parts at once how well the pattern meets its image.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.lattice import Matrix, Whole
from batik_vector.certificate.nearest_edges import spread
from batik_vector.certificate.outline import Outline, Points

SIDE = 360
"""Grid points along each side: halves, thirds, … tenths of a cell fall on points."""

ROWS = 2
"""Scan lines per row of the grid."""

BLUR = 0.8
"""Standard deviation, in grid points, of the blur that makes the coverage band-limited."""

FAINT = 1e-9
"""Spectral energy, against a coverage of one half, below which a layer is as good as plain."""


class Spectra:
    """The Fourier transforms of what each ink covers, on the torus of a lattice.

    Args:
        outline: the pattern; it may fill any number of cells of the lattice.
        basis: the lattice's vectors as columns, in mm.
    """

    def __init__(self, outline: Outline, basis: Matrix) -> None:
        self.basis = basis
        inverse = np.linalg.inv(basis)
        wave = np.fft.fftfreq(SIDE, 1 / SIDE)
        # The blur is round on cloth, so that it commutes with every isometry.
        k = np.stack(np.meshgrid(wave, wave, indexing="ij"), axis=-1) @ inverse
        pixel = float(np.hypot(*basis).max()) / SIDE
        blur = np.exp(-2 * (np.pi * BLUR * pixel) ** 2 * (k * k).sum(axis=-1))
        blur[0, 0] = 0
        self.layers = []
        for number in range(2 * len(outline.inks)):
            edges = outline.edges if number % 2 else outline.rings
            mine = edges.kind == number
            if not mine.any():
                continue
            begin, end = edges.begin[mine] @ inverse.T, edges.end[mine] @ inverse.T
            spectrum = np.fft.fft2(_strokes(begin, end) if number % 2 else _coverage(begin, end)) * blur
            energy = float((np.abs(spectrum) ** 2).sum())
            if energy > FAINT * SIDE**4:
                self.layers.append(spectrum / np.sqrt(energy))

    def agreement(self, turn: Whole) -> NDArray[np.float64]:
        """Return for every grid translation how well the pattern meets its turned self: 1 is wholly."""
        (p, q), (r, s) = turn
        index = np.arange(SIDE)
        # f(A⁻¹y) has the spectrum F(Aᵀk).
        rows = (p * index[:, None] + r * index[None, :]) % SIDE
        columns = (q * index[:, None] + s * index[None, :]) % SIDE
        total = np.zeros((SIDE, SIDE), complex)
        for layer in self.layers:
            total += np.conj(layer[rows, columns]) * layer
        return np.asarray(np.fft.ifft2(total).real * SIDE**2 / max(len(self.layers), 1))

    def peaks(self, turn: Whole, least: float, along: int | None = None) -> Points:
        """Return the translations (lattice coordinates) at which the agreement peaks, the best first.

        Args:
            turn: the linear part.
            least: the agreement below which a peak is passed over.
            along: a lattice vector along which everything may be shifted: only none of it is looked at.
        """
        field = self.agreement(turn)
        if along is not None:
            line = field[0] if along == 0 else field[:, 0]
            field = np.full_like(field, -1)
            if along == 0:
                field[0] = line
            else:
                field[:, 0] = line
        top = field >= least
        for shift in ((0, 1), (1, 0), (1, 1), (1, -1)):
            top &= field >= np.roll(field, shift, (0, 1))
            top &= field > np.roll(field, (-shift[0], -shift[1]), (0, 1))
        at = np.argwhere(top)
        place, height = _sharpened(field, at, along)
        order = np.lexsort([at[:, 1], at[:, 0], -np.round(height, 6)])
        # Grid point i stands at (i + ½) / SIDE, and the half is turned too.
        return np.asarray((place[order] + 0.5 - np.array(turn).sum(axis=1) / 2) / SIDE)


def _sharpened(
    field: NDArray[np.float64], at: NDArray[np.intp], along: int | None
) -> tuple[Points, NDArray[np.float64]]:
    """Return where peaks are between the grid points, and how high, by parabolas in each direction."""
    here = field[at[:, 0], at[:, 1]]
    place, height = at.astype(float), here.copy()
    for axis in (0, 1):
        if axis == along:
            continue
        step = np.eye(2, dtype=np.intp)[axis]
        before = field[tuple(((at - step) % SIDE).T)]
        after = field[tuple(((at + step) % SIDE).T)]
        bend = np.minimum(before - 2 * here + after, -1e-30)
        slope = (after - before) / 2
        place[:, axis] += np.clip(-slope / bend, -0.5, 0.5)
        height -= slope * slope / (2 * bend)
    return place, height


def _coverage(begin: Points, end: Points) -> NDArray[np.float64]:
    """Return what closed rings (lattice coordinates) cover round each grid point, wrapped and summed.

    Signed crossings of scan lines, added up along them. What a ring reaches beyond the torus is wrapped:
    the winding that it carries all round a line cancels, since it is closed.
    """
    scan = SIDE * ROWS
    a, b = begin * (SIDE, scan), end * (SIDE, scan)
    sign = np.sign(b[:, 1] - a[:, 1])
    low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    first = np.ceil(low - 0.5).astype(np.intp)
    edge, number = spread(np.maximum(np.ceil(high - 0.5).astype(np.intp) - first, 0))
    line = first[edge] + number
    rise = (line + 0.5 - a[edge, 1]) / (b[edge, 1] - a[edge, 1])
    x = a[edge, 0] + rise * (b[edge, 0] - a[edge, 0])
    column = np.floor(x)
    part, turns = x - column, np.floor(column / SIDE)
    weight = sign[edge]
    row = (line % scan) // ROWS
    cell = (column - turns * SIDE).astype(np.intp)
    shape = (SIDE, SIDE + 1)
    steps = np.bincount(row * shape[1] + cell, weight * (1 - part), shape[0] * shape[1])
    steps += np.bincount(row * shape[1] + cell + 1, weight * part, shape[0] * shape[1])
    whole = np.bincount(row, weight * turns, SIDE)
    # A step past the last column is one at the first of the next turn, and there the two cancel.
    wound = np.cumsum(steps.reshape(shape), axis=1)[:, :SIDE] - whole[:, None]
    # Anticlockwise rings go down on the left; the lines are v, the places along them u.
    return np.asarray(-wound.T / ROWS)


def _strokes(begin: Points, end: Points) -> NDArray[np.float64]:
    """Return the length of lines (lattice coordinates) near each grid point, as a tent spreads it."""
    step = (end - begin) * SIDE
    length = np.hypot(*step.T)
    edge, number = spread(np.maximum(1, np.ceil(2 * length)).astype(np.intp))
    count = np.maximum(1, np.ceil(2 * length))[edge]
    place = begin[edge] * SIDE + ((number + 0.5) / count)[:, None] * step[edge] - 0.5
    weight = length[edge] / count
    base = np.floor(place)
    part = place - base
    total = np.zeros(SIDE * SIDE)
    for du in (0, 1):
        for dv in (0, 1):
            u, v = ((base[:, 0] + du) % SIDE).astype(np.intp), ((base[:, 1] + dv) % SIDE).astype(np.intp)
            share = np.abs(1 - du - part[:, 0]) * np.abs(1 - dv - part[:, 1])
            total += np.bincount(u * SIDE + v, weight * share, SIDE * SIDE)
    return total.reshape(SIDE, SIDE)
