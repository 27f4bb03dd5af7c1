"""Cut: closed contours for a knife or a laser, the inner before the outer, and where the kerf asks for them.

Regions are taken as they show. Their borders, moved by half the kerf, and the edges that inks share are the
strokes; they are put in order, begun where told, parted by tabs and led as a drag knife has to be led.
"""

from __future__ import annotations

from typing import Any

from batik_vector.artwork import Artwork, Cell, Ink, Page
from batik_vector.machines import Machine
from batik_vector.processes.cutting.registration import crosses
from batik_vector.processes.cutting.stock import HAIRLINE, nested, stocks_of
from batik_vector.processes.cutting.strokes import cut_out
from batik_vector.processes.cutting.told import Told, told
from batik_vector.processes.cutting.weeding import Box
from batik_vector.processes.options import CutProcess
from batik_vector.processes.plotting.timing import Pace, taken
from batik_vector.processes.prepared import Prepared, Tool

REGISTRATION = "registration"
BLACK = "#000000"
MAGENTA = "#ff00ff"
"""What is seen on dark cloth, and on the white of a screen."""
DARK = 3 * 80
"""The sum of red, green and blue below which black is not seen on a cloth."""


def apply(page: Page, spec: CutProcess, machine: Machine) -> Prepared:
    """Return what a knife or a laser follows to cut a page's areas out, one layer for each sheet.

    Raises:
        GeometryError: where the tool cannot cut what is drawn, with the key and the value that would do.
        ExportError: where the page is too large.
    """
    asked = told(spec, page.tolerance)
    pace = Pace.of(machine.motion)
    tools, facts = list[Tool](), list[dict[str, Any]]()
    for stock in stocks_of(page, asked):
        laid, sheet = nested(stock, asked)
        strokes, found = cut_out(laid, asked)
        tools.append(Tool(stock.ink, strokes))
        seconds = round(taken(strokes, pace).seconds, 1)
        facts.append({"tool": stock.ink.name, **found, "seconds": seconds, **sheet})
    sheeted = _sheeted(page, asked)
    if asked.registration is not None:
        tools.append(_registration(sheeted, asked))
    settings = {"kerf_mm": asked.kerf / 1000, "blade_offset_mm": asked.blade_offset / 1000}
    done = (*page.provenance.processes, str(spec))
    return Prepared(sheeted, tuple(tools), done, {"cut": {**settings, "tools": facts}})


def _sheeted(page: Page, asked: Told) -> Page:
    """Return the page, or one of the sheet's size that draws nothing of its own."""
    if asked.sheet is None:
        return page
    cell = Cell(*asked.sheet)
    return Artwork(page.title, cell, (), page.cloth, page.tolerance, provenance=page.provenance)


def _registration(page: Page, asked: Told) -> Tool:
    """Return crosses beside the page's corners, or within those of a sheet."""
    size = asked.registration or 0
    dark = sum(bytes.fromhex(page.cloth.removeprefix("#"))) < DARK
    box = Box(0, 0, page.cell.columns, page.cell.rows).grown(-size if asked.sheet else size)
    return Tool(Ink(REGISTRATION, MAGENTA if dark else BLACK, HAIRLINE), crosses(box, size))
