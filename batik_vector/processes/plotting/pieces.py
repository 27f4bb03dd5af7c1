"""Strokes in pieces: segments in their strokes' order, and the strokes that some of them make."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, Steps, nothing
from batik_vector.values import frozen


@frozen(eq=False)
class Pieces:
    """Segments: where they begin and end, shape (n, 2), and the numbers of their strokes, which ascend.

    The pieces of a stroke follow one another; those of a closed one come back to where the first begins.
    """

    begin: Steps
    end: Steps
    stroke: Index

    @staticmethod
    def of(strokes: Outlines) -> Pieces:
        """Return the segments of strokes that have a length."""
        points, rings = strokes.repeating()
        stroke = np.repeat(np.arange(len(strokes)), np.diff(rings))
        real = np.flatnonzero((stroke[1:] == stroke[:-1]) & (points[1:] != points[:-1]).any(axis=1))
        return Pieces(points[real], points[real + 1], stroke[real])

    def cut(self, which: Index, at: Steps) -> Pieces:
        """Return pieces cut at places: ``which`` ascends, and the places follow one another along each."""
        return Pieces(
            np.insert(self.begin, which + 1, at, axis=0),
            np.insert(self.end, which, at, axis=0),
            np.insert(self.stroke, which, self.stroke[which]),
        )

    def taken(self, which: Index) -> Pieces:
        """Return some of the pieces, in this order."""
        return Pieces(self.begin[which], self.end[which], self.stroke[which])

    def staying(self, stays: NDArray[np.bool_], closed: NDArray[np.bool_]) -> tuple[Outlines, Index]:
        """Return the strokes that some pieces make, and the numbers of those that they are parts of.

        They are closed where a closed one is whole.

        Args:
            stays: shape (n,), which pieces there are.
            closed: for each stroke whether it is closed.
        """
        order = _from_a_gap(stays, self.stroke, closed)
        if not len(order):
            return nothing(), order
        begin, end, stroke = self.begin[order], self.end[order], self.stroke[order]
        fresh = (begin[1:] != end[:-1]).any(axis=1) | (stroke[1:] != stroke[:-1])
        heads = np.flatnonzero(np.append(True, fresh))
        tails = np.append(heads[1:], len(order)) - 1
        # There and back encloses nothing.
        shut = closed[stroke[heads]] & (begin[heads] == end[tails]).all(axis=1) & (tails - heads >= 2)
        points = np.insert(begin, (tails + 1)[~shut], end[tails[~shut]], axis=0)
        rings = np.concatenate([[0], np.cumsum(tails - heads + 1 + ~shut)]).astype(np.int64)
        return Outlines(points, rings, np.arange(len(rings)), shut), stroke[heads]


def _from_a_gap(stays: NDArray[np.bool_], stroke: Index, closed: NDArray[np.bool_]) -> Index:
    """Return the pieces that stay, in order; those of a closed stroke from after its last gap on."""
    kept = np.flatnonzero(stays)
    gaps = np.flatnonzero(~stays & closed[stroke])
    if not len(gaps):
        return kept
    last = np.full(len(closed), -1)
    # Of several, the last one written stands.
    last[stroke[gaps]] = gaps
    before = kept < last[stroke[kept]]
    return kept[np.lexsort((kept, before, stroke[kept]))]
