"""Areas and lines as path data: straight edges as they are, and cubic curves where an outline bends."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.bezier import fit_cubics

DECIMALS = 4
"""Of coordinates in mm: a tenth of a micrometre."""
LINE = 100
"""Characters after which path data go on in a new line."""


def path_data(motifs: Sequence[Geometries], tolerance: float) -> list[str]:
    """Return the outlines of polygons (mm), or polylines, as path data in lines, for each of several motifs.

    Args:
        motifs: valid polygons of each, or polylines; those that end where they begin are closed.
        tolerance: mm; how far curves may stand from their outlines.
    """
    chains = [_chains(marks) for marks in motifs]
    every = np.concatenate([np.empty(0, dtype=object), *chains])
    closed = np.asarray(shapely.is_closed(every), bool)
    offsets = np.append(0, np.cumsum(shapely.get_num_coordinates(every)))
    # All at once: to fit a thousand outlines costs little more than to fit one.
    cubics = fit_cubics(shapely.get_coordinates(every), offsets, closed, tolerance)
    found = []
    ends = np.append(0, np.cumsum([len(each) for each in chains])).tolist()
    for low, high in pairwise(ends):
        words: list[str] = []
        for number in range(low, high):
            begin, end = cubics.offsets[number], cubics.offsets[number + 1]
            if begin < end:
                words += _chain(cubics.points[begin:end], cubics.straight[begin:end], bool(closed[number]))
        found.append(_in_lines(words))
    return found


def _chains(marks: Geometries) -> Geometries:
    """Return the rings of polygons, or polylines as they are."""
    if len(marks) and (shapely.get_type_id(marks) == shapely.GeometryType.POLYGON).all():
        return np.asarray(shapely.get_rings(shapely.orient_polygons(marks)), dtype=object)
    return marks


def _chain(points: NDArray[np.float64], straight: NDArray[np.bool_], closed: bool) -> list[str]:
    """Return one outline as commands."""
    words = ["M" + _pair(points[0, 0])]
    last = len(points) - 1
    for number, (cubic, line) in enumerate(zip(points, straight.tolist(), strict=True)):
        if not line:
            words.append("C" + " ".join(_pair(each) for each in cubic[1:]))
        elif number < last or not closed:
            # The last edge of a ring is drawn by closing it.
            words.append("L" + _pair(cubic[3]))
    return [*words, "Z"] if closed else words


def _pair(place: NDArray[np.float64]) -> str:
    return ",".join(number(each) for each in place.tolist())


def number(value: float, decimals: int = DECIMALS) -> str:
    """Return a number with a few decimals, none that are zero."""
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def _in_lines(words: list[str]) -> str:
    lines, line = [], ""
    for word in words:
        if line and len(line) + len(word) + 1 > LINE:
            lines.append(line)
            line = ""
        line = f"{line} {word}" if line else word
    return "\n".join([*lines, line])
