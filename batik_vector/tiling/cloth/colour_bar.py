"""The colour bar: below what is printed, a patch of every ink with its name, each on its own plate.

Distances are in mm on cloth, the printed area's lower left corner at (0, 0).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Margins
from batik_vector.geometry.lettering import length_of, lettered
from batik_vector.geometry.outlines import MM, Outlines, of_polygons, of_polylines
from batik_vector.units import STEPS_PER_MM, on_grid, to_steps
from batik_vector.values import frozen

PATCH = 6.0
"""Side of a patch: densitometers see 3 to 4 mm."""
LETTER = 2.5
"""Height of letters."""
STROKE = 0.3
"""Breadth of the strokes of names, which a screen still holds."""
GAP = 2.0


@frozen
class ColourBar:
    """Where patches and names stand: in rows of ``width`` below the ordinate ``top``, under the title.

    ``first`` is which of the names the page's lowest ink has.
    """

    title: str
    names: tuple[str, ...]
    width: float
    top: float
    first: int = 0

    @property
    def size(self) -> tuple[float, float]:
        """How far it reaches right of the printed area's left edge, and down from ``top``."""
        right = max([length_of(self.title, LETTER), *(x + self._length(k) for k, x, _ in self._places())])
        return right, max(1, self._rows()) * (PATCH + GAP) + LETTER + 2 * GAP

    def margins(self, before: Margins, width: float) -> Margins:
        """Return the margins (steps) of a page ``width`` mm wide that are wide enough to hold it too."""
        right, down = self.size
        return replace(
            before,
            right=max(before.right, to_steps(max(right + GAP - width, 0.0))),
            bottom=max(before.bottom, to_steps(down - self.top)),
        )

    def heading(self) -> Outlines:
        """Return the title as lines, in steps: it stands on every plate."""
        ordinate = self.top - GAP - LETTER
        strokes = [shapely.LineString(each + (0.0, ordinate)) for each in lettered(self.title, LETTER)]
        lines = _gridded(strokes)
        return replace(of_polylines(lines, MM), names=["marks.title"] * len(lines))

    def patch(self, number: int) -> Outlines:
        """Return the patch and the name of an ink as areas, in steps."""
        _, x, y = self._places()[self.first + number]
        patch = shapely.box(x, y, x + PATCH, y + PATCH)
        strokes = lettered(self.names[self.first + number], LETTER)
        corner = (x + PATCH + GAP / 2, y + (PATCH - LETTER) / 2)
        body = shapely.union_all(
            [shapely.LineString(each + corner).buffer(STROKE / 2, quad_segs=4) for each in strokes]
        )
        letters = shapely.get_parts(shapely.set_precision(body, 1 / STEPS_PER_MM))
        areas = shapely.orient_polygons(_gridded([patch, *letters]))
        names = ["marks.patch"] + ["marks.name"] * len(letters)
        return replace(of_polygons(np.asarray(areas, dtype=object), MM), names=names)

    def _length(self, number: int) -> float:
        return PATCH + GAP / 2 + length_of(self.names[number], LETTER)

    def _rows(self) -> int:
        places = self._places()
        return len({y for _, _, y in places})

    def _places(self) -> list[tuple[int, float, float]]:
        """Return the number of each ink, and the lower left corner of its patch."""
        found = []
        x, row = 0.0, 0
        for number in range(len(self.names)):
            if x and x + self._length(number) > self.width:
                x, row = 0.0, row + 1
            found.append((number, x, self.top - 2 * GAP - LETTER - PATCH - row * (PATCH + GAP)))
            x += self._length(number) + 2 * GAP
        return found


def _gridded(shapes: Sequence[shapely.Geometry]) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    made = np.empty(len(shapes), dtype=object)
    made[:] = list(shapes)
    return np.asarray(shapely.transform(made, on_grid), dtype=object)
