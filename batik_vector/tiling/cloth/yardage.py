"""Yardage: a cloth of given size filled from a tile, whole marks placed and welded, written piece by piece.

    page = compile_yardage(artwork, YardageSpec(width=1500, length=10_000))
    write_artwork(page, "kawung-cloth.pdf")

A page is never held as a whole: each time it is drawn its marks are placed anew, band by band.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import Any, Protocol

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Dyeing, Geometries, Ink, Layer, Margins, Plate, Provenance
from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.outlines import MM, Outlines, Steps, nothing, of_polygons, of_polylines
from batik_vector.tiling.cloth.clusters import clustered
from batik_vector.tiling.cloth.colour_bar import ColourBar
from batik_vector.tiling.cloth.filling import filled_areas, filled_lines
from batik_vector.tiling.cloth.guides import Guides, guide_ink
from batik_vector.tiling.cloth.spec import Align, Edge, YardageSpec
from batik_vector.tiling.cloth.whole_marks import Unrolled, unrolled, welds
from batik_vector.tiling.cloth.windows import PIECE, Filling
from batik_vector.tiling.torus.torus import Window
from batik_vector.units import STEPS_PER_MM, format_mm, to_steps
from batik_vector.values import frozen

Box = tuple[float, float, float, float]
"""Left, bottom, right and top in mm on cloth."""


class Frame(Protocol):
    """Borders on the cloth: their layers (mm), and the window and shape within that the field fills."""

    @property
    def layers(self) -> Sequence[Layer]:
        """In the normal form, outside the shape."""

    @property
    def window(self) -> Box:
        """The rectangle that the borders leave."""

    @property
    def shape(self) -> shapely.Polygon:
        """The window, or what is left of it where its corners are rounded."""


@frozen(eq=False)
class _Drawn:
    """One ink on the cloth: the tile's marks off the torus, and the borders' in steps.

    The guards are the bounds of what is left out together, where only whole motifs are drawn.
    """

    ink: Ink
    areas: Unrolled
    lines: Unrolled
    border_areas: Outlines | None
    border_lines: Outlines | None
    area_guard: Steps | None = None
    line_guard: Steps | None = None

    @property
    def plate(self) -> Plate:
        areas = self.border_areas is not None or _any(self.areas)
        return Plate(self.ink, areas, self.border_lines is not None or _any(self.lines))


def _any(marks: Unrolled) -> bool:
    return len(marks.whole) + len(marks.endless) > 0


@frozen(eq=False)
class Yardage:
    """A cloth as a page that comes in pieces; see :class:`~batik_vector.artwork.Page`.

    ``origin`` is where the tile's lower left corner lies, in steps; ``filling`` says what the field fills, as
    seen from there. ``joining_corners`` are its bare corners for inks of which borders are drawn too: the
    field then reaches a little into the border, and is welded with it. ``tell`` is called with a word or two
    as each band is drawn. ``whole_lines`` has lines go over the page's edge by half their breadth, so that
    both halves of those show that run along it; ``bar`` is a colour bar in the margin.
    """

    title: str
    cell: Cell
    margins: Margins
    bleed: float
    cloth: str
    tolerance: float
    provenance: Provenance
    vertex_count: int
    filling: Filling
    origin: tuple[int, int]
    drawn: tuple[_Drawn, ...]
    joining_corners: Geometries = field(default_factory=lambda: np.empty(0, dtype=object))
    guides: Guides | None = None
    facts: Mapping[str, Any] = field(default_factory=dict)
    tell: Callable[[str], None] = field(default=lambda words: None)
    dyeing: Dyeing | None = None
    whole_lines: bool = False
    bar: ColourBar | None = None

    @property
    def plates(self) -> tuple[Plate, ...]:
        """The inks in painting order, and the marks for those who print and cut above them."""
        ink = guide_ink(self.cloth)
        guides = (Plate(ink, areas=False, lines=True, guide=True),) if self.guides else ()
        inks = (each.plate for each in self.drawn)
        return (*(replace(each, areas=True) if self.bar else each for each in inks), *guides)

    def areas(self, number: int) -> Iterator[Outlines]:
        """Yield the areas of a layer, in pieces."""
        if number == len(self.drawn):
            return
        each = self.drawn[number]
        filling, weld = self._telling(each.ink), welds(each.ink)
        if weld and each.border_areas is not None:
            filling = replace(filling, cut_away=self.joining_corners)
        for piece in filled_areas(each.areas, filling, weld, each.border_areas, each.area_guard):
            yield piece.moved(*self.origin)
        if self.bar is not None:
            yield self.bar.patch(number)

    def lines(self, number: int) -> Iterator[Outlines]:
        """Yield the centre lines of a layer, in pieces."""
        if number == len(self.drawn):
            if self.guides:
                yield self.guides.outlines()
            if self.bar is not None:
                yield self.bar.heading()
            return
        each = self.drawn[number]
        filling = self._telling(each.ink)
        if self.whole_lines:
            filling = replace(filling, window=_grown(filling.window, to_steps(each.ink.width / 2) + 1))
        for piece in filled_lines(each.lines, filling, each.border_lines, each.line_guard):
            yield piece.moved(*self.origin)

    def _telling(self, ink: Ink) -> Filling:
        return replace(self.filling, tell=lambda share: self.tell(f"{ink.name} {share:.0%}"))


def _grown(window: Window, by: int) -> Window:
    return Window(window.left - by, window.bottom - by, window.right + by, window.top + by)


NOTHING = Unrolled(nothing(), nothing(), np.empty(0, np.intp))


def compile_yardage(
    artwork: Artwork,
    spec: YardageSpec,
    *,
    frame: Frame | None = None,
    inks: Sequence[str] = (),
    piece: int = PIECE,
    progress: Callable[[str], None] | None = None,
) -> Yardage:
    """Compile the page of a cloth from the artwork of its tile.

    Args:
        artwork: the tile, in the normal form.
        spec: the cloth.
        frame: borders; they are drawn beside the field, which fills the window within them.
        inks: the names of all inks in painting order; where left out, the tile's, then those of borders only.
        piece: how many points are drawn at once, about.
        progress: called with a word or two as each band is drawn.

    Raises:
        TooLargeError: with the estimate, where the cloth would have more vertices than its limit.
        GeometryError: where borders leave no field, or another bleed is asked of an artwork that has one.
    """
    if artwork.bleed:
        raise GeometryError(f"the tile has a bleed of {format_mm(artwork.bleed)} mm: expected none")
    columns, rows = spec.size(artwork.cell)
    count = vertices_of(artwork, spec, frame)
    if count > spec.limit:
        raise TooLargeError(_too_large(count, spec.limit, rows))
    origin = _origin(artwork.cell, spec, frame, columns, rows)
    filling = replace(_filling(artwork.cell, spec, frame, origin), piece=piece)
    drawn = tuple(drawn_inks(artwork, frame, origin, inks))
    if not filling.cut:
        drawn = _guarded(drawn, artwork.cell)
    return _page(artwork, spec, frame, filling, origin, drawn, count, progress or (lambda words: None))


def _filling(cell: Cell, spec: YardageSpec, frame: Frame | None, origin: tuple[int, int]) -> Filling:
    """Return what the field fills, as seen from a tile's corner."""
    window = _window(*spec.size(cell), spec.bleed_steps, frame)
    x, y = origin
    inner = Window(window.left - x, window.bottom - y, window.right - x, window.top - y)
    return Filling(cell, inner, spec.edge != Edge.WHOLE, _corners(frame, origin))


