"""What traps take, beside Inkscape's outset of the same layers.

python -m benchmarks.trapping VERTICES            CPU seconds of traps of 0.3 mm
python -m benchmarks.trapping VERTICES inkscape   and of Inkscape's linked offsets of 0.3 mm, made into paths

Inkscape's seconds are less what it takes to open and to save the same file without offsets. It offsets each
path by itself: it neither keeps within the darker ink, nor joins, nor goes on across the seam.
"""

from __future__ import annotations

import json
import math
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from random import Random

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.export import SvgOptions, render
from batik_vector.machines import Machine
from batik_vector.processes.options import TrapProcess
from batik_vector.units import on_grid

SIDE, ACROSS, WIDTH = 300.0, 14, 0.3
HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
    'xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" width="300mm" height="300mm" '
    'viewBox="0 0 300 300">'
)
ACTIONS = "select-all:all;object-to-path;export-filename:done.svg;export-do"


def design(vertices: int) -> Artwork:
    """Return wavy light spots in a dark ground that they meet, each ink with so many vertices."""
    chance, each, step = Random(1), vertices // ACROSS**2, SIDE / ACROSS
    turn = np.arange(each) * 2 * math.pi / each
    spots = []
    for place in range(ACROSS**2):
        one, other = (chance.random() * 6 for _ in range(2))
        radius = step * 0.38 * (1 + 0.12 * np.sin(5 * turn + one) + 0.05 * np.sin(13 * turn + other))
        x, y = (step * (part + 0.5) for part in divmod(place, ACROSS))
        spots.append(shapely.Polygon(on_grid(np.c_[x + radius * np.cos(turn), y + radius * np.sin(turn)])))
    box = shapely.box(0, 0, SIDE, SIDE)
    ground = shapely.Polygon(box.exterior.coords, [spot.exterior.coords for spot in spots])
    cell = Cell(int(SIDE * 1000), int(SIDE * 1000))
    return Artwork("traps", cell, (_layer("light", "#ffe080", spots), _layer("dark", "#102040", [ground])))


def _layer(name: str, colour: str, areas: list[shapely.Polygon]) -> Layer:
    marks = np.array([*areas, None], dtype=object)[:-1]
    return Layer(Ink(name, colour), np.asarray(shapely.orient_polygons(marks), dtype=object))


def trapped(artwork: Artwork) -> float:
    """Return the CPU seconds of traps, the best of five."""
    taken = []
    for _ in range(5):
        begun = time.process_time()
        TrapProcess(width=WIDTH).apply(artwork, Machine())
        taken.append(time.process_time() - begun)
    return min(taken)


def outset(artwork: Artwork) -> float:
    """Return the CPU seconds that Inkscape takes to offset every path, without opening and saving."""
    svg = render(artwork, "svg", SvgOptions(cloth=False)).decode("utf-8")
    paths = re.findall(r'<path d="([^"]*)"', svg)
    plain = "".join(f'<path d="{path}"/>' for path in paths)
    linked = "".join(
        f'<path sodipodi:type="inkscape:offset" inkscape:radius="{WIDTH}" inkscape:original="{path}"/>'
        for path in paths
    )
    with tempfile.TemporaryDirectory() as folder:
        return _inkscape(Path(folder), linked) - _inkscape(Path(folder), plain)


def _inkscape(folder: Path, body: str) -> float:
    file = folder / "drawing.svg"
    file.write_text(f"{HEAD}{body}</svg>")
    taken = []
    for _ in range(3):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(
            ["inkscape", f"--actions={ACTIONS}", file.name], cwd=folder, check=True, capture_output=True
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        taken.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(taken)


def main(vertices: int, beside: bool) -> None:
    """Measure, and tell."""
    artwork = design(vertices)
    found = {"vertices": artwork.vertex_count, "traps": round(trapped(artwork), 3)}
    if beside:
        found["inkscape"] = round(outset(artwork), 3)
    print(json.dumps(found))


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:] == ["inkscape"])
