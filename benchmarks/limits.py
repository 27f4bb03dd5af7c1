"""The least that a stage could cost: the one thing that it cannot do without, done alone with NumPy and GEOS.

    python -m benchmarks.limits stages RINGS
    python -m benchmarks.limits overlays RINGS

The formatters are written apart from batik_vector's own. Each takes all coordinates at once as integers and
looks whole words of characters up in tables, which is the fastest known way without compiled code.
"""

from __future__ import annotations

import os
import sys
import tempfile
import zlib
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from benchmarks.drawing import LOBES, OVERLAPPING_MM, PITCH_MM, RING, SCALE_MM, WAVE, evaluated, grid
from benchmarks.peers.drawn import Part, tell, timed
from benchmarks.peers.strokes import sides

Steps: TypeAlias = NDArray[np.int32]
Words: TypeAlias = NDArray[np.uint32]

WARM = 4
ZLIB_LEVEL = 1


def words(texts: list[str]) -> Words:
    """Return short texts as words of four characters, NUL behind."""
    return np.array(texts, "S4").view("<u4")


SPACED = words([f" {i}" for i in range(1000)]), words([f"{i}" for i in range(1000)])
THOUSANDTHS = words([f".{i:03d}".rstrip("0").rstrip(".") for i in range(1000)])
FULL = words([f"{i:03d} " for i in range(1000)])


def millimetres(steps: Steps, before: Words) -> bytes:
    """Return numbers of µm below 10⁶ as decimals in mm, a word of a table before the point."""
    whole = steps // 1000
    out = np.empty((len(steps), 2), np.uint32)
    np.take(before, whole, out=out[:, 0])
    np.take(THOUSANDTHS, steps - whole * 1000, out=out[:, 1])
    return out.tobytes().translate(None, b"\0")


def operators(points: Steps) -> bytes:
    """Return points of 1000 µm and more as path operators: whole numbers, and what is done there."""
    whole = points // 1000
    rows = np.empty((len(points), 5), np.uint32)
    rows[:, 4] = words(["l\n"])
    for axis, at in ((0, 0), (1, 2)):
        np.take(SPACED[1], whole[:, axis], out=rows[:, at])
        np.take(FULL, points[:, axis] - whole[:, axis] * 1000, out=rows[:, at + 1])
    return rows.tobytes().translate(None, b"\0")


def tagged(points: Steps) -> bytes:
    """Return points as a DXF has them: each coordinate on a line of its own, its group code before it."""
    whole = points // 1000
    rows = np.empty((len(points), 6), np.uint32)
    rows[:, 0], rows[:, 3] = words(["10\n", "\n20\n"])
    for axis, at in ((0, 1), (1, 4)):
        np.take(SPACED[1], whole[:, axis], out=rows[:, at])
        np.take(THOUSANDTHS, points[:, axis] - whole[:, axis] * 1000, out=rows[:, at + 1])
    return rows.tobytes().translate(None, b"\0")


def write(path: Path, made_of: Callable[[], bytes]) -> None:
    """Make bytes and write them to a file, and nothing else."""
    data = made_of()
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    os.write(handle, data)
    os.close(handle)


def stages(rings: int) -> dict[str, Part]:
    """Time the least of every stage, once warm."""
    _stages(WARM)
    return _stages(rings)


def _stages(rings: int) -> dict[str, Part]:
    part, points = timed(partial(_everywhere, rings))
    parts = {"generation": part}

    def tiling() -> None:
        """Bring points to the grid, make polygons of them, and see that they are valid."""
        ends = np.arange(rings + 1) * RING
        grid_points = np.rint(points.reshape(-1, 2) * 1000)
        closed = np.insert(grid_points, ends[1:], grid_points[ends[:-1]], axis=0)
        offsets = np.arange(rings + 1) * (RING + 1), np.arange(rings + 1)
        shapely.is_valid(shapely.from_ragged_array(shapely.GeometryType.POLYGON, closed, offsets))

    parts["tiling"], _ = timed(tiling)
    # The tables hold less than a metre; which digits there are makes no difference to the cost.
    steps = np.rint(points.reshape(-1, 2) * 1000).astype(np.int32) % 1_000_000
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "limit"
        formats: dict[str, Callable[[], bytes]] = {
            "svg": lambda: millimetres(steps.ravel(), SPACED[0]),
            "pdf": lambda: zlib.compress(operators(steps), ZLIB_LEVEL),
            "dxf": lambda: tagged(steps),
        }
        for format_, made_of in formats.items():
            parts[format_], _ = timed(partial(write, path, made_of), path)
    return parts


def _everywhere(rings: int) -> NDArray[np.float64]:
    """Work out the curve at every vertex of every mark, as if no two were alike, and put it in its place."""
    columns, _ = grid(rings)
    angle = np.empty((rings, RING))
    angle[:] = 2 * np.pi * np.arange(RING) / RING
    radius = SCALE_MM * (1 + WAVE * np.cos(LOBES * angle))
    number = np.arange(rings)[:, None]
    points = np.empty((rings, RING, 2))
    points[..., 0] = radius * np.cos(angle) + (number % columns + 0.5) * PITCH_MM
    points[..., 1] = radius * np.sin(angle) + (number // columns + 0.5) * PITCH_MM
    return points


def overlays(rings: int) -> dict[str, Part]:
    """Time GEOS' own union of marks that make up a net, and the sorting of the ends of lines."""
    marks = evaluated(rings)
    middles = marks.mean(axis=1, keepdims=True)
    areas = shapely.polygons(np.rint((middles + (marks - middles) * (OVERLAPPING_MM / SCALE_MM)) * 1000))
    lines = np.rint(sides(round((rings * RING / 4) ** 0.5), twice=True) * 1000).astype(np.int64)

    def sort() -> None:
        """Number the ends, and sort by them."""
        _, ends = np.unique(lines.reshape(-1, 2) @ np.array([1 << 31, 1]), return_inverse=True)
        np.unique(np.sort(ends.reshape(-1, 2), axis=1) @ np.array([1 << 31, 1]))

    return {"welding": timed(partial(shapely.union_all, areas))[0], "joining": timed(sort)[0]}


TASKS: dict[str, Callable[[int], dict[str, Part]]] = {"stages": stages, "overlays": overlays}

if __name__ == "__main__":
    tell(TASKS[sys.argv[1]](int(sys.argv[2])))
