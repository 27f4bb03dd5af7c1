"""The hands: what each style does to a drawing beside its isen — its ground, its lines, its colours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from batik_vector.artwork.overdyeing import difference
from batik_vector.recipe.fills import Cecek, Style
from batik_vector.recipe.fills.marks import Rows
from batik_vector.recipe.palettes import Palette, lightness
from batik_vector.values import frozen

CONTRAST = 1.75
"""Least ratio of luminances (WCAG 2.1) between isen and what they lie on before darker ones are taken."""
GREY = 12
"""Spread of the three parts of a colour, of 255, up to which it is a grey."""


@frozen
class Hand:
    """How a style dresses a drawing.

    Colours are numbers in a palette, the lightest first; negative ones count from the darkest. ``ground`` is
    the cloth, ``line`` draws outlines, ``uncoloured`` are dealt to what the drawing gives no colour.
    ``canting`` is the breadth of outlines in mm. ``round_it`` fills the ground round the motif; where it is
    None, sprigs are strewn there.
    """

    palette: str
    ground: int
    line: int
    uncoloured: tuple[int, ...]
    canting: float
    round_it: Cecek | None
    about: str


HANDS: Mapping[Style, Hand] = {
    Style.SOLO: Hand(
        "solo",
        -1,
        0,
        (2, 0, 1, 2),
        0.9,
        Cecek(angle=30, spacing=2.3, width=0.75, margin=1.0),
        "inland Java: cream lines on a blue-black ground",
    ),
    Style.PESISIR: Hand(
        "pekalongan", 0, -1, (1, 2, 3), 0.7, None, "the coast: dark lines on an ivory ground"
    ),
    Style.MIAO: Hand(
        "guizhou",
        -1,
        0,
        (0, 2, 1),
        1.2,
        Cecek(follow=Rows.SCATTER, spacing=2.8, width=1.0, margin=1.0),
        "Guizhou: white lines on a dark indigo ground",
    ),
}
"""Grounds: dots in close even rows inland, dots here and there in Guizhou, sprigs on the coast."""


def is_grey(colour: str) -> bool:
    """Whether a colour has no hue to speak of."""
    parts = [int(colour[at : at + 2], 16) for at in (1, 3, 5)]
    return max(parts) - min(parts) <= GREY


@frozen
class Colours:
    """The colours of a batik: words of a palette and their ``#rrggbb``."""

    palette: Palette
    hand: Hand

    @property
    def ground(self) -> int:
        """The colour of the cloth."""
        return self.hand.ground % len(self.palette.colours)

    @property
    def line(self) -> int:
        """The colour of outlines."""
        return self.hand.line % len(self.palette.colours)

    @property
    def cells(self) -> list[int]:
        """The colours that cells may have: all but the ground's."""
        return [number for number in range(len(self.palette.colours)) if number != self.ground]

    def uncoloured(self, turn: int) -> int:
        """Return the colour that is dealt to a cell without one."""
        dealt = [number % len(self.palette.colours) for number in self.hand.uncoloured]
        known = [number for number in dealt if number != self.ground]
        return known[turn % len(known)]

    def matched(self, drawn: Sequence[str]) -> dict[str, int]:
        """Return which colour for cells each of some drawn colours becomes: the nearest, for the eye.

        Colours that differ stay different as long as the palette has as many; others go where the one goes
        that they are most like.

        Args:
            drawn: those that matter most first.
        """
        first = list(drawn[: len(self.cells)])
        apart = {
            (colour, number): difference(self.palette.colours[number], colour)
            for colour in first
            for number in self.cells
        }
        found: dict[str, int] = {}
        for colour, number in sorted(apart, key=lambda pair: (apart[pair], pair)):
            if colour not in found and number not in found.values():
                found[colour] = number
        return found | {
            colour: found[min(first, key=lambda known: difference(known, colour))]
            for colour in drawn[len(first) :]
        }

    def isen_on(self, number: int) -> int:
        """Return the colour of isen on a cell: the lightest, unless it would hardly show there."""
        return self._over(number, [0, self.ground, len(self.palette.colours) - 1, 2])

    def line_round(self, number: int) -> int:
        """Return the colour of the line round a cell."""
        return self._over(number, [self.line, 2, *self.cells])

    def _over(self, number: int, wishes: Sequence[int]) -> int:
        """Return the first of some colours that shows on a cell of a colour; else the one that shows best."""
        known = [wish for wish in wishes if wish < len(self.palette.colours) and wish != number]
        good = [wish for wish in known if self._contrast(number, wish) >= CONTRAST]
        return good[0] if good else max(known, key=lambda wish: self._contrast(number, wish))

    def _contrast(self, one: int, other: int) -> float:
        """Return the contrast ratio of two colours. WCAG 2.1."""
        light = sorted(lightness(self.palette.colours[each]) + 0.05 for each in (one, other))
        return light[1] / light[0]
