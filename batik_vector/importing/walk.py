"""The walk over a drawing's tree: what is painted, in painting order, as outlines on the page.

Groups, nested pages, ``use`` and symbols are followed, transforms and styles carried down. What paints
without being an outline (pictures, text, masks, filters) is refused by name and line.
"""

from __future__ import annotations

import contextlib
import xml.etree.ElementTree as ET
from collections.abc import Container
from dataclasses import replace

import numpy as np

from batik_vector.geometry.paths.matrix import IDENTITY, Matrix, spread, times
from batik_vector.geometry.paths.outline import Outline, box
from batik_vector.importing.clip_paths import MAX_REACH_MM, Clip, ClipPaths, Part, Space, box_of, covers
from batik_vector.importing.document import (
    MAX_DEPTH,
    SWITCHES,
    Document,
    children,
    local,
    reference,
)
from batik_vector.importing.elements import PASSED, REFUSED
from batik_vector.importing.layer_names import layer_of
from batik_vector.importing.origins import transform_of
from batik_vector.importing.page import Box, Page, fitted, parse_px, view_box
from batik_vector.importing.paint import EXPAND, FIRST_COLOUR, SOLID, look_of, paint_of
from batik_vector.importing.painting import Paint
from batik_vector.importing.patterns import pattern_of, server_of
from batik_vector.importing.pens import NO_PEN, dots, lean_of, pen_of, stroke_first
from batik_vector.importing.scene import Here, Shape, Tiling
from batik_vector.importing.shapes import SHAPES, outline_of
from batik_vector.importing.styles import GEOMETRY, INITIAL, MOVES, Style, Styles, share_of

MAX_SHAPES = 1_000_000
MAX_POINTS = 20_000_000
"""Shapes and points a drawing may have once every ``use`` in it is followed."""
MAX_WORK = 1_000_000
"""Elements to which ``use`` may lead, painted or not, long attributes counted as several."""

_FOLLOWED = "once every use in it is followed"
DASHED = "dashed lines are taken as whole ones, but at the seam"
LOPSIDED = "lines under a lopsided transform have their mean breadth"
TILE_NOTES = frozenset((DASHED, LOPSIDED, SOLID, FIRST_COLOUR))
"""What is told of tiles alone: who draws every mark for itself draws these as they are, or refuses them."""


