"""Clip paths as SVG writes them (CSS Masking 1, 5), read as outlines on the page."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from batik_vector.geometry.paths.matrix import Matrix, times
from batik_vector.geometry.paths.outline import EMPTY, Outline, bounds_of, joined
from batik_vector.importing.document import Document, children, local, reference
from batik_vector.importing.elements import REFUSED
from batik_vector.importing.origins import transform_of
from batik_vector.importing.page import Box, parse_px
from batik_vector.importing.paint import EXPAND, url_of
from batik_vector.importing.shapes import SHAPES, outline_of
from batik_vector.importing.styles import Style, Styles
from batik_vector.values import frozen

MAX_REACH_MM = 1e6
"""How far from the page a shape may reach; further off, products of whole µm leave 64 bits."""


FRAME_SLACK = 1e-3
"""Parts of a side by which a clip may fall short of what it holds and still cut nothing away."""


@frozen(eq=False)
class Part:
    """One shape of a clip: how many of its subpaths are its own, its fill rule, and what clips it in turn."""

    subpaths: int
    evenodd: bool = False
    within: tuple[Clip, ...] = ()


@frozen(eq=False)
class Clip:
    """A region of the page (mm, y down): all that its parts cover. ``outline`` has their subpaths in turn."""

    outline: Outline
    parts: tuple[Part, ...]


@frozen
class Space:
    """Where a reference to a clip stands: its units, its viewport's sides, and the box of what is clipped."""

    matrix: Matrix
    size: tuple[float, float]
    box: Callable[[], Box | None]


@dataclass
class ClipPaths:
    """Reads the clip paths of a document; ``spend`` counts each element that is looked at."""

    document: Document
    styles: Styles
    spend: Callable[[ET.Element], None]
    _known: dict[object, tuple[Clip, ...]] = field(default_factory=dict)

    def of(
        self, element: ET.Element, style: Style, space: Space, used: tuple[ET.Element, ...] = ()
    ) -> tuple[Clip, ...]:
        """Return the clips that an element's style sets; what it draws shows where all of them let it."""
        text = style.get("clip-path", "none")
        if text in ("none", ""):
            return ()
        url = url_of(text)
        if url is None:
            self.document.refuse(element, f"is clipped; {EXPAND}")
            return ()
        target = url[0]
        clip = self.document.by_id.get(target[1:]) if target.startswith("#") else None
        # A reference to nothing, or to what is no clip, clips nothing.
        if clip is None or local(clip) != "clipPath":
            return ()
        if clip in used:
            self.document.refuse(element, f'is clipped by "{target[:60]}", which it is part of')
            return ()
        boxed = clip.get("clipPathUnits") == "objectBoundingBox"
        box = space.box() if boxed else None
        key = clip, space.matrix, space.size, boxed, box
        if key not in self._known:
            self._known[key] = self._read(clip, space, boxed, box, (*used, clip))
        return self._known[key]

    def _read(
        self, clip: ET.Element, space: Space, boxed: bool, box: Box | None, used: tuple[ET.Element, ...]
    ) -> tuple[Clip, ...]:
        style = self.styles.standing(clip)
        matrix = times(space.matrix, self._transform(clip, style, space.size))
        size = space.size
        outlines: list[Outline] = []
        parts: list[Part] = []
        if box is not None:
            matrix, size = times(matrix, (box[2], 0.0, 0.0, box[3], box[0], box[1])), (1.0, 1.0)
        if not boxed or box is not None:
            inside = Space(matrix, size, space.box)
            for child in children(clip):
                self._add(child, style, inside, used, (outlines, parts), ())
        return Clip(joined(outlines), tuple(parts)), *self.of(clip, style, space, used)

    def _add(
        self,
        element: ET.Element,
        parent: Style,
        space: Space,
        used: tuple[ET.Element, ...],
        found: tuple[list[Outline], list[Part]],
        within: tuple[Clip, ...],
    ) -> None:
        """Add the shape that an element of a clip draws, or refers to."""
        self.spend(element)
        kind = local(element)
        style = self.styles.of(element, parent)
        if style.get("display") == "none" or kind not in (*SHAPES, "use", "text"):
            return
        if kind == "text":
            self.document.refuse(element, REFUSED["text"])
            return
        matrix = times(space.matrix, self._transform(element, style, space.size))
        if kind == "use":
            x, y = (parse_px(element.get(name), space.size[i]) or 0.0 for i, name in enumerate("xy"))
            matrix = times(matrix, (1.0, 0.0, 0.0, 1.0, x, y))
        here = Space(matrix, space.size, lambda: _box_of(element, space.size))
        within += self.of(element, style, here, used)
        if kind == "use":
            target = self.document.by_id.get(reference(element)[1:])
            if target is not None and local(target) != "use":
                self._add(target, style, here, used, found, within)
        elif style["visibility"] == "visible":
            outline = self._outline(element, here)
            found[0].append(outline)
            found[1].append(Part(len(outline.closed), style["clip-rule"] == "evenodd", within))

    def _outline(self, element: ET.Element, space: Space) -> Outline:
        try:
            outline = outline_of(element, space.size).moved(space.matrix)
        except ValueError as error:
            self.document.refuse(element, str(error))
            return EMPTY
        if not (np.abs(outline.points) <= MAX_REACH_MM).all():
            self.document.refuse(element, f"reaches further than {MAX_REACH_MM / 1e6:g} km from the page")
            return EMPTY
        return outline

    def _transform(self, element: ET.Element, style: Style, size: tuple[float, float]) -> Matrix:
        try:
            return transform_of(style, size)
        except ValueError as error:
            self.document.refuse(element, str(error))
            return 1.0, 0.0, 0.0, 1.0, 0.0, 0.0


def _box_of(element: ET.Element, size: tuple[float, float]) -> Box | None:
    try:
        return box_of([outline_of(element, size)])
    except (ValueError, KeyError):
        return None


def box_of(outlines: list[Outline]) -> Box | None:
    """Return left, top, width and height of what outlines reach; None where it has no breadth or height."""
    outline = joined(outlines)
    if not len(outline.points):
        return None
    x, y, right, low = bounds_of(outline)
    return (x, y, right - x, low - y) if right > x and low > y else None


def covers(outline: Outline, width: float, height: float) -> bool:
    """Whether an outline is an upright rectangle that holds the page."""
    points = outline.points
    low, high = points.min(axis=0), points.max(axis=0)
    slack = FRAME_SLACK * max(width, height)
    upright = (np.isclose(points, low, atol=1e-6) | np.isclose(points, high, atol=1e-6)).all()
    corners = len(np.unique(np.round(points, 6), axis=0)) == 4
    holds = (low <= slack).all() and (high >= np.array([width, height]) - slack).all()
    return bool(upright and corners and holds)
