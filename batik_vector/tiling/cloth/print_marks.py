"""Marks for printers round a page: crop and registration marks, the title, and a colour bar."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from batik_vector.artwork import Cell, Margins
from batik_vector.tiling.cloth.colour_bar import ColourBar
from batik_vector.tiling.cloth.guides import Guides
from batik_vector.tiling.cloth.yardage import Yardage
from batik_vector.units import STEPS_PER_MM


def with_print_marks(page: Yardage, names: Sequence[str] = ()) -> Yardage:
    """Return a page with marks in margins that are wide enough for them.

    What has marks already, as a cloth may, keeps its own and gets the colour bar below them. The plate of one
    ink among ``names`` has its patch where it is in the bar of all.
    """
    drawn = [each.ink.name for each in page.drawn]
    names = names or drawn
    guides = page.guides or _guides(page.cell, page.bleed)
    before = page.margins if page.guides else _both(page.margins, guides.margins())
    bar = replace(_bar(page.title, page.cell, names, before), first=list(names).index(drawn[0]))
    return replace(page, guides=guides, bar=bar, margins=bar.margins(before, page.cell.width))


def marked_margins(cell: Cell, bleed: float, title: str, names: Sequence[str]) -> Margins:
    """Return the margins of a page with marks, from what is known before it is set out."""
    before = _guides(cell, bleed).margins()
    return _bar(title, cell, names, before).margins(before, cell.width)


def _guides(cell: Cell, bleed: float) -> Guides:
    # No repeat begins within the page: trim marks say where they begin.
    return Guides(cell.width, cell.height, bleed, 0.0, cell.height + 1, cell.height + 1)


def _bar(title: str, cell: Cell, names: Sequence[str], margins: Margins) -> ColourBar:
    return ColourBar(title, tuple(names), cell.width, -margins.bottom / STEPS_PER_MM)


def _both(one: Margins, other: Margins) -> Margins:
    return Margins(
        max(one.left, other.left),
        max(one.bottom, other.bottom),
        max(one.right, other.right),
        max(one.top, other.top),
    )
