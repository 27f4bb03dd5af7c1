"""Each stroke once: what an earlier stroke has drawn already is left out of the later ones.

Strokes are taken apart at every place that lies upon them, within 1 µm, where any stroke turns, begins or
ends. Then pieces with the same two ends are the same, whichever way they are drawn: so are exact doubles,
reversed ones, and the parts that overlapping lines have in common, slanted ones too, whose ends were rounded
beside one another's line. Nothing moves by more than that 1 µm, and a line that nothing touches not at all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps
from batik_vector.processes.ordering.distances import Distances, distances
from batik_vector.processes.plotting.pieces import Pieces
from batik_vector.processes.plotting.touching import numbered, pairs, touching
from batik_vector.values import frozen

REACH = 1
"""How many steps beside one another two stretches may lie that are the same line."""


@frozen(eq=False)
class Doubled:
    """What had been drawn before: a stretch for each piece of a stroke that was left out.

    ``places`` has shape (k, 2): the middle of each stretch's first piece, in steps. ``lengths`` are those of
    the stretches, in parts of a step, and ``source`` the numbers of the strokes that they are left out of.
    """

    places: Steps
    lengths: Distances
    source: Index

    @property
    def length(self) -> int:
        """That of all together, in parts of a step."""
        return int(self.lengths.sum())


@frozen(eq=False)
class _Numbered:
    """Segments in their strokes' order: the numbers of their ends, their strokes, and whether each stays."""

    start: Index
    end: Index
    stroke: Index
    stays: NDArray[np.bool_]


def once(strokes: Outlines, reach: int = REACH) -> tuple[Outlines, Index, Doubled]:
    """Return what is left of strokes when nothing is drawn twice, in their order and without names.

    Args:
        strokes: one ring or polyline to a mark. The first of those that share a line draws it.
        reach: how many steps beside one another two stretches may lie that are the same line.

    Returns:
        The strokes that are left, closed where a closed one is whole; for each of them the number of the
        stroke that it is a part of; and what is left out.

    Raises:
        GeometryError: where the drawing is broader or higher than 2 km.
    """
    points, rings = strokes.repeating()
    places, number = numbered(points)
    pieces = _segments(number, rings)
    pieces = _first_of_each(pieces, len(places))
    segments = np.flatnonzero(pieces.stays)
    which, upon = touching(places, pieces.start[segments], pieces.end[segments], reach)
    if len(which):
        pieces = _first_of_each(_cut(pieces, segments[which], upon), len(places))
    doubled = _doubled(pieces, places)
    parts = Pieces(places[pieces.start], places[pieces.end], pieces.stroke)
    left, source = parts.staying(pieces.stays, strokes.closed)
    return left, source, doubled


def _segments(number: Index, rings: Offsets) -> _Numbered:
    """Return the segments of strokes that have a length."""
    stroke = np.repeat(np.arange(len(rings) - 1), np.diff(rings))
    real = np.flatnonzero((stroke[1:] == stroke[:-1]) & (number[1:] != number[:-1]))
    return _Numbered(number[real], number[real + 1], stroke[real], np.ones(len(real), bool))


def _first_of_each(pieces: _Numbered, places: int) -> _Numbered:
    """Return pieces of which, of those that stay, only those do that no earlier one has drawn."""
    some = np.flatnonzero(pieces.stays)
    keys = pairs(pieces.start[some], pieces.end[some], places)
    stays: NDArray[np.bool_] = np.zeros(len(pieces.stays), bool)
    stays[some[np.unique(keys, return_index=True)[1]]] = True
    return _Numbered(pieces.start, pieces.end, pieces.stroke, stays)


def _cut(pieces: _Numbered, which: Index, upon: Index) -> _Numbered:
    """Return pieces cut at the places upon them; ``which`` ascends."""
    after = np.insert(pieces.start, which + 1, upon)
    end = np.insert(pieces.end, which, upon)
    # A place ends one piece and begins the next.
    stroke = np.insert(pieces.stroke, which, pieces.stroke[which])
    return _Numbered(after, end, stroke, np.insert(pieces.stays, which, pieces.stays[which]))


def _doubled(pieces: _Numbered, places: Steps) -> Doubled:
    """Return what does not stay."""
    gone = np.flatnonzero(~pieces.stays)
    start, end, stroke = pieces.start[gone], pieces.end[gone], pieces.stroke[gone]
    fresh = np.append(True, (np.diff(gone) != 1) | (np.diff(stroke) != 0))[: len(gone)]
    middle = (places[start[fresh]] + places[end[fresh]]) // 2
    each = distances(places[start], places[end])
    lengths = np.asarray(np.bincount(np.cumsum(fresh) - 1, each, len(middle)), float)
    return Doubled(middle, lengths, stroke[fresh])