class Walker:
    """Collects what a document paints. :meth:`walk` is called once."""

    def __init__(self, document: Document, page: Page, only: Container[ET.Element] | None = None) -> None:
        """Ready a walk over all that is painted, or over ``only`` some elements and what a use leads to."""
        self.document = document
        self.page = page
        self._only = only
        self.shapes: list[Shape] = []
        self._styles = Styles(document)
        self._clip_paths = ClipPaths(document, self._styles, self._spend)
        self._measured: list[Outline] | None = None
        self._points = 0
        self._work = 0

    def walk(self) -> list[Shape]:
        """Return the shapes in painting order; fills by patterns are left as tilings.

        Raises:
            DrawingError: with all that cannot be read.
        """
        root = self.document.root
        style = self._styles.of(root, INITIAL)
        here = Here(self.page.matrix, style, size=self.page.size, opacity=_opacity(style), trail=(root,))
        if self._painted(root, style):
            self._refused_effects(root, style)
            here = replace(here, clips=self._clips(root, style, here))
            for child in children(root):
                self._visit(child, here, top=True)
        self.document.settle()
        return self.shapes

    def _visit(self, element: ET.Element, here: Here, top: bool = False) -> None:
        if here.used:
            self._spend(element)
        elif self._only is not None and element not in self._only:
            return
        kind = local(element)
        if kind in PASSED or not kind:
            return
        style = self._styles.of(element, here.style)
        if not self._painted(element, style):
            return
        if kind in REFUSED:
            if style["visibility"] == "visible" and (kind != "text" or "".join(element.itertext()).strip()):
                self.document.refuse(element, REFUSED[kind])
            return
        self._refuse_styled_geometry(element, kind, style)
        matrix = times(here.matrix, self._transform(element, style, here))
        if kind == "use":
            # They are one more transform of its own, and its clips lie behind it too (SVG 2, 5.6).
            x, y = _px(element.get("x"), 0.0, here.size[0]), _px(element.get("y"), 0.0, here.size[1])
            matrix = times(matrix, (1.0, 0.0, 0.0, 1.0, x, y))
        opacity = here.opacity * _opacity(style)
        inside = replace(
            here,
            matrix=matrix,
            style=style,
            depth=here.depth + 1,
            opacity=opacity,
            trail=(*here.trail, element),
        )
        if inside.depth > MAX_DEPTH:
            raise self.document.fault(f"nested deeper than {MAX_DEPTH} elements", element)
        self._refused_effects(element, style)
        if self._measured is None:
            clips = self._clips(element, style, inside)
            inside = replace(inside, clips=inside.clips + clips) if clips else inside
        self._enter(element, inside, top)

    def _enter(self, element: ET.Element, inside: Here, top: bool) -> None:
        """Draw an element whose own transform, style and clips are known."""
        kind = local(element)
        if kind in SHAPES:
            self._draw(element, inside)
        elif kind in ("g", "a"):
            inside = replace(inside, label=layer_of(element, inside.label, top))
            for child in children(element):
                self._visit(child, inside)
        elif kind == "switch":
            self._switch(element, inside)
        elif kind == "svg":
            self._viewport(element, inside)
        elif kind == "use":
            self._use(element, inside)
        else:
            self.document.note(f"<{kind}> is passed over")

    def _painted(self, element: ET.Element, style: Style) -> bool:
        return style.get("display") != "none" and _opacity(style) > 0

    def _spend(self, element: ET.Element) -> None:
        """Count the work that an element makes each time a use leads to it, drawn or not."""
        self._work += 1 + len(element) + sum(map(len, element.attrib.values())) // 100
        if self._work > MAX_WORK:
            raise self.document.fault(f"more than {MAX_WORK:,} elements, {_FOLLOWED}", element)

    def _refuse_styled_geometry(self, element: ET.Element, kind: str, style: Style) -> None:
        for name in GEOMETRY.get(kind, ()):
            if style.get(name, element.get(name)) != element.get(name):
                self.document.refuse(element, f"takes its {name} from a style; write it as an attribute")
        for name in MOVES:
            if style.get(name, "none") not in ("none", "normal"):
                self.document.refuse(element, f"is moved by the style {name}; write it as a transform")

    def _transform(self, element: ET.Element, style: Style, here: Here) -> Matrix:
        try:
            return transform_of(style, here.size)
        except ValueError as error:
            self.document.refuse(element, str(error))
            return IDENTITY

    def _switch(self, element: ET.Element, here: Here) -> None:
        """Draw the first child that asks for nothing beyond SVG."""
        for child in children(element):
            if not any(child.get(name) for name in SWITCHES) and local(child) != "foreignObject":
                self._visit(child, here)
                return

    def _viewport(self, element: ET.Element, here: Here, size: tuple[str, str] = ("", "")) -> None:
        """Draw a nested svg, or a symbol in the size that a use gives it."""
        width = _px(size[0] or element.get("width"), here.size[0], here.size[0])
        height = _px(size[1] or element.get("height"), here.size[1], here.size[1])
        if width <= 0 or height <= 0:
            return
        x, y = _px(element.get("x"), 0.0, here.size[0]), _px(element.get("y"), 0.0, here.size[1])
        frame = view_box(self.document, element)
        inner = fitted(frame, width, height, element.get("preserveAspectRatio", ""))
        outer = times(here.matrix, (1.0, 0.0, 0.0, 1.0, x, y))
        clips = here.clips
        if here.style.get("overflow", "hidden") not in ("visible", "auto"):
            edge = Clip(box(0.0, 0.0, width, height).moved(outer), (Part(1),))
            clips += () if self._holds_page(edge) else (edge,)
        inside = replace(
            here,
            matrix=times(outer, inner),
            size=(frame[2], frame[3]) if frame else (width, height),
            clips=clips,
        )
        for child in children(element):
            self._visit(child, inside)

    def _use(self, element: ET.Element, here: Here) -> None:
        target = reference(element)
        found = self.document.by_id.get(target[1:]) if target.startswith("#") else None
        if found is None:
            where = "another file" if target and not target.startswith("#") else "nothing in the file"
            self.document.refuse(element, f'refers to "{target[:60]}", {where}')
            return
        if found in here.used or found is self.document.root:
            self.document.refuse(element, f'refers to "{target[:60]}", which it is part of')
            return
        here = replace(here, used=(*here.used, found))
        if local(found) == "symbol":
            style = self._styles.of(found, here.style)
            if self._painted(found, style):
                matrix = times(here.matrix, self._transform(found, style, here))
                inside = replace(here, style=style, matrix=matrix, trail=(*here.trail, found))
                self._refuse_styled_geometry(found, "symbol", style)
                self._spend(found)
                self._refused_effects(found, style)
                if self._measured is None:
                    inside = replace(inside, clips=inside.clips + self._clips(found, style, inside))
                self._viewport(found, inside, (element.get("width", ""), element.get("height", "")))
        else:
            self._visit(found, here)

    def _draw(self, element: ET.Element, here: Here) -> None:
        style = here.style
        if self._measured is not None:
            self._measure(element, here)
            return
        server = server_of(self.document, style)
        stroke = paint_of(self.document, element, style, "stroke")
        fill = "" if server is not None else paint_of(self.document, element, style, "fill")
        width = _px(style["stroke-width"], 1.0, float(np.hypot(*here.size)) / 2**0.5)
        stroke = stroke if width > 0 else ""
        if style["visibility"] != "visible" or not (fill or stroke or server is not None):
            return
        try:
            drawn = outline_of(element, here.size)
        except ValueError as error:
            self.document.refuse(element, str(error))
            return
        if not len(drawn.points):
            return
        outline = drawn.moved(here.matrix)
        self._count(element, outline)
        if not (np.abs(outline.points) <= MAX_REACH_MM).all():
            self.document.refuse(element, f"reaches further than {MAX_REACH_MM / 1e6:g} km from the page")
            return
        if stroke:
            self._stroke_notes(element, style, here)
        breadth = self._breadth(style, width, here)
        names = here.label, element.get("id", "")
        looks = self._look("fill", fill, drawn, here), self._look("stroke", stroke, drawn, here)
        pen = pen_of(style, here.size, breadth / width) if stroke else NO_PEN
        shape = Shape(
            outline,
            *names,
            fill,
            style["fill-rule"],
            stroke,
            breadth,
            looks,
            pen,
            here.clips,
            trail=here.trail,
            stroke_first=stroke_first(style),
            lean=self._lean(style, here),
        )
        if server is not None:
            self._tile(element, shape, here, (server, box_of([drawn])))
        if fill or stroke:
            self.shapes.append(shape)
        if stroke:
            self._dot(shape, drawn, width, here)

    def _dot(self, shape: Shape, drawn: Outline, width: float, here: Here) -> None:
        """Draw where a stroke has no length: dots are areas of its ink, over the fill."""
        if here.style.get("vector-effect") == "non-scaling-stroke":
            outline = dots(shape.outline, shape.pen, shape.width / 2)
        else:
            outline = dots(drawn, shape.pen, width / 2).moved(here.matrix)
        if len(outline.points):
            looks = shape.looks[1], Paint("", "#000000")
            dotted = replace(
                shape, outline=outline, fill=shape.stroke, rule="nonzero", stroke="", looks=looks
            )
            self.shapes.append(dotted)

    def _tile(
        self, element: ET.Element, shape: Shape, here: Here, paint: tuple[ET.Element, Box | None]
    ) -> None:
        """Keep the fill of a shape by a pattern."""
        try:
            pattern = pattern_of(self.document, paint[0], here.matrix, here.size, paint[1])
        except ValueError as error:
            self.document.refuse(paint[0], str(error))
            return
        if pattern is not None:
            bare = replace(shape, stroke="", looks=(shape.looks[0], Paint("", "#000000")))
            self.shapes.append(replace(bare, tiling=Tiling(element, pattern, here)))

    def draw(self, element: ET.Element, here: Here) -> None:
        """Draw what an element holds, as another refers to it."""
        here = replace(here, style=self._styles.standing(element), used=(*here.used, element))
        for child in children(element):
            self._visit(child, here)

    def reach(self, element: ET.Element) -> Box | None:
        """Return the box, on the page in mm, of what an element draws where it stands, painted or not."""
        parents = {child: parent for parent in self.document.root.iter() for child in parent}
        line = [element]
        while line[-1] in parents:
            line.append(parents[line[-1]])
        here = Here(self.page.matrix, INITIAL, size=self.page.size)
        for each in reversed(line):
            here = replace(here, style=self._styles.of(each, here.style))
            here = replace(here, matrix=times(here.matrix, self._transform(each, here.style, here)))
        found = self._measured_within(element, here)
        return box_of(found)

    def _measure(self, element: ET.Element, here: Here) -> None:
        self._spend(element)
        if self._measured is not None:
            with contextlib.suppress(ValueError):
                self._measured.append(outline_of(element, here.size).moved(here.matrix))

    def _look(self, what: str, ink: str, drawn: Outline, here: Here) -> Paint | None:
        """Return how a fill or a stroke shows, and take note of what cannot be told."""
        if not ink:
            return Paint(ink, "#000000")

        def reach() -> Box:
            low, high = drawn.points.min(axis=0), drawn.points.max(axis=0)
            return float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1])

        look = look_of(self.document, here.style, what, ink, here.opacity, (here.matrix, reach))
        if look is None:
            self.document.leave_open("whether the colours of a mesh gradient agree at the seam")
        return look

    def _count(self, element: ET.Element, outline: Outline) -> None:
        self._points += len(outline.points)
        if len(self.shapes) >= MAX_SHAPES or self._points > MAX_POINTS:
            words = f"more than {MAX_SHAPES:,} shapes or {MAX_POINTS:,} points"
            raise self.document.fault(f"{words}, {_FOLLOWED}", element)

    def _breadth(self, style: Style, width: float, here: Here) -> float:
        if style.get("vector-effect") == "non-scaling-stroke":
            return width * spread(self.page.matrix)[0]
        most, least = spread(here.matrix)
        if most > 1.01 * least and style["stroke"] != "none":
            self.document.note(LOPSIDED)
        return width * float((most * least) ** 0.5)

    def _lean(self, style: Style, here: Here) -> Matrix | None:
        scaling = style.get("vector-effect") != "non-scaling-stroke"
        return lean_of(here.matrix) if scaling and style["stroke"] != "none" else None

    def _stroke_notes(self, element: ET.Element, style: Style, here: Here) -> None:
        if style["stroke-dasharray"] not in ("none", "0"):
            self.document.note(DASHED)
        if any(style[name] != "none" for name in ("marker-start", "marker-mid", "marker-end")):
            self.document.refuse(element, f"has markers at its ends; {EXPAND}")

    def _refused_effects(self, element: ET.Element, style: Style) -> None:
        for name in ("mask", "filter"):
            if style.get(name, "none") not in ("none", ""):
                self.document.refuse(element, f"has a {name}; {EXPAND}")
        if style.get("mix-blend-mode", "normal") != "normal":
            self.document.leave_open("how colours that are blended (mix-blend-mode) show at the seam")

    def _clips(self, element: ET.Element, style: Style, here: Here) -> tuple[Clip, ...]:
        """Return the clips of an element itself; mere frames round the page are left out."""
        space = Space(here.matrix, here.size, lambda: self._box(element, here))
        found = self._clip_paths.of(element, style, space)
        return tuple(clip for clip in found if not self._holds_page(clip))

    def _holds_page(self, clip: Clip) -> bool:
        """Whether a clip is a mere frame round the page, as Figma and Illustrator set one about all."""
        plain = len(clip.parts) == 1 and not clip.parts[0].within and clip.parts[0].subpaths == 1
        return plain and covers(clip.outline, self.page.width, self.page.height)

    def _box(self, element: ET.Element, here: Here) -> Box | None:
        """Return the box of what an element draws, painted or not, in its own units."""
        return box_of(self._measured_within(element, replace(here, matrix=IDENTITY)))

    def _measured_within(self, element: ET.Element, here: Here) -> list[Outline]:
        kept, self._measured = self._measured, []
        self._enter(element, replace(here, used=(*here.used, element)), False)
        found, self._measured = self._measured, kept
        return found


def _opacity(style: Style) -> float:
    return share_of(style.get("opacity", "1"))


def _px(text: str | None, default: float, whole: float) -> float:
    value = parse_px(text, whole)
    return default if value is None else value
