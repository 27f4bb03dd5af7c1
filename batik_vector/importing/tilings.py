"""Fills by patterns, drawn: a page filled by one is its cell, and on other marks cells lie side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from batik_vector.geometry.paths.matrix import inverse_of, moved, spread, times
from batik_vector.geometry.paths.outline import box
from batik_vector.importing.clip_paths import Clip, Part
from batik_vector.importing.document import Document, DrawingError, local, named
from batik_vector.importing.page import MM_PER_PX, Page, page_of
from batik_vector.importing.paint import EXPAND
from batik_vector.importing.patterns import MAX_CELLS, Pattern, fills_page
from batik_vector.importing.scene import Shape, Tiling
from batik_vector.importing.styles import share_of
from batik_vector.importing.walk import Walker
from batik_vector.units import format_mm

WINDOW_PX = 1000.0
"""Sides of the window in which a page without a size is looked at: what fills it fills any other."""
OVER = 1e-9
"""Part of a cell by which what it holds may hang over unseen."""


def drawn(document: Document) -> tuple[Page, list[Shape]]:
    """Return the page of a document, or the cell of the pattern that fills it, and what is painted on it.

    Raises:
        DrawingError: where it has no size, or draws what is no geometry.
    """
    try:
        page, unsized = page_of(document), None
    except DrawingError as error:
        if not any(local(each) == "pattern" for each in document.root.iter()) or document.root.get("viewBox"):
            raise
        scale = (MM_PER_PX, 0.0, 0.0, MM_PER_PX, 0.0, 0.0)
        side = WINDOW_PX * MM_PER_PX
        page, unsized = Page(side, side, scale, (WINDOW_PX, WINDOW_PX)), error
    walker = Walker(document, page)
    shapes = walker.walk()
    grounds = _grounds(shapes, page)
    if grounds is not None and not (unsized and grounds[1].pattern.hangs):
        return _tile(document, *grounds)
    if unsized:
        raise unsized
    if any(shape.tiling for shape in shapes):
        shapes = _expanded(walker, shapes)
        document.settle()
    return page, shapes


def _grounds(shapes: Sequence[Shape], page: Page) -> tuple[list[Shape], Tiling] | None:
    """Return plain grounds and the pattern over them, where shapes are no more than that."""
    if not shapes or not all(fills_page(shape.outline, page) and not shape.clips for shape in shapes):
        return None
    *under, last = shapes
    if last.tiling is None or any(shape.tiling or shape.stroke for shape in under):
        return None
    return under, last.tiling


def _tile(document: Document, under: list[Shape], tiling: Tiling) -> tuple[Page, list[Shape]]:
    """Return the cell of a pattern as a page, and what is painted on it."""
    page, skewed = tiling.pattern.page()
    size = f"{format_mm(page.width)} × {format_mm(page.height)} mm"
    document.note(
        f"the page is filled by the {named(tiling.pattern.server)}: its cell of {size} is taken as the tile"
    )
    if skewed:
        document.note("the pattern is skewed; its cell is measured before that, in the pattern's own frame")
    walker = Walker(document, page)
    here = replace(
        tiling.here,
        matrix=page.matrix,
        size=tiling.pattern.size,
        opacity=_opacity(tiling),
        clips=(),
        label="",
    )
    walker.draw(tiling.pattern.holder, here)
    whole = box(0.0, 0.0, page.width, page.height)
    shapes = _expanded(walker, walker.shapes)
    document.settle()
    return page, [*(replace(shape, outline=whole) for shape in under), *shapes]


def _opacity(tiling: Tiling) -> float:
    return tiling.here.opacity * share_of(tiling.here.style["fill-opacity"])


def _expanded(walker: Walker, shapes: Sequence[Shape]) -> list[Shape]:
    """Return shapes, cells drawn in the place of tilings."""
    found: list[Shape] = []
    # Drawing cells adds to the walker's own list, which this may be.
    for shape in list(shapes):
        if shape.tiling is None:
            found.append(shape)
        else:
            found += _expanded(walker, _cells(walker, shape, shape.tiling))
    return found


def _cells(walker: Walker, shape: Shape, tiling: Tiling) -> list[Shape]:
    """Return the cells of a pattern that a mark shows, clipped to it."""
    pattern, here, document = tiling.pattern, tiling.here, walker.document
    if pattern.holder in here.used:
        document.refuse(tiling.element, "is filled with a pattern that it is part of")
        return []
    count = pattern.count(shape.outline)
    if not count <= MAX_CELLS:
        document.refuse(
            tiling.element,
            f"is filled with a pattern of {count:,.0f} cells, expected at most {MAX_CELLS:,}; {EXPAND}",
        )
        return []
    mark = Clip(shape.outline, (Part(len(shape.outline.closed), shape.rule == "evenodd"),))
    clips = (*here.clips, mark)
    found: list[Shape] = []
    over: bool | None = None
    for x, y in pattern.shifts(shape.outline):
        there = times(pattern.matrix, (1.0, 0.0, 0.0, 1.0, x, y))
        begin = len(walker.shapes)
        matrix = times(there, pattern.content)
        walker.draw(
            pattern.holder,
            replace(here, matrix=matrix, size=pattern.size, opacity=_opacity(tiling), clips=clips),
        )
        mine = walker.shapes[begin:]
        if over is None:
            over = _hangs_over(mine, pattern, x, y)
        if over:
            frame = Clip(box(*pattern.cell).moved(there), (Part(1),))
            mine = [replace(each, clips=(*each.clips, frame)) for each in mine]
        found += mine
    return found


def _hangs_over(shapes: Sequence[Shape], pattern: Pattern, x: float, y: float) -> bool:
    """Whether anything that a cell holds reaches beyond it."""
    back = inverse_of(pattern.matrix)
    low = np.array(pattern.cell[:2]) + (x, y)
    high = low + pattern.cell[2:]
    slack = OVER * np.array(pattern.cell[2:])
    for shape in shapes:
        reach = shape.width / 2 * max(shape.pen.limit, 1.5) * spread(back)[0] if shape.stroke else 0.0
        there = moved(shape.outline.points, back)
        if (there.min(axis=0) - reach < low - slack).any() or (
            there.max(axis=0) + reach > high + slack
        ).any():
            return True
    return False
