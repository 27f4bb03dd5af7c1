"""Layouts that fill the repeat: marks tossed or packed, and lines that run round it and close.

They are measured in mm on cloth and need to know the lattice: what they do is in
:mod:`batik_vector.tiling.tossing.toss` and :mod:`batik_vector.tiling.torus.stripes`.
"""

from __future__ import annotations

import enum
import math
from typing import Annotated, ClassVar

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, Useful, check
from batik_vector.tiling.layouts.base import Layout
from batik_vector.values import frozen


class Clear(enum.StrEnum):
    """What tossed marks keep clear of, beside one another."""

    TOSSED = "tossed"
    """All that earlier tosses of the recipe put down."""
    ALL = "all"
    """All that earlier placements of the recipe put down."""
    NONE = "none"
    """Nothing."""


@frozen(kw_only=True)
class Scattered(Layout):
    """Marks of one or several motifs over the whole repeat, none overlapping another, seam or no seam."""

    spreads: ClassVar[bool] = False
    kind: ClassVar[str] = ""
    """What it is called where a key is refused."""

    distance: Annotated[
        Annotated[Length, Between(0, 1000)], Says("least gap between two marks, outline to outline")
    ] = 1.0
    count: Annotated[
        Annotated[int, Between(1, 20_000)] | None,
        Says("marks to set down, which a symmetry multiplies; as many as fit when left out"),
    ] = None
    fill: Annotated[
        Annotated[float, Between(0.001, 1)] | None,
        Says("share of the repeat to cover, at which no more are set down"),
    ] = None
    turn: Annotated[
        tuple[Annotated[float, Between(-360, 360)], Annotated[float, Between(-360, 360)]],
        Says("degrees between which each mark is turned", called="turn from, turn to"),
    ] = (0.0, 360.0)
    turns: Annotated[
        tuple[Annotated[float, Between(-360, 360)], ...], Says("the only turns there are, instead of turn")
    ] = ()
    size: Annotated[
        tuple[Annotated[float, Between(0.01, 100)], Annotated[float, Between(0.01, 100)]],
        Says("sizes between which each mark is scaled by chance", called="least size, largest size"),
    ] = (1.0, 1.0)
    flip: Annotated[bool, Says("change left and right of one mark in two, by chance")] = False
    weights: Annotated[
        tuple[Annotated[float, Between(1e-6, 1e6)], ...],
        Says("how often each of several motifs comes; all alike when left out"),
    ] = ()
    clear: Annotated[Clear, Says("what marks keep clear of, beside one another")] = Clear.TOSSED
    tries: Annotated[
        int, Between(10, 100_000), Says("darts that must miss in a row for the repeat to be full")
    ] = 2000
    seed: Annotated[
        Annotated[int, Between(0, 2**63 - 1)] | None, Says("a seed of its own; the recipe's when left out")
    ] = None

    def __post_init__(self) -> None:
        check(self)
        for name, (low, high) in (("turn", self.turn), ("size", self.size)):
            if low > high:
                raise GeometryError(f"{name} = [{low:g}, {high:g}]: expected the lesser number first")
        if self.turns and self.turn != (0.0, 360.0):
            raise GeometryError("turn and turns are both given: expected one of them")


@frozen(kw_only=True)
class Toss(Scattered):
    """Marks scattered by chance and evenly over the whole repeat, none overlapping another, seam or no seam.

    Poisson-disc darts (Cook, "Stochastic sampling in computer graphics", 1986) with the real outlines for
    discs, thrown where holes are left, and then shifted until the gaps are even.
    """

    kind = "toss"

    settle: Annotated[
        int, Between(0, 100), Says("how often the marks are shifted to even out the gaps between them")
    ] = 12


@frozen(kw_only=True)
class Pack(Scattered):
    """Marks packed side by side over the whole repeat so that their outlines nestle, seam or no seam.

    Each is set down where it lies closest to those that are there, turned as that needs, and holes are
    filled with the largest that fit. Twice as much is covered as by a toss.
    """

    kind = "pack"

    tries: Annotated[
        int, Between(20, 5000), Useful(50, 1000), Says("places tried for each mark: more lie closer")
    ] = 120


@frozen(kw_only=True)
class FreeGround(Layout):
    """No motif: the marks of ``fill_with``, in all of the repeat that earlier placements leave free.

    They keep their margin to what lies there, go on over the seam, and keep the symmetry of the repeat where
    what lies there does. Rows at an angle keep to translations: they are drawn apart or aslant by so much
    that they close on the repeat, by 5 % at most.
    """

    spreads: ClassVar[bool] = False


@frozen(kw_only=True)
class Stripes(Layout):
    """Lines that run over the repeat and close on it: the motif, laid end to end along a lattice vector.

    The motif's x from 0 to 1 is one link. Links are stretched along so that a whole number of them makes up
    the vector p·a + q·b of the repeat's own translations a (across) and b (up). Bands (``parang``,
    ``lereng``) know how broad they are: with ``fit`` they lie side by side, without a gap or an overlap. Only
    lines along such a vector close; ``angle`` takes the one that comes nearest with bands of about the
    placement's size, and what came of it is told.
    """

    spreads: ClassVar[bool] = False
    count: Annotated[
        Annotated[int, Between(1, 2000)] | None,
        Says("lines, evenly spaced; when left out 12, or with fit as many bands as there is room for"),
    ] = None
    winding: Annotated[
        tuple[Annotated[int, Between(-60, 60)], Annotated[int, Between(-60, 60)]],
        Says("how often a line goes round the repeat across and up before it closes", called="across, up"),
    ] = (1, 0)
    angle: Annotated[
        Annotated[float, Between(-180, 180)] | None,
        Says("degrees at which the lines run, as nearly as they close; instead of winding"),
    ] = None
    fit: Annotated[bool, Says("make bands as broad as the distance of the lines")] = False
    links: Annotated[
        Annotated[int, Between(1, 10_000)] | None,
        Says("motifs end to end along a line; as many as keep their shape when left out"),
    ] = None
    flip: Annotated[bool, Says("mirror every other line at its own axis")] = False
    creep: Annotated[
        int, Between(-1000, 1000), Says("links by which lines creep ahead of one another over the repeat")
    ] = 0

    def __post_init__(self) -> None:
        check(self)
        if self.angle is not None and self.winding != (1, 0):
            raise GeometryError("winding and angle are both given: expected one of them")
        if math.gcd(*self.winding) != 1:
            p, q = self.winding
            common = math.gcd(p, q)
            near = f"[{p // common}, {q // common}]" if common else "[1, 0]"
            raise GeometryError(
                f"winding = [{p}, {q}]: the line would run over itself, expected numbers without a "
                f"common factor, such as {near}"
            )
        if self.flip and self.count and self.count % 2:
            raise GeometryError(f"count = {self.count}: lines flipped in turn close only when they are even")
