"""Travel: the ways that a tool goes lifted, from stroke to stroke, made visible."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from batik_vector.artwork import Ink
from batik_vector.geometry.outlines import Outlines, Steps, together
from batik_vector.processes.prepared import Prepared, Tool

NAME, COLOUR = "travel", "#e8502e"
"""A red that shows on undyed cotton as on indigo."""
THIN = 1 / 1000
"""Breadth of a way over the longer side of the page: a hair in any picture of it."""
LEAST = 2.5
"""Breadth of a stroke over that of a way, at least."""


def with_travel(page: Prepared) -> Prepared:
    """Return a page to be looked at, with its ways in a layer on top that no tool draws.

    Each tool begins at the page's corner (0, 0), as :func:`ways` has it.
    """
    drawn = [tool for tool in page.tools if not tool.guide]
    found = together([_lines(ways(tool.strokes)) for tool in drawn])
    longer = max(page.cell.width, page.cell.height)
    ink = Ink(NAME, COLOUR, max(round(longer * THIN, 3), 0.01))
    # Hairs for a cutter would be lost beside them.
    least = LEAST * ink.width
    tools = [replace(each, ink=replace(each.ink, width=max(each.ink.width, least))) for each in page.tools]
    return replace(page, tools=(*tools, Tool(ink, found, guide=True)))


def ways(strokes: Outlines) -> Steps:
    """Return the ways of a tool to each of its strokes.

    Args:
        strokes: as they are drawn, none of them empty.

    Returns:
        Where each way begins and ends, shape (k, 2, 2), in steps; the first begins at (0, 0).
    """
    first, last = strokes.rings[:-1], strokes.rings[1:] - 1
    ends = strokes.points[np.where(strokes.closed, first, last)]
    before = np.concatenate([np.zeros((1, 2), np.int64), ends[:-1]]) if len(ends) else ends
    return np.stack([before, strokes.points[first]], axis=1)


def _lines(found: Steps) -> Outlines:
    """Return ways as lines; those without length are left out."""
    found = found[(found[:, 0] != found[:, 1]).any(axis=1)]
    ends = 2 * np.arange(len(found) + 1)
    count = np.arange(len(found) + 1)
    return Outlines(found.reshape(-1, 2), ends, count, np.zeros(len(found), bool), ("",) * len(found))
