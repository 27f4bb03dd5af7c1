"""Pattern paint servers: cells that are repeated over what they fill (SVG 2, 14.3)."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator

import numpy as np
import shapely

from batik_vector.geometry.paths.matrix import Matrix, inverse_of, moved, spread, times
from batik_vector.geometry.paths.outline import CURVE, Outline
from batik_vector.importing.document import MAX_DEPTH, Document, children, local, reference
from batik_vector.importing.page import Box, Page, fitted, parse_px, view_box
from batik_vector.importing.paint import url_of
from batik_vector.importing.styles import Style, share_of
from batik_vector.importing.transforms import parse_transform
from batik_vector.values import frozen

MAX_CELLS = 10_000
"""Cells of a pattern that a mark may show before it is refused: at a fifth of a millisecond each."""
SKEW = 1e-6
"""Cosine of the angle between a cell's sides from which it is no rectangle."""


@frozen(eq=False)
class Pattern:
    """A pattern as it fills one mark.

    ``matrix`` takes its own space to the page (mm, y down); the ``cell`` is a box there, repeated by its own
    sides, and ``content`` takes the units of what ``holder`` holds to that space. ``size`` are the sides to
    which percentages in it refer. ``hangs`` says that the cell's size hangs on the mark or on the page.
    """

    server: ET.Element
    holder: ET.Element
    matrix: Matrix
    cell: Box
    content: Matrix
    size: tuple[float, float]
    hangs: bool

    def page(self) -> tuple[Page, bool]:
        """Return the cell as a page, turned back into the pattern's own frame, and whether it was skewed."""
        x, y, width, height = self.cell
        a, b, c, d = self.matrix[:4]
        across, down = math.hypot(a, b), math.hypot(c, d)
        own = times((across, 0.0, 0.0, down, -x * across, -y * down), self.content)
        skewed = abs(a * c + b * d) > SKEW * across * down
        return Page(width * across, height * down, own, self.size, whole=False), skewed

    def shifts(self, outline: Outline) -> Iterator[tuple[float, float]]:
        """Yield how far the cells lie from the first, in the pattern's space, that an outline may show."""
        x, y, width, height = self.cell
        there = moved(outline.points, inverse_of(self.matrix))
        low = np.floor((there.min(axis=0) - (x, y)) / (width, height)).astype(int)
        high = np.ceil((there.max(axis=0) - (x, y)) / (width, height)).astype(int)
        for row in range(int(low[1]), int(high[1])):
            for column in range(int(low[0]), int(high[0])):
                yield column * width, row * height

    def count(self, outline: Outline) -> float:
        """Return how many cells these are, in no time."""
        there = moved(outline.points, inverse_of(self.matrix))
        reach = np.ptp(there, axis=0) / self.cell[2:]
        return float(np.prod(reach + 1))


def server_of(document: Document, style: Style) -> ET.Element | None:
    """Return the pattern that a style fills with, if any."""
    url = url_of(style["fill"])
    found = document.by_id.get(url[0][1:]) if url and url[0].startswith("#") else None
    return (
        found if found is not None and local(found) == "pattern" and share_of(style["fill-opacity"]) else None
    )


def pattern_of(
    document: Document, server: ET.Element, matrix: Matrix, size: tuple[float, float], box: Box | None
) -> Pattern | None:
    """Return a pattern as it fills a mark, or None where it shows nothing.

    Args:
        document: where it stands.
        server: the pattern.
        matrix: from the mark's units to the page.
        size: the sides of the mark's viewport, to which percentages refer.
        box: the mark's, in its own units.

    Raises:
        ValueError: saying what of it cannot be read.
    """
    chain = _chain(document, server)
    holder = next((each for each in chain if any(True for _ in children(each))), None)

    def get(name: str) -> str:
        return next((each.get(name, "").strip() for each in chain if each.get(name)), "")

    boxed = get("patternUnits") != "userSpaceOnUse"
    if holder is None or (boxed and box is None):
        return None
    x, y, width, height = _cell(get, size, box if boxed else None)
    if width <= 0 or height <= 0:
        return None
    own = times(matrix, parse_transform(get("patternTransform")))
    if spread(own)[1] <= 0:
        return None
    framed = next((each for each in chain if each.get("viewBox")), None)
    # Every renderer begins what a cell holds at the cell's own corner.
    content: Matrix = (1.0, 0.0, 0.0, 1.0, x, y)
    if framed is not None:
        frame = view_box(document, framed)
        content = times(content, fitted(frame, width, height, get("preserveAspectRatio")))
        size = (frame[2], frame[3]) if frame else size
    elif get("patternContentUnits") == "objectBoundingBox":
        if box is None:
            return None
        content, size = (box[2], 0.0, 0.0, box[3], x, y), (1.0, 1.0)
    hangs = boxed or any("%" in get(name) for name in ("x", "y", "width", "height"))
    return Pattern(server, holder, own, (x, y, width, height), content, size, hangs)


def _cell(get: Callable[[str], str], size: tuple[float, float], box: Box | None) -> Box:
    found = []
    for i, name in enumerate(("x", "y", "width", "height")):
        text = get(name) or "0"
        value = parse_px(text, 1.0 if box else size[i % 2])
        if value is None:
            raise ValueError(f'{name} = "{text[:40]}", expected a length')
        found.append(value)
    x, y, width, height = found
    if box is None:
        return x, y, width, height
    return box[0] + x * box[2], box[1] + y * box[3], width * box[2], height * box[3]


def _chain(document: Document, server: ET.Element) -> list[ET.Element]:
    """Return a pattern and those that it takes over from, the nearest first."""
    chain = [server]
    while len(chain) < MAX_DEPTH:
        found = document.by_id.get(reference(chain[-1])[1:])
        if found is None or found in chain or local(found) != "pattern":
            break
        chain.append(found)
    return chain


def fills_page(outline: Outline, page: Page) -> bool:
    """Whether an outline is a polygon that holds a page."""
    if len(outline.closed) != 1 or len(outline.points) < 3 or (outline.kinds == CURVE).any():
        return False
    slack = 1e-3 * max(page.width, page.height)
    inner = shapely.box(slack, slack, page.width - slack, page.height - slack)
    polygon = shapely.Polygon(outline.points)
    return bool(polygon.is_valid and polygon.covers(inner))
