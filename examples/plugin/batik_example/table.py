"""CSV: what each ink covers, for who weighs out wax and dye."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, BinaryIO

from batik_vector.recipe.outputs import OutputSpec
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.artwork import Page


@frozen(kw_only=True)
class CsvOptions:
    """What can be chosen of a table: nothing."""


@frozen(kw_only=True)
class CsvOutput(OutputSpec, CsvOptions):
    """A table of the inks: their marks, area and length of line."""

    format = "csv"
    writer = CsvOptions
    suffix = ".csv"
    module = "batik_example.table"


def render(page: Page, options: CsvOptions | None = None) -> bytes:
    """Return the table as a file: a row for each ink, in painting order."""
    import numpy as np
    import shapely

    from batik_vector.geometry.outlines import to_polygons

    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["ink", "colour", "marks", "area_mm2", "line_mm"])
    for number, plate in enumerate(page.plates):
        marks, area, length = 0, 0.0, 0.0
        for piece in page.areas(number):
            marks += len(piece)
            area += float(shapely.area(to_polygons(piece)).sum()) / STEPS_PER_MM**2
        for piece in page.lines(number):
            marks += len(piece)
            points, rings = piece.repeating()
            steps = np.hypot(*np.diff(points, axis=0, prepend=points[:1]).T)
            steps[rings[:-1]] = 0.0
            length += float(steps.sum()) / STEPS_PER_MM
        rows.writerow([plate.ink.name, plate.ink.colour, marks, f"{area:.2f}", f"{length:.2f}"])
    return text.getvalue().encode("utf-8")


def write(page: Page, sink: BinaryIO, options: CsvOptions | None = None) -> None:
    """Write the table into a sink."""
    sink.write(render(page, options))
