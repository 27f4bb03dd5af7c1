"""The road from recipe to files, stage by stage; one process, one line of JSON.

python -m benchmarks.stages stages RINGS [plain]    generation, tiling, and the writers
python -m benchmarks.stages weld RINGS              marks that all meet their neighbours
python -m benchmarks.stages join RINGS              squares that share their sides, as lines
python -m benchmarks.stages once SIDE               the same lines without the road: drawn once, joined
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import shapely

from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import write_artwork
from batik_vector.geometry.sampling import Geometries
from batik_vector.recipe.loading import read_recipe
from batik_vector.tiling.welding.duplicates import drawn_once
from benchmarks.contests.writing import FORMATS
from benchmarks.drawing import OVERLAPPING_MM, RING, SCALE_MM, grid, recipe, squares_recipe
from benchmarks.peers.drawn import LEAST, WARM, Part, forget_peak, middle, often, peak_kib, tell, timed
from benchmarks.peers.strokes import sides

WARM_SCALE = 3.5
"""Another size than the drawing's, so that nothing of the drawing is kept from warming up."""


class Clock:
    """Told of each stage by the compiler, it notes when placing ends and tiling begins."""

    def __init__(self) -> None:
        self.begun = self.now()
        self.turned = self.begun

    @staticmethod
    def now() -> tuple[float, float]:
        """Return CPU and wall seconds."""
        return time.process_time(), time.perf_counter()

    def __call__(self, stage: str) -> None:
        """Take note; the first stage that places nothing ends the generation."""
        if self.turned == self.begun and not stage.startswith("placing"):
            self.turned = self.now()

    def parts(self) -> dict[str, Part]:
        """Return what generation and tiling took, up to now."""
        end = self.now()
        pairs = {"generation": (self.begun, self.turned), "tiling": (self.turned, end)}
        return {name: {"cpu": b[0] - a[0], "wall": b[1] - a[1]} for name, (a, b) in pairs.items()}


def compiled(text: str) -> tuple[Artwork, dict[str, Part]]:
    """Return a recipe's artwork, and what generation and tiling took; memory is that of both."""
    read = read_recipe(text)
    forget_peak()
    before = peak_kib()
    clock = Clock()
    artwork = compile_recipe(read, progress=clock)
    parts = clock.parts()
    parts["tiling"]["mib"] = (peak_kib() - before) / 1024
    parts["generation"]["vertices"] = parts["tiling"]["vertices"] = artwork.vertex_count
    return artwork, parts


def stages(rings: int, *words: str) -> dict[str, Part]:
    """Time every stage. Marks lie on the tile's edge, or with "plain" none does."""
    stagger = "plain" not in words
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        warm, _ = compiled(recipe(WARM, scale=WARM_SCALE, stagger=stagger))
        for format_ in FORMATS:
            write_artwork(warm, folder / f"warm.{format_}")
        runs: list[dict[str, Part]] = []
        while sum(part["cpu"] for run in runs for part in run.values()) < LEAST:
            # Each a little smaller, so that nothing that was kept answers.
            artwork, parts = compiled(recipe(rings, scale=SCALE_MM - len(runs) / 1000, stagger=stagger))
            for format_ in FORMATS:
                path = folder / f"drawing.{format_}"
                parts[format_], _ = timed(partial(write_artwork, artwork, path), path)
            runs.append(parts)
    return {name: middle([run[name] for run in runs]) for name in runs[0]}


def weld(rings: int) -> dict[str, Part]:
    """Time the welding of marks that make up one net."""
    compiled(recipe(WARM, scale=WARM_SCALE + 2))
    _, parts = compiled(recipe(rings, scale=OVERLAPPING_MM))
    return {"welding": parts["tiling"]}


def join(rings: int) -> dict[str, Part]:
    """Time the joining of squares drawn as lines, as many as have the vertices of so many marks."""
    compiled(squares_recipe(2, 2))
    columns, rows = grid(rings * RING // 4)
    _, parts = compiled(squares_recipe(columns, rows))
    return {"joining": parts["tiling"]}


def once(side: int) -> dict[str, Part]:
    """Time the drawing once of all sides of squares, each a line of its own, in any order."""

    def lines(count: int) -> Geometries:
        return np.asarray(shapely.linestrings(sides(count, twice=True) * 1000.0), dtype=object)

    def once_each(given: Geometries) -> object:
        return drawn_once(given, np.zeros(len(given), np.intp))

    once_each(lines(3))
    return {"once": often(partial(lines, side), once_each)[0]}


TASKS: dict[str, Callable[..., dict[str, Part]]] = {
    "stages": stages,
    "weld": weld,
    "join": join,
    "once": once,
}

if __name__ == "__main__":
    tell(TASKS[sys.argv[1]](int(sys.argv[2]), *sys.argv[3:]))
