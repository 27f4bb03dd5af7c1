"""Where two opposite edges of a drawing's page show different things, and whether that was meant.

Tiles laid side by side make a field, and in the field an edge of the page is no place of its own. So ink may
end there by design, as that of a checkerboard does, or of stripes: its own outline runs along the edge. It
is another thing where the page cuts a mark off, and nothing goes on at the opposite edge.

What the page cuts is known, since bodies are read uncut. A file whose marks were cut before, at the page,
shows straight ends along the edge as well; those are taken for the drawing's own where the border leaves the
seam squarely at both ends, or meets another there, or where the drawing has the same corner elsewhere.
"""

from __future__ import annotations

import enum
import math
from collections import Counter
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.drawing import Drawing
from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.picture.corners import Corners, borders
from batik_vector.certificate.picture.ends import Ends
from batik_vector.certificate.picture.rim import Rim, Shown, shown
from batik_vector.certificate.report import Limits
from batik_vector.certificate.seam import Seam
from batik_vector.values import frozen

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

ALIKE, ALIKE_RAMP = 2 / 255, 6 / 255
"""By how much colours may differ and be the same; where a colour runs, half a step of it shows."""


class Cause(enum.StrEnum):
    """Why two edges show different things."""

    MEANT = "ends by design"
    CUT = "cut off"
    NICK = "a flat end"
    ORDER = "another order"
    TINT = "another tint"
    RAMP = "a colour that runs"


@frozen
class Joint:
    """A stretch of a seam whose two edges differ: ``low`` to ``high`` in steps on the near edge.

    ``near`` and ``far`` are the topmost bodies there, -1 where it is bare; ``body`` is the one to blame, and
    ``ending`` are those that show on one edge alone, each with whether that is the far one.
    """

    low: float
    high: float
    near: int
    far: int
    cause: Cause
    body: int
    ending: tuple[tuple[int, bool], ...] = ()

    @property
    def meant(self) -> bool:
        """Whether it is no fault."""
        return self.cause == Cause.MEANT


@frozen(eq=False)
class Joints:
    """All joints of one seam; ``mismatch`` (mm) is the longest stretch that was let pass.

    ``reach`` is how far (steps) from a joint its cause may lie: half the breadth of the broadest stroke.
    """

    seam: Seam
    joints: tuple[Joint, ...]
    mismatch: float
    reach: float

    @property
    def broken(self) -> tuple[Joint, ...]:
        """Those that are faults."""
        return tuple(each for each in self.joints if not each.meant)

    def touches(self, low: float, high: float) -> bool:
        """Whether a stretch of the seam (steps) lies at a fault, on the circle."""
        return any(self._meet(each, low, high) for each in self.broken)

    def untold(self, places: list[float]) -> list[Joint]:
        """Return the faults at none of the places (steps) that were told of already."""
        return [each for each in self.broken if not any(self._meet(each, place, place) for place in places)]

    def _meet(self, joint: Joint, low: float, high: float) -> bool:
        length = self.seam.length
        turn = np.rint(((joint.low + joint.high) / 2 - (low + high) / 2) / length) * length
        return bool(low + turn <= joint.high + self.reach and high + turn >= joint.low - self.reach)


def joints_of(rim: Rim, seam: Seam, tile: Drawing, limits: Limits) -> Joints:
    """Compare what two opposite edges show."""
    per_mm = seam.frame.per_mm
    near, far = shown(rim, seam, limits.position * per_mm, limits.hair * per_mm)
    return _Comparison(rim.bodies, seam, near, far, limits, tile).result()


