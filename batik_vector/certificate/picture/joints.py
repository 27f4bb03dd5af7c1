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
import shapely
from numpy.typing import NDArray

from batik_vector.certificate.drawing import SNAP, Drawing
from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.picture.rim import ROUNDING, Rim, Shown, Spans, shown
from batik_vector.certificate.report import Limits
from batik_vector.certificate.seam import Seam
from batik_vector.values import frozen

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

ALIKE, ALIKE_RAMP = 2 / 255, 6 / 255
"""By how much colours may differ and be the same; where a colour runs, half a step of it shows."""

SQUARE = np.sin(np.radians(0.5))
"""How far a border may lean and still leave the seam squarely."""

STRAIGHT_MM = 0.2
"""How long (mm) the piece of border must be that leaves the seam squarely, or the drawing's own corner's."""

SHORT_MM = 0.05
"""How long (mm) a piece of border along the seam must be, inside the page, for its corners to count."""

SMOOTH = np.sin(np.radians(3.0))
"""How far the borders of both sides may lean apart and still go on in one another."""

FLAT = np.cos(np.radians(15.0))
"""How far a border leans that leaves along the seam, as at a rounded corner."""

CORNER = 1.0
"""Degrees by which corners may differ and be the same."""

PARALLEL = np.tan(np.radians(0.2))


