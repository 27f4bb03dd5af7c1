"""Motifs that a layout bends: every figure is carried through its maps, finer where they stretch it more."""

from __future__ import annotations

from functools import partial

import numpy as np

from batik_vector.artwork import Geometries
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.figures import Figure
from batik_vector.tiling.layouts import Bend
from batik_vector.tiling.torus.remembered import remembered
from batik_vector.values import frozen

SOURCE_SHARE = 0.2
"""Share of the tolerance that the source of a bent image may use; the bending itself has the rest."""


@frozen
class Source:
    """How fine a motif must be drawn to be bent: a tolerance place by place.

    It is a value, so that what is drawn to it can be known again.

    Attributes:
        images: what bends it.
        tolerance: of what is bent, in motif units.
    """

    images: Bend
    tolerance: float

    def __call__(self, points: Points) -> Array:
        """Return the tolerance at points, shape (n, 2) → (n,)."""
        stretch = self.images.system.stretch(self.images.first.at(points))
        return np.asarray(self.tolerance * SOURCE_SHARE / np.maximum(stretch, 1e-6))


def bent(figures: list[Figure], images: Bend, tolerance: float) -> list[Figure]:
    """Return the images of figures, those of each element together.

    They are kept: who turns one knob bends the rest again.

    Args:
        figures: in motif units.
        images: what bends them.
        tolerance: in motif units.
    """

    def carried(marks: Geometries, what: str) -> Geometries:
        carry = images.system.areas if what == "areas" else images.system.lines
        return carry(images.first.apply(marks), tolerance)[0]

    def known(marks: Geometries, what: str) -> Geometries:
        return remembered(("bent", what, images, tolerance), marks, partial(carried, marks, what))

    return [Figure(each.element, known(each.areas, "areas"), known(each.lines, "lines")) for each in figures]