class _Comparison:
    def __init__(
        self, bodies: Bodies, seam: Seam, near: Shown, far: Shown, limits: Limits, tile: Drawing
    ) -> None:
        self.bodies, self.seam, self.near, self.far = bodies, seam, near, far
        self.limit = limits.position * seam.frame.per_mm
        self.ends = Ends(bodies, seam, limits)
        self.corners = Corners(near, far, seam, tile, limits)

    def result(self) -> Joints:
        """Return the joints."""
        alike = ALIKE_RAMP if any(paint.runs for paint in self.bodies.paints) else ALIKE
        # Ink that stops a hair short of the edge shows a hair further inside.
        odd = np.ones(len(self.near.top), bool)
        for one, other in (
            (self.near.levels, self.far.levels),
            (self.near.deeper, self.far.levels),
            (self.near.levels, self.far.deeper),
        ):
            odd &= np.abs(one - other).max(axis=1, initial=0.0) > alike
        found: list[Joint] = []
        mismatch = 0.0
        for first, last in _runs(odd):
            size = self._thickness(float(self.near.cuts[first]), float(self.near.cuts[last]))
            if size <= self.limit:
                mismatch = max(mismatch, size)
            else:
                found += self._parts(first, last)
        for nick in self.ends.nicks():
            tops = (-1, nick.body) if nick.far else (nick.body, -1)
            found.append(Joint(nick.low, nick.high, *tops, Cause.NICK, nick.body))
        reach = self.limit + float(self.bodies.breadth.max(initial=0.0)) / 2 * self.seam.frame.per_mm
        return Joints(self.seam, tuple(found), mismatch / self.seam.frame.per_mm, reach)

    def _parts(self, first: int, last: int) -> list[Joint]:
        """Return the joints of a run of stretches that differ: one for each pair of things that meet."""
        pairs = [
            (self._look(self.near, i), self._look(self.far, i), self.near.top[i], self.far.top[i])
            for i in range(first, last)
        ]
        begins = [0, *(i for i in range(1, len(pairs)) if pairs[i] != pairs[i - 1]), len(pairs)]
        found = []
        for one, next_ in pairwise(begins):
            low, high = float(self.near.cuts[first + one]), float(self.near.cuts[first + next_])
            if self._thickness(low, high) > self.limit or len(begins) == 2:
                found.append(self._joint(low, high))
        return found or [self._joint(float(self.near.cuts[first]), float(self.near.cuts[last]))]

    def _thickness(self, low: float, high: float) -> float:
        """Return how thick (steps) a difference is: of borders that come in aslant, less than its length.

        Two borders out of register stand apart across themselves. A tip that pokes over the edge is as deep
        as the way to where its sides meet, and of a round mark that touches the edge half of that is lost.
        """
        if high - low <= self.limit or high - low > MOST_ASLANT * self.limit:
            return high - low
        ends = [
            [
                np.concatenate(
                    [borders(each, place, self.seam.length, 0.0)[0] for each in (side.spans, side.inner)]
                )
                for side in (self.near, self.far)
            ]
            for place in (low, high)
        ]
        thick = high - low
        for one in (0, 1):
            for a in ends[0][one].tolist():
                for b in ends[1][1 - one].tolist():
                    thick = min(thick, (high - low) * math.sqrt(1 - min(abs(a), abs(b)) ** 2))
                for b in ends[1][one].tolist():
                    closing = _slope(a) - _slope(b)
                    if closing > 0:
                        thick = min(thick, (high - low) / closing)
                    elif closing < 0 and not self._goes_on(low, high):
                        thick = min(thick, (high - low) / (-2 * closing))
        return thick

    def _goes_on(self, low: float, high: float) -> bool:
        """Whether a body that ends where a difference does goes on beyond the page there."""
        place, reach = (low + high) / 2, self.limit
        for side in (self.near, self.far):
            mine = side.spans.body[
                (np.abs(side.spans.low - low) <= reach) | (np.abs(side.spans.high - high) <= reach)
            ]
            there = (side.beyond.low <= place) & (place <= side.beyond.high)
            if np.isin(side.beyond.body[there], mine).any():
                return True
        return False

    def _look(self, side: Shown, row: int) -> tuple[object, ...]:
        body = int(side.top[row])
        if body >= 0 and self.bodies.paints[self.bodies.paint[body]].runs:
            return (int(self.bodies.paint[body]),)
        return tuple(np.round(side.levels[row], 3).tolist())

    def _joint(self, low: float, high: float) -> Joint:
        middle = (low + high) / 2
        stacks = [side.stack(middle, self.limit) for side in (self.near, self.far)]
        tops = [stack[0][0] if stack else -1 for stack in stacks]
        cause, body = self._cause(low, high, stacks)
        ending = [
            (body, bool(far))
            for far in (0, 1)
            for body, _ in _more(_visible(stacks[far], self.bodies), stacks[1 - far], self.bodies.paint)
        ]
        return Joint(low, high, tops[0], tops[1], cause, body, tuple(ending))

    def _cause(self, low: float, high: float, stacks: list[list[tuple[int, bool]]]) -> tuple[Cause, int]:
        paint, paints = self.bodies.paint, self.bodies.paints
        seen = [_visible(stack, self.bodies) for stack in stacks]
        kinds = [{int(paint[body]) for body, _ in each} for each in seen]
        odd = [_more(seen[i], seen[1 - i], paint) for i in (0, 1)]
        if not odd[0] and not odd[1]:
            running = [body for each in seen for body, _ in each if paints[paint[body]].runs]
            return (Cause.RAMP, running[0]) if running else (Cause.ORDER, seen[0][0][0] if seen[0] else -1)
        hidden = [{int(paint[body]) for body, cut in stack if cut} for stack in stacks]
        cut = [
            [body for body, goes_on in odd[i] if goes_on and not self.ends.reaches(body, low, high)]
            for i in (0, 1)
        ]
        lone = [[body for body in cut[i] if int(paint[body]) not in hidden[1 - i]] for i in (0, 1)]
        if not any(lone):
            if cut[0] and cut[1]:
                return Cause.ORDER, cut[0][0]
            body = (odd[0] or odd[1])[0][0]
            meant = self.corners.drawn(low, high) and not self.corners.displaced(low, high)
            return (Cause.MEANT if meant else Cause.CUT), body
        body = (lone[0] or lone[1])[0]
        mine, others = paints[paint[body]], (paints[i] for i in kinds[1 if lone[0] else 0])
        if mine.runs is False and any(o.runs is False and o.colour == mine.colour for o in others):
            return Cause.TINT, body
        return (Cause.RAMP if mine.runs and lone[0] and lone[1] else Cause.CUT), body


