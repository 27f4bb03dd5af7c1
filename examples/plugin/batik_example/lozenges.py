"""A fill of lozenges (*wajik*) in rows."""

from __future__ import annotations

from typing import Annotated

from batik_vector.fields import Between, Says, Useful
from batik_vector.recipe.fills.base import Angled, Marks, Room
from batik_vector.values import frozen


@frozen(kw_only=True)
class Lozenges(Angled):
    """Lozenges (*wajik*) in staggered rows."""

    kind = "lozenges"
    marks_each = 1.16

    tall: Annotated[float, Between(0.2, 5), Useful(1, 2), Says("height of a lozenge, of its width")] = 1.4

    def _laid(self, room: Room) -> Marks:
        # NumPy and what lays marks are imported once a recipe has such a fill: a start stays short.
        import numpy as np

        from batik_vector.geometry.fills.bodies import stamped
        from batik_vector.geometry.fills.insets import inset
        from batik_vector.geometry.fills.rows import hexagonal

        half, high = self.width / 2, self.width / 2 * self.tall
        within = inset(room.parts, self.margin + max(half, high))
        places, part = hexagonal(within, self.angle, self.spacing)
        shape = np.array([[half, 0.0], [0.0, high], [-half, 0.0], [0.0, -high]])
        return stamped(shape, places, np.full(len(places), np.radians(self.angle))), within.region[part]
