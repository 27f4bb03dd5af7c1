"""A draft written down: one motif for each kind of mark, one placement for its copies, as a page of TOML."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.certificate.symmetry.operations import FoundGroup
from batik_vector.drafting.copies import Copies
from batik_vector.drafting.drawing_beside import drawing_beside
from batik_vector.drafting.ink_names import ink_names
from batik_vector.drafting.marks import BARE, Painted
from batik_vector.drafting.path_data import number, path_data
from batik_vector.drafting.units import Unit
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.paths.data import parse_path
from batik_vector.geometry.paths.outline import bounds_of
from batik_vector.recipe.references import quoted
from batik_vector.tiling.symmetry.orbits import Shift
from batik_vector.units import format_mm
from batik_vector.values import frozen

Index = NDArray[np.intp]
Floats = NDArray[np.float64]

FINER = 8
"""How much more finely than the recipe asks curves are fitted."""
LONG = 4000
"""Characters of path data past which they stand in a drawing beside the recipe."""
LINE = 100
"""Characters after which a list goes on in a new line."""
_ODD = re.compile(r"[^A-Za-z0-9_-]+")


@frozen(eq=False)
class Page:
    """What a draft says of all its marks: the colours of cloth and inks, the tolerance (mm), the repeat."""

    title: str
    cloth: str
    inks: tuple[str, ...]
    tolerance: float
    unit: Unit
    group: FoundGroup


@frozen(eq=False)
class Placed:
    """Marks, as copies of few, how high each lies, and those of them that are placed."""

    marks: Painted
    copies: Copies
    level: Index
    chosen: Index


@frozen(eq=False)
class Ground:
    """Pieces of endless marks in the unit, in mm, with their inks, and how high each lies."""

    shapes: Geometries
    ink: Index
    level: Index


@frozen(eq=False)
class Composed:
    """A recipe's text, and the drawing beside it, where it has one."""

    text: str
    drawing: str = ""


def composed(page: Page, placed: Placed, ground: Ground, beside: str = "") -> Composed:
    """Return a draft as a page of TOML.

    Args:
        page: what holds for all of it.
        placed: marks and their copies.
        ground: pieces of endless marks.
        beside: the name of a drawing for outlines that are too long to be read in a recipe; without it they
            stand in the recipe.
    """
    return _Composer(page, placed, ground, beside).composed()


@frozen(eq=False)
class _Motif:
    """A motif to be: its outlines in mm about its origin, whether it cuts, and where the drawing has it."""

    shapes: Geometries
    bare: bool
    home: Shift


@frozen(eq=False)
class _Sheet:
    """A placement to be: how high it lies, its motif, its ink, the marks that it places; none for pieces."""

    level: int
    rank: int
    motif: str
    ink: int
    marks: Index


