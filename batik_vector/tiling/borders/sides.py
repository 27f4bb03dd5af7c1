"""Borders: where the periods of a band come to lie along the sides of a cloth and round its corners.

Whole grid steps throughout. The corners of a window are numbered anticlockwise from the lower left one; a
side's own coordinates are x along it and y inwards, as those of :mod:`batik_vector.tiling.borders.bands`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.sampling import Points
from batik_vector.tiling.borders.bands import Band, Marks, Span, spans, together
from batik_vector.tiling.borders.bends import bent
from batik_vector.tiling.borders.joints import closed
from batik_vector.tiling.torus.torus import Window
from batik_vector.units import STEPS_PER_MM, format_mm
from batik_vector.values import frozen

SIDES = {"bottom": (0, 1), "right": (1, 2), "top": (2, 3), "left": (3, 0)}
"""Sides anticlockwise, each from the corner where it begins to the one where it ends."""

CORNER_NAMES = ("lower left", "lower right", "upper right", "upper left")

BACKWARDS = {"turn": (), "mirror": ("top", "left"), "mitre": ("right", "left")}
"""Which sides run the other way, so that opposite ones, or those that meet in a corner, are mirror images."""

INWARD = {"bottom": (0, 1), "right": (-1, 0), "top": (0, -1), "left": (1, 0)}

INWARDS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
"""Which way the window lies from each of its corners."""

TRIES = 33
"""How many stretches of the corners are compared to find one that suits all sides."""


@frozen
class Side:
    """A side of a window: where it begins, which way it runs, and the corners it joins."""

    name: str
    origin: tuple[int, int]
    along: tuple[int, int]
    length: int
    corners: tuple[int, int]

    def to_cloth(self, xy: Points) -> Points:
        """Return points of the side's own coordinates on the cloth."""
        axes = np.array([self.along, INWARD[self.name]], float)
        return np.asarray(xy @ axes + np.array(self.origin, float))


def corner_points(window: Window) -> list[tuple[int, int]]:
    """Return the corners of a window, anticlockwise from the lower left one."""
    return [
        (window.left, window.bottom),
        (window.right, window.bottom),
        (window.right, window.top),
        (window.left, window.top),
    ]


def sides_of(window: Window, names: Collection[str], manner: str) -> list[Side]:
    """Return sides of a window, anticlockwise from the lower one; ``manner`` is a key of ``BACKWARDS``."""
    points = corner_points(window)
    found = []
    for name, ends in SIDES.items():
        if name not in names:
            continue
        begin, end = ends[::-1] if name in BACKWARDS[manner] else ends
        (x0, y0), (x1, y1) = points[begin], points[end]
        length = abs(x1 - x0) + abs(y1 - y0)
        along = (x1 - x0) // max(length, 1), (y1 - y0) // max(length, 1)
        found.append(Side(name, (x0, y0), along, length, (begin, end)))
    return found


def turned_corners(names: Collection[str]) -> frozenset[int]:
    """Return the corners where two of the sides meet."""
    ends = [corner for name, both in SIDES.items() if name in names for corner in both]
    return frozenset(corner for corner in ends if ends.count(corner) == 2)


def corner_square(window: Window, corner: int, manner: str) -> Callable[[Points], Points]:
    """Return the map that brings a square drawn for the lower left corner to another: turned, or mirrored."""
    x, y = INWARDS[corner]
    axes = np.array([(x, 0), (0, y)] if manner == "mirror" or x == y else [(0, y), (x, 0)], float)
    origin = np.array(corner_points(window)[corner], float)
    return lambda xy: np.asarray(xy @ axes + origin)