MOST_ASLANT = 20.0
"""How many times the limit a difference is looked at that borders may make which come in aslant."""


def _slope(lean: float) -> float:
    return lean / math.sqrt(max(1 - lean * lean, 1e-12))


def _visible(stack: list[tuple[int, bool]], bodies: Bodies) -> list[tuple[int, bool]]:
    """Return the bodies that show: those down to the first that nothing shows through."""
    seen = []
    for body, goes_on in stack:
        seen.append((body, goes_on))
        if bodies.paints[bodies.paint[body]].solid:
            break
    return seen


def _more(
    mine: list[tuple[int, bool]], others: list[tuple[int, bool]], paint: NDArray[np.intp]
) -> list[tuple[int, bool]]:
    """Return the bodies of a stack for which another has none of that paint left: those that end, first."""
    left = Counter(int(paint[body]) for body, _ in others)
    odd = []
    for body, goes_on in sorted(mine, key=lambda each: (not each[1], each[0])):
        kind = int(paint[body])
        left[kind] -= 1
        if left[kind] < 0:
            odd.append((body, goes_on))
    return sorted(odd, reverse=True)


def _runs(odd: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the runs of true values, as (first, past the last)."""
    steps = np.diff(np.concatenate([[0], odd.astype(np.int8), [0]]))
    return list(zip(np.flatnonzero(steps == 1).tolist(), np.flatnonzero(steps == -1).tolist(), strict=True))
