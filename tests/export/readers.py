"""Readers of our files that share nothing with the writers."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

import numpy as np

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
Point = tuple[float, float]


@dataclass
class Ring:
    """A subpath: its points, the first not repeated unless the file repeats it, and how it is drawn."""

    points: list[Point] = field(default_factory=list)
    closed: bool = False
    curves: int = 0

    @property
    def area(self) -> float:
        """Signed area."""
        p = np.array(self.points)
        q = np.roll(p, -1, axis=0)
        return float((p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]).sum() / 2)

    @property
    def length(self) -> float:
        p = np.array([*self.points, self.points[0]] if self.closed else self.points)
        return float(np.hypot(*np.diff(p, axis=0).T).sum())


def bezier(p0: Point, p1: Point, p2: Point, p3: Point) -> list[Point]:
    """Twenty points on a cubic, without its start."""
    t = np.arange(1, 21)[:, None] / 20
    a, b, c, d = (np.array(p) for p in (p0, p1, p2, p3))
    curve = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
    return [(float(x), float(y)) for x, y in curve]


def svg_path(d: str) -> list[Ring]:
    """Read M, L, C and Z, absolute, with repeated commands left out as SVG allows."""
    tokens = re.findall(r"[A-Za-z]|-?\d+(?:\.\d+)?", d)
    assert re.fullmatch(r"(?:[MLCZ]|[ ]|-?\d+(?:\.\d+)?)*", d)
    rings: list[Ring] = []
    command, at = "", 0

    def pair() -> Point:
        nonlocal at
        at += 2
        return float(tokens[at - 2]), float(tokens[at - 1])

    while at < len(tokens):
        if tokens[at].isalpha():
            command, at = tokens[at], at + 1
        if command == "Z":
            rings[-1].closed = True
        elif command == "M":
            rings.append(Ring([pair()]))
            command = "L"
        elif command == "L":
            rings[-1].points.append(pair())
        else:
            assert command == "C"
            rings[-1].points += bezier(rings[-1].points[-1], pair(), pair(), pair())
            rings[-1].curves += 1
    return rings


def svg_layers(data: bytes) -> dict[str, ET.Element]:
    """Layers of an SVG by label; they must be direct children of the root."""
    root = ET.fromstring(data)
    layers = [g for g in root if g.get(f"{INKSCAPE}groupmode") == "layer"]
    assert len(layers) == len([e for e in root.iter() if e.get(f"{INKSCAPE}groupmode")])
    return {g.get(f"{INKSCAPE}label", ""): g for g in layers}


def svg_rings(layer: ET.Element, filled: bool) -> list[Ring]:
    """Rings of a layer's paths and polygons that are filled, or stroked."""
    rings = []
    for group in layer.iter(f"{SVG}g"):
        fill = group.get("fill")
        if fill is not None and (fill != "none") == filled:
            for path in group.findall(f"{SVG}path"):
                rings += svg_path(path.get("d", ""))
            for polygon in group.findall(f"{SVG}polygon"):
                numbers = [float(number) for number in polygon.get("points", "").split()]
                rings.append(Ring(list(zip(numbers[0::2], numbers[1::2], strict=True)), closed=True))
    return rings


def pdf_rings(content: str, layer: int) -> tuple[list[Ring], list[Ring]]:
    """Rings filled and rings stroked in an optional-content layer, in the stream's own units."""
    body = content.split(f"/OC /L{layer} BDC\n")[1].split("EMC\n")[0]
    filled: list[Ring] = []
    stroked: list[Ring] = []
    path: list[Ring] = []
    stack: list[float] = []
    for token in body.split():
        pairs = list(zip(stack[0::2], stack[1::2], strict=False))
        if re.fullmatch(r"-?\d+(?:\.\d+)?", token):
            stack.append(float(token))
            continue
        if token == "m":
            path.append(Ring(pairs))
        elif token == "l":
            path[-1].points += pairs
        elif token == "c":
            path[-1].points += bezier(path[-1].points[-1], *pairs)
            path[-1].curves += 1
        elif token == "re":
            x, y, w, h = stack
            path.append(Ring([(x, y), (x + w, y), (x + w, y + h), (x, y + h)], closed=True))
        elif token == "h":
            path[-1].closed = True
        elif token in ("f", "f*", "S"):
            (stroked if token == "S" else filled).extend(path)
            path = []
        else:
            assert token in ("rg", "RG", "w", "cs", "CS", "scn", "SCN") or token.startswith("/S"), token
        stack = []
    assert not path
    return filled, stroked