@frozen
class Course:
    """A side with the spans laid along it; ``arc`` spans bend round the corner at its end.

    ``stretch`` is the factor on the period that is farthest from 1, ``periods`` how many the side holds.
    """

    side: Side
    spans: list[Span]
    mitres: tuple[bool, bool]
    periods: float
    stretch: float
    arc: tuple[Span, ...] = ()

    def laid(self, band: Band, radius: int, tolerance: float) -> Marks:
        """Return a band's marks along the side, on the cloth."""
        parts = [band.laid(self.spans, self.mitres, self.side.length)]
        if self.arc:
            length = self.arc[-1].end
            flat = closed(band.laid(self.arc, (False, False), length), band.merges).opened_at(
                Window(0, 0, length, band.depth)
            )
            start = (self.side.length - radius, 0)
            parts.append(bent(flat, length, radius, tolerance, band.merges).moved(lambda xy: xy + start))
        return together(parts).moved(self.side.to_cloth)


@frozen
class Measures:
    """What all sides of a border share: in grid steps, and the limit as a share of the period.

    ``phase`` is where in a period sides begin; ``whole`` says whether they end with a whole one at an edge of
    the cloth.
    """

    period: int
    depth: int
    phase: int
    whole: bool
    limit: float

    def spans(self, first: int, last: int, begin: int, end: int) -> list[Span]:
        """Return the drawing from ``first`` to ``last`` behind the phase, laid from ``begin`` to ``end``."""
        return spans(self.phase + first, self.phase + last, begin, end, self.period)