def _page(
    artwork: Artwork,
    spec: YardageSpec,
    frame: Frame | None,
    filling: Filling,
    origin: tuple[int, int],
    drawn: tuple[_Drawn, ...],
    count: int,
    tell: Callable[[str], None],
) -> Yardage:
    columns, rows = spec.size(artwork.cell)
    bleed = spec.bleed_steps
    guides = _guides(artwork.cell, spec, origin) if spec.marks else None
    side = max(to_steps(spec.selvedge), bleed)
    return Yardage(
        title=artwork.title,
        cell=Cell(columns, rows),
        margins=guides.margins() if guides else Margins(side, bleed, side, bleed),
        bleed=bleed / STEPS_PER_MM,
        cloth=artwork.cloth,
        tolerance=artwork.tolerance,
        provenance=artwork.provenance,
        dyeing=artwork.dyeing,
        vertex_count=count,
        filling=filling,
        origin=origin,
        drawn=drawn,
        joining_corners=_corners(frame, origin, artwork.tolerance),
        guides=guides,
        tell=tell,
    )


def vertices_of(artwork: Artwork, spec: YardageSpec, frame: Frame | None = None) -> int:
    """Return about how many vertices a cloth will have."""
    window = _window(*spec.size(artwork.cell), spec.bleed_steps, frame)
    area = (window.right - window.left) * (window.top - window.bottom)
    share = area / (artwork.cell.columns * artwork.cell.rows)
    border = sum(
        int(shapely.get_num_coordinates(marks).sum())
        for layer in (frame.layers if frame else ())
        for marks in (layer.areas, layer.lines)
    )
    return round(artwork.vertex_count * share) + border


