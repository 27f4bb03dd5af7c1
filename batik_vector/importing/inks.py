"""From painted shapes to the layers of inks that a printer would make of them.

An ink is a colour: as an area, or as a line of one breadth. In our own files a layer is an ink, whatever
its colour.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries, Ink, Layer, Overlap
from batik_vector.importing.document import Document
from batik_vector.importing.fills import filled
from batik_vector.importing.pens import bodies
from batik_vector.importing.polylines import Lines
from batik_vector.importing.scene import Shape
from batik_vector.units import STEPS_PER_MM, format_mm
from batik_vector.values import frozen

Indices = NDArray[np.intp]
Key = tuple[str, str, float]
"""What makes an ink: a layer's name, a colour, and the breadth of its lines, 0 for areas."""

WHITE = "#ffffff"
"""The cloth where none is drawn."""
MAX_INKS = 300
"""Inks past which a drawing is refused: cloth is dyed in some ten."""
PAGE_SLACK_MM = 1e-3
"""How far a ground may fall short of its page and still be the cloth."""
_PEN = re.compile(r"^\d+ +(?=\S)")
_GUIDE = re.compile(r"%\d+ +(?=\S)")
_CLOTH = re.compile(r"(?:%(?:\d+ +)?)?cloth", re.IGNORECASE)
"""The cloth's layer: ours is ``%99 cloth``, and was ``%cloth``."""


@frozen(eq=False)
class Marks:
    """What shapes paint, in mm on the cell: areas and lines, each with the number of its shape."""

    shapes: Sequence[Shape]
    areas: Geometries
    area_shape: Indices
    lines: Geometries
    line_shape: Indices

    def only(self, areas: NDArray[np.bool_], lines: NDArray[np.bool_]) -> Marks:
        """Return some of the marks."""
        return replace(
            self,
            areas=self.areas[areas],
            area_shape=self.area_shape[areas],
            lines=self.lines[lines],
            line_shape=self.line_shape[lines],
        )

    def __len__(self) -> int:
        return len(self.areas) + len(self.lines)


def painted(shapes: Sequence[Shape], lines: Lines, counts: Indices, closed: NDArray[np.bool_]) -> Marks:
    """Return what shapes paint.

    Args:
        shapes: in painting order.
        lines: their subpaths as polylines, one shape's after the other's.
        counts: for every shape how many of them are its own.
        closed: for every subpath whether it ends where it begins.
    """
    owner = np.repeat(np.arange(len(shapes)), counts)
    fills = np.array([bool(shape.fill) for shape in shapes])
    evenodd = np.array([shape.rule == "evenodd" for shape in shapes])
    areas, area_shape = filled(*_chosen(lines, owner, fills[owner]), evenodd)
    strokes = np.array([bool(shape.stroke) for shape in shapes])
    points, offsets, mine = _chosen(lines, owner, strokes[owner])
    drawn, line_shape = _polylines(points, offsets, mine, closed[strokes[owner]])
    return Marks(shapes, areas, area_shape, drawn, line_shape)


def _chosen(
    lines: Lines, owner: Indices, chosen: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], Indices, Indices]:
    count = np.diff(lines.offsets)
    points = lines.points[np.repeat(chosen, count)]
    return points, np.append(0, np.cumsum(count[chosen])), owner[chosen]


def _polylines(
    points: NDArray[np.float64], offsets: Indices, owner: Indices, closed: NDArray[np.bool_]
) -> tuple[Geometries, Indices]:
    """Return polylines without steps of no length; those that come to nothing are left out."""
    count = np.diff(offsets)
    ring = np.concatenate([np.repeat(np.arange(len(count)), count), np.flatnonzero(closed)])
    coords = np.concatenate([points, points[offsets[:-1][closed]]])
    order = np.argsort(ring, kind="stable")
    coords, ring = coords[order], ring[order]
    if not len(coords):
        return np.empty(0, dtype=object), np.empty(0, np.intp)
    again = (coords[1:] == coords[:-1]).all(axis=1) & (ring[1:] == ring[:-1])
    keep = np.append(True, ~again)
    coords, ring = coords[keep], ring[keep]
    enough = np.bincount(ring, minlength=len(count)) >= 2
    keep = enough[ring]
    if not keep.any():
        return np.empty(0, dtype=object), np.empty(0, np.intp)
    return shapely.linestrings(coords[keep], indices=(np.cumsum(enough) - 1)[ring[keep]]), owner[enough]


