"""The L-system: what a turtle draws along a word that was rewritten again and again."""

from __future__ import annotations

import enum
import functools
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError, nearest, shortened
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Outlined
from batik_vector.geometry.lsystems import rounding
from batik_vector.geometry.lsystems.catalogue import NAMED, Named
from batik_vector.geometry.lsystems.contours import bodies
from batik_vector.geometry.lsystems.expansion import expanded
from batik_vector.geometry.lsystems.grammar import grammar_of
from batik_vector.geometry.lsystems.lattice import on_lattice
from batik_vector.geometry.lsystems.turtle import Complex, Gait, Walk, walked
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

WORDS = (
    'such as "F -> F+F--F+F"; "F: 2 -> FF" comes twice as often as another rule of F; "A(s) -> F(s)A(s/2)"'
)


class Origin(enum.StrEnum):
    """What of a turtle's drawing lies in the motif's centre."""

    MIDDLE = "middle"
    """The middle of the drawing."""
    START = "start"
    """Where the turtle begins."""
    LINK = "link"
    """Where it begins; and it is turned and scaled to end in (1, 0), as a link of stripes."""


@frozen(kw_only=True)
class Turtle:
    """What every L-system says of its words and of its turtle."""

    system: Annotated[str, Says("name of a known one, such as dragon; or axiom and rules of one's own")] = ""
    axiom: Annotated[str, Says("the word to begin with; the known one's when left out")] = ""
    rules: Annotated[tuple[str, ...], Says(f"what symbols are rewritten to: {WORDS}")] = ()
    level: Annotated[
        Annotated[int, Between(0, 60)] | None,
        Says("how often all symbols are rewritten; the known one's when left out"),
    ] = None
    angle: Annotated[
        Annotated[float, Between(-360, 360)] | None,
        Says("degrees of + and -; the known one's when left out, else 90"),
    ] = None
    heading: Annotated[
        Annotated[float, Between(-360, 360)] | None,
        Says("degrees to which the turtle looks first; the known one's when left out, else 0"),
    ] = None
    draws: Annotated[str, Says("letters that draw a step; the known one's when left out, else F")] = ""
    shrink: Annotated[float, Between(0.01, 100), Says('factor of the steps behind a "')] = 0.7
    width: Annotated[
        float, Between(0, 100), Says("breadth of the strokes in steps, as an area; 0 leaves lines, or rings")
    ] = 0.0
    taper: Annotated[
        float,
        Between(0.01, 1),
        Says("share of its breadth that a stroke ends with, and a branch begins with"),
    ] = 1.0
    round: Annotated[float, Between(0, 1), Says("how round its corners are; at 1 arcs meet in mid-step")] = (
        0.0
    )
    origin: Annotated[Origin, Says("what lies in the motif's centre")] = Origin.MIDDLE
    seed: Annotated[int, Between(0, 2**63 - 1), Says("which of the drawings that chance allows")] = 0

    @functools.cached_property
    def known(self) -> Named:
        """Return the words and the gait: those of the known system, or one's own."""
        if self.system and self.system not in NAMED:
            near = nearest(self.system, list(NAMED))
            hint = f'did you mean "{near}"?' if near else f"expected one of {', '.join(NAMED)}"
            raise GeometryError(f'system = "{shortened(self.system)}": {hint}')
        if self.system and (self.axiom or self.rules):
            raise GeometryError(
                f'axiom and rules stand beside system = "{self.system}": expected the one or the other'
            )
        if not self.system and not self.axiom:
            raise GeometryError(
                "an L-system needs a system or an axiom: expected a system that is known, such as dragon, or "
                "axiom and rules"
            )
        base = NAMED.get(self.system) or Named(self.axiom, self.rules, 90.0, "", 3)
        return Named(
            base.axiom,
            base.rules,
            base.angle if self.angle is None else self.angle,
            base.source,
            base.level if self.level is None else self.level,
            base.heading if self.heading is None else self.heading,
            self.draws or base.draws,
        )

    def walk(self, marks: str = "") -> Walk:
        """Return what the turtle draws, in motif units, and the poses at some symbols."""
        known = self.known
        grammar = grammar_of(known.axiom, known.rules, known.draws)
        word = expanded(grammar, known.level, self.seed)
        gait = Gait(known.angle, known.heading, self.shrink, self.taper)
        found = walked(word, known.draws, gait, marks)
        origin, unit = self._frame(found.points)
        poses = {
            symbol: ((at - origin) / unit, way * (abs(unit) / unit), size / abs(unit))
            for symbol, (at, way, size) in found.marks.items()
        }
        return Walk((found.points - origin) / unit, found.offsets, found.widths, poses)

    def _frame(self, points: Complex) -> tuple[complex, complex]:
        """Return the point that becomes the origin, and the vector that becomes (1, 0)."""
        if self.origin == Origin.MIDDLE:
            x, y = points.real, points.imag
            return complex((x.min() + x.max()) / 2, (y.min() + y.max()) / 2), 1 + 0j
        start = complex(points[0])
        if self.origin == Origin.START:
            return start, 1 + 0j
        span = complex(points[-1]) - start
        if abs(span) < 1e-9 * max(float(np.abs(points - start).max()), 1e-300):
            raise GeometryError('origin = "link": the line ends where it begins, expected one that leads on')
        return start, span


@frozen(kw_only=True)
class LSystem(Turtle, Outlined):
    """What a turtle draws along the word of an L-system: lines, rings where a line closes, or strokes.

    Letters that draw make a step, f one that is not drawn; + turns left, - right, | about; [ and ] begin and
    end a branch; " makes the steps behind it shorter, ! its strokes thinner. A symbol may carry a number, as
    F(2) or +(25). Systems known by name: koch-curve, koch-snowflake, koch-island, sierpinski-arrowhead,
    dragon, hilbert, gosper, levy, plant-weed, plant-bush, plant-spray, plant-fern, kolam-snake,
    kolam-anklets.
    Prusinkiewicz & Lindenmayer, The Algorithmic Beauty of Plants (1990).
    """

    def __post_init__(self) -> None:
        check(self)
        self.outline()

    @property
    def closed(self) -> bool:  # type: ignore[override]
        """Whether it bounds a region: by its strokes, or by rings alone."""
        return self.width > 0 or bool(self.outline().closed.all())

    def outline(self) -> Outline:
        """Return its lines, in the middle of its strokes."""
        return self._outline

    @property
    def _walk(self) -> Walk:
        return _walked(self)

    @property
    def _unit(self) -> float:
        """Return the length of a step in motif units."""
        walk = self._walk
        return float(np.abs(walk.points[1] - walk.points[0])) if self.origin == Origin.LINK else 1.0

    @functools.cached_property
    def _outline(self) -> Outline:
        walk = self._walk
        unit = self._unit
        return rounding.outlined(walk.points / unit, walk.offsets, self.round).moved((unit, 0, 0, unit, 0, 0))

    def region(self, tolerance: float) -> Geometries | None:
        """Return its strokes, welded, where they have a breadth."""
        if not self.width:
            return None
        walk, unit = self._walk, self._unit
        if self.taper == 1 and not self.round:
            found = on_lattice(walk.points, walk.offsets, self.width * unit, tolerance)
            if found is not None:
                return found
        points, offsets, widths = rounding.sampled(
            walk.points / unit, walk.offsets, walk.widths, self.round, tolerance / unit
        )
        return bodies(points * unit, offsets, widths * self.width * unit, tolerance)


@functools.lru_cache(maxsize=4)
def _walked(curve: LSystem) -> Walk:
    """Return what the turtle of a curve draws: kept for a moment only, since curves are kept for long."""
    return curve.walk()
