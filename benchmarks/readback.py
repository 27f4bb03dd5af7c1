"""What is in a file: read back, so that one sees that everyone drew the same; one line of JSON.

python -m benchmarks.readback drawing FILE    vertices, and the marks' share of the box they fill
python -m benchmarks.readback pdf FILE        layers and page boxes
python -m benchmarks.readback audit FILE      what ezdxf's audit finds in a DXF (in the peers' environment)
python -m benchmarks.readback librecad FILE   whether LibreCAD opens a DXF, and prints something
python -m benchmarks.readback imports DXF RECIPE   whether writing a DXF imports ezdxf
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zlib
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

FURNITURE = 5
"""Vertices up to which a contour is the page's ground and no mark."""
NUMBER = rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
NUMBERS = re.compile(NUMBER)
SVG_SHAPES = re.compile(rb'\s(?:d|points)="([^"]*)"')
PDF_STREAMS = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
PDF_POINTS = re.compile(rb"(" + NUMBER + rb") (" + NUMBER + rb") ([ml])\b")
DXF_POINTS = re.compile(rb"\n *10\r?\n *(" + NUMBER + rb")\r?\n *20\r?\n *(" + NUMBER + rb")")
HPGL_STROKES = re.compile(rb"PU([-\d,]+;PD[-\d,]+);")
GCODE_COMMENTS = re.compile(rb";[^\n]*|\([^)\n]*\)")
GCODE_RAPIDS = re.compile(rb"\nG0?0 (?=X)")
GCODE_PLACES = re.compile(rb"X(" + NUMBER + rb") ?Y(" + NUMBER + rb")")
DXF_NEXT = re.compile(rb"\n *0\r?\n")
SECONDS = 120
"""Longer than any program takes to open a small drawing."""


def contours(path: Path) -> Iterator[NDArray[np.float64]]:
    """Yield the contours of a file, each of shape (n, 2), in whatever unit it has."""
    data = path.read_bytes()
    if path.suffix == ".svg":
        for shape in SVG_SHAPES.findall(data):
            for part in re.split(rb"[Mm]", shape):
                yield _points(NUMBERS.findall(part))
    elif path.suffix == ".pdf":
        for stream in PDF_STREAMS.findall(data):
            yield from _painted(stream)
    elif path.suffix == ".hpgl":
        for stroke in HPGL_STROKES.findall(data):
            yield _points(NUMBERS.findall(stroke))
    elif path.suffix == ".gcode":
        # In these files every line with a place has both its words, and a rapid move begins each stroke.
        for stroke in GCODE_RAPIDS.split(GCODE_COMMENTS.sub(b"", data)):
            yield _points([number for pair in GCODE_PLACES.findall(stroke) for number in pair])
    else:
        for entity in data.split(b"\nLWPOLYLINE")[1:]:
            entity = DXF_NEXT.split(entity, maxsplit=1)[0]
            yield _points([number for pair in DXF_POINTS.findall(entity) for number in pair])


def _points(numbers: list[bytes]) -> NDArray[np.float64]:
    even = numbers[: len(numbers) // 2 * 2]
    return np.array(even, dtype="S").astype(np.float64).reshape(-1, 2)


def _painted(stream: bytes) -> Iterator[NDArray[np.float64]]:
    """Yield the paths of a content stream; of any other stream nothing."""
    try:
        content = zlib.decompressobj().decompress(stream)
    except zlib.error:
        content = stream
    found = PDF_POINTS.findall(content)
    starts = [number for number, (_, _, letter) in enumerate(found) if letter == b"m"]
    for first, last in pairwise([*starts, len(found)]):
        yield _points([number for x, y, _ in found[first:last] for number in (x, y)])


def drawing(name: str) -> dict[str, Any]:
    """Return how many vertices a file's marks have, and what share of the box round them they cover.

    The share knows no unit, so that files in points, pixels and millimetres compare. Contours that repeat
    their first point at the end are counted without it.
    """
    vertices, area = 0, 0.0
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for points in contours(Path(name)):
        if len(points) > 1 and (points[0] == points[-1]).all():
            points = points[:-1]
        if len(points) <= FURNITURE:
            continue
        x, y = (points - points[0]).T
        vertices += len(points)
        area += abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))) / 2
        low, high = np.minimum(low, points.min(axis=0)), np.maximum(high, points.max(axis=0))
    box = float(np.prod(high - low)) if vertices else 0.0
    return {"vertices": vertices, "share": area / box if box else 0.0}


def pdf(name: str) -> dict[str, Any]:
    """Return how many layers a PDF has, and which boxes."""
    data = Path(name).read_bytes()
    boxes = [box for box in ("MediaBox", "BleedBox", "TrimBox") if f"/{box}".encode() in data]
    return {"layers": data.count(b"/Type /OCG"), "boxes": boxes}


def audit(name: str) -> dict[str, Any]:
    """Return how many errors and repairs ezdxf's audit reports."""
    from ezdxf.filemanagement import readfile

    auditor = readfile(name).audit()
    return {"errors": len(auditor.errors), "fixes": len(auditor.fixes)}


def librecad(name: str) -> dict[str, Any]:
    """Return whether LibreCAD opened a DXF and printed it; None where it is not installed."""
    program = shutil.which("librecad")
    if program is None:
        return {"opened": None}
    with tempfile.TemporaryDirectory() as home:
        rooms = ("HOME", "XDG_RUNTIME_DIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME")
        subprocess.run(
            [program, "dxf2pdf", "--monochrome", "--directory", home, name],
            env={"PATH": os.environ["PATH"], "QT_QPA_PLATFORM": "offscreen", **dict.fromkeys(rooms, home)},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=SECONDS,
            check=False,
        )
        printed = Path(home) / Path(name).with_suffix(".pdf").name
        return {"opened": printed.exists() and any(len(points) for points in contours(printed))}


def imports(name: str, recipe: str) -> dict[str, Any]:
    """Return whether a recipe that is compiled to a DXF brings ezdxf along."""
    from batik_vector import compile_recipe, load_recipe, write_artwork

    write_artwork(compile_recipe(load_recipe(recipe)), name)
    return {"ezdxf": any(module.partition(".")[0] == "ezdxf" for module in sys.modules)}


TASKS: dict[str, Callable[..., dict[str, Any]]] = {
    "drawing": drawing,
    "pdf": pdf,
    "audit": audit,
    "librecad": librecad,
    "imports": imports,
}

if __name__ == "__main__":
    print(json.dumps(TASKS[sys.argv[1]](*sys.argv[2:])))
