"""The wallpaper group of a tile, found from its geometry alone.

The tile's outline is taken to the torus. The finest lattice of translations is found first, so that it
does not matter how many cells the tile holds or how they are dropped; then every rotation and reflection
that this lattice allows is placed by correlation and least squares, and measured along the whole outline.
An operation holds when no point of any ink's outline lands further from the same ink's outline than the
tolerance explains, with the covered side on the same side. How the tile was made is never asked.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from batik_vector.artwork import Cell, Layer
from batik_vector.certificate.symmetry.agreement import Fit, Matcher
from batik_vector.certificate.symmetry.candidates import Spectra, pixel_of
from batik_vector.certificate.symmetry.group_names import ORBIFOLDS, name_of
from batik_vector.certificate.symmetry.lattice import (
    IDENTITY,
    Matrix,
    Turn,
    Whole,
    closed,
    fractions_of,
    reduced,
    refined,
    turns,
)
from batik_vector.certificate.symmetry.operations import FoundGroup, Miss, Pair, Vector, described, pair
from batik_vector.certificate.symmetry.outline import Outline, outline
from batik_vector.certificate.symmetry.stripes import stripes
from batik_vector.units import GRID_MM, STEPS_PER_MM

__all__ = ["FoundGroup", "found_group"]

STRETCH = 0.015
"""How far a lattice may be from square or hexagonal, and still be one stretched to fit a machine."""

SHIFTS, PLACES = 64, 16
"""How many peaks of the correlation are looked into for translations, and for each linear part."""

AGREEMENT = 0.4
"""The correlation below which a peak is passed over; true symmetries stand above 0.9."""

FOLLOWING = 1.5
"""By how much an operation that follows from others may exceed their limit, as their deviations add up."""

RIGID = 1.5
"""On a stretched lattice marks may have kept their shape, and then stand out by the stretch times the way to
their centre. No more of it than this many times the slack is put up with."""

PLAIN = "blank, or covered all over"
SPECKS = 1e-6
"""The share of the page that may be bare, or covered, of one that is covered all over, or blank."""

COARSE = 50
"""How many times the slack the shortest translation of a tile is, at the least."""

FINEST = 4
"""A pattern that repeats within so many times the slack cannot be told from one that is drawn less truly."""

NEARLY, MISSES = 0.5, 3
"""The share of the outline that a refused operation must meet to be told of, and how many are told of."""


def found_group(
    layers: Sequence[Layer],
    cell: Cell,
    tolerance: float = 0.02,
    *,
    stretch: float = STRETCH,
    misses: bool = True,
) -> FoundGroup:
    """Return the wallpaper group of a tile, from its geometry.

    Args:
        layers: in mm; they need not be in the normal form. Every operation must map each ink onto itself:
            its areas (taken together) onto its areas, its centre lines onto its centre lines.
        cell: the lattice on which the tile repeats; it may be any supercell of the pattern.
        tolerance: how far (mm) a drawn edge may stand from the true curve.
        stretch: how far a lattice may be from one that a rotation or reflection allows, and still count as
            that lattice stretched (0.01 is one percent).
        misses: whether the operations that nearly hold are wanted, which takes about as long again.
    """
    drawn = outline(layers, cell)
    if _plain(drawn, cell):
        basis = basis_of(cell)
        sides = (pair(basis[:, 0]), pair(basis[:, 1]))
        return FoundGroup("p1", ORBIFOLDS["p1"], sides, 1, note=PLAIN)
    # Both the pattern and its image may be out by the tolerance; simplifying and rounding add a little.
    slack = 2 * tolerance + 4 * GRID_MM
    # Where a tolerance is coarse for a small tile, everything would be found to be like everything.
    finest = float(np.hypot(*basis_of(cell)).min()) / COARSE
    return _Search(drawn, cell, min(slack, finest), stretch).result(misses)


def _plain(drawn: Outline, cell: Cell) -> bool:
    """Whether nothing is drawn, or the page covered all over, but for specks that rounding leaves."""
    if (drawn.edges.kind % 2 == 1).any():
        return False
    (x0, y0), (x1, y1) = drawn.rings.begin.T, drawn.rings.end.T
    shares = np.bincount(drawn.rings.kind, (x0 * y1 - x1 * y0) / 2) / (cell.width * cell.height)
    return bool((np.minimum(np.abs(shares), np.abs(1 - shares)) <= SPECKS).all())


def basis_of(cell: Cell) -> Matrix:
    """Return a reduced basis of the lattice on which a tile repeats, as columns in mm."""
    return reduced(np.array(cell.lattice, float).T / STEPS_PER_MM)


class _Search:
    """The search for one pattern; ``slack`` (mm) is what an image may miss it by."""

    def __init__(self, drawn: Outline, cell: Cell, slack: float, stretch: float) -> None:
        basis = basis_of(cell)
        self.cell = cell
        self.along = stripes(drawn, basis, slack)
        self.basis = basis if self.along is None else self.along.basis
        self.drawn = drawn if self.along is None else self.along.drawn
        self.slack, self.stretch = slack, stretch
        self.matcher = Matcher(self.drawn.edges, self.basis, slack, pixel_of(self.basis), thin=slack / 2)
        self.refused: list[tuple[float, Whole, Matrix, Vector]] = []
        self.deviation = 0.0

    def result(self, misses: bool) -> FoundGroup:
        """Return the group, and if so asked what it narrowly misses."""
        spectra = Spectra(self.drawn, self.basis)
        lattice = self._finest(spectra)
        times = round(abs(float(np.linalg.det(self.basis) / np.linalg.det(lattice))))
        if times > 1:
            spectra = Spectra(self.drawn, lattice)
        found, stretch = {IDENTITY: np.zeros(2)}, 0.0
        tried: set[Whole] = set()
        for turn in turns(lattice, self.stretch):
            if turn.matrix not in found and turn.inverse not in tried:
                found = self._with(turn, found, lattice, spectra)
                tried.add(turn.matrix)
            if turn.matrix in found:
                stretch = max(stretch, turn.stretch)
        name = name_of(found, lattice)
        return FoundGroup(
            name=name,
            orbifold=ORBIFOLDS[name],
            translations=(pair(lattice[:, 0]), pair(lattice[:, 1])),
            copies=times * len(found),
            deviation=self.deviation,
            stretch=100 * stretch,
            operations=tuple(described(turn, found[turn], lattice) for turn in list(found)[1:]),
            misses=self._misses(lattice) if misses else (),
            continuous=None if self.along is None else self.along.way,
            note="" if self.along is None else "stripes: any shift along them is a symmetry",
        )

    def _finest(self, spectra: Spectra) -> Matrix:
        """Return a reduced basis of all translations of the pattern."""
        places = spectra.peaks(IDENTITY, AGREEMENT, self._free(self.basis))
        lattice, finer = self.basis, np.eye(2)
        shifts: list[tuple[Fraction, Fraction]] = []
        looked: list[Vector] = []
        for place in places[: SHIFTS + 1]:
            if self._whole(place @ np.linalg.inv(finer), lattice):
                continue
            # A shift and its opposite hold or fail together.
            if any(self._whole(place + other, self.basis) for other in looked):
                continue
            looked.append(place)
            shift = self._freed(self.matcher.placed(np.eye(2), self.basis @ place))
            rows = refined(shifts)
            # Of what is known to repeat, the parts are larger than of the tile.
            part = fractions_of(np.asarray(np.linalg.solve(lattice, shift)), lattice, self.slack)
            if part is not None:
                part = (
                    part[0] * rows[0][0] + part[1] * rows[1][0],
                    part[0] * rows[0][1] + part[1] * rows[1][1],
                )
                shift = self.basis @ np.array(part, float)
            if part is not None and self._too_fine(refined([*shifts, part])):
                continue
            fit = self.matcher.fit(np.eye(2), shift, self.slack)
            if part is not None and self._accepted(fit, IDENTITY, np.eye(2), shift):
                self.deviation = max(self.deviation, fit.worst)
                shifts.append(part)
                finer = np.array(refined(shifts), float)
                lattice = self.basis @ finer.T
                self.matcher.keep_one_cell(reduced(lattice))
        return reduced(lattice) if shifts else self.basis

    def _too_fine(self, rows: tuple[tuple[Fraction, ...], ...]) -> bool:
        """Whether a lattice is one that any drawing would have, being within the slack of every shift."""
        finer = reduced(self.basis @ np.array(rows, float).T)
        return bool(np.hypot(*finer).min() <= FINEST * self.slack)

    def _whole(self, place: Vector, basis: Matrix) -> bool:
        """Whether lattice coordinates are whole numbers, as far as a grid of the correlation tells."""
        return bool(np.hypot(*(basis @ (place - np.rint(place)))) <= 1.5 * pixel_of(self.basis))

    def _with(
        self, turn: Turn, found: dict[Whole, Vector], lattice: Matrix, spectra: Spectra
    ) -> dict[Whole, Vector]:
        """Return the operations with one more linear part and all that follows from it, if it holds."""
        matrix = lattice @ np.array(turn.matrix, float) @ np.linalg.inv(lattice)
        limit = self.slack + min(turn.stretch * np.hypot(*lattice[:, 0]) / 2, RIGID * self.slack)
        places = spectra.peaks(turn.matrix, AGREEMENT, self._free(lattice))
        for place in places[:PLACES]:
            shift = self._freed(self.matcher.placed(matrix, lattice @ place))
            if turn.mirror:
                shift = self._settled(turn, shift, lattice)
            fit = self.matcher.fit(matrix, shift, limit)
            if not self._accepted(fit, turn.matrix, matrix, shift):
                continue
            more = closed(found, turn.matrix, np.asarray(np.linalg.solve(lattice, shift)))
            if more is None:
                continue
            fits = [self._follows(more[each], each, lattice, limit) for each in more if each not in found]
            if all(fit.holds for fit in fits):
                self.deviation = max(self.deviation, *(fit.worst for fit in fits))
                return more
        return found

    def _follows(self, place: Vector, turn: Whole, lattice: Matrix, limit: float) -> Fit:
        matrix = lattice @ np.array(turn, float) @ np.linalg.inv(lattice)
        fit = self.matcher.fit(matrix, lattice @ place, FOLLOWING * limit)
        self._accepted(fit, turn, matrix, lattice @ place)
        return fit

    def _accepted(self, fit: Fit, turn: Whole, matrix: Matrix, shift: Vector) -> bool:
        if not fit.holds and fit.share >= NEARLY:
            self.refused.append((fit.share, turn, matrix, shift))
        return fit.holds

    def _settled(self, turn: Turn, shift: Vector, lattice: Matrix) -> Vector:
        """Return the shift of a reflection, its part along the axis a whole number of half translations."""
        place = np.linalg.solve(lattice, shift)
        square = place + np.array(turn.matrix, float) @ place
        off = lattice @ (np.rint(square) - square) / 2
        return shift + off if np.hypot(*off) <= self.slack else shift

    def _free(self, lattice: Matrix) -> int | None:
        """Return which vector of a lattice lies along stripes."""
        if self.along is None:
            return None
        return int(np.argmax(np.abs(np.array(self.along.way) @ lattice / np.hypot(*lattice))))

    def _freed(self, shift: Vector) -> Vector:
        """Return a shift without its part along stripes, where every part is as good."""
        if self.along is None:
            return shift
        way = np.array(self.along.way)
        return np.asarray(shift - (shift @ way) * way)

    def _misses(self, lattice: Matrix) -> tuple[Miss, ...]:
        """Return the refused operations that meet most of the outline, each kind of them once."""
        told: dict[Whole, Miss] = {}
        for share, turn, matrix, shift in sorted(self.refused, key=lambda refused: -refused[0]):
            if turn in told or len(told) == MISSES:
                continue
            worst, where, kind = self.matcher.failure(matrix, shift)
            operation = described(turn, np.asarray(np.linalg.solve(lattice, shift)), lattice)
            told[turn] = Miss(operation, share, worst, self._on_tile(where), self.drawn.inks[kind // 2])
        return tuple(told.values())

    def _on_tile(self, place: Pair) -> Pair:
        """Return a place moved onto the tile; stripes are measured beyond its edges too."""
        x, y = place
        (ax, ay), (bx, by) = self.cell.lattice
        if bx:
            rows = math.floor(y / self.cell.height)
            x, y = x - rows * bx / STEPS_PER_MM, y - rows * by / STEPS_PER_MM
        columns = math.floor(x / self.cell.width)
        x, y = x - columns * ax / STEPS_PER_MM, y - columns * ay / STEPS_PER_MM
        return x, y % self.cell.height
