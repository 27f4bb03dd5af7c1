"""The regions of a page by the baths that their cloth sees: as they show from above.

Lines have the body that their ink gives them, round at the ends. All regions are taken from one arrangement:
where one ends the next begins, corner by corner, and both sides of a seam are alike.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Dyeing, Geometries, Ink, Page, Seen
from batik_vector.geometry.arrangement import Arrangement, arranged
from batik_vector.geometry.outlines import Outlines, to_polygons, to_polylines
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.processes.prepared import whole_page
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

SAG = 0.5
"""Steps by which chords about the ends of lines may lie within their arcs."""
LEAST = 16
"""Chords of a quarter of such an arc, at least."""


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
    made = [_areas(page, ink, areas, lines) for ink, areas, lines in layers]
    arrangement = arranged(made, box)
    top = np.full(len(arrangement.faces), -1, np.intp)
    for number, covered in enumerate(arrangement.covered):
        top[covered] = number
    return Shown(arrangement, tuple(ink.name for ink, _, _ in layers), top)


def _areas(page: Page, ink: Ink, areas: Outlines, lines: Outlines) -> Geometries:
    """Return what an ink covers as polygons in steps that may overlap."""
    filled = oriented(to_polygons(areas)) if len(areas) else np.empty(0, dtype=object)
    if not len(lines) or not ink.width > 0:
        return filled
    radius = ink.width * STEPS_PER_MM / 2
    chords = max(LEAST, math.ceil(round(math.pi / 4 / math.acos(max(1 - SAG / radius, 0.5)), 6)))
    body = shapely.buffer(to_polylines(lines), radius, quad_segs=chords)
    bodies = oriented(polygonal(shapely.set_precision(body, 1)))
    return np.concatenate([filled, _around(page, bodies)])


def _around(page: Page, bodies: Geometries) -> Geometries:
    """Return bodies with their repeats that come into the tile: a line ends at its edge, no body does."""
    if not isinstance(page, Artwork) or page.bleed:
        return bodies
    (ax, ay), (bx, by) = page.cell.lattice
    left, bottom, right, top = shapely.total_bounds(bodies).tolist()
    far = math.ceil(max(-left, right - ax) / ax), math.ceil(max(-bottom, top - by) / by)
    found = [bodies]
    bounds = shapely.bounds(bodies)
    for i in range(-far[0] - 1, far[0] + 2):
        for j in range(-far[1] - 2, far[1] + 3):
            x, y = i * ax + j * bx, i * ay + j * by
            if x == y == 0:
                continue
            low, high = bounds[:, :2] + (x, y), bounds[:, 2:] + (x, y)
            near = (low < (page.cell.columns, page.cell.rows)).all(axis=1) & (high > 0).all(axis=1)
            if near.any():
                found.append(_moved(bodies[near], x, y))
    return np.concatenate(found)


def _moved(bodies: Geometries, right: int, up: int) -> Geometries:
    return np.asarray(shapely.transform(bodies, lambda xy: xy + (right, up)), dtype=object)
