"""Gradients as ramps of colours: what colour a linear or a radial gradient has at a place.

SVG 2, 14.2: stops, spread methods, units and transforms, and what a gradient takes over from another.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.paths.matrix import Matrix, inverse_of, moved, times
from batik_vector.importing.colours import colour_of
from batik_vector.importing.document import MAX_DEPTH, Document, children, local, reference
from batik_vector.importing.page import parse_px
from batik_vector.importing.styles import share_of
from batik_vector.importing.transforms import parse_transform
from batik_vector.values import frozen

Floats = NDArray[np.float64]
LEAST = 1e-12
"""Determinant below which a gradient's space has no breadth, and nothing is drawn by it."""


@frozen(eq=False)
class Gradient:
    """The colours of a gradient: ``inverse`` takes places on the page (mm, y down) to its own space.

    ``along`` returns how far along the ramp places of that space lie, ``spread`` what holds beyond its ends;
    ``stops`` are offsets, shape (k,), and ``colours`` red, green, blue, opacity, shape (k, 4).
    """

    inverse: Matrix
    along: Callable[[Floats], Floats]
    spread: str
    stops: Floats
    colours: Floats

    def at(self, xy: Floats) -> Floats:
        """Return the colours at places in mm, as :class:`~batik_vector.importing.painting.Ramp` does."""
        t = self.along(moved(xy, self.inverse))
        if self.spread == "repeat":
            t = t % 1.0
        elif self.spread == "reflect":
            t = 1 - np.abs(t % 2.0 - 1)
        return np.column_stack([np.interp(t, self.stops, level) for level in self.colours.T])

    def under(self, matrix: Matrix) -> Gradient:
        """Return the gradient of a drawing that was moved by an affine map."""
        return Gradient(
            times(self.inverse, inverse_of(matrix)), self.along, self.spread, self.stops, self.colours
        )


def gradient_of(
    document: Document,
    server: ET.Element,
    matrix: Matrix,
    box: tuple[float, float, float, float],
    current: str,
) -> Gradient | None:
    """Return the ramp of a gradient element, or None where it is of a kind that is not understood.

    Args:
        document: where it stands.
        server: the gradient.
        matrix: from the painted element's user units to the page.
        box: left, upper edge, width and height of the element in its user units.
        current: the colour that ``currentColor`` is.
    """
    chain = _chain(document, server)
    kind = local(server)
    stops, colours = _stops(chain, current)
    if kind not in ("linearGradient", "radialGradient") or not len(stops):
        return None
    get = _getter(chain, kind)
    user = get("gradientUnits") == "userSpaceOnUse"
    outer = matrix if user else times(matrix, (box[2], 0.0, 0.0, box[3], box[0], box[1]))
    try:
        inner = parse_transform(get("gradientTransform"))
    except ValueError:
        return None
    whole = times(outer, inner)
    if abs(whole[0] * whole[3] - whole[1] * whole[2]) < LEAST:
        return None
    along = (_linear if kind == "linearGradient" else _radial)(get, box[2:] if user else (1.0, 1.0))
    return Gradient(inverse_of(whole), along, get("spreadMethod"), stops, colours)


def _chain(document: Document, server: ET.Element) -> list[ET.Element]:
    """Return a gradient and those it takes over from, the nearest first."""
    chain = [server]
    while len(chain) < MAX_DEPTH:
        found = document.by_id.get(reference(chain[-1])[1:])
        if found is None or found in chain:
            break
        chain.append(found)
    return chain


def _getter(chain: list[ET.Element], kind: str) -> Callable[[str], str]:
    def get(name: str) -> str:
        for each in chain:
            shared = name in ("gradientUnits", "gradientTransform", "spreadMethod")
            if (shared or local(each) == kind) and each.get(name) is not None:
                return (each.get(name) or "").strip()
        return ""

    return get


def _stops(chain: list[ET.Element], current: str) -> tuple[Floats, Floats]:
    """Return offsets, never falling, and colours."""
    for each in chain:
        stops = [child for child in children(each) if local(child) == "stop"]
        if stops:
            break
    else:
        return np.empty(0), np.empty((0, 4))
    offsets, colours = [], []
    for stop in stops:
        offsets.append(share_of((stop.get("offset") or "0").strip()) if stop.get("offset") else 0.0)
        found = colour_of(declared_on(stop, "stop-color") or "black", current) or ("#000000", 1.0)
        opacity = found[1] * share_of(declared_on(stop, "stop-opacity") or "1")
        colours.append([*(int(found[0][i : i + 2], 16) / 255 for i in (1, 3, 5)), opacity])
    return np.maximum.accumulate(np.array(offsets)), np.array(colours)


def declared_on(stop: ET.Element, name: str) -> str:
    """Return what a stop says of one property, by its style or by an attribute."""
    pairs = (part.split(":", 1) for part in (stop.get("style") or "").split(";") if ":" in part)
    values = {key.strip(): value.strip() for key, value in pairs}
    return values.get(name) or stop.get(name) or ""


def _length(get: Callable[[str], str], name: str, default: str, whole: float) -> float:
    text = get(name) or default
    value = parse_px(text, whole)
    return 0.0 if value is None else value


def _linear(get: Callable[[str], str], size: tuple[float, ...]) -> Callable[[Floats], Floats]:
    x1, x2 = (_length(get, name, default, size[0]) for name, default in (("x1", "0%"), ("x2", "100%")))
    y1, y2 = (_length(get, name, "0%", size[1]) for name in ("y1", "y2"))
    way = np.array([x2 - x1, y2 - y1])
    square = float(way @ way)

    def along(xy: Floats) -> Floats:
        # Without a way, the last colour holds (SVG 2, 14.2.2).
        return np.asarray((xy - np.array([x1, y1])) @ way / square) if square else np.ones(len(xy))

    return along


def _radial(get: Callable[[str], str], size: tuple[float, ...]) -> Callable[[Floats], Floats]:
    side = math.hypot(*size) / 2**0.5
    centre = np.array([_length(get, "cx", "50%", size[0]), _length(get, "cy", "50%", size[1])])
    radius = _length(get, "r", "50%", side)
    focus = np.array(
        [
            _length(get, "fx", "", size[0]) if get("fx") else centre[0],
            _length(get, "fy", "", size[1]) if get("fy") else centre[1],
        ]
    )

    def along(xy: Floats) -> Floats:
        if radius <= 0:
            return np.ones(len(xy))
        # The circle through a place, of the cone from the focus to the outer circle:
        # |p - f - t (c - f)| = t r.
        p, axis = xy - focus, centre - focus
        a = float(axis @ axis) - radius**2
        b, c = p @ axis, (p * p).sum(axis=1)
        root = np.sqrt(np.maximum(b * b - a * c, 0.0))
        return np.asarray((b - root) / a if abs(a) > LEAST else c / np.where(b == 0, 1.0, 2 * b))

    return along
