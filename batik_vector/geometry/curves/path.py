"""The path: a drawing of one's own, as SVG path data."""

from __future__ import annotations

import enum
from typing import Annotated

from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Outlined
from batik_vector.geometry.paths.data import FARTHEST, path_of
from batik_vector.geometry.paths.outline import Outline, bounds_of
from batik_vector.values import frozen

PATH_DATA = 'path data as SVG writes them, such as "M0 0C1 0 1 1 0 1Z", in motif units'
Coordinate = Annotated[float, Between(-FARTHEST, FARTHEST)]


class YAxis(enum.StrEnum):
    """Where the y of path data points."""

    DOWN = "down"
    """As SVG and the programs that write it have it."""
    UP = "up"
    """As the motif has it."""


def path_middle(d: str) -> tuple[float, float]:
    """Return the middle of what path data draw, as the data have it.

    Raises:
        GeometryError: as :class:`PathCurve` does.
    """
    left, low, right, high = bounds_of(path_of(d, upward=True))
    return (left + right) / 2, (low + high) / 2


@frozen
class PathCurve(Outlined):
    """Lines and Béziers written as SVG path data.

    Subpaths that end with Z are closed, and make holes by the element's fill rule; the others are open lines.
    https://www.w3.org/TR/SVG2/paths.html
    """

    d: Annotated[str, Says(PATH_DATA, called="path")]
    y: Annotated[YAxis, Says("where their y points")] = YAxis.DOWN
    centre: Annotated[
        tuple[Coordinate, Coordinate], Says("the point of theirs that becomes the motif's centre")
    ] = (0.0, 0.0)

    def __post_init__(self) -> None:
        check(self)
        self.outline()

    def outline(self) -> Outline:
        """Return the path, y up, about its centre."""
        return path_of(self.d, self.y == YAxis.UP, self.centre)
