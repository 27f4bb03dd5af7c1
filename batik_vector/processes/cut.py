"""Cut: closed contours for a knife or a laser."""

from __future__ import annotations

from batik_vector.artwork import Page
from batik_vector.geometry.outlines import together
from batik_vector.machines import Machine
from batik_vector.processes.options import CutProcess
from batik_vector.processes.order import contours, ordered
from batik_vector.processes.prepared import Prepared, Tool, whole_page


def apply(page: Page, spec: CutProcess, machine: Machine) -> Prepared:
    """Return the outlines of each ink's areas, the inner before the outer."""
    tools = [
        Tool(plate.ink, together(list(ordered(contours([areas])))), plate.pen, plate.guide)
        for plate, areas, _ in whole_page(page)
    ]
    return Prepared(page, tuple(tools), (*page.provenance.processes, str(spec)))