DISPLACED = 0.05
"""Share of a seam within which borders that do not meet are one, out of register: no step was drawn."""


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
        self.displaced = limits.reach * seam.frame.per_mm
        self.tile = tile
        self._corners: Floats | None = None

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
        found += self._nicks()
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
                    [_borders(each, place, self.seam.length, 0.0)[0] for each in (side.spans, side.inner)]
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
                    elif closing < 0 and not self._goes_on((low + high) / 2):
                        thick = min(thick, (high - low) / (-2 * closing))
        return thick

    def _goes_on(self, place: float) -> bool:
        """Whether any body goes on beyond the page there."""
        return any(
            ((side.beyond.low <= place) & (place <= side.beyond.high)).any() for side in (self.near, self.far)
        )

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
        kinds = [{int(self.bodies.paint[body]) for body, _ in stack} for stack in stacks]
        ending = [
            (body, bool(far))
            for far in (0, 1)
            for body, _ in _visible(stacks[far], self.bodies)
            if int(self.bodies.paint[body]) not in kinds[1 - far]
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
            [body for body, goes_on in odd[i] if goes_on and not self._ends(body, low, high)] for i in (0, 1)
        ]
        lone = [[body for body in cut[i] if int(paint[body]) not in hidden[1 - i]] for i in (0, 1)]
        if not any(lone):
            if cut[0] and cut[1]:
                return Cause.ORDER, cut[0][0]
            body = (odd[0] or odd[1])[0][0]
            meant = self._designed(low, high) and not self._displaced(low, high)
            return (Cause.MEANT if meant else Cause.CUT), body
        body = (lone[0] or lone[1])[0]
        mine, others = paints[paint[body]], (paints[i] for i in kinds[1 if lone[0] else 0])
        if mine.runs is False and any(o.runs is False and o.colour == mine.colour for o in others):
            return Cause.TINT, body
        return (Cause.RAMP if mine.runs and lone[0] and lone[1] else Cause.CUT), body

    def _nicks(self) -> list[Joint]:
        """Return the nicks that show where lines come in aslant and end flat, on the edge."""
        bodies, seam, per_mm = self.bodies, self.seam, self.seam.frame.per_mm
        found: dict[int, Joint] = {}
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
                tops = (-1, int(mine[0])) if far else (int(mine[0]), -1)
                found.setdefault(round(place), Joint(low, high, *tops, Cause.NICK, int(mine[0])))
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

    def _end_places(self, body: int) -> Floats:
        """Return where on this seam, in steps, the line ends whose body this is."""
        owner = self.bodies.owner[body]
        if owner < 0:
            return np.empty(0)
        seam, per_mm = self.seam, self.seam.frame.per_mm
        ends = self.bodies.ends[self.bodies.end_owner == owner] * per_mm
        across, along = ends[:, seam.axis], ends[:, 1 - seam.axis]
        on_near, on_far = (np.abs(across - edge) <= SNAP * per_mm for edge in (seam.near, seam.far))
        return np.asarray(np.concatenate([along[on_near], along[on_far] - seam.slip]) % seam.length)

    def _ends(self, body: int, low: float, high: float) -> bool:
        """Whether a stroke reaches over the edge there by no more than the cap of an end that lies on it."""
        half = self.bodies.breadth[body] / 2 * self.seam.frame.per_mm * 1.01 + self.limit
        places = self._end_places(body)
        return bool(self._near(places, low, high, half).any())

    def _near(self, places: Floats, low: float, high: float, reach: float) -> NDArray[np.bool_]:
        """Tell within reach of which places on the circle a stretch wholly lies."""
        length = self.seam.length
        turned = places + np.rint(((low + high) / 2 - places) / length) * length
        return np.asarray((low >= turned - reach) & (high <= turned + reach))

    def _designed(self, low: float, high: float) -> bool:
        """Whether both ends of a stretch look like the drawing's own corners."""
        length = float(self.seam.length)
        if high - low >= length - ROUNDING:
            return True
        return all(self._own_corner(place) for place in (low, high))

    def _displaced(self, low: float, high: float) -> bool:
        """Whether a border of either edge ends the stretch, and they are so near that they ought to meet."""
        if high - low > min(self.displaced, DISPLACED * self.seam.length):
            return False
        near, far = (
            [len(_borders(side.spans, place, self.seam.length, self.limit)[0]) for place in (low, high)]
            for side in (self.near, self.far)
        )
        return near in ([1, 0], [0, 1]) and far == near[::-1]

    def _own_corner(self, place: float) -> bool:
        """Whether a stretch ends at a place as no page would end it that cuts a mark off."""
        borders = [
            _borders(side.spans, place, self.seam.length, self.limit) for side in (self.near, self.far)
        ]
        (here, one), (there, other) = borders
        lean, run = (np.concatenate(parts) for parts in zip(*borders, strict=True))
        straight = STRAIGHT_MM * self.seam.frame.per_mm
        # Where more than two borders meet, or one leaves along the edge, the corner was drawn.
        if len(lean) not in (1, 2) or np.abs(lean).max() >= FLAT:
            return True
        if len(lean) == 2 and not (len(here) and len(there)) and np.ptp(lean) > SMOOTH:
            return True
        if len(here) and len(there):
            # A curve that goes straight on, in another colour, is one mark in two halves.
            return not (abs(here[0] + there[0]) <= SMOOTH and min(one[0], other[0]) < straight)
        if ((run >= straight) & (np.abs(lean) <= SQUARE)).any():
            return True
        own = self._inner_corners()
        turns = np.degrees(np.arccos(np.clip(np.concatenate([lean, -lean]), -1, 1)))
        return bool(len(own) and (np.abs(turns[:, None] - own[None, :]).min(axis=1) <= CORNER).any())

    def _inner_corners(self) -> Floats:
        """Return by how many degrees borders turn, inside the page, at the ends of pieces along this seam."""
        if self._corners is None:
            seam = self.seam
            found = []
            for ink in self.tile:
                step = (ink.rings.end - ink.rings.begin).astype(np.float64)
                run, rise = np.abs(step[:, 1 - seam.axis]), np.abs(step[:, seam.axis])
                at = ink.rings.begin[:, seam.axis]
                mine = (rise <= PARALLEL * run) & (run >= SHORT_MM * seam.frame.per_mm)
                mine &= (at > seam.near + self.limit) & (at < seam.far - self.limit)
                found += [ink.rings.turn_begin[mine], ink.rings.turn_end[mine]]
            turns = np.degrees(np.concatenate(found)) if found else np.empty(0)
            self._corners = np.unique(np.round(turns[np.isfinite(turns) & (turns > 5)], 2))
        return self._corners


ON_EDGE = 0.02
"""How near (mm) to an edge a line ends that ends on it."""

MOST_ASLANT = 20.0
"""How many times the limit a difference is looked at that borders may make which come in aslant."""


def _slope(lean: float) -> float:
    return lean / math.sqrt(max(1 - lean * lean, 1e-12))


def _turned(apart: Floats, length: int) -> Floats:
    return np.asarray((apart + length / 2) % length - length / 2)


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


def _borders(spans: Spans, place: float, length: int, reach: float) -> tuple[Floats, Floats]:
    """Return lean and run of the borders that leave an edge at a place."""
    ends = np.column_stack([spans.low, spans.high])
    on = (np.abs(_turned(ends - place, length)) <= reach + ROUNDING) & (spans.run > 0)
    return spans.lean[on], spans.run[on]


def _runs(odd: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the runs of true values, as (first, past the last)."""
    steps = np.diff(np.concatenate([[0], odd.astype(np.int8), [0]]))
    return list(zip(np.flatnonzero(steps == 1).tolist(), np.flatnonzero(steps == -1).tolist(), strict=True))