def _too_large(count: int, limit: int, rows: int) -> str:
    fits = rows / STEPS_PER_MM * limit / count
    return (
        f"the cloth would have about {count:,} vertices (some {count * 16 / 1e9:.1f} GB as SVG), past the "
        f"limit of {limit:,}: expected a length of {format_mm(int(fits))} mm at most, more tolerance, or a "
        "higher limit"
    )


def _window(columns: int, rows: int, bleed: int, frame: Frame | None) -> Window:
    """Return what the field fills; where borders lie beyond, it does not bleed."""
    if frame is None:
        return Window(-bleed, -bleed, columns + bleed, rows + bleed)
    left, bottom, right, top = (to_steps(edge) for edge in frame.window)
    window = Window(
        left if left > 0 else -bleed,
        bottom if bottom > 0 else -bleed,
        right if right < columns else columns + bleed,
        top if top < rows else rows + bleed,
    )
    if window.left >= window.right or window.bottom >= window.top:
        raise GeometryError("the borders leave no room for a field: expected a larger cloth")
    return window


def _origin(cell: Cell, spec: YardageSpec, frame: Frame | None, columns: int, rows: int) -> tuple[int, int]:
    """Return where the lower left corner of a tile lies, in steps."""
    box = (0, 0, columns, rows) if frame is None else tuple(to_steps(edge) for edge in frame.window)
    dx, dy = (to_steps(move) for move in spec.phase)
    if spec.align == Align.CORNER:
        return box[0] + dx, box[1] + dy
    return (box[0] + box[2] - cell.columns) // 2 + dx, (box[1] + box[3] - cell.rows) // 2 + dy


def _corners(frame: Frame | None, origin: tuple[int, int], grown: float = 0.0) -> Geometries:
    """Return what rounded corners of borders leave bare of their window, in steps from the tile's corner.

    ``grown`` is how far (mm) the field reaches over a rounded corner.
    """
    if frame is None:
        return np.empty(0, dtype=object)
    shape = shapely.transform(frame.shape, lambda xy: np.rint(xy * STEPS_PER_MM) - origin)
    window = shapely.box(*shape.bounds)
    if grown:
        shape = shapely.buffer(shape, grown * STEPS_PER_MM, join_style="mitre")
    parts = shapely.get_parts(shapely.difference(window, shape, grid_size=1.0))
    return np.asarray(parts[shapely.area(parts) > 0], dtype=object)


def _guides(cell: Cell, spec: YardageSpec, origin: tuple[int, int]) -> Guides:
    columns, rows = spec.size(cell)
    return Guides(
        columns / STEPS_PER_MM,
        rows / STEPS_PER_MM,
        spec.bleed_steps / STEPS_PER_MM,
        spec.selvedge,
        origin[1] % cell.rows / STEPS_PER_MM,
        cell.rows / STEPS_PER_MM,
    )


def drawn_inks(
    artwork: Artwork, frame: Frame | None = None, origin: tuple[int, int] = (0, 0), order: Sequence[str] = ()
) -> Iterator[_Drawn]:
    """Yield the inks of the tile and of its borders, in painting order."""
    tile = {layer.ink.name: layer for layer in artwork.layers}
    border = {layer.ink.name: layer for layer in (frame.layers if frame else ())}
    names = list(dict.fromkeys([*tile, *border]))
    known = {name: number for number, name in enumerate(order)}
    names.sort(key=lambda name: known.get(name, len(known)))
    for name in names:
        layer, beside = tile.get(name), border.get(name)
        ink = layer.ink if layer is not None else border[name].ink
        yield _Drawn(
            ink,
            unrolled(layer, artwork.cell) if layer is not None else NOTHING,
            unrolled(layer, artwork.cell, lines=True) if layer is not None else NOTHING,
            _beside(beside, origin, lines=False) if beside is not None else None,
            _beside(beside, origin, lines=True) if beside is not None else None,
        )


def _guarded(drawn: Sequence[_Drawn], cell: Cell) -> tuple[_Drawn, ...]:
    """Return inks with the bounds of what is left out together, for all of them at once."""
    sets = [marks.whole for each in drawn for marks in (each.areas, each.lines)]
    bodies = [body for each in drawn for body in (0, to_steps(each.ink.width / 2))]
    guards = clustered(sets, bodies, cell)
    return tuple(
        replace(each, area_guard=areas, line_guard=lines)
        for each, areas, lines in zip(drawn, guards[::2], guards[1::2], strict=True)
    )


def _beside(layer: Layer, origin: tuple[int, int], lines: bool) -> Outlines | None:
    """Return a border's marks as the tile sees them."""
    marks = of_polylines(layer.lines, MM) if lines else of_polygons(layer.areas, MM)
    if not len(marks):
        return None
    return replace(marks.moved(-origin[0], -origin[1]), names=layer.line_names if lines else layer.area_names)
