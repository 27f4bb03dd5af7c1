"""Patterns of cells: Kronecker powers of a small matrix, and the histories of elementary automata."""

from __future__ import annotations

import functools
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Outlined
from batik_vector.geometry.generators.cells import Cells, merged
from batik_vector.geometry.paths.geometries import outline_of
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

MOST_CELLS = 1_000_000
"""Cells of a grid."""

REFERENCE = 1e-4
"""Share of its breadth by which the outline of a pattern may stand off its round corners."""


@frozen(kw_only=True)
class CellPattern(Outlined):
    """What patterns of cells share: they are 1 broad, about their middle, and merged where cells meet."""

    round: Annotated[float, Between(0, 1), Says("how round corners are; at 1 arcs meet in mid-side")] = 0.0
    periodic: Annotated[bool, Says("round as if the pattern went on over its edges, for grounds")] = False

    def cells(self) -> Cells:
        """Return which cells are filled, shape (rows, columns), the lowest row first."""
        raise NotImplementedError

    def region(self, tolerance: float) -> Geometries:
        """Return the merged cells."""
        cells = self._cells
        rows, columns = cells.shape
        areas = merged(cells, self.round, tolerance * columns, periodic=self.periodic)
        middle = np.array([columns / 2, rows / 2])
        return np.asarray([*_moved(areas, middle, columns)], dtype=object)

    @functools.cached_property
    def _cells(self) -> Cells:
        cells = self.cells()
        if not cells.any():
            raise GeometryError("all cells are empty: expected some that are filled")
        return cells

    def outline(self) -> Outline:
        """Return the rings round the merged cells."""
        return self._outline

    @functools.cached_property
    def _outline(self) -> Outline:
        return outline_of(self.region(REFERENCE))


def _moved(
    areas: Geometries, middle: np.ndarray[tuple[int, ...], np.dtype[np.float64]], columns: int
) -> Geometries:
    import shapely

    return np.asarray(shapely.transform(areas, lambda p: (p - middle) / columns), dtype=object)


@frozen(kw_only=True)
class Kronecker(CellPattern):
    """A Kronecker power of a matrix of noughts and ones, its ones as merged cells.

    Every one of the matrix is replaced by the matrix, `level` times. The carpet is [[1, 1, 1], [1, 0, 1],
    [1, 1, 1]]. Leskovec et al., "Kronecker graphs" (2010), has the power; after Yuan, Cheng, Wang and Liu
    2017 (the paper's reference 30), who weave such patterns.
    """

    matrix: Annotated[
        tuple[tuple[Annotated[int, Between(0, 1)], ...], ...], Says("rows of noughts and ones, top first")
    ] = ((0, 1, 0), (1, 1, 1), (0, 1, 0))
    level: Annotated[int, Between(1, 12), Says("how often the matrix is taken; 1 draws itself")] = 2

    def __post_init__(self) -> None:
        check(self)
        lengths = [len(row) for row in self.matrix]
        if not lengths or not lengths[0] or len(set(lengths)) > 1:
            told = f"rows of {', '.join(map(str, lengths[:8]))} numbers" if lengths else "no rows"
            raise GeometryError(f"matrix = {told}: expected rows that are equally long")
        cells = (len(lengths) * lengths[0]) ** self.level
        if cells > MOST_CELLS:
            raise TooLargeError(
                f"level = {self.level} makes {cells:,} cells, more than {MOST_CELLS:,}: "
                "expected a lower level"
            )
        _ = self._cells

    def cells(self) -> Cells:
        """Return the power."""
        one = np.array(self.matrix, bool)
        found = one
        for _ in range(self.level - 1):
            found = np.kron(found, one)
        return np.asarray(found[::-1], bool)


@frozen(kw_only=True)
class Automaton(CellPattern):
    """The history of an elementary cellular automaton, its living cells merged, the first row lowest.

    Rows close in a ring. With `mirror` the history runs up and back again, and so closes upwards too: it
    tiles. Wolfram, "Statistical mechanics of cellular automata" (1983), numbers the rules.
    """

    rule: Annotated[int, Between(0, 255), Says("Wolfram's number of the rule")] = 90
    columns: Annotated[int, Between(2, 1000), Says("cells of a row")] = 64
    rows: Annotated[int, Between(1, 1000), Says("rows, the first one and those that follow from it")] = 32
    start: Annotated[
        tuple[Annotated[int, Between(0, 999)], ...], Says("cells that live in the first row")
    ] = ()
    density: Annotated[
        float, Between(0, 1), Says("share of cells that live in it by chance; 0 leaves the one in the middle")
    ] = 0.0
    mirror: Annotated[bool, Says("run the history back again, so that it closes")] = True
    seed: Annotated[int, Between(0, 2**63 - 1), Says("which first row chance takes")] = 0

    def __post_init__(self) -> None:
        check(self)
        beyond = [each for each in self.start if each >= self.columns]
        if beyond:
            raise GeometryError(f"start = {beyond[0]}, expected cells from 0 to {self.columns - 1}")
        _ = self._cells

    def cells(self) -> Cells:
        """Return the history."""
        row = np.zeros(self.columns, np.uint8)
        if self.start:
            row[list(self.start)] = 1
        elif self.density:
            row[:] = np.random.default_rng(self.seed).random(self.columns) < self.density
        else:
            row[self.columns // 2] = 1
        table = np.array([self.rule >> number & 1 for number in range(8)], np.uint8)
        found = [row]
        for _ in range(self.rows - 1):
            row = table[4 * np.roll(row, 1) + 2 * row + np.roll(row, -1)]
            found.append(row)
        history = np.array(found, bool)
        # Where it goes on over its edges, the next one begins with the first row.
        back = history[-2:0:-1] if self.periodic else history[-2::-1]
        return np.concatenate([history, back]) if self.mirror else history
