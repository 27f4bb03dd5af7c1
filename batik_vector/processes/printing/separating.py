"""Plates: what each ink prints, as the inks say: cut out where others knock it out, whole beneath others.

Lines become areas as broad as their ink draws them. Of a tile the half of a body that lies across its edge
is drawn on the edge opposite; a cloth ends where it is cut, and its lines come piece by piece as areas that
may lie over one another. A cloth keeps its trim marks, by which plates are laid over one another.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import (
    Artwork,
    Cell,
    Dyeing,
    Geometries,
    Ink,
    Layer,
    Margins,
    Overlap,
    Page,
    Plate,
    Provenance,
    dyeing_of,
)
from batik_vector.errors import GeometryError, unknown_name
from batik_vector.geometry.arrangement import arranged
from batik_vector.geometry.outlines import Outlines, nothing, of_polygons, together
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.machines import Machine
from batik_vector.processes.bodies import inked
from batik_vector.processes.printing.options import PlateColour, SeparateProcess
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

BLACK, WHITE = "#000000", "#ffffff"


@frozen(eq=False)
class OnePlate:
    """A page of which one ink is left, and the guides; it comes in pieces as the page does."""

    page: Page
    kept: tuple[int, ...]
    colour: PlateColour
    done: str
    facts: dict[str, Any]

    @property
    def title(self) -> str:
        """What the design is called."""
        return self.page.title

    @property
    def cell(self) -> Cell:
        """The rectangle to which the page is trimmed."""
        return self.page.cell

    @property
    def margins(self) -> Margins:
        """How far the page reaches beyond the cell."""
        return self.page.margins

    @property
    def bleed(self) -> float:
        """How far the drawing reaches beyond the cell on every side, in mm."""
        return self.page.bleed

    @property
    def cloth(self) -> str:
        """The ground's colour on screen."""
        return WHITE if self.colour is PlateColour.BLACK else self.page.cloth

    @property
    def tolerance(self) -> float:
        """How far any drawn edge may stand from the true curve, in mm."""
        return self.page.tolerance

    @property
    def dyeing(self) -> Dyeing | None:
        """The baths that the cloth goes through."""
        return dyeing_of(self.page)

    @property
    def provenance(self) -> Provenance:
        """Recipe, seed, version, and the processes that were gone through."""
        before = self.page.provenance
        return replace(before, processes=(*before.processes, self.done))

    @property
    def vertex_count(self) -> int:
        """Vertices of the whole page; bodies of lines have about twice as many as the lines."""
        return self.page.vertex_count

    @property
    def plates(self) -> tuple[Plate, ...]:
        """The ink, and the guides."""
        return tuple(_in_colour(self.page.plates[number], self.colour) for number in self.kept)

    def areas(self, number: int) -> Iterator[Outlines]:
        """Yield the areas of a layer, the bodies of its lines among them, in pieces."""
        plate = self.page.plates[self.kept[number]]
        yield from self.page.areas(self.kept[number])
        if not plate.guide:
            for piece in self.page.lines(self.kept[number]):
                yield _body(self.page, plate.ink, piece)

    def lines(self, number: int) -> Iterator[Outlines]:
        """Yield the guides, in pieces."""
        if self.page.plates[self.kept[number]].guide:
            yield from self.page.lines(self.kept[number])


def _in_colour(plate: Plate, colour: PlateColour) -> Plate:
    ink = plate.ink if colour is PlateColour.INK else _black(plate.ink)
    if plate.guide or not plate.lines:
        return replace(plate, ink=ink)
    # Bodies come piece by piece, and may lie over areas and over one another.
    return replace(plate, ink=replace(ink, overlap=Overlap.OVERLAY), areas=True, lines=False)


