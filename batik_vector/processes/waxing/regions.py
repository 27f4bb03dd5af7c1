"""The regions of a page by the baths that their cloth sees: as they show from above.

Lines have the body that their ink gives them, round at the ends. All regions are taken from one arrangement:
where one ends the next begins, corner by corner, and both sides of a seam are alike.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Dyeing, Geometries, Page, Seen
from batik_vector.geometry.arrangement import Arrangement, arranged
from batik_vector.processes.bodies import inked
from batik_vector.processes.prepared import whole_page
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen


@frozen(eq=False)
class Shown:
    """A page as it shows: the faces into which its marks divide it, and the uppermost ink of each.

    ``inks`` are the inks, the lowest first; ``top`` has a number of them for each face, or −1 for bare cloth.
    """

    arrangement: Arrangement
    inks: tuple[str, ...]
    top: NDArray[np.intp]

    def seen(self, dyeing: Dyeing) -> list[Seen]:
        """Return what the cloth of bare ground, and then of each ink, sees."""
        return [dyeing.ground, *(dyeing.inks[name] for name in self.inks)]

    def region(self, dyeing: Dyeing, sets: Iterable[Seen]) -> Geometries:
        """Return the cloth that sees one of some sets of baths, as polygons in steps that share no edge."""
        wanted = set(sets)
        chosen = np.array([each in wanted for each in self.seen(dyeing)], bool)
        return self.arrangement.region(chosen[self.top + 1])


def shown(page: Page) -> Shown:
    """Return a page as it shows; of the page last asked for it is known.

    Raises:
        GeometryError: where its edges cannot be brought to the grid.
        ExportError: where the page is too large.
    """
    return _shown(_Same(page))


@frozen(eq=False)
class _Same:
    """A page that is the same where it is the very same object."""

    page: Page

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.page is self.page

    def __hash__(self) -> int:
        return id(self.page)


@functools.lru_cache(maxsize=1)
def _shown(asked: _Same) -> Shown:
    page = asked.page
    layers = [(plate.ink, areas, lines) for plate, areas, lines in whole_page(page) if not plate.guide]
    bleed = round(page.bleed * STEPS_PER_MM)
    box = -bleed, -bleed, page.cell.columns + bleed, page.cell.rows + bleed
    made = [inked(page, ink, areas, lines) for ink, areas, lines in layers]
    arrangement = arranged(made, box)
    top = np.full(len(arrangement.faces), -1, np.intp)
    for number, covered in enumerate(arrangement.covered):
        top[covered] = number
    return Shown(arrangement, tuple(ink.name for ink, _, _ in layers), top)
