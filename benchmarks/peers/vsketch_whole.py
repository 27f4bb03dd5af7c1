"""vsketch with shapely: the tiles of the four-square flower that the sweep makes, each with another pistil.

python -m benchmarks.peers.vsketch_whole COUNT FOLDER     save so many sketches
python -m benchmarks.peers.vsketch_whole areas            the area (mm²) of each ink of one

What vsketch has no words for shapely does, as a script would let it: the curves of an element are united at
once, what lies on top is cut out of what lies beneath with its gap, lines become areas, and what crosses the
tile's edge comes in on the other side. Inks are layers. Points are as many as our tiles have, about.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import affinity

from benchmarks.peers.vsketch_svg import page

SIDE, SCALE, LINE = 320.0, 60.0, 1.4
PISTIL = 0.8
INKS = ("light", "wax")
FLOWERS = ((80, 80), (240, 80), (240, 240), (80, 240))
BUDS = ((0, 0), (160, 0), (0, 160), (160, 160))
KNOTS = ((0, 80), (160, 80), (0, 240), (160, 240), (80, 0), (240, 0), (80, 160), (240, 160))

Points = NDArray[np.float64]
Sheets = dict[str, shapely.Geometry]


def leaf(a: float, b: float, length: float, width: float) -> Points:
    """Return a superellipse."""
    t = 2 * np.pi * np.linspace(0, 1, 96, endpoint=False)
    cos, sin = np.cos(t), np.sin(t)
    return np.column_stack([length * np.sign(cos) * abs(cos) ** a, width * np.sign(sin) * abs(sin) ** b])


def petal(n: int, length: float) -> Points:
    """Return one petal of a rose."""
    t = np.linspace(-np.pi / 2 / n, np.pi / 2 / n, 48)
    return np.asarray(length * np.cos(n * t)[:, None] * np.column_stack([np.cos(t), np.sin(t)]))


def star(length: float) -> shapely.Geometry:
    """Return all that lies within a hypocycloid of 16 cusps, every fifth joined."""
    q, t = 16 / 5, 2 * np.pi * np.linspace(0, 5, 640, endpoint=False)
    x, y = (q - 1) * np.cos(t) + np.cos((q - 1) * t), (q - 1) * np.sin(t) - np.sin((q - 1) * t)
    ring = length / q * SCALE * np.column_stack([x, y])
    crossed = shapely.node(shapely.LineString(np.append(ring, ring[:1], axis=0)))
    faces = shapely.get_parts(shapely.polygonize([crossed]))
    return shapely.union_all([shapely.Polygon(each.exterior) for each in faces])


def disc(radius: float, at: Points | None = None) -> shapely.Geometry:
    """Return discs about places in motif units."""
    centres = shapely.points(np.zeros((1, 2)) if at is None else at * SCALE)
    return shapely.union_all(shapely.buffer(centres, radius * SCALE, quad_segs=8))


def turned(curve: Points, turns: Sequence[float]) -> shapely.Geometry:
    """Return a curve turned about the centre by each of some angles in degrees, as areas."""
    parts = shapely.get_parts(shapely.make_valid(shapely.polygons(outlines(curve, turns))))
    return shapely.union_all(parts[shapely.area(parts) > 0])


def outlines(curve: Points, turns: Sequence[float]) -> Points:
    """Return a closed curve turned about the centre by each of some angles in degrees, in mm."""
    angles = np.radians(turns)
    ways = np.array([[np.cos(angles), np.sin(angles)], [-np.sin(angles), np.cos(angles)]]).transpose(2, 0, 1)
    return np.asarray(SCALE * (np.append(curve, curve[:1], axis=0) @ ways))


def placed(shape: shapely.Geometry, places: Sequence[tuple[float, float]]) -> shapely.Geometry:
    """Return a shape at all places of the tile, what crosses its edges on the other side too."""
    moved = []
    for x, y in places:
        for across in (-SIDE, 0, SIDE):
            for up in (-SIDE, 0, SIDE):
                there = affinity.translate(shape, x + across, y + up)
                if shapely.intersects(there, TILE):
                    moved.append(there)
    return shapely.intersection(shapely.union_all(moved), TILE)


TILE = shapely.box(0, 0, SIDE, SIDE)


class Sheet:
    """The tile as it is drawn, ink by ink, bottom first."""

    def __init__(self) -> None:
        self.inks: Sheets = {ink: shapely.Polygon() for ink in INKS}

    def cut(self, shape: shapely.Geometry, places: Sequence[tuple[float, float]], gap: float) -> None:
        """Cut out of all inks what lies within a gap of a shape."""
        hole = placed(shapely.buffer(shape, gap) if gap else shape, places)
        for ink in INKS:
            self.inks[ink] = shapely.difference(self.inks[ink], hole)

    def draw(
        self, shape: shapely.Geometry, places: Sequence[tuple[float, float]], ink: str, gap: float = 0.0
    ) -> None:
        """Lay a shape over all that is there."""
        self.cut(shape, places, gap)
        self.inks[ink] = shapely.union(self.inks[ink], placed(shape, places))


def tile(pistil: float) -> Sheets:
    """Return what each ink of the tile covers."""
    sheet = Sheet()
    eight, four = range(0, 360, 45), range(0, 360, 90)
    blade, ways = leaf(0.2, 20, 1.2, 0.3), [22.5 + 45 * k for k in range(4)]
    sheet.draw(turned(blade, ways), FLOWERS, "wax")
    lines = shapely.buffer(shapely.linestrings(outlines(blade, ways)), LINE / 2)
    sheet.draw(shapely.union_all(lines), FLOWERS, "wax")
    sheet.cut(turned(petal(2, 1.0), eight), FLOWERS, 2.8)
    sheet.draw(turned(petal(2, 1.0), [45 + k for k in four]), FLOWERS, "light")
    sheet.draw(turned(petal(2, 1.0), four), FLOWERS, "wax", 1.4)
    sheet.cut(star(pistil), FLOWERS, 0.6)
    sheet.draw(turned(petal(4, 0.5), eight), FLOWERS, "wax", 1.2)
    sheet.cut(disc(0.1), FLOWERS, 0.0)
    angles = np.radians([18.75 + 90 * side + 7.5 * k for side in range(4) for k in range(8)])
    sheet.draw(disc(0.026, 1.3333 * np.column_stack([np.cos(angles), np.sin(angles)])), FLOWERS, "wax")
    sheet.draw(turned(leaf(0.3, 5, 0.46, 0.13), [0, 90]), BUDS, "light")
    sheet.draw(turned(petal(2, 0.37), [45 + k for k in four]), BUDS, "wax", 1.4)
    sheet.cut(turned(petal(2, 0.22), [45 + k for k in four]), BUDS, 0.0)
    sheet.draw(disc(0.075), BUDS, "wax", 1.2)
    angles = np.radians(eight)
    sheet.draw(disc(0.045), KNOTS, "wax")
    sheet.draw(disc(0.022, 0.125 * np.column_stack([np.cos(angles), np.sin(angles)])), KNOTS, "wax")
    return sheet.inks


def main(count: int, folder: Path) -> None:
    """Draw and save all sketches."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, pistil in enumerate(np.linspace(0.55, 0.85, count)):
        sketch = page(SIDE, SIDE)
        for layer, area in enumerate(tile(float(pistil)).values(), 1):
            sketch.stroke(layer)
            sketch.geometry(area)
        sketch.save(str(folder / f"{number}.svg"))


if __name__ == "__main__":
    if sys.argv[1] == "areas":
        print(json.dumps({ink: round(shapely.area(area), 1) for ink, area in tile(PISTIL).items()}))
    else:
        main(int(sys.argv[1]), Path(sys.argv[2]) / "vsketch-whole")
