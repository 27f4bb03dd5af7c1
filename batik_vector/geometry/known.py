"""What may be known of the vertices of polylines from elsewhere than the polylines themselves."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.sampling import Array, Indices
from batik_vector.values import frozen

UNKNOWN, SMOOTH, BREAK = -1, 0, 1
"""What may be known of a vertex."""


@frozen(eq=False)
class Known:
    """What is known of vertices from elsewhere; see :mod:`batik_vector.geometry.continuations`.

    One item per vertex: ``arriving`` and ``leaving`` are the directions of the curve, in radians, NaN where
    they are not known; ``joint`` tells whether the curve has a corner there.
    """

    arriving: Array
    leaving: Array
    joint: NDArray[np.int8]

    def taken(self, which: Indices) -> Known:
        """Return what is known of some vertices."""
        return Known(self.arriving[which], self.leaving[which], self.joint[which])


def nothing_known(size: int) -> Known:
    """Return that nothing is known of so many vertices."""
    return Known(np.full(size, np.nan), np.full(size, np.nan), np.full(size, UNKNOWN, np.int8))
