"""Sums along the branches of a word: what holds behind a "]" is what held at its "["."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.sampling import Indices
from batik_vector.values import frozen

DEEPEST = 2_000
"""How deep branches may be nested: they are summed depth by depth."""

Any_ = TypeVar("Any_", np.int64, np.float64, np.complex128)


@frozen(eq=False)
class Branches:
    """The symbols of a word depth by depth: those of one branch stand together, led by its "[".

    ``order`` are the symbols so; ``bounds`` where each depth begins among them; ``opens`` which of them, in
    that order, are a "[".
    """

    order: Indices
    bounds: Indices
    opens: NDArray[np.bool_]

    @staticmethod
    def of(opened: NDArray[np.bool_], closed: NDArray[np.bool_]) -> Branches:
        """Return the branches of a word.

        Args:
            opened, closed: which symbols are a "[" and a "]".

        Raises:
            TooLargeError: where they are nested too deeply.
        """
        depth = np.cumsum(opened.astype(np.int32) - closed.astype(np.int32), dtype=np.int32)
        deepest = int(depth.max(initial=0))
        if deepest > DEEPEST:
            raise TooLargeError(
                f"branches are nested {deepest:,} deep, more than {DEEPEST:,}: expected a lower level"
            )
        order: Indices = np.argsort(depth.astype(np.int16), kind="stable")
        bounds: Indices = np.searchsorted(depth[order], np.arange(deepest + 2)).astype(np.intp)
        return Branches(order, bounds, opened[order])

    def sums(self, steps: NDArray[Any_]) -> NDArray[Any_]:
        """Return for every symbol the sum of all steps on the way to it, its own included."""
        found: NDArray[Any_] = np.empty_like(steps)
        for low, high in zip(self.bounds[:-1], self.bounds[1:], strict=True):
            mine = self.order[low:high]
            own = steps[mine]
            total = np.cumsum(own)
            start = np.flatnonzero(self.opens[low:high])
            if len(start):
                before = total[start] - own[start]
                # What stands before a "[" is a symbol of the branch that it leaves, or nothing at all.
                at = mine[start] - 1
                base = np.where(at >= 0, found[np.maximum(at, 0)], 0)
                total = total + np.repeat(base - before, np.diff(np.append(start, len(mine))))
            found[mine] = total
        return found
