"""Random recipes as people write them: TOML, each made of a number and always the same.

Where ``recipes.py`` looks for extremes of every value, these are everyday recipes of all repeats: motifs
in a few inks, placed, tossed and laid in stripes over one another, with gaps, lines and bodies of lines.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random

from batik_vector.tiling.symmetry.groups import GROUPS
from batik_vector.tiling.symmetry.repeats import MIRRORS, repeat_of

DROPS = ("grid", "half-drop", "brick", "drop 1/3", "drop 2/5", "brick 1/4")
EVERY_REPEAT = (*GROUPS, *MIRRORS, *DROPS)
INKS = ("wax", "indigo", "soga")


def recipe_text(number: int) -> str:
    """Return a recipe; numbers that follow one another go through all repeats."""
    return _Writer(Random(number), EVERY_REPEAT[number % len(EVERY_REPEAT)]).text(number)


class _Writer:
    """Writes one recipe, of one repeat."""

    def __init__(self, chance: Random, repeat: str) -> None:
        self.chance, self.repeat = chance, repeat
        self.width = round(chance.uniform(25, 110), chance.choice([0, 1, 3]))
        ratio = repeat_of(repeat).kind.ratio
        self.height = round(chance.uniform(25, 110), 1) if ratio is None else round(self.width * ratio, 3)
        self.inks = INKS[: chance.randint(1, 3)]
        # What is multiplied often is small, so that every recipe is quickly compiled.
        self.images = len(GROUPS[repeat].operations) if repeat in GROUPS else 4 if repeat in MIRRORS else 1

    def text(self, number: int) -> str:
        chance = self.chance
        lines = [
            f'title = "Random {number}"',
            f"tolerance = {chance.choice([0.02, 0.02, 0.02, 0.05, 0.1])}",
            f"seed = {number}",
        ]
        for ink in self.inks:
            overlap = chance.choice(["weld", "weld", "knockout", "overlay"])
            lines += [f"[ink.{ink}]", f"width = {chance.uniform(0.3, 2):.2f}", f'overlap = "{overlap}"']
        motifs = [f"m{k}" for k in range(chance.randint(1, 3))]
        for motif in motifs:
            lines += self.motif(motif)
        for _ in range(chance.randint(1, 3)):
            lines += self.placement(chance.choice(motifs))
        lines += ["[tile]", f"size = [{self.width}, {self.height}]", f'repeat = "{self.repeat}"']
        if self.repeat not in MIRRORS and chance.random() < 0.3:
            lines.append('cut = "unit"')
        return "\n".join(lines) + "\n"

    def motif(self, name: str) -> list[str]:
        if self.chance.random() < 0.25:
            return [f"[motif.{name}]", 'kind = "flower"', *self.flower()]
        parts = [self.element() for _ in range(self.chance.randint(1, 4))]
        return [
            f"[motif.{name}]",
            'kind = "rosette"',
            "elements = [",
            *(f"  {{ {each} }}," for each in parts),
            "]",
        ]

    def flower(self) -> list[str]:
        chance = self.chance
        counts = {
            "leaf": chance.randint(0, 9),
            "petal": chance.randint(3, 9),
            "core": chance.choice([0, 4, 5, 8]),
        }
        tables = [f"{part} = {{ count = {count}, {self.look()} }}" for part, count in counts.items()]
        cusps, cusp = chance.choice([(5, 2), (7, 2), (8, 3), (16, 5)])
        return [
            *tables,
            f"pistil = {{ count = {cusps}, cusp = {cusp}, {self.look()} }}",
            f"disc = {{ {self.look()} }}",
        ]

    def element(self) -> str:
        chance = self.chance
        parts = [f"curve = {{ {self.curve()} }}", self.look()]
        if chance.random() < 0.6:
            parts += [f"count = {chance.randint(2, 9)}", f"radius = {chance.uniform(0, 1.2):.3f}"]
        if chance.random() < 0.5:
            parts += [f"turn = {chance.uniform(0, 360):.1f}", f"spin = {chance.uniform(0, 360):.1f}"]
        if chance.random() < 0.2:
            parts.append("mirror = true")
        return ", ".join(parts)

    def curve(self) -> str:
        chance = self.chance
        size = f"{chance.uniform(0.2, 1.2):.3f}"
        curves: list[Callable[[], str]] = [
            lambda: f'kind = "circle", radius = {size}',
            lambda: (
                f'kind = "superellipse", length = {size}, width = {chance.uniform(0.1, 0.8):.3f}, '
                f"a = {chance.uniform(0.3, 2):.2f}, b = {chance.uniform(0.6, 10):.2f}"
            ),
            lambda: f'kind = "rose", n = {chance.randint(2, 7)}, d = {chance.randint(1, 3)}, length = {size}',
            lambda: f'kind = "petal", n = {chance.randint(1, 6)}, length = {size}',
            lambda: (
                f'kind = "hypocycloid", m = {chance.choice([5, 7, 11])}, n = {chance.randint(1, 3)}, '
                f"length = {size}"
            ),
            lambda: f'kind = "polygon", sides = {chance.randint(3, 8)}, radius = {size}',
            lambda: (
                f'kind = "star", points = {chance.randint(3, 9)}, radius = {size}, '
                f"inner = {chance.uniform(0.1, 0.9):.3f}"
            ),
            lambda: f'kind = "spiral", revolutions = {chance.uniform(0.5, 3):.2f}, radius = {size}',
        ]
        return chance.choice(curves)()

    def look(self) -> str:
        chance = self.chance
        treatment = chance.choice(["area", "area", "stroke", "line", "both", "cut"])
        parts = [f'treatment = "{treatment}"', f'ink = "{chance.choice(self.inks)}"']
        if treatment == "both" and chance.random() < 0.5:
            parts.append(f'line_ink = "{chance.choice(self.inks)}"')
        if chance.random() < 0.4:
            parts.append(f"gap = {chance.choice([0, 0.3, 0.5, round(chance.uniform(0, 2), 2)])}")
        if chance.random() < 0.1:
            parts.append("whole = true")
        if chance.random() < 0.1:
            parts.append(f"contours = {chance.randint(2, 4)}")
        return ", ".join(parts)

    def placement(self, motif: str) -> list[str]:
        chance = self.chance
        lines = ["[[place]]", f'motif = "{motif}"', f'ink = "{chance.choice(self.inks)}"']
        if chance.random() < 0.3:
            lines.append(f"gap = {chance.choice([0, 0.5, 1])}")
        small = min(self.width, self.height)
        if chance.random() < 0.25:
            return [
                *lines,
                f"scale = {small * chance.uniform(0.02, 0.06):.3f}",
                f"layout = {{ {self.ground()} }}",
            ]
        size = small * chance.uniform(0.1, 0.5) / math.sqrt(self.images) ** 0.5
        lines += [
            f"scale = {size:.3f}",
            f"at = [{self.within(self.width)}, {self.within(self.height)}]",
            f"turn = {chance.uniform(0, 360):.1f}",
            f"layout = {{ {self.layout()} }}",
        ]
        if self.repeat in GROUPS and chance.random() < 0.5:
            lines.append(f'region = "{chance.choice(["free", "centre", "cut"])}"')
        return lines

    def within(self, side: float) -> str:
        return f"{self.chance.uniform(-side, side):.2f}"

    def layout(self) -> str:
        chance = self.chance
        layouts = [
            'kind = "single"',
            'kind = "single"',
            f'kind = "ring", count = {chance.randint(2, 6)}, radius = {chance.uniform(0.5, 2):.2f}',
            f'kind = "mirror", axis = {chance.randint(0, 180)}',
            f'kind = "rosette", group = "{chance.choice(["C3", "C5", "D2", "D3"])}"',
            f'kind = "lattice", columns = {chance.randint(1, 3)}, rows = 2, stagger = true',
            f'kind = "julian", power = {chance.randint(2, 5)}, dist = {chance.randint(2, 5)}',
        ]
        return chance.choice(layouts)

    def ground(self) -> str:
        chance = self.chance
        if chance.random() < 0.6:
            distance, count = chance.choice([0, 0.3, 1]), chance.randint(1, 12) // self.images + 1
            return (
                f'kind = "toss", distance = {distance}, count = {count}, '
                f'flip = true, clear = "{chance.choice(["tossed", "none", "none"])}", tries = 50, settle = 2'
            )
        winding = chance.choice(["[1, 0]", "[0, 1]", "[1, 1]", "[1, -1]"])
        lines, links = (2, 8) if self.images > 2 else (4, 16)
        return (
            f'kind = "stripes", count = {chance.randint(1, lines)}, winding = {winding}, '
            f"links = {chance.randint(3, links)}"
        )