def layers_of(
    document: Document, marks: Marks, cell: Cell, bleed: float, ours: bool
) -> tuple[tuple[Layer, ...], str]:
    """Return the layers of inks in painting order, and the colour of the cloth.

    Raises:
        DrawingError: where nothing is drawn on the page, or in more than ``MAX_INKS`` inks.
    """
    marks, cloth = on_cloth(document, marks, cell, bleed)
    cloth = cloth or WHITE
    if ours:
        marks = _without_guides(marks)
    keys = _keys(marks, ours)
    inks = len({*keys[0], *keys[1]})
    if inks > MAX_INKS:
        raise document.fault(
            f"a drawing of {inks:,} inks (colours, and breadths of lines) is a tracing or a shaded picture, "
            f"expected at most {MAX_INKS}: bring it down to the few colours it is to be dyed in"
        )
    names = _named_by_layer(keys) if ours else _named_by_colour(marks, keys)
    if not ours:
        _stroke_notes(document, [names[key] for key in keys[1]])
    return tuple(_layers(marks, keys, names, ours)), cloth


def on_cloth(document: Document, marks: Marks, cell: Cell, bleed: float) -> tuple[Marks, str]:
    """Return the marks that the page shows, and the colour of its cloth, nothing where none is drawn.

    Raises:
        DrawingError: where nothing is drawn on the page.
    """
    marks, cloth = _without_cloth(document, marks, cell, bleed)
    if not len(marks):
        raise document.fault("nothing is drawn on its ground")
    marks = _on_page(document, marks, cell, bleed)
    if not len(marks):
        raise document.fault("is no tile: all that it draws lies outside its page", document.root)
    return marks, cloth


def _without_guides(marks: Marks) -> Marks:
    """Leave out what a file of ours draws beside the pattern: a printer's marks, a tool's ways."""
    label = np.array([bool(_GUIDE.match(shape.label)) for shape in marks.shapes], bool)
    return marks.only(~label[marks.area_shape], ~label[marks.line_shape]) if label.any() else marks


def _stroke_notes(document: Document, inks: Sequence[str]) -> None:
    """Tell of each ink that strokes what its strokes count by."""
    for name in dict.fromkeys(inks):
        document.note(
            f'the strokes of ink "{name}" are measured by their bodies at the seam, and by their centre '
            "lines for symmetry, doubles and slivers"
        )


def _without_cloth(document: Document, marks: Marks, cell: Cell, bleed: float) -> tuple[Marks, str]:
    """Take the ground out: what lies in a layer "cloth", or else a first shape as large as the page."""
    label = np.array([is_cloth(shape.label) for shape in marks.shapes])
    ground = label[marks.area_shape] if len(marks.areas) else np.empty(0, bool)
    if not ground.any() and len(marks.areas):
        first = int(marks.area_shape[0])
        page = shapely.box(-bleed, -bleed, cell.width + bleed, cell.height + bleed)
        begins = not len(marks.lines) or first <= int(marks.line_shape[0])
        grown = shapely.buffer(marks.areas[0], PAGE_SLACK_MM, join_style="mitre")
        if begins and shapely.covers(grown, page):
            ground[0] = True
    if not ground.any():
        return marks, ""
    colour = marks.shapes[int(marks.area_shape[np.argmax(ground)])].fill
    if not label.any():
        document.note(f"the first shape is as large as the page: taken as the cloth, {colour}")
    return marks.only(~ground, ~label[marks.line_shape] if len(marks.lines) else np.empty(0, bool)), colour


def is_cloth(label: str) -> bool:
    """Whether a layer is the cloth's by its name."""
    return bool(_CLOTH.fullmatch(label))


def _on_page(document: Document, marks: Marks, cell: Cell, bleed: float) -> Marks:
    """Leave out the marks that lie wholly outside the page."""
    low, high = np.full(2, -bleed), np.array([cell.width, cell.height]) + bleed
    breadth = np.array([shape.width for shape in marks.shapes]) / 2

    def seen(geometries: Geometries, reach: NDArray[np.float64]) -> NDArray[np.bool_]:
        bounds = shapely.bounds(geometries).reshape(-1, 4)
        right = (bounds[:, :2] - reach[:, None] <= high).all(axis=1)
        return np.asarray(right & (bounds[:, 2:] + reach[:, None] >= low).all(axis=1))

    areas = seen(marks.areas, np.full(len(marks.areas), -PAGE_SLACK_MM))
    lines = seen(marks.lines, breadth[marks.line_shape])
    # A sharp corner reaches further than half a breadth: where it might be the one thing on the page, the
    # whole body is looked at.
    mitred = np.array([shape.pen.limit if shape.pen.join == "mitre" else 1.0 for shape in marks.shapes])
    near = np.flatnonzero(seen(marks.lines, (breadth * mitred)[marks.line_shape]) & ~lines)
    for row, number in zip(near.tolist(), marks.line_shape[near].tolist(), strict=True):
        shape = marks.shapes[number]
        body, _ = bodies(marks.lines[row : row + 1], shape.width, shape.pen, PAGE_SLACK_MM)
        lines[row] = seen(body, np.zeros(len(body))).any()
    away = int((~areas).sum() + (~lines).sum())
    if away:
        document.note(f"{away:,} marks lie wholly outside the page and are left out")
    return marks.only(areas, lines)


