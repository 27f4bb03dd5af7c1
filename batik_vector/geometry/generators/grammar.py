"""A grammar of shapes: closed figures from which rules make others, generation after generation.

Stiny & Gips, "Shape grammars and the generative specification of painting and sculpture" (1972). A shape is a
closed line of straight sides. A rule takes a shape and makes new ones of it, which the next rule takes.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError, TooLargeError, nearest, shortened
from batik_vector.values import frozen

Complex = NDArray[np.complex128]

MOST_SHAPES = 20_000
"""Shapes of all generations."""

RULES = {
    "inscribe": "a shape between the points of its sides, at a share of each (0.5)",
    "shrink": "itself about its middle, by a factor (0.5)",
    "turn": "itself about its middle, by degrees (45)",
    "corners": "itself about every corner, by a factor (0.5)",
    "sides": "a square on every side, outwards, by a share of the side (1)",
    "spikes": "a triangle on every side, outwards, as high as a share of the side (0.5)",
    "hold": "itself",
}
"""What each rule makes of a shape."""
DEFAULTS = {
    "inscribe": 0.5,
    "shrink": 0.5,
    "turn": 45.0,
    "corners": 0.5,
    "sides": 1.0,
    "spikes": 0.5,
    "hold": 0.0,
}
_RULE = re.compile(r"\s*+([a-z]++)(?:\s++(-?+\d++\.?+\d*+|-?+\.\d++))?\s*+", re.ASCII)


@frozen
class ShapeRule:
    """A rule, and the number that it takes."""

    name: str
    number: float


def rules_of(words: Sequence[str]) -> tuple[ShapeRule, ...]:
    """Read rules such as ``"inscribe 0.3"``.

    Raises:
        GeometryError: for rules that are none, and numbers beyond -360 to 360.
    """
    found = []
    for place, text in enumerate(words):
        read = _RULE.fullmatch(text)
        if not read and text.split()[:1] and text.split()[0] in RULES:
            raise GeometryError(
                f'rules[{place}] = "{shortened(text)}": expected one number behind the name, '
                f'such as "{text.split()[0]} {DEFAULTS[text.split()[0]]:g}"'
            )
        if not read or read[1] not in RULES:
            near = nearest(text.split()[0], list(RULES)) if text.split() else None
            hint = f'did you mean "{near}"?' if near else f"expected one of {', '.join(RULES)}"
            raise GeometryError(f'rules[{place}] = "{shortened(text)}": {hint}')
        number = float(read[2]) if read[2] else DEFAULTS[read[1]]
        if not -360 <= number <= 360 or (number == 0 and read[1] not in ("hold", "turn")):
            raise GeometryError(
                f'rules[{place}] = "{shortened(text)}": expected a number other than 0, to 360'
            )
        found.append(ShapeRule(read[1], number))
    return tuple(found)


def generations(sides: int, radius: float, rules: Sequence[ShapeRule]) -> list[Complex]:
    """Return the shapes of every generation, each of shape (n, corners), the first one first.

    Raises:
        TooLargeError: where there are too many.
    """
    count, corners, total = 1, sides, 1
    for rule in rules:
        if rule.name in ("corners", "sides", "spikes"):
            count *= corners
            corners = {"sides": 4, "spikes": 3}.get(rule.name, corners)
        total += count
        if total > MOST_SHAPES:
            raise TooLargeError(f"rules make more than {MOST_SHAPES:,} shapes: expected fewer of them")
    turn = np.pi / 2 + np.pi / sides
    angles = turn + 2 * np.pi * np.arange(sides) / sides
    shapes: Complex = np.asarray(radius * np.exp(1j * angles), np.complex128)[None]
    found = [shapes]
    for rule in rules:
        shapes = _made(shapes, rule)
        found.append(shapes)
    return found


def _made(shapes: Complex, rule: ShapeRule) -> Complex:
    """Return what a rule makes of shapes."""
    following = np.roll(shapes, -1, axis=1)
    middle = shapes.mean(axis=1, keepdims=True)
    number = rule.number
    if rule.name == "inscribe":
        return np.asarray(shapes + (following - shapes) * number)
    if rule.name == "shrink":
        return np.asarray(middle + (shapes - middle) * number)
    if rule.name == "turn":
        return np.asarray(middle + (shapes - middle) * np.exp(1j * np.radians(number)))
    if rule.name == "corners":
        about = shapes[:, :, None] + (shapes - middle)[:, None, :] * number
        return np.asarray(about.reshape(-1, shapes.shape[1]))
    side = following - shapes
    if rule.name == "sides":
        out = -1j * side * number
        inset = side * (1 - number) / 2
        square = np.stack(
            [shapes + inset, shapes + inset + out, following - inset + out, following - inset], axis=-1
        )
        return np.asarray(square.reshape(-1, 4))
    if rule.name == "spikes":
        tip = (shapes + following) / 2 - 1j * side * number
        return np.asarray(np.stack([shapes, tip, following], axis=-1).reshape(-1, 3))
    return shapes
