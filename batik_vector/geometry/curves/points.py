"""The curve through points: a drawing of one's own, as a list of places."""

from __future__ import annotations

import functools
from typing import Annotated

from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Outlined
from batik_vector.geometry.paths.data import FARTHEST
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.splines import through
from batik_vector.values import frozen

Coordinate = Annotated[float, Between(-FARTHEST, FARTHEST)]


@frozen
class PointsCurve(Outlined):
    """Curve through points, by straight lines or as a smooth line: a cubic spline of centripetal steps.

    The bend of a smooth one runs on without a step, but for the corners. Floater, "On the deviation of a
    parametric cubic spline interpolant from its data polygon" (2008), has why it stays near the points.
    """

    points: Annotated[
        tuple[tuple[Coordinate, Coordinate], ...], Says("the points, [x, y] each, in motif units, y up")
    ]
    smooth: Annotated[bool, Says("a smooth line through them; else straight from each to the next")] = False
    closed: Annotated[bool, Says("leads back to the first point")] = True  # type: ignore[misc]
    corners: Annotated[
        tuple[Annotated[int, Between(0, 1_000_000)], ...],
        Says("points where a smooth line turns sharply, by number; the first point is 0"),
    ] = ()

    def __post_init__(self) -> None:
        check(self)
        self.outline()

    def outline(self) -> Outline:
        """Return the curve as an outline of one subpath."""
        return self._outline

    @functools.cached_property
    def _outline(self) -> Outline:
        return through(self.points, self.smooth, self.closed, self.corners)
