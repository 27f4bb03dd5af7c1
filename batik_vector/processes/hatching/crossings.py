"""Where parallel lines cross the outlines of areas: all lines and all areas in one go.

Lines lie at whole multiples of a pitch from the page's (0, 0), so that areas side by side are hatched by the
same lines. They are half of the smallest unit off those places, where no vertex can be: a line crosses an
edge or it does not, and crosses each outline an even number of times.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, Steps
from batik_vector.processes.hatching.directions import Direction, Whole
from batik_vector.values import frozen


@frozen(eq=False)
class Crossings:
    """Crossings in the order in which the outlines pass them, k of them.

    ``edge`` is the point at which the crossed edge begins, ``share`` how much of the edge lies before the
    crossing, ``line`` which line it is on and ``place`` where, rounded to steps, shape (k, 2). ``scan`` has
    their numbers mark by mark, line by line, along the line: each two of it are where a line enters the area
    and where it leaves.
    """

    edge: Index
    share: NDArray[np.float64]
    line: Whole
    place: Steps
    scan: Index


class Lines:
    """Parallel lines at multiples of a pitch."""

    def __init__(self, direction: Direction, spacing: float) -> None:
        """Take lines along a direction, ``spacing`` steps apart."""
        self.direction = direction
        self._pitch = spacing * direction.length

    def offsets(self, number: Whole) -> Whole:
        """Return where lines lie, in halves of the direction's unit: always odd."""
        places: Whole = np.rint(number * self._pitch).astype(np.int64)
        return 2 * places + 1

    def beyond(self, across: Whole) -> Whole:
        """Return the first line that lies beyond each place, given in the direction's unit."""
        number = np.ceil(across / self._pitch).astype(np.int64)
        # A quotient may be rounded past a whole number.
        number -= self.offsets(number - 1) > 2 * across
        number += self.offsets(number) < 2 * across
        return number

    def counts(self, outlines: Outlines) -> tuple[Whole, Whole, Whole]:
        """Return of each edge where it begins across the lines, the first line beyond that, and how many it
        crosses: fewer than 0 where it goes down.
        """
        across = self.direction.across(outlines.points)
        first = self.beyond(across)
        return across, first, first[following(outlines)] - first

    def crossings(self, outlines: Outlines) -> Crossings:
        """Return where the lines cross closed outlines."""
        after = following(outlines)
        across, first, counts = self.counts(outlines)
        many = np.abs(counts)
        edge = np.repeat(np.arange(len(many)), many)
        nth = np.arange(len(edge)) - np.repeat(np.cumsum(many) - many, many)
        upward = counts[edge] > 0
        line = np.where(upward, first[edge] + nth, first[edge] - 1 - nth)
        begin, end = across[edge], across[after[edge]]
        share = (self.offsets(line) - 2 * begin) / (2 * (end - begin))
        a, b = outlines.points[edge], outlines.points[after[edge]]
        exact = a + (b - a) * share[:, None]
        mark = np.repeat(np.arange(len(outlines)), outlines.sizes())[edge]
        scan = np.lexsort((self.direction.along(exact[:, 0], exact[:, 1]), line, mark))
        return Crossings(edge, share, line, np.rint(exact).astype(np.int64), scan)


def following(outlines: Outlines) -> Index:
    """Return for each point of closed outlines the one that follows it."""
    after = np.arange(1, len(outlines.points) + 1)
    after[outlines.rings[1:] - 1] = outlines.rings[:-1]
    return after
