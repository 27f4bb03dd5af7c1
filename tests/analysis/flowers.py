"""Flowers made for the analyser: elements put together, and the row that is right for them."""

from __future__ import annotations

from typing import NamedTuple

from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.recipe.loading import read_recipe

HEAD = """
[ink.light]
colour = "#7d9cc0"
[ink.wax]
colour = "#f4efe2"
[[place]]
motif = "flower"
scale = "40 mm"
ink = "wax"
[tile]
size = ["100 mm", "100 mm"]
"""

Points = list[tuple[float, float]]

DROP: Points = [
    (0.25, 0), (0.5, 0.13), (0.76, 0.2), (0.92, 0.14), (1, 0), (0.92, -0.14), (0.76, -0.2), (0.5, -0.13),
]  # fmt: skip
RHOMB: Points = [(0.2, 0), (0.62, 0.16), (1, 0), (0.62, -0.16)]
HOOK: Points = [(0.25, 0), (0.5, 0.1), (0.8, 0.18), (0.98, 0.3), (0.9, 0.02), (0.7, -0.1), (0.5, -0.08)]
FRILL: Points = [
    (0.24, 0), (0.48, 0.1), (0.64, 0.2), (0.7, 0.17), (0.8, 0.25), (0.86, 0.17), (0.96, 0.15), (0.94, 0.06),
    (1.02, 0), (0.94, -0.06), (0.96, -0.15), (0.86, -0.17), (0.8, -0.25), (0.7, -0.17), (0.64, -0.2),
    (0.48, -0.1),
]  # fmt: skip
PISTIL: Points = [(0.45, 0), (0.6, 0.012), (0.74, 0.028), (0.8, 0), (0.74, -0.028), (0.6, -0.012)]


def scaled(points: Points, size: float) -> Points:
    """Return points enlarged about the centre of the flower."""
    return [(x * size, y * size) for x, y in points]


def lengthened(points: Points, factor: float) -> Points:
    """Return a petal that is longer by a factor, from its base on."""
    (base, _), *_ = points
    return [(base + (x - base) * factor, y) for x, y in points]


def narrowed(points: Points, factor: float) -> Points:
    """Return a petal of another breadth."""
    return [(x, y * factor) for x, y in points]


def ring(points: Points, count: int, turn: float = 0.0, smooth: bool = True, rest: str = "") -> str:
    """Return an element of the flower: copies of a figure round its centre."""
    listed = ", ".join(f"[{x:.5f}, {y:.5f}]" for x, y in points)
    corners = f", smooth = true, corners = [0, {len(points) // 2}]" if smooth else ""
    curve = f'{{ kind = "points", points = [{listed}]{corners} }}'
    return f"{{ curve = {curve}, count = {count}, turn = {turn}{', ' if rest else ''}{rest} }}"


def dots(radius: float, at: float, count: int, turn: float = 0.0, rest: str = "") -> str:
    """Return a ring of dots."""
    curve = f'{{ kind = "circle", radius = {radius} }}'
    return f"{{ curve = {curve}, count = {count}, radius = {at}, turn = {turn}{', ' if rest else ''}{rest} }}"


CUT = 'treatment = "cut"'
HEART = dots(0.12, 0, 1)


class Case(NamedTuple):
    """A flower and its row."""

    row: str
    elements: tuple[str, ...]
    kind: str = "rotation and reflection"


