"""What a certificate asks of a picture: bodies in painting order, each with its paint.

They are read from a stranger's drawing elsewhere; nothing here needs to know of files.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Geometries

Floats = NDArray[np.float64]


class Paint(Protocol):
    """What a body is painted with."""

    @property
    def ink(self) -> str:
        """The ink that it is counted as."""

    @property
    def colour(self) -> str:
        """Its colour, ``#rrggbb``."""

    @property
    def opacity(self) -> float:
        """How solid it is: 0 to 1."""

    @property
    def runs(self) -> bool:
        """Whether the colour hangs on the place, as in a gradient."""

    @property
    def solid(self) -> bool:
        """Whether nothing shows through."""

    def levels(self, xy: Floats) -> Floats:
        """Return red, green, blue and opacity, shape (n, 4), at places in mm, shape (n, 2)."""


class Bodies(Protocol):
    """What is painted along the edges of a page, uncut, the lowest first."""

    @property
    def shapes(self) -> Geometries:
        """Valid polygons in mm, y up, shape (n,)."""

    @property
    def paint(self) -> NDArray[np.intp]:
        """Number of each body's paint, shape (n,)."""

    @property
    def paints(self) -> Sequence[Paint]:
        """The paints."""

    @property
    def breadth(self) -> Floats:
        """Breadth (mm) of the stroke that a body is, shape (n,); 0 for what is filled."""

    @property
    def owner(self) -> NDArray[np.intp]:
        """The line whose body it is, shape (n,); -1 for what is filled."""

    @property
    def ends(self) -> Floats:
        """Places (mm) on the page's edges at which lines end, shape (m, 2); there bodies go straight on."""

    @property
    def end_owner(self) -> NDArray[np.intp]:
        """The line that each of these ends, shape (m,)."""

    @property
    def nicks(self) -> Floats:
        """How deep (mm) a nick the true end of each leaves beside it, shape (m,); negative before it."""
