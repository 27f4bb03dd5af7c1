"""The paper's layouts by name: the symmetric, the double-square, the four-square and the circles.

They say no more than a rosette, a ring or a list of places could, in the words of Tian et al. 2019, §5.2:
there P1 = 2 gives the symmetric, 3 the three-circle, 4 the four-square and 5 the five-circle layout. Several
motifs take their places in turn.
"""

from __future__ import annotations

from typing import Annotated, ClassVar

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.tiling.layouts.base import Bend, Layout, Pair
from batik_vector.tiling.layouts.copies import Ring, RosetteLayout
from batik_vector.values import frozen

_Distance = Annotated[float, Between(-1e4, 1e4), Says("distance of the copies from the centre")]
_Turn = Annotated[float, Between(-360, 360), Says("degrees the motif is turned first")]


def _rosette(group: str, shift: Pair, turn: float, axis: float = 0.0) -> Affines | Bend:
    return RosetteLayout(group=group, shift=shift, turn=turn, axis=axis).images((0.0, 0.0))


@frozen(kw_only=True)
class Symmetric(Layout):
    """Two copies that face each other across the centre. Tian et al. 2019, §5.2, P1 = 2."""

    deals: ClassVar[bool] = True
    distance: _Distance = 4 / 3
    mirrored: Annotated[bool, Says("the other one is a mirror image; else it is turned half round")] = False
    turn: _Turn = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """Two images, the first on the right."""
        return _rosette("D1" if self.mirrored else "C2", (self.distance, 0.0), self.turn, 90.0)


@frozen(kw_only=True)
class DoubleSquare(Layout):
    """Copies side by side in a row about the centre, as a pattern that goes on to two sides. Tian et al.
    2019, §4.5.

    What goes on to two sides (*erfang lianxu*) and to four are the textbook's two kinds of repeats, and the
    paper's double-square and four-square read as these. With JuliaN, P1 = 2, more iterations draw such a row
    too.
    """

    deals: ClassVar[bool] = True
    count: Annotated[int, Between(1, 1000), Says("copies in the row")] = 2
    distance: Annotated[float, Between(-1e4, 1e4), Says("distance of neighbours from each other")] = 8 / 3
    axis: Annotated[float, Between(-360, 360), Says("direction of the row in degrees")] = 0.0
    flip: Annotated[bool, Says("mirror every other copy at the row")] = False
    turn: _Turn = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """One image per copy, along the row."""
        number = np.arange(self.count)
        places = np.column_stack([(number - (self.count - 1) / 2) * self.distance, np.zeros(self.count)])
        upright = Affines.scales(np.ones(self.count), np.where(self.flip & (number % 2 == 1), -1.0, 1.0))
        return Affine.turn(self.axis) @ (Affines.translations(places) @ upright @ Affine.turn(self.turn))


@frozen(kw_only=True)
class FourSquare(Layout):
    """Four copies at the corners of a square. Tian et al. 2019, §5.2, P1 = 4, and Figures 14b and 16a."""

    deals: ClassVar[bool] = True
    distance: Annotated[
        float, Between(-1e4, 1e4), Says("distance of the copies from both middle lines", "dx = dy")
    ] = 4 / 3
    mirrored: Annotated[
        bool, Says("left and right, upper and lower ones are mirror images; else each is turned on by 90°")
    ] = False
    turn: _Turn = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """Four images, anticlockwise from the upper right."""
        images = _rosette("D2" if self.mirrored else "C4", (self.distance, self.distance), self.turn)
        if self.mirrored and isinstance(images, Affines):
            # Of each turned copy its mirror image follows: upper right, lower right, lower left, upper left.
            return Affines(images.rows[[0, 3, 2, 1]])
        return images


@frozen(kw_only=True)
class ThreeCircle(Layout):
    """Three copies round the centre, each turned on by 120°. Tian et al. 2019, §5.2, P1 = 3."""

    deals: ClassVar[bool] = True
    distance: _Distance = 4 / 3
    turn: _Turn = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """Three images, anticlockwise from the right."""
        return _rosette("C3", (self.distance, 0.0), self.turn)


@frozen(kw_only=True)
class FiveCircle(Layout):
    """Five copies round the centre, each turned on by 72°. Tian et al. 2019, §5.2, P1 = 5."""

    deals: ClassVar[bool] = True
    distance: _Distance = 1.95
    turn: _Turn = 0.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """Five images, anticlockwise from the right."""
        return _rosette("C5", (self.distance, 0.0), self.turn)


@frozen(kw_only=True)
class Circle(Ring):
    """Copies on a circle, several motifs in turn where there are several. Tian et al. 2019, Figure 16b.

    A `ring` by the paper's name.
    """