class _Composer:
    def __init__(self, page: Page, placed: Placed, ground: Ground, beside: str) -> None:
        self.page, self.placed, self.ground, self.beside = page, placed, ground, beside
        self.inks = ink_names(page.inks)
        self.motifs: dict[str, _Motif] = {}
        self.names = self._names()
        self.sheets = sorted([*self._marks(), *self._pieces()], key=lambda each: (each.level, each.rank))
        outlines = [motif.shapes for motif in self.motifs.values()]
        self.data = dict(zip(self.motifs, path_data(outlines, page.tolerance / FINER), strict=True))
        self.long = {name for name, data in self.data.items() if beside and len(data) > LONG}

    def composed(self) -> Composed:
        """Return the recipe and its drawing."""
        drawing = ""
        if self.long:
            drawn = [
                (name, self.data[name], self.motifs[name].home, self._colour(name))
                for name in self.motifs
                if name in self.long
            ]
            tile = self.page.unit.tile.size
            drawing = drawing_beside(self.page.title, tile, self.page.cloth, drawn)
        return Composed("\n".join([*self._lines(), ""]), drawing)

    def _colour(self, name: str) -> str:
        ink = next(sheet.ink for sheet in self.sheets if sheet.motif == name)
        return self.page.cloth if ink == BARE else self.page.inks[ink]

    def _lines(self) -> Iterator[str]:
        """Yield the lines of the recipe."""
        page, tile = self.page, self.page.unit.tile
        stacked = len({each.level for each in self.sheets}) > 1
        yield f"# {self._about()}"
        yield f"title = {quoted(page.title)}"
        yield f'tolerance = "{format_mm(page.tolerance)} mm"'
        for name, colour in zip(self.inks, page.inks, strict=True):
            yield ""
            yield f"[ink.{name}]"
            yield f'colour = "{colour}"'
            if stacked:
                yield 'overlap = "knockout"'
        yield ""
        yield "[cloth]"
        yield f'colour = "{page.cloth}"'
        yield ""
        yield "[tile]"
        yield f"size = [{', '.join(quoted(f'{format_mm(side)} mm') for side in tile.size)}]"
        yield f'repeat = "{tile.repeat}"'
        for name in self.motifs:
            yield ""
            yield from self._drawn(name)
        for sheet in self.sheets:
            yield ""
            yield from self._placement(sheet)

    def _about(self) -> str:
        count = len(self.placed.marks)
        kinds = len(self.placed.copies.heads)
        marks = f"{count:,} mark{'s' if count != 1 else ''} of {kinds:,} kind{'s' if kinds != 1 else ''}"
        return f"Drafted from a drawing: symmetry group {self.page.group.name}, {marks}."

    def _names(self) -> list[str]:
        """Return a name for each kind of mark, no two alike: what the drawing calls it, or a number."""
        placed = self.placed
        names: list[str] = []
        for position, called in enumerate(placed.marks.names[placed.copies.heads].tolist(), start=1):
            name = _ODD.sub("-", called).strip("-")[:40] or f"mark-{position}"
            names.append(_unused(name, names))
        return names

    def _drawn(self, name: str) -> Iterator[str]:
        """Yield the lines of a motif."""
        yield f"[motif.{name}]"
        yield 'kind = "svg"' if name in self.long else 'kind = "path"'
        if self.motifs[name].bare:
            yield 'treatment = "cut"'
        if name in self.long:
            yield f"file = {quoted(self.beside)}"
            yield f'elements = "{name}"'
            return
        yield 'y = "up"'
        yield "centre = [0, 0]"
        yield f'd = """\n{self.data[name]}"""'

    def _marks(self) -> Iterator[_Sheet]:
        """Yield the placements of marks, and write their motifs down."""
        placed, copies = self.placed, self.placed.copies
        for level in np.unique(placed.level[placed.chosen]).tolist():
            some = placed.chosen[placed.level[placed.chosen] == level]
            for kind in dict.fromkeys(copies.kind[some].tolist()):
                mine = some[copies.kind[some] == kind]
                head = int(copies.heads[kind])
                ink, name = int(placed.marks.ink[head]), self.names[kind]
                if name not in self.motifs:
                    x, y = copies.place[head].tolist()
                    about = Affine.translation((-x, -y)).apply(placed.marks.shapes[[head]])
                    self.motifs[name] = _Motif(about, ink == BARE, (x, y))
                yield _Sheet(level, int(mine.min()), name, ink, mine)

    def _pieces(self) -> Iterator[_Sheet]:
        """Yield the placements of endless marks, which lie where they are drawn."""
        ground, many = self.ground, len(self.placed.marks)
        keys = dict.fromkeys(zip(ground.level.tolist(), ground.ink.tolist(), strict=True))
        none = np.empty(0, np.intp)
        for position, (level, ink) in enumerate(keys, start=1):
            mine = np.flatnonzero((ground.level == level) & (ground.ink == ink))
            name = _unused(f"ground-{position}", self.names)
            self.motifs[name] = _Motif(ground.shapes[mine], ink == BARE, (0.0, 0.0))
            yield _Sheet(level, many + position, name, ink, none)

    def _placement(self, sheet: _Sheet) -> Iterator[str]:
        """Yield the lines of a placement."""
        yield "[[place]]"
        yield f'motif = "{sheet.motif}"'
        if len(self.inks) > 1 and sheet.ink != BARE:
            yield f'ink = "{self.inks[sheet.ink]}"'
        yield "scale = 1"
        # What is read from a drawing lies about the middle of its own box.
        middle = np.zeros((1, 2))
        if sheet.motif in self.long:
            left, low, right, high = bounds_of(parse_path(self.data[sheet.motif]))
            middle[0] = (left + right) / 2, (low + high) / 2
        unit = self.page.unit
        if not len(sheet.marks):
            yield f"at = {_listed(unit.tile.orbit('p1').base.inverse().at(middle)[0])}"
            if unit.symmetry or len(unit.orbit.operations) > 1:
                yield 'symmetry = "p1"'
            return
        if unit.symmetry:
            yield f'symmetry = "{unit.symmetry}"'
        if unit.phase != (0.0, 0.0):
            yield f"phase = [{', '.join(number(each) for each in unit.phase)}]"
        yield from self._where(sheet.marks, middle)

    def _where(self, marks: Index, middle: Floats) -> Iterator[str]:
        """Yield the lines that say where copies lie."""
        copies = self.placed.copies
        there = copies.maps().taken(marks).at(middle)[:, 0]
        place = self.page.unit.orbit.base.inverse().at(there)
        turn, mirrored = copies.turn[marks], copies.mirrored[marks]
        if len(marks) == 1 and not mirrored[0]:
            yield f"at = {_listed(place[0])}"
            if turn[0]:
                yield f"turn = {number(float(turn[0]), 6)}"
            return
        yield "at = [0, 0]"
        yield "[place.layout]"
        yield 'kind = "places"'
        for key, some in (("at", ~mirrored), ("mirrored", mirrored)):
            if some.any():
                yield from _rows(key, place[some], turn[some])


def _unused(name: str, names: Sequence[str]) -> str:
    """Return a name, with a number behind it where there is one already."""
    number, free = 1, name
    while free in names:
        number += 1
        free = f"{name}-{number}"
    return free


def _rows(key: str, place: Floats, turn: Floats) -> list[str]:
    """Return a list of places as lines."""
    lines, line = [f"{key} = ["], ""
    for at, degrees in zip(place, turn.tolist(), strict=True):
        item = _listed(at, degrees) + ","
        if line and len(line) + len(item) > LINE:
            lines.append(f"  {line.rstrip()}")
            line = ""
        line += item + " "
    return [*lines, f"  {line.rstrip()}", "]"]


def _listed(place: Sequence[float] | Floats, turn: float = 0.0) -> str:
    parts = [number(float(place[0])), number(float(place[1]))]
    return "[" + ", ".join([*parts, number(turn, 6)] if turn else parts) + "]"
