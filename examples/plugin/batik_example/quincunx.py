"""The quincunx: five, as on a die."""

from __future__ import annotations

from typing import Annotated, ClassVar

from batik_vector.fields import Between, Says
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.tiling.layouts.base import Bend, Layout
from batik_vector.values import frozen


@frozen(kw_only=True)
class Quincunx(Layout):
    """Five copies: one in the middle and one in each corner of a rectangle; several motifs take turns."""

    deals: ClassVar[bool] = True
    width: Annotated[float, Between(0, 1e4), Says("from corner to corner across, in motif units")] = 4.0
    height: Annotated[float, Between(0, 1e4), Says("from corner to corner upwards")] = 4.0

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """The middle, then the corners, counter-clockwise from the lower left."""
        x, y = self.width / 2, self.height / 2
        places = [(0.0, 0.0), (-x, -y), (x, -y), (x, y), (-x, y)]
        return Affines.of([Affine.translation(place) for place in places])
