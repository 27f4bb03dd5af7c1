"""Pouncing: outlines as rows of holes, to prick a paper through which chalk is dabbed onto the cloth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.fields import Between, Length, Says
from batik_vector.processes.spec import StrokeProcess
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

# The catalogue is read for help and messages too: what is heavy is imported where the work is done.
if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from batik_vector.artwork import Page
    from batik_vector.geometry.outlines import Outlines
    from batik_vector.machines import Machine
    from batik_vector.processes.prepared import Prepared

MOST_HOLES = 500_000
CORNERS = 12
"""A hole is a polygon: at half a millimetre no knife and no laser tells it from a circle."""


@frozen(kw_only=True)
class Pounce(StrokeProcess):
    """Outlines and lines as rows of holes, for a laser or a plotter with a needle."""

    kind = "pounce"
    module = "batik_example.pounce"
    keeps_tile = False

    spacing: Annotated[Annotated[Length, Between(0.3, 50)], Says("from hole to hole")] = 2.0
    hole: Annotated[Annotated[Length, Between(0.1, 10)], Says("across a hole")] = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.spacing <= self.hole:
            raise GeometryError(f"spacing = {self.spacing:g}, expected more than a hole's {self.hole:g} mm")


def apply(page: Page, spec: Pounce, machine: Machine) -> Prepared:
    """Return a page's outlines as holes, a layer for each ink.

    Raises:
        TooLargeError: where there would be far too many.
    """
    import numpy as np

    from batik_vector.geometry.outlines import Outlines
    from batik_vector.processes.prepared import Prepared, Tool, whole_page

    tools, holes = [], 0
    for plate, *marks in whole_page(page):
        middles = np.concatenate([_along(each, spec) for each in marks])
        holes += len(middles)
        angles = 2 * np.pi * np.arange(CORNERS) / CORNERS
        ring = np.rint(spec.hole / 2 * STEPS_PER_MM * np.column_stack([np.cos(angles), np.sin(angles)]))
        count = np.arange(len(middles) + 1)
        points = (middles[:, None, :] + ring).reshape(-1, 2).astype(np.int64)
        strokes = Outlines(points, count * CORNERS, count, np.ones(len(middles), bool))
        tools.append(Tool(plate.ink, strokes))
    done = (*page.provenance.processes, str(spec))
    return Prepared(page, tuple(tools), done, {"pounce": {"holes": holes}})


def _along(marks: Outlines, spec: Pounce) -> NDArray[np.float64]:
    """Return places along outlines and lines, shape (n, 2), evenly spread over each ring."""
    import numpy as np

    points, rings = marks.repeating()
    if not len(points):
        return np.empty((0, 2))
    steps = np.hypot(*np.diff(points, axis=0, prepend=points[:1]).T)
    steps[rings[:-1]] = 0.0  # from the end of a ring to the next nothing is drawn
    run = np.cumsum(steps)
    begins, ends = run[rings[:-1]], run[rings[1:] - 1]
    counts = np.maximum(np.rint((ends - begins) / (spec.spacing * STEPS_PER_MM)), 1).astype(int)
    if counts.sum() > MOST_HOLES:
        raise TooLargeError(
            f"spacing = {spec.spacing:g}: {counts.sum():,} holes, past the limit of {MOST_HOLES:,}"
        )
    number = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    at = np.repeat(begins, counts) + number * np.repeat((ends - begins) / counts, counts)
    # Where rings meet the run stands still; the later of equal places is the new ring's first.
    after = np.minimum(np.searchsorted(run, at, side="right"), len(run) - 1)
    before = after - 1
    share = (at - run[before]) / np.maximum(run[after] - run[before], 1e-9)
    places: NDArray[np.float64] = points[before] + share[:, None] * (points[after] - points[before])
    return np.rint(places)
