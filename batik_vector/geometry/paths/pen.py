"""The pen that path commands move: it draws lines, cubic Béziers and what is turned into them.

Quadratic Béziers become cubic exactly. Arcs become cubics of at most 22.5°, whose error is 7e-8 of the
radius (a twentieth of a µm at a metre). Most paths are short and there are many of them, so places are
complex numbers here, one after another: arrays pay only from some hundred on.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.paths.arcs import arc
from batik_vector.geometry.paths.outline import CONTROL, CURVE, EMPTY, LINE, MOVE, Outline

Command = tuple[str, list[float]]
"""A letter and its numbers, as many as it takes or a multiple."""

MANY = 200
"""Numbers from which on an array pays."""
_CUBIC, _ALONE = bytes([CONTROL, CONTROL, CURVE]), bytes([MOVE, MOVE])


def drawn(commands: Iterable[Command]) -> Outline:
    """Return the outline that commands draw."""
    pen = _Pen()
    for letter, numbers in commands:
        pen.command(letter, numbers)
    return pen.outline()


def _pairs(numbers: list[float]) -> list[complex]:
    if len(numbers) >= MANY:
        paired: list[complex] = np.array(numbers).view(complex).tolist()
        return paired
    return list(map(complex, numbers[::2], numbers[1::2]))


class _Pen:
    """Draws command after command; ``at``, ``begin`` and ``handle`` are where it stands and began."""

    def __init__(self) -> None:
        self.points: list[complex] = []
        self.kinds = bytearray()
        self.closed: list[bool] = []
        self.at = self.begin = self.handle = 0j
        self.last = ""
        self.open = False

    def command(self, letter: str, numbers: list[float]) -> None:
        command, relative = letter.upper(), letter.islower()
        if not self.last and command != "M":
            raise ValueError(f'path data begin with "{letter}", expected "M"')
        if command == "Z":
            self._close()
        elif command == "M":
            first, *more = _pairs(numbers)
            self._move(first + self.at if relative else first)
            self._draw_l(more, relative)
        else:
            if not self.open:
                self._move(self.begin)
            if command in "HVA":
                draw: Callable[[list[float], bool], None] = getattr(self, f"_draw_{command.lower()}")
                draw(numbers, relative)
            else:
                lead: Callable[[list[complex], bool], None] = getattr(self, f"_draw_{command.lower()}")
                lead(_pairs(numbers), relative)
        if not cmath.isfinite(self.at):
            self._refuse(letter, numbers)
        self.last = command

    def _refuse(self, letter: str, numbers: list[float]) -> None:
        if not all(map(math.isfinite, numbers)):
            raise ValueError(f'path command "{letter}" has a number that is not finite')
        raise ValueError(f'path command "{letter}" leads past the greatest number')

    def outline(self) -> Outline:
        if not self.points:
            return EMPTY
        points = np.array(self.points).view(float).reshape(-1, 2)
        if not np.isfinite(points).all():
            raise ValueError("path data have a handle that is not finite")
        kinds: NDArray[np.uint8] = np.frombuffer(bytes(self.kinds), np.uint8)
        closed = np.array(self.closed, bool)
        if _ALONE in self.kinds or self.kinds[-1] == MOVE:
            begins = np.flatnonzero(kinds == MOVE)
            alone = np.diff(np.append(begins, len(kinds))) == 1
            keep = np.ones(len(kinds), bool)
            keep[begins[alone]] = False
            points, kinds, closed = points[keep], kinds[keep], closed[~alone]
        return Outline(points, kinds, closed)

    def _close(self) -> None:
        if self.open:
            if self.last == "M" and self.kinds[-1] == MOVE:
                # Of no length, yet closed: caps make a dot of it.
                self.points.append(self.begin)
                self.kinds.append(LINE)
            self.closed[-1] = True
        self.at, self.open = self.begin, False

    def _move(self, to: complex) -> None:
        self.points.append(to)
        self.kinds.append(MOVE)
        self.closed.append(False)
        self.at = self.begin = to
        self.open = True

    def _draw_l(self, to: list[complex], relative: bool) -> None:
        if relative:
            at = self.at
            for place, step in enumerate(to):
                to[place] = at = at + step
        if to:
            self.points += to
            self.kinds += bytes([LINE]) * len(to)
            self.at = to[-1]

    def _draw_h(self, numbers: list[float], relative: bool) -> None:
        if relative:
            self._draw_l([complex(x, 0) for x in numbers], True)
        else:
            self._draw_l([complex(x, self.at.imag) for x in numbers], False)

    def _draw_v(self, numbers: list[float], relative: bool) -> None:
        if relative:
            self._draw_l([complex(0, y) for y in numbers], True)
        else:
            self._draw_l([complex(self.at.real, y) for y in numbers], False)

    def _cubics(self, control: list[complex]) -> None:
        """Draw cubics one after the other: two handles and an end of each."""
        self.points += control
        self.kinds += _CUBIC * (len(control) // 3)
        self.at, self.handle = control[-1], control[-2]

    def _draw_c(self, control: list[complex], relative: bool) -> None:
        if relative:
            at = self.at
            for end in range(2, len(control), 3):
                control[end - 2] += at
                control[end - 1] += at
                at = control[end] = control[end] + at
        self._cubics(control)

    def _draw_s(self, numbers: list[complex], relative: bool) -> None:
        at, handle = self.at, self.handle if self.last in "CS" else self.at
        control = []
        for second, end in zip(numbers[::2], numbers[1::2], strict=True):
            first = at + at - handle
            if relative:
                second, end = second + at, end + at
            control += [first, second, end]
            at, handle = end, second
        self._cubics(control)

    def _draw_q(self, numbers: list[complex], relative: bool) -> None:
        at = self.at
        handles, ends = [], []
        for handle, end in zip(numbers[::2], numbers[1::2], strict=True):
            if relative:
                handle, end = handle + at, end + at
            handles.append(handle)
            ends.append(end)
            at = end
        self._quadratics(handles, ends)

    def _draw_t(self, ends: list[complex], relative: bool) -> None:
        at, handle = self.at, self.handle if self.last in "QT" else self.at
        handles = []
        for place, end in enumerate(ends):
            handle = at + at - handle
            handles.append(handle)
            ends[place] = at = end + at if relative else end
        self._quadratics(handles, ends)

    def _quadratics(self, handles: list[complex], ends: list[complex]) -> None:
        control = []
        at = self.at
        for handle, end in zip(handles, ends, strict=True):
            control += [at + (handle - at) * (2 / 3), end + (handle - end) * (2 / 3), end]
            at = end
        self._cubics(control)
        self.handle = handles[-1]

    def _draw_a(self, numbers: list[float], relative: bool) -> None:
        for place in range(0, len(numbers), 7):
            rx, ry, turn, large, sweep, x, y = numbers[place : place + 7]
            end = complex(x, y) + (self.at if relative else 0)
            start, stop = np.array([self.at.real, self.at.imag]), np.array([end.real, end.imag])
            control = arc(start, stop, (rx, ry), math.radians(turn), bool(large), bool(sweep))
            if control is None:
                self._draw_l([end], False)
            elif len(control):
                self._cubics(np.ascontiguousarray(control).view(complex).ravel().tolist())
