"""Marks that stand in rows: each is drawn about the origin in a room of a given width and height.

:data:`ROWS` is the catalogue. A mark is handed its room and the :class:`Row` that it stands in, and
``ALONG`` names those that run through the whole link instead of standing side by side.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Annotated, TypeAlias

import numpy as np

from batik_vector.errors import GeometryError, unknown_name
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves import Blade
from batik_vector.geometry.paths.bands import band
from batik_vector.geometry.paths.outline import Outline, bounds_of, box, polyline
from batik_vector.geometry.paths.splines import through
from batik_vector.geometry.sampling import Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import dot, outline_of, similar, stroke
from batik_vector.values import frozen


@frozen(kw_only=True)
class Row(Dress):
    """A row of marks along a band; its measures are in links, its strengths shares of the room."""

    kind: Annotated[
        str,
        Says(
            "its marks: line, dots, lozenges, leaves, blades, flowers, waves, spirals, ferns, teeth, "
            "meander, scales, chevrons, or space for bare ground"
        ),
    ] = "line"
    height: Annotated[float, Between(0.01, 4), Says("height of the row, in links")] = 0.1
    count: Annotated[int, Between(1, 60), Says("marks to a link")] = 4
    full: Annotated[float, Between(0.1, 1), Says("size of a mark, as a share of its room")] = 0.8
    weight: Annotated[
        float, Between(0.02, 0.3), Says("half the breadth of marks that are lines, as a share of the height")
    ] = 0.07
    turns: Annotated[float, Between(0.5, 5), Says("turns of a spiral")] = 2.0
    shift: Annotated[float, Between(-1, 1), Says("move along the band, in marks")] = 0.0
    flip: Annotated[bool, Says("upside down")] = False
    back: Annotated[bool, Says("mirrored along the band")] = False

    def __post_init__(self) -> None:
        check(self)
        if self.kind not in ROWS:
            raise GeometryError(unknown_name(self.kind, list(ROWS), "row of marks"))

    def outlines(self, middle: float) -> list[Outline]:
        """Return all its marks in a link from x = 0 to 1, about a height."""
        mark = ROWS[self.kind]
        across = (-1.0 if self.flip else 1.0), (-1.0 if self.back else 1.0)
        if self.kind in ALONG:
            return [
                each.moved((1.0, 0.0, 0.0, across[0], 0.0, middle)) for each in mark(1.0, self.height, self)
            ]
        shapes = mark(1 / self.count, self.height, self)
        places = ((np.arange(self.count) + 0.5 + self.shift) / self.count).tolist()
        return [each.moved((across[1], 0.0, 0.0, across[0], x, middle)) for x in places for each in shapes]


Mark: TypeAlias = Callable[[float, float, Row], list[Outline]]


def lozenge(half: float, high: float, bow: float) -> Outline:
    """Return a lozenge about the origin; its sides bow out by a share of their length, as far as they can."""
    most = 0.4 * min(half, high) / float(np.hypot(half, high))
    bow = min(max(bow, -most), most)
    corners = np.array([half, 1j * high, -half, -1j * high])
    step = np.linspace(0, 1, 6)[:-1]
    nodes = [
        a + (b - a) * step - 1j * (b - a) * bow * 4 * step * (1 - step)
        for a, b in zip(corners, np.roll(corners, -1), strict=True)
    ]
    ring = np.concatenate(nodes)
    return through(np.column_stack([ring.real, ring.imag]), True, True, (0, 5, 10, 15))


def leaf(length: float, width: float, base: float, tip: float, bend: float = 0.0) -> Outline:
    """Return a blade of any size, however small."""
    share = min(max(width / length, 0.01), 0.6)
    return outline_of(Blade(1.0, share, base, tip, bend)).moved(similar(0.0, length))


def within(shape: Outline, width: float, height: float, full: float) -> Outline:
    """Return an outline as large as a share of a room about the origin allows, in its middle."""
    left, low, right, high = bounds_of(shape)
    size = full * min(width / (right - left), height / (high - low))
    return shape.moved(similar(0.0, size, (-size * (left + right) / 2, -size * (low + high) / 2)))


def fret(path: Points, half: float) -> Outline:
    """Return a line of right angles with a body, its corners and ends square."""
    line = path[:, 0] + 1j * path[:, 1]
    along = np.diff(line)
    along = along / np.abs(along)
    first, last = line[0] - half * along[0], line[-1] + half * along[-1]
    line = np.concatenate([[first], line[1:-1], [last]])
    # At a right angle the corner of either side lies along both normals.
    side = 1j * half * np.concatenate([along[:1], along[:-1] + along[1:], along[-1:]])
    ring = np.concatenate([line - side, (line + side)[::-1]])
    return polyline(np.column_stack([ring.real, ring.imag]), True)


def _space(width: float, height: float, row: Row) -> list[Outline]:
    return []


def _line(width: float, height: float, row: Row) -> list[Outline]:
    return [box(0.0, -0.5 * height, 1.0, height)]


def _dots(width: float, height: float, row: Row) -> list[Outline]:
    return [dot((0.0, 0.0), 0.5 * row.full * min(width, height))]


def _lozenges(width: float, height: float, row: Row) -> list[Outline]:
    return [lozenge(0.5 * row.full * width, 0.5 * row.full * height, -0.08)]


def _leaves(width: float, height: float, row: Row) -> list[Outline]:
    """Return a leaf that leans with the band and bends."""
    slant = min(float(np.degrees(np.arctan2(height, 1.5 * width))), 62.0)
    return [within(leaf(1.0, 0.3, 0.8, 1.2, 40.0).moved(similar(slant - 20)), width, height, row.full)]


def _blades(width: float, height: float, row: Row) -> list[Outline]:
    """Return a small blade of parang: an S, pointed at both ends."""
    u = np.linspace(-1, 1, 17)
    line = np.column_stack([0.16 * width * np.sin(np.pi * u) - 0.2 * width * u, 0.5 * height * row.full * u])
    half = min(0.27 * width, 0.2 * height) * row.full * (1 - u**2)
    return [band(line, np.concatenate([[0.0], half[1:-1], [0.0]]))]


def _flowers(width: float, height: float, row: Row) -> list[Outline]:
    """Return petals round a dot."""
    size = 0.5 * row.full * min(width, height)
    petal = leaf(0.68 * size, 0.27 * size, 0.9, 0.55)
    out = petal.moved(similar(0.0, 1.0, (0.32 * size, 0.0)))
    return [*(out.moved(similar(90 + 60.0 * k)) for k in range(6)), dot((0.0, 0.0), 0.2 * size)]


def _waves(width: float, height: float, row: Row) -> list[Outline]:
    """Return one line that waves through the link, cut upright at both ends."""
    nodes = np.linspace(0, 1, 12 * row.count + 1)
    half = row.weight * height
    crest = max(0.5 * row.full * height - half, 0.0) * np.sin(2 * np.pi * ((row.count * nodes) % 1.0))
    # Upright, a steep line looks slim: as much more as its slope asks for.
    slope = np.cos(2 * np.pi * row.count * nodes) * 2 * np.pi * row.count * 0.5 * row.full * height
    body = half * np.minimum(np.sqrt(1 + slope**2), 3.0)
    ring = np.concatenate(
        [np.column_stack([nodes, crest - body]), np.column_stack([nodes, crest + body])[::-1]]
    )
    last = len(nodes) - 1
    return [through(ring, True, True, (0, last, last + 1, 2 * last + 1))]


def _spirals(width: float, height: float, row: Row) -> list[Outline]:
    """Return a spiral (*wotuo*) that opens at its foot and runs on to the next one."""
    size = 0.5 * row.full * min(width, height)
    pitch = size / (row.turns + 0.35)
    half = min(row.weight * height, 0.34 * pitch)
    turn = np.linspace(0, row.turns, int(12 * row.turns) + 2)
    radius = (size - half) * (0.12 + 0.88 * turn / row.turns)
    coil = radius * np.exp(2j * np.pi * (turn - row.turns - 0.25))
    foot = coil[-1]
    tail = foot + np.array([0.3, 0.62]) * width + 1j * size * np.array([0.0, 0.16])
    line = np.concatenate([coil, tail])
    share = np.linspace(0, 1, len(line))
    body = half * np.minimum(1.0, 0.6 + 3 * share)
    body[-1] = 0.35 * half
    return [band(np.column_stack([line.real, line.imag]), body)]


def _ferns(width: float, height: float, row: Row) -> list[Outline]:
    """Return the head of a fern: a stalk that rises from the foot of its room and curls up."""
    turn = np.linspace(0, 1, int(16 * row.turns) + 10)
    angle = np.pi * 0.6 - 2 * np.pi * (0.3 + 0.5 * row.turns) * turn**1.25
    way = np.concatenate([[0.0], np.cumsum(np.exp(1j * angle[:-1]) * (1 - 0.86 * turn[:-1]) ** 1.2)])
    low, high = way.imag.min(), way.imag.max()
    left, right = way.real.min(), way.real.max()
    size = row.full * min(height / (high - low), width / (right - left))
    way = (way - (left + right) / 2 - 1j * (low + high) / 2) * size
    half = row.weight * height
    return [stroke(np.column_stack([way.real, way.imag]), 1.2 * half, 0.45 * half)]


def _teeth(width: float, height: float, row: Row) -> list[Outline]:
    """Return a tooth of a saw, its foot on the row's, its sides a little hollow."""
    half, high = 0.5 * width * row.full, height
    step = np.linspace(0, 1, 4)[:-1]
    foot, tip = np.array([-half - 0.5j * high, half - 0.5j * high]), 0.5j * high
    up = foot[1] + (tip - foot[1]) * step - 0.12 * half * np.sin(np.pi * step)
    down = -np.conj(up)[:0:-1]
    ring = np.concatenate([foot[:1], up, [tip], down])
    return [through(np.column_stack([ring.real, ring.imag]), True, True, (0, 1, 4))]