CASES = {
    "seven petals": Case(
        "2, rotation, 1/7, single, curved, 7, 1", (ring(DROP, 7), ring(PISTIL, 7, rest=CUT), HEART)
    ),
    "no pistils": Case("1, rotation, 1/8, single, curved, 8, none", (ring(DROP, 8), HEART)),
    "two layers": Case(
        "1, rotation, 1/8, double, curved, 8, none",
        (ring(narrowed(DROP, 0.8), 8), ring(scaled(narrowed(DROP, 0.8), 0.5), 8, 22.5)),
    ),
    "three layers": Case(
        "1, rotation, 1/8, multi, curved, 8, none",
        (
            ring([(x * 0.6 + 0.4, y * 0.5) for x, y in DROP], 8),
            ring([(x * 0.36 + 0.24, y * 0.3) for x, y in DROP], 8, 22.5),
            ring([(x * 0.216 + 0.144, y * 0.18) for x, y in DROP], 8),
        ),
    ),
    "one petal a twentieth longer": Case(
        "2, rotation, none, single, curved, 8, 1",
        (
            ring(DROP, 7, 45, rest="arc = 315"),
            ring(lengthened(DROP, 1.05), 1),
            ring(PISTIL, 8, rest=CUT),
            HEART,
        ),
        "reflection",
    ),
    "one petal missing": Case(
        "1, rotation, none, single, curved, 7, none",
        (ring(DROP, 7, 45, rest="arc = 315"), HEART),
        "reflection",
    ),
    "one petal of another kind": Case(
        "1, rotation, none, single, curved, 8, none",
        (ring(DROP, 7, 45, rest="arc = 315"), ring(RHOMB, 1, smooth=False), HEART),
        "reflection",
    ),
    "a dot beside one petal": Case(
        "1, rotation, none, single, curved, 8, none",
        (ring(DROP, 8), dots(0.03, 0.9, 1, 22.5), HEART),
        "reflection",
    ),
    "petals in two inks by turns": Case(
        "1, rotation, 1/4, single, curved, 8, none",
        (ring(DROP, 4), ring(DROP, 4, 45, rest='ink = "light"'), HEART),
    ),
    "a dozen petals": Case(
        "1, rotation, 1/12, single, curved, 10 or more, none", (ring(narrowed(DROP, 0.8), 12), HEART)
    ),
    "nine petals": Case("1, rotation, 1/9, single, curved, 9, none", (ring(narrowed(DROP, 0.9), 9), HEART)),
    "six and twelve": Case(
        "1, rotation, 1/6, double, curved, 6 and 10 or more, none",
        (
            ring([(x * 0.6 + 0.4, y * 0.5) for x, y in DROP], 12),
            ring([(x * 0.45 + 0.06, y * 0.375) for x, y in DROP], 6),
        ),
    ),
    "hooked petals have no mirror": Case(
        "1, rotation, 1/8, single, curved, 8, none", (ring(narrowed(HOOK, 0.8), 8), HEART), "rotation"
    ),
    "rhombi": Case("1, rotation, 1/8, single, rhombus, 8, none", (ring(RHOMB, 8, smooth=False), HEART)),
    "frilled petals": Case("1, rotation, 1/6, single, wavy, 6, none", (ring(FRILL, 6), HEART)),
    "pistils on every other petal": Case(
        "2, rotation, 1/4, single, curved, 8, none and 2",
        (ring(DROP, 8), ring(PISTIL, 4, 4, rest=CUT), ring(PISTIL, 4, -4, rest=CUT), HEART),
    ),
    "three pistils": Case(
        "2, rotation, 1/6, single, curved, 6, multi",
        (ring(DROP, 6), *(ring(PISTIL, 6, turn, rest=CUT) for turn in (-7, 0, 7)), HEART),
    ),
    "user B's first flower": Case(
        "2, rotation, 1/5, single, curved, 5, 2",
        (ring(narrowed(DROP, 1.5), 5), ring(PISTIL, 5, 5, rest=CUT), ring(PISTIL, 5, -5, rest=CUT), HEART),
    ),
    "user B's second flower": Case(
        "multi, rotation, 1/5, double, curved and wavy, 5, none",
        (
            ring(FRILL, 5),
            ring(scaled(DROP, 0.6), 5, 36),
            dots(0.05, 0.92, 5, 36),
            ring([(0.14, 0.035), (0.21, 0.02), (0.21, -0.02), (0.14, -0.035)], 5, smooth=False),
            HEART,
        ),
    ),
    "beads between the petals": Case(
        "2, rotation, 1/8, single, curved, 8, none", (ring(DROP, 8), dots(0.05, 0.9, 8, 22.5), HEART)
    ),
    "three petals": Case("1, rotation, 1/3, single, curved, 3, none", (ring(narrowed(DROP, 1.6), 3), HEART)),
}


def drawn(*elements: str) -> Artwork:
    """Return a tile with one flower of these elements."""
    motif = f'[motif.flower]\nkind = "rosette"\nelements = [{", ".join(elements)}]\n'
    return compile_recipe(read_recipe(motif + HEAD))