def _keys(marks: Marks, ours: bool) -> tuple[list[Key], list[Key]]:
    """Return the ink of every area and of every line."""
    label = [_PEN.sub("", shape.label) if ours else "" for shape in marks.shapes]
    areas = [(label[i], marks.shapes[i].fill, 0.0) for i in marks.area_shape.tolist()]
    widths = [round(shape.width * STEPS_PER_MM) / STEPS_PER_MM for shape in marks.shapes]
    lines = [(label[i], marks.shapes[i].stroke, widths[i]) for i in marks.line_shape.tolist()]
    return areas, lines


def _named_by_layer(keys: tuple[list[Key], list[Key]]) -> dict[Key, str]:
    """Name inks after their layers: areas, and lines of one breadth, of one colour are one ink."""
    names: dict[Key, str] = {}
    colours: dict[str, str] = {}
    widths: dict[tuple[str, str], float] = {}
    for label, colour, width in dict.fromkeys([*keys[0], *keys[1]]):
        usual = colours.setdefault(label, colour) == colour
        name = label if usual and label else f"{label} {colour}".strip()
        if width and widths.setdefault((label, colour), width) != width:
            name += f" {format_mm(width)} mm"
        names[label, colour, width] = name
    return names


def _named_by_colour(marks: Marks, keys: tuple[list[Key], list[Key]]) -> dict[Key, str]:
    """Name inks after the layer that holds all of an ink and nothing else, or else after their colour."""
    layers: dict[Key, set[str]] = {}
    inks: dict[str, set[Key]] = {}
    for some, owner in zip(keys, (marks.area_shape, marks.line_shape), strict=True):
        for key, shape in zip(some, owner.tolist(), strict=True):
            layer = marks.shapes[shape].label
            layers.setdefault(key, set()).add(layer)
            inks.setdefault(layer, set()).add(key)
    names = {}
    for key, labels in layers.items():
        (label, *others) = labels
        alone = label and not others and len(inks[label]) == 1
        width = f" {format_mm(key[2])} mm" if key[2] else ""
        names[key] = label if alone else key[1] + width
    return names


def _grouped(inks: Sequence[str]) -> dict[str, Indices]:
    """Return for each name where it stands, ascending."""
    number = {name: i for i, name in enumerate(dict.fromkeys(inks))}
    which = np.array([number[name] for name in inks], np.intp)
    cuts = np.cumsum(np.bincount(which, minlength=len(number)))[:-1]
    return dict(zip(number, np.split(np.argsort(which, kind="stable"), cuts), strict=True)) if number else {}


def _layers(
    marks: Marks, keys: tuple[list[Key], list[Key]], names: dict[Key, str], ours: bool
) -> Iterator[Layer]:
    """Yield a layer for each name, in the order in which their first marks are painted."""
    area_ink, line_ink = ([names[key] for key in some] for some in keys)
    order: dict[str, tuple[int, int]] = {}
    colours: dict[str, str] = {}
    widths: dict[str, float] = {}
    for kind, (some, inks, owner) in enumerate(
        ((keys[0], area_ink, marks.area_shape), (keys[1], line_ink, marks.line_shape))
    ):
        for key, ink, shape in zip(some, inks, owner.tolist(), strict=True):
            order[ink] = min(order.get(ink, (shape, kind)), (shape, kind))
            colours.setdefault(ink, key[1])
            if key[2]:
                widths.setdefault(ink, key[2])
    areas_of, lines_of = _grouped(area_ink), _grouped(line_ink)
    none = np.empty(0, np.intp)
    # Shapes of a stranger's ink may overlap as they like.
    overlap = Overlap.WELD if ours else Overlap.OVERLAY
    for name in sorted(order, key=lambda each: order[each]):
        mine, others = areas_of.get(name, none), lines_of.get(name, none)
        yield Layer(
            Ink(name, colours[name], widths.get(name, 1.0), overlap),
            marks.areas[mine],
            marks.lines[others],
            tuple(marks.shapes[i].name for i in marks.area_shape[mine].tolist()),
            tuple(marks.shapes[i].name for i in marks.line_shape[others].tolist()),
        )
