"""Lines that end on a seam: how far their caps reach over it, and the nicks that flat ends leave.

Their bodies are drawn on straight over the edge, so that a line that goes on in another shows no joint. What
the true end does is looked at here.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.report import Limits
from batik_vector.certificate.seam import Seam
from batik_vector.values import frozen

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

ON_EDGE = 0.02
"""How near (mm) to an edge a line ends that ends on it."""


@frozen
class Nick:
    """A nick beside the flat end of a line: from ``low`` to ``high`` (steps), ``far`` or not, of ``body``."""

    low: float
    high: float
    far: bool
    body: int


class Ends:
    """The ends of lines on one seam."""

    def __init__(self, bodies: Bodies, seam: Seam, limits: Limits) -> None:
        self.bodies, self.seam = bodies, seam
        self.limit = limits.position * seam.frame.per_mm

    def nicks(self) -> list[Nick]:
        """Return the nicks that show where lines come in aslant and end flat, on the edge."""
        bodies, seam, per_mm = self.bodies, self.seam, self.seam.frame.per_mm
        found: dict[int, Nick] = {}
        for row in np.flatnonzero(np.abs(bodies.nicks) > self.limit / per_mm).tolist():
            mine = np.flatnonzero(bodies.owner == bodies.end_owner[row])
            x, y = (bodies.ends[row] * per_mm).tolist()
            across, along = (x, y) if seam.axis == 0 else (y, x)
            far = abs(across - seam.far) < abs(across - seam.near)
            edge = seam.far if far else seam.near
            corner = min(abs(x), abs(x - seam.frame.cell.columns)) <= ON_EDGE * per_mm
            # In a corner of the page a line ends on two edges; the nick is told once.
            if not len(mine) or abs(across - edge) > ON_EDGE * per_mm or (seam.axis == 1 and corner):
                continue
            reach = float(np.copysign(bodies.breadth[mine[0]] / 2 * per_mm, bodies.nicks[row]))
            inward = (-1 if far else 1) * 0.05 * abs(reach)
            beside = (edge + inward, along + reach / 2)
            if self._bare(beside if seam.axis == 0 else beside[::-1], mine):
                place = (along - (seam.slip if far else 0)) % seam.length
                low, high = sorted((place, place + reach))
                found.setdefault(round(place), Nick(low, high, far, int(mine[0])))
        return list(found.values())

    def _bare(self, place: tuple[float, float], mine: Indices) -> bool:
        """Whether no body of a line's paint, nor anything solid above the line, lies at a place (steps)."""
        bodies, frame = self.bodies, self.seam.frame
        point = shapely.Point(np.array(frame.on_page(*place)) / frame.per_mm)
        own_page = place == frame.on_page(*place)
        there = np.flatnonzero(shapely.intersects(bodies.shapes, point))
        others = there[~np.isin(there, mine)] if own_page else there
        solid = np.array([bodies.paints[number].solid for number in bodies.paint[others]], bool)
        alike = bodies.paint[others] == bodies.paint[mine[0]]
        return not (alike | (solid & (others > mine.max()))).any()

    def _places(self, body: int) -> Floats:
        """Return where on this seam, in steps, the line ends whose body this is."""
        owner = self.bodies.owner[body]
        if owner < 0:
            return np.empty(0)
        seam, per_mm = self.seam, self.seam.frame.per_mm
        ends = self.bodies.ends[self.bodies.end_owner == owner] * per_mm
        across, along = ends[:, seam.axis], ends[:, 1 - seam.axis]
        on_near, on_far = (np.abs(across - edge) <= ON_EDGE * per_mm for edge in (seam.near, seam.far))
        return np.asarray(np.concatenate([along[on_near], along[on_far] - seam.slip]) % seam.length)

    def reaches(self, body: int, low: float, high: float) -> bool:
        """Whether a stroke reaches over the edge there by no more than the cap of an end that lies on it."""
        half = self.bodies.breadth[body] / 2 * self.seam.frame.per_mm * 1.01 + self.limit
        places = self._places(body)
        return bool(self._near(places, low, high, half).any())

    def _near(self, places: Floats, low: float, high: float, reach: float) -> NDArray[np.bool_]:
        """Tell within reach of which places on the circle a stretch wholly lies."""
        length = self.seam.length
        turned = places + np.rint(((low + high) / 2 - places) / length) * length
        return np.asarray((low >= turned - reach) & (high <= turned + reach))