def straight(sides: Sequence[Side], corners: Collection[int], m: Measures) -> list[Course]:
    """Lay a band that ends in front of corner squares, or at the edges of the cloth.

    Raises:
        GeometryError: where a period would be stretched past the limit, or there is no room.
    """
    found = []
    runs = []
    for side in sides:
        begin, end = (m.depth if corner in corners else 0 for corner in side.corners)
        run = side.length - begin - end
        if run <= 0:
            raise _no_room(side, begin + end)
        runs.append(run)
        fits = m.whole or bool(begin and end)
        count = max(1, round(run / m.period)) if fits else 0
        first, last = (0, count * m.period) if fits else (-(run // 2), run - run // 2)
        stretch = run / (last - first)
        laid = m.spans(first, last, begin, begin + run)
        found.append(Course(side, laid, (False, False), (last - first) / m.period, stretch))
    _refuse_past_limit(found, runs, m)
    return found


def mitred_round(sides: Sequence[Side], corners: Collection[int], m: Measures) -> list[Course]:
    """Lay a band that is cut along the 45° line of each corner, where it meets its mirror image.

    The two sides that meet must be stretched alike as far as the corner reaches. So periods near corners
    have one stretch on all sides, and those between take up what is left.

    Raises:
        GeometryError: where a period would be stretched past the limit, or there is no room.
    """
    mitres = {side.name: (side.corners[0] in corners, side.corners[1] in corners) for side in sides}
    for side in sides:
        if side.length <= sum(mitres[side.name]) * m.depth:
            raise _no_room(side, sum(mitres[side.name]) * m.depth)
    counts = {side.name: max(1, round(side.length / m.period)) for side in sides}
    means = [
        side.length / (counts[side.name] * m.period) for side in sides if m.whole or all(mitres[side.name])
    ] or [1.0]

    def courses(stretch: float, lay: bool = False) -> list[Course]:
        return [_mitred(side, mitres[side.name], counts[side.name], stretch, sides, m, lay) for side in sides]

    tried = np.linspace(min(means), max(means), TRIES).tolist()
    best = min(tried, key=lambda stretch: max(abs(course.stretch - 1) for course in courses(stretch)))
    _refuse_past_limit(courses(best), [side.length for side in sides], m)
    return courses(best, lay=True)


def _mitred(
    side: Side,
    mitres: tuple[bool, bool],
    count: int,
    stretch: float,
    sides: Sequence[Side],
    m: Measures,
    lay: bool,
) -> Course:
    """Lay one side of which the corners have a given stretch, or measure how it would be stretched only."""
    ends = sum(mitres)
    zone = math.ceil(m.depth / (stretch * m.period) - 1e-9) * m.period
    if any(other.length < 2.5 * stretch * zone for other in sides):
        # No whole periods fit beside the corners: what is stretched alike ends with the corner itself.
        zone = math.ceil(m.depth / stretch)
    room = max(round(stretch * zone), m.depth)
    if m.whole or ends == 2:
        first, last = 0, count * m.period
    else:
        drawn = round(side.length / stretch)
        first, last = (0, drawn) if mitres[0] or not ends else (-drawn, 0)
    inner = [
        first + zone * mitres[0],
        last - zone * mitres[1],
        room * mitres[0],
        side.length - room * mitres[1],
    ]
    if inner[1] <= inner[0] or inner[3] <= inner[2]:
        worst = math.inf
    else:
        between = (inner[3] - inner[2]) / (inner[1] - inner[0])
        worst = max([stretch, between] if ends else [between], key=lambda each: abs(each - 1))
    laid: list[Span] = []
    if lay:
        laid += m.spans(first, inner[0], 0, room) if mitres[0] else []
        laid += m.spans(inner[0], inner[1], inner[2], inner[3])
        laid += m.spans(inner[1], last, side.length - room, side.length) if mitres[1] else []
    return Course(side, laid, mitres, (last - first) / m.period, worst)


def bent_round(sides: Sequence[Side], corners: Collection[int], radius: int, m: Measures) -> list[Course]:
    """Lay a band that runs on round its corners, bent on circles of ``radius`` at its outer edge.

    Along its middle every period is stretched alike. A band that goes all round begins in the middle of the
    lower side, and has an even number of periods if the limit lets it: then a half turn maps it to itself.

    Raises:
        GeometryError: where a period would be stretched past the limit, or there is no room.
    """
    for side in sides:
        need = sum(corner in corners for corner in side.corners) * radius
        if side.length < need:
            raise _no_room(side, need)
    found = []
    for chain in _chains(sides, corners):
        found += _bent_chain(chain, corners, radius, m)
    return found


def _chains(sides: Sequence[Side], corners: Collection[int]) -> list[list[Side]]:
    """Return the sides in runs that are joined by corners, each from its beginning."""
    if len(corners) == len(SIDES):
        return [list(sides)]
    by_start = {side.corners[0]: side for side in sides}
    chains = []
    for side in sides:
        if side.corners[0] in corners:
            continue
        chain = [side]
        while chain[-1].corners[1] in corners:
            chain.append(by_start[chain[-1].corners[1]])
        chains.append(chain)
    return chains


def _bent_chain(chain: list[Side], corners: Collection[int], radius: int, m: Measures) -> list[Course]:
    ring = len(corners) == len(SIDES)
    quarter = (radius - m.depth / 2) * math.pi / 2
    stops = []
    for side in chain:
        begin, end = (radius if corner in corners else 0 for corner in side.corners)
        stops.append((begin, side.length - end, quarter if end else 0.0))
    total = sum(end - begin + arc for begin, end, arc in stops)
    count = _count(total, chain, ring, m)
    drawn = count * m.period if count else round(total)
    # A ring begins in the middle of its first side; what is trimmed is so from its middle.
    behind = (stops[0][1] - stops[0][0]) / 2 if ring else 0.0 if count else total / 2
    lengths = [length for begin, end, arc in stops for length in (end - begin, arc)]
    knots = np.rint((np.cumsum([0.0, *lengths]) - behind) * (drawn / total)).astype(np.int64).tolist()
    knots[-1] = knots[0] + drawn
    found = []
    for number, (side, (begin, end, arc)) in enumerate(zip(chain, stops, strict=True)):
        q = knots[2 * number : 2 * number + 3]
        laid = m.spans(q[0], q[1], begin, end) if end > begin else []
        bow = tuple(m.spans(q[1], q[2], 0, q[2] - q[1])) if arc else ()
        found.append(Course(side, laid, (False, False), (q[2] - q[0]) / m.period, total / drawn, bow))
    _refuse_past_limit(found[:1], [round(total)], m, "the way round")
    return found


def _count(total: float, chain: list[Side], ring: bool, m: Measures) -> int:
    """Return how many periods a chain holds; 0 where it is trimmed."""
    if not ring:
        return max(1, round(total / m.period)) if m.whole else 0
    square = len({side.length for side in chain}) == 1
    for even in (4, 2) if square else (2,):
        count = max(1, round(total / m.period / even)) * even
        if abs(total / (count * m.period) - 1) <= m.limit:
            return count
    return max(1, round(total / m.period))


def _no_room(side: Side, need: int) -> GeometryError:
    return GeometryError(
        f"the {side.name} side is {format_mm(side.length / STEPS_PER_MM)} mm long, its corners alone take "
        f"{format_mm(need / STEPS_PER_MM)} mm: expected a larger cloth or a smaller depth"
    )


def _refuse_past_limit(
    courses: Sequence[Course], lengths: Sequence[int], m: Measures, what: str = ""
) -> None:
    """Raise where a course is stretched past the limit, with the period and the lengths that would do."""
    stretch = [course.stretch for course in courses]
    if all(abs(each - 1) <= m.limit + 1e-12 for each in stretch):
        return
    # Each side by itself: what sides do to one another at mitres is told only where each would fit alone.
    alone = [_alone(course, length, m) for course, length in zip(courses, lengths, strict=True)]
    shared = not what and all(abs(each - 1) <= m.limit + 1e-12 for each in alone)
    if not what and not shared:
        stretch = alone
    worst = max(range(len(courses)), key=lambda i: abs(stretch[i] - 1))
    period = m.period / STEPS_PER_MM
    run = lengths[worst] / STEPS_PER_MM
    offers = [format_mm(k * period) for k in (math.floor(run / period), math.floor(run / period) + 1) if k]
    spoken = what or f"the {courses[worst].side.name} side"
    percent = "" if math.isinf(stretch[worst]) else f" by {abs(stretch[worst] - 1):.1%}"
    verb = "stretched" if stretch[worst] > 1 else "squeezed"
    near = _nearest_period(lengths, m)
    raise GeometryError(
        f"{spoken}, {format_mm(run)} mm, holds {run / period:.2f} periods of {format_mm(period)} mm: "
        f"{'to meet the other sides at its corners ' if shared else ''}"
        f"they would be {verb}{percent}, past the limit of {m.limit:.1%}; expected "
        + (f"a period of {format_mm(near)} mm, or " if near else "")
        + f"{' or '.join(offers)} mm of length"
    )


def _alone(course: Course, length: int, m: Measures) -> float:
    """Return the factor on the period that brings a whole number of periods to a length."""
    return length / (course.periods * m.period) if course.periods.is_integer() else course.stretch


def _nearest_period(lengths: Sequence[int], m: Measures) -> float:
    """Return the period (mm) nearest to the one asked for of which all lengths hold whole numbers; or 0."""
    tried = []
    for length in lengths:
        near = max(1, round(length / m.period))
        for count in range(max(1, near - 4), near + 5):
            period = length / count
            off = max(abs(each / (max(1, round(each / period)) * period) - 1) for each in lengths)
            if off <= 0.75 * m.limit:
                tried.append(period)
    best = min(tried, key=lambda period: abs(period - m.period), default=0.0)
    return best / STEPS_PER_MM


def inner_shape(window: Window, radii: Sequence[int], segments: int) -> shapely.Polygon:
    """Return a window with its corners, anticlockwise from the lower left one, rounded by the radii."""
    parts: list[NDArray[np.float64]] = []
    for number, (point, inward, radius) in enumerate(zip(corner_points(window), INWARDS, radii, strict=True)):
        if not radius:
            parts.append(np.array([point], float))
            continue
        angle = np.pi * (1 + number / 2) + np.linspace(0, np.pi / 2, segments + 1)
        centre = np.array(point) + radius * np.array(inward)
        parts.append(np.rint(centre + radius * np.column_stack([np.cos(angle), np.sin(angle)])))
    return shapely.Polygon(np.concatenate(parts))
