"""Elements: a curve, its copies round the centre of a motif, and the look of them all."""

from __future__ import annotations

from dataclasses import fields
from typing import Annotated, Any, TypeAlias

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, OneOf, Says, check
from batik_vector.geometry.curves import CURVES, Curve, OutlineCurve
from batik_vector.geometry.curves.base import FunctionCurve, Outlined
from batik_vector.geometry.paths.geometries import outline_of
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.values import frozen

AnyCurve: TypeAlias = Annotated[Curve, OneOf(lambda: CURVES, "curve")]


Ring: TypeAlias = tuple[int, float, float, float, float, bool, bytes]
"""Count, radius, turn, arc, spin, mirror and poses of an element: what says where its curve is drawn."""


@frozen(kw_only=True)
class Element(Dress):
    """A curve and its copies turned about the motif's centre.

    A copy is first turned by ``spin`` about its own centre, then set ``radius`` out along +x, then turned
    by ``turn`` and on by arc/count from copy to copy.
    """

    curve: Annotated[AnyCurve, Says("the curve drawn")]
    name: Annotated[str, Says("what the element is called in the file")] = ""
    count: Annotated[int, Between(1, 1000), Says("copies round the centre")] = 1
    radius: Annotated[float, Between(-1e3, 1e3), Says("distance of the copies from the centre")] = 0.0
    turn: Annotated[float, Between(-360, 360), Says("degrees to which the first copy is turned")] = 0.0
    arc: Annotated[float, Between(-360, 360), Says("degrees over which the copies are spread")] = 360.0
    spin: Annotated[float, Between(-360, 360), Says("degrees each copy is turned about itself")] = 0.0
    mirror: Annotated[bool, Says("also draw each copy's mirror image")] = False

    def __post_init__(self) -> None:
        check(self)
        # What is drawn by hand may be open by oversight; a spiral or a wave says so by its name.
        drawn = isinstance(self.curve, FunctionCurve | Outlined)
        if drawn and self.treatment in (Treatment.AREA, Treatment.CUT) and not self.curve.closed:
            raise GeometryError(
                'an open line has no area to fill: expected treatment = "line", "stroke" or "both", '
                "or a curve that is closed (path data end each subpath with Z)"
            )

    @classmethod
    def from_geometry(cls, geometry: Any, **look: Any) -> Element:
        """Return an element that draws geometry of shapely: polygons with holes, lines, several of them.

        Args:
            geometry: one, or a list or array of them, in motif units.
            look: the other fields of an element, such as ``ink`` and ``treatment``.

        Raises:
            GeometryError: where it is none, is empty, not finite or has points.
        """
        return cls(curve=OutlineCurve(outline_of(geometry)), **look)

    @property
    def ring(self) -> Ring:
        """What says where the curve is drawn."""
        return self.count, self.radius, self.turn, self.arc, self.spin, self.mirror, b""


def dressed(
    part: Dress,
    name: str,
    curve: Curve,
    count: int,
    *,
    turn: float = 0.0,
    radius: float = 0.0,
    arc: float = 360.0,
) -> Element:
    """Return an element that draws a curve in the look of a part of a motif."""
    look = {f.name: getattr(part, f.name) for f in fields(Dress)}
    return Element(curve=curve, name=name, count=count, turn=turn, radius=radius, arc=arc, **look)
