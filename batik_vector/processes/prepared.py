"""What a process leaves: a page of strokes, each tool's in the order in which it draws them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field, replace
from typing import Any

import numpy as np

from batik_vector.artwork import Cell, Dyeing, Ink, Margins, Page, Plate, Provenance, dyeing_of
from batik_vector.errors import ExportError
from batik_vector.geometry.outlines import Outlines, together
from batik_vector.values import frozen

MOST = 20_000_000
"""Vertices past which a page is not taken into memory whole."""


@frozen(eq=False)
class Tool:
    """A pen or a knife and what it draws.

    ``strokes`` are rings and polylines, one to a mark, in the order and direction in which they are drawn.
    ``pen`` is its number on the machine, the next free one where it is 0; ``guide`` marks are drawn by none.
    """

    ink: Ink
    strokes: Outlines
    pen: int = 0
    guide: bool = False


@frozen(eq=False)
class Prepared:
    """A page as a machine follows it. Writers write it as it stands, in this order.

    Its origin is the page's that it was made of, so that several files of one recipe register. ``done`` names
    the processes, as ``--process`` takes them, and ``facts`` are plain values for the report.
    """

    page: Page
    tools: tuple[Tool, ...]
    done: tuple[str, ...] = ()
    facts: Mapping[str, Any] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """What the design is called."""
        return self.page.title

    @property
    def cell(self) -> Cell:
        """The rectangle to which the page is trimmed."""
        return self.page.cell

    @property
    def margins(self) -> Margins:
        """How far the page reaches beyond the cell: as before, or as far as what is drawn."""
        cell, before = self.page.cell, self.page.margins
        points = [tool.strokes.points for tool in self.tools if len(tool.strokes.points)]
        if not points:
            return before
        left, bottom = np.min([each.min(axis=0) for each in points], axis=0).tolist()
        right, top = np.max([each.max(axis=0) for each in points], axis=0).tolist()
        return Margins(
            max(before.left, -left),
            max(before.bottom, -bottom),
            max(before.right, right - cell.columns),
            max(before.top, top - cell.rows),
        )

    @property
    def bleed(self) -> float:
        """How far the drawing reaches beyond the cell on every side, in mm."""
        return self.page.bleed

    @property
    def cloth(self) -> str:
        """The ground's colour on screen."""
        return self.page.cloth

    @property
    def dyeing(self) -> Dyeing | None:
        """The baths that the cloth goes through."""
        return dyeing_of(self.page)

    @property
    def tolerance(self) -> float:
        """How far any drawn edge may stand from the true curve, in mm."""
        return self.page.tolerance

    @property
    def provenance(self) -> Provenance:
        """Recipe, seed, version, and the processes that were gone through."""
        return replace(self.page.provenance, processes=self.done)

    @property
    def vertex_count(self) -> int:
        """Vertices of all strokes together."""
        return sum(len(tool.strokes.points) for tool in self.tools)

    @property
    def plates(self) -> tuple[Plate, ...]:
        """One layer for each tool."""
        return tuple(
            Plate(tool.ink, areas=False, lines=len(tool.strokes) > 0, guide=tool.guide, pen=tool.pen)
            for tool in self.tools
        )

    def areas(self, number: int) -> Iterator[Outlines]:
        """Yield nothing: a tool draws strokes."""
        yield from ()

    def lines(self, number: int) -> Iterator[Outlines]:
        """Yield the strokes of a tool; names may be lost where strokes were joined."""
        strokes = self.tools[number].strokes
        if len(strokes):
            yield strokes if len(strokes.names) else replace(strokes, names=("",) * len(strokes))


def whole_page(page: Page) -> list[tuple[Plate, Outlines, Outlines]]:
    """Return each layer of a page with all its areas and all its lines.

    Raises:
        ExportError: where the page is larger than what is taken into memory.
    """
    if page.vertex_count > MOST:
        raise ExportError(
            f"{page.vertex_count:,} vertices, expected at most {MOST:,} for a process: "
            "prepare the tile, or less cloth"
        )
    return [
        (plate, together(list(page.areas(number))), together(list(page.lines(number))))
        for number, plate in enumerate(page.plates)
    ]
