"""A picture as a screen shows it: bodies in painting order, each with its paint.

An artwork says what each ink prints; a stranger's drawing says what lies on top of what. At the seam of a
tile both count, and so a drawing that was read keeps, beside its artwork, what it paints along the edges.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.values import frozen

Floats = NDArray[np.float64]


class Ramp(Protocol):
    """A paint whose colour hangs on the place."""

    def at(self, xy: Floats) -> Floats:
        """Return red, green, blue and opacity (0 to 1), shape (n, 4), at places in mm, shape (n, 2)."""


@frozen(eq=False)
class Paint:
    """What a body is painted with: a colour ``#rrggbb`` as solid as ``opacity`` says, or a ramp of colours.

    ``ink`` is the ink that it is counted as.
    """

    ink: str
    colour: str
    opacity: float = 1.0
    ramp: Ramp | None = None

    @property
    def runs(self) -> bool:
        """Whether the colour hangs on the place."""
        return self.ramp is not None

    @property
    def solid(self) -> bool:
        """Whether nothing shows through."""
        return self.ramp is None and self.opacity >= 1 - 1e-6

    def levels(self, xy: Floats) -> Floats:
        """Return red, green, blue and opacity at places in mm, shape (n, 2), as shape (n, 4)."""
        if self.ramp is not None:
            levels = self.ramp.at(xy)
            levels[:, 3] *= self.opacity
            return levels
        parts = [int(self.colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        return np.tile([*parts, self.opacity], (len(xy), 1))


@frozen(eq=False)
class Bodies:
    """What is painted along the edges of a page, uncut, the lowest first.

    Attributes:
        shapes: valid polygons in mm, y up, shape (n,).
        paint: number of each body's paint, shape (n,).
        paints: the paints.
        breadth: of the stroke that a body is, in mm; 0 for what is filled.
        owner: number of the line whose body it is, shape (n,); -1 for what is filled.
        ends: places (mm) on the page's edges at which lines end, shape (m, 2). Their bodies go straight on
            there, so that a body shows at the edge what it would if the line went on.
        end_owner: the line that each of these ends, shape (m,).
        nicks: how deep (mm) a nick the true end of such a line leaves, where it comes in aslant, shape (m,):
            positive where it lies beyond that place along the edge, negative where before.
    """

    shapes: Geometries
    paint: NDArray[np.intp]
    paints: tuple[Paint, ...]
    breadth: Floats
    owner: NDArray[np.intp]
    ends: Floats
    end_owner: NDArray[np.intp]
    nicks: Floats
