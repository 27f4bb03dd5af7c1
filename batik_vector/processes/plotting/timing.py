"""How long a pen takes: it gathers speed, brakes for corners and stops at both ends of every stroke.

Between two stops speed rises and falls by one acceleration and is held at the top: a trapezoid. A corner is
gone round as fast as the same acceleration holds a tool on the arc that stays within a small deviation of it:
Sonny Jeon, "Improving Grbl: Cornering Algorithm", 24 September 2011, as grbl does with its setting $11.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Outlines, Steps
from batik_vector.machines import Motion
from batik_vector.processes.ordering.distances import PARTS, distances
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Array: TypeAlias = NDArray[np.float64]

DEVIATION = 0.01
"""How far (mm) the tool may be thought to cut a corner: grbl's own default of $11."""


@frozen
class Pace:
    """How fast a machine goes.

    ``draw`` and ``travel`` are speeds with the pen down and up, in mm/s; ``acceleration`` in mm/s², 0 for a
    machine that is at its speed at once; ``lift`` is the time to lift and to lower the pen once, in s.
    """

    draw: float
    travel: float
    acceleration: float = 0.0
    lift: float = 0.0

    @classmethod
    def of(cls, motion: Motion) -> Pace:
        """Return how fast a machine of that profile goes."""
        return cls(motion.draw_speed, motion.travel_speed, motion.acceleration, motion.lift)


@frozen
class Taken:
    """What strokes take: mm with the pen down and up, how often it is lifted, and seconds, all together."""

    drawn: float
    travelled: float
    lifts: int
    seconds: float


def taken(strokes: Outlines, pace: Pace) -> Taken:
    """Return what it takes to draw strokes in their order, from the first point to the last.

    Args:
        strokes: one ring or polyline to a mark.
        pace: how fast.
    """
    points, rings = strokes.repeating()
    if len(points) < 2:
        return Taken(0.0, 0.0, len(strokes), len(strokes) * pace.lift)
    way = distances(points[1:], points[:-1])
    between = rings[1:-1] - 1
    up = way[between]
    way[between] = 0
    length = way / (PARTS * STEPS_PER_MM)
    square = _held(_cornering(points, rings, pace), length, pace.acceleration)
    drawing = _seconds(length, square[:-1], square[1:], pace.draw, pace.acceleration)
    away = up / (PARTS * STEPS_PER_MM)
    rest = np.zeros(len(away))
    going = _seconds(away, rest, rest, pace.travel, pace.acceleration)
    # The exact sum, which hangs on no order.
    seconds = math.fsum(drawing.tolist() + going.tolist()) + len(strokes) * pace.lift
    drawn, travelled = (int(each.sum()) / PARTS / STEPS_PER_MM for each in (way, up))
    return Taken(drawn, travelled, len(strokes), seconds)


def _cornering(points: Steps, rings: NDArray[np.int64], pace: Pace) -> Array:
    """Return the square of the speed that each point allows; strokes begin and end at rest."""
    step = np.diff(points, axis=0).astype(float)
    step /= np.maximum(np.sqrt((step * step).sum(axis=1)), 1.0)[:, None]
    straight = (step[1:] * step[:-1]).sum(axis=1)
    # The sine of half the angle that the two ways enclose: 1 straight on, 0 back.
    sine = np.sqrt(np.clip((1 + straight) / 2, 0.0, 1.0))
    radius = DEVIATION * sine / np.maximum(1 - sine, 1e-12)
    allowed = np.zeros(len(points))
    allowed[1:-1] = np.minimum(pace.acceleration * radius, pace.draw**2)
    allowed[rings[:-1]] = allowed[rings[1:] - 1] = 0.0
    return allowed


def _held(square: Array, length: Array, acceleration: float) -> Array:
    """Return squares of speeds that one acceleration can bring about between one point and the next.

    What a point allows is bound by every other: by no more than twice the acceleration times the way between.
    """
    gained = 2 * acceleration * np.concatenate([[0.0], np.cumsum(length)])
    forward = np.minimum.accumulate(square - gained) + gained
    back = np.minimum.accumulate((forward + gained)[::-1])[::-1] - gained
    return np.asarray(np.maximum(back, 0.0))


def _seconds(length: Array, begin: Array, end: Array, speed: float, acceleration: float) -> Array:
    """Return how long ways take, of which the squares of the speeds at both ends are known."""
    if acceleration <= 0:
        return length / speed
    peak = np.minimum(speed**2, (begin + end) / 2 + acceleration * length)
    top = np.sqrt(peak)
    ramps = (2 * top - np.sqrt(begin) - np.sqrt(end)) / acceleration
    level = np.maximum(length - (2 * peak - begin - end) / (2 * acceleration), 0.0)
    return np.asarray(ramps + level / speed)
