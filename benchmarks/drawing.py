"""The drawing that everyone draws: rows of five-lobed marks, each a closed ring of 100 vertices.

    r(θ) = 1 + ¼ cos 5θ, 3.6 mm to the unit, 10 mm apart

As a recipe it goes the whole road; its peers evaluate the same curve with NumPy. At 0.01 mm of tolerance
batik_vector needs 100 vertices for such a mark, which is why it has that size. No mark meets another or the
edge.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

RING = 100
"""Vertices of a mark."""
PITCH_MM = 10.0
SCALE_MM = 3.6
LOBES, WAVE = 5, 0.25
OVERLAPPING_MM = 5.2
"""The scale at which every mark meets its four neighbours, and all of them make up one net."""

MARKS = """\
title = "{title}"
tolerance = "0.01 mm"
limit = 50_000_000

[motif.mark]
kind = "rosette"

[[motif.mark.elements]]
name = "mark"
curve = {{ kind = "polar", radius = 1.0, waves = [[{lobes}, {wave}, 0.0]] }}

[ink.wax]
colour = "#1a1a1a"

[[place]]
motif = "mark"
layout = {{ kind = "lattice", columns = {columns}, rows = {rows}, stagger = {stagger} }}
scale = "{scale} mm"

[tile]
size = ["{width} mm", "{height} mm"]
"""

SQUARES = """\
title = "Squares that share their sides"
tolerance = "0.01 mm"
limit = 50_000_000

[motif.square]
kind = "rosette"

[[motif.square.elements]]
name = "square"
curve = {{ kind = "polygon", sides = 4, radius = 1.0 }}
turn = 45
treatment = "line"

[ink.pen]
colour = "#1a1a1a"
width = "0.5 mm"

[[place]]
motif = "square"
layout = {{ kind = "lattice", columns = {columns}, rows = {rows} }}
scale = "{scale} mm"

[tile]
size = ["{width} mm", "{height} mm"]
"""


MOTIF = """\
title = "A drawing of {segments:,} segments"
tolerance = "0.02 mm"
limit = 50_000_000

[motif.drawing]
kind = "svg"
file = "curves.svg"

[ink.wax]
colour = "#1a1a1a"

[[place]]
motif = "drawing"
scale = "{scale} mm"

[tile]
size = ["{width} mm", "{height} mm"]

[[output]]
format = "svg"
repeat = [{times}, {times}]
"""
TIMES = 10
"""How often the drawing is repeated across and up, each time a tenth as large."""


def grid(rings: int) -> tuple[int, int]:
    """Return columns and rows, as nearly square as their product allows, rows even if possible."""
    known = [k for k in range(1, int(rings**0.5) + 1) if rings % k == 0]
    rows = max([k for k in known if k % 2 == 0] or known)
    return rings // rows, rows


def size(rings: int) -> tuple[float, float]:
    """Return the page's width and height in mm."""
    columns, rows = grid(rings)
    return columns * PITCH_MM, rows * PITCH_MM


def recipe(rings: int, *, scale: float = SCALE_MM, stagger: bool = False) -> str:
    """Return the drawing as a recipe.

    Args:
        rings: how many marks.
        scale: mm to a unit of the motif; above 4 marks meet their neighbours.
        stagger: set every other row off by half a step, so that marks lie on the tile's edge.
    """
    (columns, rows), (width, height) = grid(rings), size(rings)
    return MARKS.format(
        title=f"{rings * RING:,} vertices",
        lobes=LOBES,
        wave=WAVE,
        columns=columns,
        rows=rows,
        stagger=str(stagger).lower(),
        scale=scale,
        width=width,
        height=height,
    )


def squares_recipe(columns: int, rows: int) -> str:
    """Return a recipe of squares of 5 mm, side by side, drawn as lines: each side twice."""
    return SQUARES.format(columns=columns, rows=rows, scale=5 / 2**0.5, width=5 * columns, height=5 * rows)


def evaluated(rings: int) -> NDArray[np.float64]:
    """Return the drawing as a script would work it out: shape (rings, 100, 2), mm, y up."""
    import numpy as np

    columns, rows = grid(rings)
    angle = 2 * np.pi * np.arange(RING) / RING
    radius = SCALE_MM * (1 + WAVE * np.cos(LOBES * angle))
    mark = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    x = (np.arange(columns) + 0.5) * PITCH_MM
    y = (np.arange(rows) + 0.5) * PITCH_MM
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    return places[:, None, :] + mark


def curves_svg(rings: int) -> str:
    """Return the drawing as an SVG of cubic Béziers, 100 to a mark, that keep the curve's tangents."""
    import numpy as np

    width, height = size(rings)
    angle = 2 * np.pi * np.arange(RING + 1) / RING
    radius, steeper = 1 + WAVE * np.cos(LOBES * angle), -LOBES * WAVE * np.sin(LOBES * angle)
    cos, sin = np.cos(angle), np.sin(angle)
    mark = SCALE_MM * np.column_stack([radius * cos, radius * sin])
    handle = SCALE_MM * np.column_stack([steeper * cos - radius * sin, steeper * sin + radius * cos])
    handle *= 2 * np.pi / RING / 3
    control = np.stack([mark[:-1] + handle[:-1], mark[1:] - handle[1:], mark[1:]], axis=1).reshape(-1, 2)
    columns, rows = grid(rings)
    paths = []
    for row in range(rows):
        for column in range(columns):
            middle = (np.array([column, row]) + 0.5) * PITCH_MM
            numbers = (np.vstack([mark[:1], control]) + middle).round(4).ravel().tolist()
            paths.append('<path d="M{} {}C{}Z"/>'.format(*numbers[:2], " ".join(map(str, numbers[2:]))))
    frame = f'width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {frame}>{"".join(paths)}</svg>'


def curves_recipe(rings: int) -> str:
    """Return a recipe with that SVG, ``curves.svg`` beside it, as its motif."""
    width, height = size(rings)
    return MOTIF.format(
        segments=rings * RING, scale=1 / TIMES, width=width / TIMES, height=height / TIMES, times=TIMES
    )
