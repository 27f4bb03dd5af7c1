"""Plot: outlines and lines as strokes for a pen."""

from __future__ import annotations

from batik_vector.artwork import Page
from batik_vector.geometry.outlines import together
from batik_vector.machines import Machine
from batik_vector.processes.options import PlotProcess
from batik_vector.processes.order import contours, ordered
from batik_vector.processes.prepared import Prepared, Tool, whole_page


def apply(page: Page, spec: PlotProcess, machine: Machine) -> Prepared:
    """Return the strokes of each ink in a good order."""
    tools = [
        Tool(
            plate.ink,
            together(list(ordered(contours([areas, lines]), join=spec.join))),
            plate.pen,
            plate.guide,
        )
        for plate, areas, lines in whole_page(page)
    ]
    return Prepared(page, tuple(tools), (*page.provenance.processes, str(spec)))
