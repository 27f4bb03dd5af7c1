"""SVG path data, parsed to outlines of lines and cubic Béziers.

Quadratic Béziers become cubic exactly. Arcs become cubics of at most 22.5°, whose error is 7e-8 of the
radius (a twentieth of a µm at a metre).
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import compress

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.fields.fitting import shown
from batik_vector.geometry.paths.outline import CONTROL, CURVE, EMPTY, LINE, MOVE, Outline
from batik_vector.geometry.sampling import Points
from batik_vector.patterns import NUMBER, numbers_in

MAX_ARC = math.pi / 8


_COMMAND = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*)")
_TOKEN = re.compile(rf"{NUMBER}|[^\s,]")
_LETTERS = frozenset("MmZzLlHhVvCcSsQqTt")
_MOVES = [ord(letter) for letter in "MmZz"]
LONG_TEXT = 400
"""Characters from which path data are read at once."""
_ARC = re.compile(
    r"[\s,]*+({0})[\s,]*+({0})[\s,]*+({0})[\s,]*+([01])[\s,]*+([01])[\s,]*+({0})[\s,]*+({0})".replace(
        "{0}", NUMBER
    )
)
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


def parse_path(text: str) -> Outline:
    """Return the outline that path data draw (SVG 2, 9.3); a mere move draws no subpath.

    Raises:
        ValueError: where the data break off or are none.
    """
    pen = _Pen()
    for letter, numbers in _tokens(text) or _commands(text):
        pen.command(letter, numbers)
    return pen.outline()


FARTHEST = 1e6
"""Coordinates of a curve at most: floats then tell places apart to a part in 10¹⁰ of them."""


@functools.lru_cache(maxsize=64)
def path_of(text: str, upward: bool = False, centre: tuple[float, float] = (0.0, 0.0)) -> Outline:
    """Return the outline that path data draw, y up. Kept: a recipe asks for it again and again.

    Args:
        text: path data.
        upward: whether their y points up; as SVG has it, it points down.
        centre: the point of theirs that becomes the origin.

    Raises:
        GeometryError: where they cannot be read, draw nothing, or reach too far.
    """
    try:
        outline = parse_path(text)
    except ValueError as error:
        raise GeometryError(f"d = {shown(text)}: {error}") from None
    if not len(outline.points) or not np.ptp(outline.points, axis=0).any():
        raise GeometryError(f'd = {shown(text)} draws nothing, expected path data such as "M0 0L2 0L1 2Z"')
    if (far := float(np.abs(outline.points).max())) > FARTHEST:
        words = f"reaches as far as {far:.3g}, expected coordinates up to {FARTHEST:,.0f}"
        raise GeometryError(f"d = {shown(text)} {words}")
    flip = 1.0 if upward else -1.0
    return outline.moved((1.0, 0.0, 0.0, flip, -centre[0], -flip * centre[1]))


def _tokens(text: str) -> list[tuple[str, Points]] | None:
    """Return the commands of long, sound path data without arcs, read at once; None of any other."""
    if len(text) < LONG_TEXT or "a" in text or "A" in text:
        return None
    tokens = _TOKEN.findall(text)
    letters = np.array([token in _LETTERS for token in tokens], bool)
    places = np.flatnonzero(letters)
    if not len(places) or places[0] != 0:
        return None
    try:
        numbers = np.array(list(map(float, compress(tokens, (~letters).tolist()))))
    except ValueError:
        return None
    names = [tokens[i] for i in places.tolist()]
    takes = np.array([_TAKES[name.upper()] for name in names])
    counts = np.diff(np.append(places, len(tokens))) - 1
    sound = np.where(takes > 0, (counts > 0) & (counts % np.maximum(takes, 1) == 0), counts == 0)
    if not (sound.all() and np.isfinite(numbers).all()):
        return None
    code = np.array([ord(name) for name in names])
    # One letter again and again, as some programs write it, is one command with many arguments.
    new = np.append(True, (code[1:] != code[:-1]) | np.isin(code[1:], _MOVES))
    firsts = np.flatnonzero(new)
    ends = np.cumsum(counts)[np.append(firsts[1:], len(names)) - 1]
    begins = np.append(0, ends[:-1])
    return [
        (names[i], numbers[low:high].reshape(-1, max(int(takes[i]), 1)))
        for i, low, high in zip(firsts.tolist(), begins.tolist(), ends.tolist(), strict=True)
    ]


def _commands(text: str) -> Iterator[tuple[str, Points]]:
    """Yield the commands of path data, and fail where they break off."""
    at = 0
    letter, run = "", list[float]()
    for match in _COMMAND.finditer(text):
        if text[at : match.start()].strip():
            break
        at = match.end()
        if match[1] != letter or letter in "MmZz":
            if letter:
                yield letter, _arguments(letter, run)
            letter, run = match[1], []
        run += _numbers(letter, match[2])
    if letter:
        yield letter, _arguments(letter, run)
    if text[at:].strip():
        raise ValueError(f'path data "…{text[at : at + 40].strip()}" cannot be read')


def _numbers(letter: str, text: str) -> list[float]:
    command = letter.upper()
    if command == "A":
        found, at = list[float](), 0
        while match := _ARC.match(text, at):
            found += map(float, match.groups())
            at = match.end()
        read = None if text[at:].strip(" \t\r\n,") else found
    else:
        read = numbers_in(text)
    if read is None:
        raise ValueError(f'path data "{letter}{text[:40]}" cannot be read')
    takes = _TAKES[command]
    if (len(read) % takes if takes else len(read)) or (takes and not read):
        some = f"{takes} or a multiple" if takes else "none"
        count = f"{len(read)} number{'' if len(read) == 1 else 's'}"
        raise ValueError(f'path command "{letter}" has {count}, expected {some}')
    return read


def _arguments(letter: str, read: list[float]) -> Points:
    """Return the numbers of a command, one row for each time that it is carried out."""
    numbers = np.array(read, float)
    if not np.isfinite(numbers).all():
        raise ValueError(f'path command "{letter}" has a number that is not finite')
    return numbers.reshape(-1, _TAKES[letter.upper()] or 1)


@dataclass
class _Pen:
    """Draws command after command; the points of one command are worked out together."""

    points: list[Points] = field(default_factory=list)
    kinds: list[NDArray[np.uint8]] = field(default_factory=list)
    closed: list[bool] = field(default_factory=list)
    at: Points = field(default_factory=lambda: np.zeros(2))
    begin: Points = field(default_factory=lambda: np.zeros(2))
    handle: Points = field(default_factory=lambda: np.zeros(2))
    last: str = ""
    open: bool = False

    def command(self, letter: str, numbers: Points) -> None:
        command, relative = letter.upper(), letter.islower()
        if not self.last and command != "M":
            raise ValueError(f'path data begin with "{letter}", expected "M"')
        if command == "Z":
            if self.open:
                if self.last == "M" and self.kinds[-1][-1] == MOVE:
                    # Of no length, yet closed: caps make a dot of it.
                    self._add(self.begin[None], LINE)
                self.closed[-1] = True
            self.at, self.open = self.begin, False
        elif command == "M":
            self._move(numbers[0] + self.at if relative else numbers[0])
            if len(numbers) > 1:
                self._lines(_chained(numbers[1:], self.at) if relative else numbers[1:])
        else:
            draw: Callable[[Points, bool], None] = getattr(self, f"_draw_{command.lower()}")
            draw(numbers, relative)
        self.last = command

    def outline(self) -> Outline:
        if not self.points:
            return EMPTY
        points, kinds = np.concatenate(self.points), np.concatenate(self.kinds)
        begins = np.flatnonzero(kinds == MOVE)
        alone = np.diff(np.append(begins, len(kinds))) == 1
        keep = np.ones(len(kinds), bool)
        keep[begins[alone]] = False
        return Outline(points[keep], kinds[keep], np.array(self.closed, bool)[~alone])

    def _move(self, to: Points) -> None:
        self._add(to[None], MOVE)
        self.closed.append(False)
        self.at = self.begin = to
        self.open = True

    def _add(self, points: Points, kind: int) -> None:
        self.points.append(points)
        self.kinds.append(np.full(len(points), kind, np.uint8))

    def _lines(self, to: Points) -> None:
        if not self.open:
            self._move(self.begin)
        self._add(to, LINE)
        self.at = to[-1]

    def _cubics(self, control: Points) -> None:
        """Draw cubics, shape (m, 3, 2), one after the other."""
        if not self.open:
            self._move(self.begin)
        self.points.append(control.reshape(-1, 2))
        self.kinds.append(np.tile(np.array([CONTROL, CONTROL, CURVE], np.uint8), len(control)))
        self.at, self.handle = control[-1, 2], control[-1, 1]

    def _draw_l(self, numbers: Points, relative: bool) -> None:
        self._lines(_chained(numbers, self.at) if relative else numbers)

    def _draw_h(self, numbers: Points, relative: bool) -> None:
        x = np.cumsum(numbers[:, 0]) + self.at[0] if relative else numbers[:, 0]
        self._lines(np.column_stack([x, np.full(len(x), self.at[1])]))

    def _draw_v(self, numbers: Points, relative: bool) -> None:
        y = np.cumsum(numbers[:, 0]) + self.at[1] if relative else numbers[:, 0]
        self._lines(np.column_stack([np.full(len(y), self.at[0]), y]))

    def _draw_c(self, numbers: Points, relative: bool) -> None:
        self._cubics(_ended(numbers, 3, relative, self.at))

    def _draw_s(self, numbers: Points, relative: bool) -> None:
        control = _ended(numbers, 2, relative, self.at)
        first = self.handle if self.last in "CS" else self.at
        starts = np.vstack([self.at, control[:-1, 1]])
        before = np.vstack([first, control[:-1, 0]])
        self._cubics(np.concatenate([(2 * starts - before)[:, None], control], axis=1))

    def _draw_q(self, numbers: Points, relative: bool) -> None:
        control = _ended(numbers, 2, relative, self.at)
        self._quadratics(control[:, 0], control[:, 1])

    def _draw_t(self, numbers: Points, relative: bool) -> None:
        ends = _chained(numbers, self.at) if relative else numbers
        starts = np.vstack([self.at, ends[:-1]])
        handles = []
        handle = self.handle if self.last in "QT" else self.at
        for start in starts:
            handle = 2 * start - handle
            handles.append(handle)
        self._quadratics(np.array(handles), ends)

    def _quadratics(self, handles: Points, ends: Points) -> None:
        starts = np.vstack([self.at, ends[:-1]])
        self._cubics(
            np.stack([starts + (handles - starts) * (2 / 3), ends + (handles - ends) * (2 / 3), ends], 1)
        )
        self.handle = handles[-1]

    def _draw_a(self, numbers: Points, relative: bool) -> None:
        for rx, ry, turn, large, sweep, x, y in numbers.tolist():
            end = np.array([x, y]) + (self.at if relative else 0.0)
            control = arc(self.at, end, (rx, ry), math.radians(turn), bool(large), bool(sweep))
            if control is None:
                self._lines(end[None])
            elif len(control):
                self._cubics(control)


def _chained(steps: Points, begin: Points) -> Points:
    """Return where relative steps lead, each from where the last ended."""
    return np.asarray(np.cumsum(np.vstack([begin, steps]), axis=0)[1:])


def _ended(numbers: Points, points: int, relative: bool, begin: Points) -> Points:
    """Return control points, shape (m, points, 2), absolute; each segment begins where the last ended."""
    control = numbers.reshape(-1, points, 2)
    if not relative:
        return control
    starts = np.cumsum(np.vstack([begin, control[:-1, -1]]), axis=0)
    return np.asarray(control + starts[:, None])


def arc(
    start: Points, end: Points, radii: tuple[float, float], turn: float, large: bool, sweep: bool
) -> Points | None:
    """Return an elliptic arc as cubics, shape (m, 3, 2), or None where it is a straight line.

    SVG 2, B.2.4 (from end points to centre) and B.2.5 (radii that are too small).
    """
    rx, ry = abs(radii[0]), abs(radii[1])
    if (start == end).all():
        return np.empty((0, 3, 2))
    if rx == 0 or ry == 0:
        return None
    cos, sin = math.cos(turn), math.sin(turn)
    half = (start - end) / 2
    x, y = cos * half[0] + sin * half[1], -sin * half[0] + cos * half[1]
    needed = (x / rx) ** 2 + (y / ry) ** 2
    if needed > 1:
        rx, ry = rx * math.sqrt(needed), ry * math.sqrt(needed)
    over = max(0.0, 1 / max(needed, 1e-300) - 1) if needed <= 1 else 0.0
    side = math.sqrt(over) * (-1 if large == sweep else 1)
    cx, cy = side * rx * y / ry, -side * ry * x / rx
    first = math.atan2((y - cy) / ry, (x - cx) / rx)
    swept = math.atan2((-y - cy) / ry, (-x - cx) / rx) - first
    if sweep and swept < 0:
        swept += 2 * math.pi
    elif not sweep and swept > 0:
        swept -= 2 * math.pi
    frame = np.array([[rx * cos, rx * sin], [-ry * sin, ry * cos]])
    middle = (start + end) / 2 + np.array([cos * cx - sin * cy, sin * cx + cos * cy])
    control: Points = _unit_arc(first, swept) @ frame + middle
    control[-1, 2] = end
    return control


def _unit_arc(first: float, swept: float) -> Points:
    """Return an arc of the unit circle as cubics, shape (m, 3, 2)."""
    pieces = max(1, math.ceil(abs(swept) / MAX_ARC - 1e-9))
    angle = first + np.linspace(0, swept, pieces + 1)
    reach = 4 / 3 * math.tan(swept / pieces / 4)
    on = np.column_stack([np.cos(angle), np.sin(angle)])
    along = np.column_stack([-np.sin(angle), np.cos(angle)]) * reach
    return np.stack([on[:-1] + along[:-1], on[1:] - along[1:], on[1:]], axis=1)


def drawn(commands: Sequence[tuple[str, Sequence[float]]]) -> Outline:
    """Return the outline of one closed subpath: commands with their numbers, without the Z at the end."""
    pen = _Pen()
    for letter, numbers in commands:
        pen.command(letter, np.array([numbers], float))
    pen.command("Z", np.empty(0))
    return pen.outline()
