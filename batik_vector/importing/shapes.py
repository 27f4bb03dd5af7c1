"""SVG's basic shapes as outlines (SVG 2, chapter 10)."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

from batik_vector.geometry.paths.data import parse_path
from batik_vector.geometry.paths.outline import EMPTY, Outline, polyline
from batik_vector.geometry.paths.shapes import ellipse, rectangle
from batik_vector.importing.document import local
from batik_vector.importing.page import parse_px
from batik_vector.patterns import numbers_in

SHAPES = frozenset(("path", "rect", "circle", "ellipse", "line", "polyline", "polygon"))


def outline_of(element: ET.Element, size: tuple[float, float]) -> Outline:
    """Return the outline of a shape in its own units.

    Args:
        element: one of ``SHAPES``.
        size: the sides of its viewport, of which percentages are shares.

    Raises:
        ValueError: saying which of its attributes cannot be read.
    """
    kind = local(element)
    if kind == "path":
        return parse_path(element.get("d") or "")
    if kind in ("polyline", "polygon"):
        return _points(element.get("points") or "", kind == "polygon")
    read = _Reader(element, size)
    if kind == "line":
        ends = [[read.x("x1"), read.y("y1")], [read.x("x2"), read.y("y2")]]
        return polyline(np.array(ends), False)
    if kind == "rect":
        width, height = read.x("width"), read.y("height")
        if width <= 0 or height <= 0:
            return EMPTY
        rx, ry = read.maybe("rx", size[0]), read.maybe("ry", size[1])
        rx, ry = (ry if rx is None else rx), (rx if ry is None else ry)
        return rectangle(read.x("x"), read.y("y"), width, height, rx or 0.0, ry or 0.0)
    if kind == "circle":
        rx = ry = read.one("r", float(np.hypot(*size)) / 2**0.5)
    else:
        across, down = read.maybe("rx", size[0]), read.maybe("ry", size[1])
        rx = (down if across is None else across) or 0.0
        ry = (across if down is None else down) or 0.0
    return ellipse(read.x("cx"), read.y("cy"), rx, ry) if rx > 0 and ry > 0 else EMPTY


class _Reader:
    """Reads lengths of an element."""

    def __init__(self, element: ET.Element, size: tuple[float, float]) -> None:
        self._element, self._size = element, size

    def x(self, name: str) -> float:
        return self.one(name, self._size[0])

    def y(self, name: str) -> float:
        return self.one(name, self._size[1])

    def one(self, name: str, whole: float) -> float:
        return self.maybe(name, whole) or 0.0

    def maybe(self, name: str, whole: float) -> float | None:
        text = (self._element.get(name) or "").strip()
        if not text or text == "auto":
            return None
        value = parse_px(text, whole)
        if value is None:
            raise ValueError(f'{name} = "{text[:40]}", expected a length')
        return value


def _points(text: str, closed: bool) -> Outline:
    numbers = numbers_in(text)
    if numbers is None:
        raise ValueError(f'points = "{text[:40]}" cannot be read')
    if len(numbers) % 2:
        raise ValueError(f"points with {len(numbers)} numbers, expected pairs")
    return polyline(np.array(numbers, float).reshape(-1, 2), closed)