def _body(page: Page, ink: Ink, lines: Outlines) -> Outlines:
    """Return lines of a page as areas as broad as their ink draws them, cut off where its drawing ends."""
    made = inked(page, ink, nothing(), lines)
    made = polygonal(shapely.union_all(made, grid_size=1))
    over = round(page.bleed * STEPS_PER_MM)
    box = shapely.box(-over, -over, page.cell.columns + over, page.cell.rows + over)
    across = ~np.asarray(shapely.contains_properly(box, made), bool)
    cut = polygonal(shapely.intersection(made[across], box, grid_size=1))
    found = of_polygons(oriented(np.concatenate([made[~across], cut])))
    return replace(found, names=(ink.name,) * len(found))


def _black(ink: Ink) -> Ink:
    """Return an ink in black, which is all the key's on paper."""
    return replace(ink, colour=BLACK, cmyk=(0.0, 0.0, 0.0, 100.0), lab=None)


def parts(page: Page, spec: SeparateProcess) -> list[tuple[str, SeparateProcess]]:
    """Return the files of plates and what is added to their names; none where one file holds all.

    Raises:
        GeometryError: where two inks would give one name.
    """
    inks = _inks(page)
    if spec.ink or len(inks) <= 1:
        return []
    found: dict[str, str] = {}
    for name in inks:
        slug = re.sub(r"[^\w.+-]+", "-", name).strip("-.") or f"ink-{len(found) + 1}"
        if slug.lower() in map(str.lower, found):
            slug = f"{slug}-{len(found) + 1}"
        found[slug] = name
    return [(slug, replace(spec, ink=name)) for slug, name in found.items()]


def _inks(page: Page) -> list[str]:
    return [plate.ink.name for plate in page.plates if not plate.guide]


def apply(page: Page, spec: SeparateProcess, machine: Machine) -> Artwork | OnePlate:
    """Return what one ink prints.

    Raises:
        GeometryError: where the page has no ink of that name, or has several and none is named.
    """
    inks = _inks(page)
    if not inks:
        raise GeometryError('kind = "separate", expected something drawn: the page has no ink')
    if not spec.ink and len(inks) > 1:
        raise GeometryError(f"ink = none, expected one of {', '.join(inks)}: a file holds one plate")
    if spec.ink and spec.ink not in inks:
        raise GeometryError(f"ink = {unknown_name(spec.ink, inks, 'ink')}")
    name = spec.ink or inks[0]
    numbers = [k for k, plate in enumerate(page.plates) if plate.guide or plate.ink.name == name]
    if not isinstance(page, Artwork):
        return OnePlate(page, tuple(numbers), spec.colour, str(spec), {"separate": {"ink": name}})
    layer = next(each for each in page.layers if each.ink.name == name)
    areas, names = _bodied(page, layer)
    ink = layer.ink if spec.colour is PlateColour.INK else _black(layer.ink)
    share = float(shapely.area(areas).sum()) / (page.cell.width * page.cell.height)
    return replace(
        page,
        layers=(Layer(ink, areas, area_names=names),),
        cloth=WHITE if spec.colour is PlateColour.BLACK else page.cloth,
        provenance=replace(page.provenance, processes=(*page.provenance.processes, str(spec))),
        borders=_borders(page, layer),
        facts={"separate": {"ink": name, "covers": round(share, 6)}},
    )


def _borders(page: Artwork, layer: Layer) -> frozenset[tuple[str, int, int, int]]:
    return frozenset(each for each in page.borders if each[0] == layer.ink.name)


def _bodied(page: Artwork, layer: Layer) -> tuple[Geometries, tuple[str, ...]]:
    """Return the areas of a layer, its lines among them, with their names."""
    if not len(layer.lines):
        return layer.areas, layer.area_names
    number = page.layers.index(layer)
    areas, lines = together(list(page.areas(number))), together(list(page.lines(number)))
    bleed = round(page.bleed * STEPS_PER_MM)
    box = -bleed, -bleed, page.cell.columns + bleed, page.cell.rows + bleed
    made = arranged([inked(page, layer.ink, areas, lines)], box)
    found = oriented(made.region(np.asarray(made.covered[0], bool)))
    in_mm = np.asarray(shapely.transform(found, lambda xy: xy / STEPS_PER_MM), dtype=object)
    return in_mm, (layer.ink.name,) * len(in_mm)
