"""Where a rotation or reflection of a pattern may stand: peaks of a correlation on the torus.

The pattern is laid out as coverage on a grid in lattice coordinates. There a linear part that keeps the
lattice is a matrix of whole numbers, so it permutes the grid and its spectrum without any interpolation,
and one Fourier transform shows for all translation parts at once how well the pattern meets its image.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.symmetry.lattice import Matrix, Whole
from batik_vector.certificate.symmetry.nearest_edges import spread
from batik_vector.certificate.symmetry.outline import Outline, Points

SIDE = 360
"""Grid points along each side: halves, thirds, … tenths of a cell fall on points."""

ROWS = 2
"""Scan lines per row of the grid."""

BLUR = 0.8
"""Standard deviation, in grid points, of the blur that makes the coverage band-limited."""

MOST_TIMES = 16
"""How many times ``SIDE`` grid points lie along the longer side of a long lattice at the most."""

LONG = 4.0
"""How many times its shorter vector the longer one of a long lattice is: no symmetry swaps them."""

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
        self.sides = sides = sides_of(basis)
        self.waves = [np.rint(np.fft.fftfreq(side, 1 / side)).astype(np.intp) for side in sides]
        k = np.stack(np.meshgrid(*self.waves, indexing="ij"), axis=-1) @ inverse @ _blurs(basis, sides)
        blur = np.exp(-2 * (np.pi * BLUR) ** 2 * (k * k).sum(axis=-1))
        blur[0, 0] = 0
        self.layers = []
        for number in range(2 * len(outline.inks)):
            edges = outline.edges if number % 2 else outline.rings
            mine = edges.kind == number
            if not mine.any():
                continue
            begin, end = edges.begin[mine] @ inverse.T, edges.end[mine] @ inverse.T
            spectrum = np.fft.fft2((_strokes if number % 2 else _coverage)(begin, end, sides)) * blur
            energy = float((np.abs(spectrum) ** 2).sum())
            if energy > FAINT * float(sides[0] * sides[1]) ** 2:
                self.layers.append(spectrum / np.sqrt(energy))

    def agreement(self, turn: Whole) -> NDArray[np.float64]:
        """Return for every grid translation how well the pattern meets its turned self: 1 is wholly."""
        (p, q), (r, s) = turn
        across, up = self.waves[0][:, None], self.waves[1][None, :]
        # f(A⁻¹y) has the spectrum F(Aᵀk).
        rows = (p * across + r * up) % self.sides[0]
        columns = (q * across + s * up) % self.sides[1]
        total = np.zeros(self.sides, complex)
        for layer in self.layers:
            total += np.conj(layer[rows, columns]) * layer
        return np.asarray(np.fft.ifft2(total).real * total.size / max(len(self.layers), 1))

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
        # Grid point i stands at (i + ½) / side, and the half is turned too.
        return np.asarray((place[order] + 0.5 - _halves(turn, self.sides)) / self.sides)


def sides_of(basis: Matrix) -> tuple[int, int]:
    """Return how many grid points lie along each vector of a lattice: more along the longer of a long one."""
    length = np.hypot(*basis)
    times = int(min(max(length.max() / length.min() / LONG, 1), MOST_TIMES))
    return (SIDE * times, SIDE) if length[0] > length[1] else (SIDE, SIDE * times)


def pixel_of(basis: Matrix) -> float:
    """Return how far (mm) grid points stand apart at the most."""
    return float((np.hypot(*basis) / sides_of(basis)).max())


def _halves(turn: Whole, sides: tuple[int, int]) -> Points:
    """Return where a linear part carries half a step of the grid in both directions, in steps."""
    half = 0.5 / np.array(sides, float)
    return np.asarray(np.array(turn, float) @ half * sides)


def _blurs(basis: Matrix, sides: tuple[int, int]) -> Matrix:
    """Return what a grid point of the blur is on cloth, as two columns in mm.

    It is round, so that it commutes with every isometry. On a long lattice it is long as well, or it would
    wipe out what stands across: only mirrors along and across, and half turns, can hold there, and commute.
    """
    length = np.hypot(*basis)
    if length.max() < LONG * length.min():
        return np.asarray(np.eye(2) * length.max() / SIDE)
    short = basis[:, int(np.argmin(length))] / length.min()
    height = abs(float(np.linalg.det(basis))) / length.min() / max(sides) * SIDE
    return np.column_stack([short * length.min(), np.array([-short[1], short[0]]) * height]) / SIDE


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
        before = field[tuple(((at - step) % field.shape).T)]
        after = field[tuple(((at + step) % field.shape).T)]
        bend = np.minimum(before - 2 * here + after, -1e-30)
        slope = (after - before) / 2
        place[:, axis] += np.clip(-slope / bend, -0.5, 0.5)
        height -= slope * slope / (2 * bend)
    return place, height


def _coverage(begin: Points, end: Points, sides: tuple[int, int]) -> NDArray[np.float64]:
    """Return what closed rings (lattice coordinates) cover round each grid point, wrapped and summed.

    Signed crossings of scan lines, added up along them. What a ring reaches beyond the torus is wrapped:
    the winding that it carries all round a line cancels, since it is closed.
    """
    side, scan = sides[0], sides[1] * ROWS
    a, b = begin * (side, scan), end * (side, scan)
    sign = np.sign(b[:, 1] - a[:, 1])
    low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    first = np.ceil(low - 0.5).astype(np.intp)
    edge, number = spread(np.maximum(np.ceil(high - 0.5).astype(np.intp) - first, 0))
    line = first[edge] + number
    rise = (line + 0.5 - a[edge, 1]) / (b[edge, 1] - a[edge, 1])
    x = a[edge, 0] + rise * (b[edge, 0] - a[edge, 0])
    column = np.floor(x)
    part, turns = x - column, np.floor(column / side)
    weight = sign[edge]
    row = (line % scan) // ROWS
    cell = (column - turns * side).astype(np.intp)
    shape = (sides[1], side + 1)
    steps = np.bincount(row * shape[1] + cell, weight * (1 - part), shape[0] * shape[1])
    steps += np.bincount(row * shape[1] + cell + 1, weight * part, shape[0] * shape[1])
    whole = np.bincount(row, weight * turns, sides[1])
    # A step past the last column is one at the first of the next turn, and there the two cancel.
    wound = np.cumsum(steps.reshape(shape), axis=1)[:, :side] - whole[:, None]
    # Anticlockwise rings go down on the left; the lines are v, the places along them u.
    return np.asarray(-wound.T / ROWS)


def _strokes(begin: Points, end: Points, sides: tuple[int, int]) -> NDArray[np.float64]:
    """Return the length of lines (lattice coordinates) near each grid point, as a tent spreads it."""
    step = (end - begin) * sides
    length = np.hypot(*step.T)
    edge, number = spread(np.maximum(1, np.ceil(2 * length)).astype(np.intp))
    count = np.maximum(1, np.ceil(2 * length))[edge]
    place = begin[edge] * sides + ((number + 0.5) / count)[:, None] * step[edge] - 0.5
    weight = length[edge] / count
    base = np.floor(place)
    part = place - base
    total = np.zeros(sides[0] * sides[1])
    for du in (0, 1):
        for dv in (0, 1):
            u, v = (
                ((base[:, 0] + du) % sides[0]).astype(np.intp),
                ((base[:, 1] + dv) % sides[1]).astype(np.intp),
            )
            share = np.abs(1 - du - part[:, 0]) * np.abs(1 - dv - part[:, 1])
            total += np.bincount(u * sides[1] + v, weight * share, len(total))
    return total.reshape(sides)