MEANDER = np.array(
    [[-1, 0], [-1, 1], [-2, 1], [-2, -1], [0, -1], [0, 1], [2, 1], [2, -1], [1, -1], [1, 0]], float
)
"""The thunder meander (*leigong*): an S of right angles whose ends turn in, five units to a mark."""


def _meander(width: float, height: float, row: Row) -> list[Outline]:
    half = min(row.weight * height, 0.3 * width / 5, 0.16 * height)
    path = MEANDER * [0.96 * width / 4.9, 0.5 * row.full * height - half]
    return [fret(path, half)]


def _scales(width: float, height: float, row: Row) -> list[Outline]:
    """Return a scale: an arc that swells, and a drop in it."""
    angle = np.linspace(0.04, 0.96, 11) * np.pi
    wide, high = 0.5 * width * row.full, height * row.full
    half = min(row.weight * height, 0.2 * wide)
    line = np.column_stack([(wide - half) * np.cos(angle), (high - half) * np.sin(angle) - 0.5 * height])
    drop = leaf(0.5 * high, 0.18 * wide, 0.7, 1.2)
    return [
        stroke(line, 0.5 * half, 0.5 * half, 0.5 * half),
        drop.moved(similar(90.0, 1.0, (0.0, -0.44 * height))),
    ]


def _chevrons(width: float, height: float, row: Row) -> list[Outline]:
    half, high, wide = row.weight * height, 0.5 * row.full * height, 0.3 * row.full * width
    wax = min(2.2 * half, 0.45 * width)
    ring = [
        [-wide, -high],
        [wax - wide, -high],
        [wide, 0],
        [wax - wide, high],
        [-wide, high],
        [wide - wax, 0],
    ]
    return [polyline(np.array(ring), True)]


ROWS: Mapping[str, Mark] = {
    "space": _space,
    "line": _line,
    "dots": _dots,
    "lozenges": _lozenges,
    "leaves": _leaves,
    "blades": _blades,
    "flowers": _flowers,
    "waves": _waves,
    "spirals": _spirals,
    "ferns": _ferns,
    "teeth": _teeth,
    "meander": _meander,
    "scales": _scales,
    "chevrons": _chevrons,
}
ALONG = ("line", "waves")
