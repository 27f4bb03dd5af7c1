"""Regions drawn in: where the middle of a pen may go so that its ink stays inside.

Each is drawn in by ``buffer`` of the whole polygon: a curve that is set off by itself tears at corners. At a
corner that points inwards the true outline is an arc; drawn as arcs, outlines would have twice as many points
each time. Here such corners stay corners, and sharper ones are cut off a little farther in than the arc.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index, Outlines, of_polygons, to_polygons
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

BEYOND = 1.05
"""How much farther in than the arc a corner may be: sharper than 36° of turn it is cut off there."""


@frozen(eq=False)
class Regions:
    """Polygons in steps, as floats, and the mark that each belongs to."""

    polygons: Geometries
    marks: Index

    @staticmethod
    def of(areas: Outlines) -> Regions:
        """Return areas as regions, each a mark."""
        return Regions(to_polygons(areas), np.arange(len(areas)))

    def __len__(self) -> int:
        return len(self.polygons)

    def drawn_in(self, distance: float) -> tuple[Regions, Index]:
        """Return what lies so many steps within, in pieces, and which of the regions each piece is of."""
        if distance <= 0:
            return self, np.arange(len(self))
        return self.parts(self.shrunk(distance))

    def shrunk(self, distance: float) -> Geometries:
        """Return what lies so many steps within each of the regions, in one or more pieces or empty."""
        left = shapely.buffer(self.polygons, -distance, join_style="mitre", mitre_limit=BEYOND)
        return np.asarray(left, dtype=object)

    def parts(self, left: Geometries) -> tuple[Regions, Index]:
        """Return what is left of each of the regions in pieces, and which of the regions each piece is of."""
        pieces, of = shapely.get_parts(left, return_index=True)
        whole = ~shapely.is_empty(pieces)
        return Regions(pieces[whole], self.marks[of[whole]]), of[whole]

    def taken(self, which: Index) -> Regions:
        """Return some of them."""
        return Regions(self.polygons[which], self.marks[which])

    def outlines(self) -> Outlines:
        """Return them on the grid."""
        return of_polygons(self.polygons)
