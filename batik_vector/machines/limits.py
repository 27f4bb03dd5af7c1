"""What a machine or a workshop can still do: the limits that an audit measures a drawing against."""

from __future__ import annotations

import enum
from typing import Annotated

from batik_vector.fields import Between, Length, Says, check
from batik_vector.values import frozen


class Twice(enum.StrEnum):
    """Which paths drawn again are told of."""

    NO = "no"
    """None: to draw once more does no harm."""
    INK = "ink"
    """What an ink draws again that it has drawn."""
    ALL = "all"
    """What is drawn again by any ink: a cutter cuts all layers into one sheet."""


@frozen(kw_only=True)
class Limits:
    """Limits in mm on cloth; what is not set is not measured."""

    narrowest_line: Annotated[
        Annotated[Length, Between(0.001, 1000)] | None, Says("narrowest line, or neck of an area")
    ] = None
    narrowest_gap: Annotated[
        Annotated[Length, Between(0.001, 1000)] | None, Says("narrowest bare gap between marks of one ink")
    ] = None
    smallest_hole: Annotated[
        Annotated[Length, Between(0.001, 1000)] | None, Says("smallest hole: the disc that must fit in")
    ] = None
    sliver: Annotated[
        Annotated[Length, Between(0.001, 1000)] | None,
        Says("marks and holes narrower than this all over are slivers, which nobody meant to draw"),
    ] = None
    most_nodes: Annotated[
        Annotated[float, Between(0.001, 1000)] | None, Says("most nodes to a mm of path, over 16 in a row")
    ] = None
    closed: Annotated[bool, Says("paths must be closed: a knife cuts open ones free of nothing")] = False
    repeats: Annotated[
        bool,
        Says("it repeats the tile itself, as a screen does: the tile has to fit its size, not the cloth"),
    ] = False
    twice: Annotated[Twice, Says("which paths drawn again are told of")] = Twice.NO

    def __post_init__(self) -> None:
        check(self)
