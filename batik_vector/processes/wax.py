"""Wax: the plates of a dyeing, each the areas of cloth that are waxed, or scraped off again, at one step.

Regions are taken as they show, by the baths that their cloth sees. A plate is an artwork like another: it can
be written as it is, plotted by a wax pen, or cut out as a stencil.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Dyeing, Geometries, Ink, Layer, Page, Seen, dyeing_of
from batik_vector.errors import GeometryError, nearest
from batik_vector.machines import Machine
from batik_vector.processes.options import WaxProcess
from batik_vector.processes.waxing.cantings import drawn_by
from batik_vector.processes.waxing.caps import Grid, grid_of, stamp
from batik_vector.processes.waxing.choices import ALL, CLOTH, Removal
from batik_vector.processes.waxing.planning import Doing, Plate, Step, planned, plates
from batik_vector.processes.waxing.regions import Shown, shown
from batik_vector.processes.waxing.verdict import colours_of, refusal
from batik_vector.units import STEPS_PER_MM

MOST_STAMPS = 100
"""Stamps past which a repeat is not divided."""

STAYS, COMES_OFF, SCRAPED = "#7a4a1e", "#c98f3c", "#d9b98a"
"""The colours of plates on screen: strong wax, wax that is scraped off again, and where it is."""


def apply(page: Page, spec: WaxProcess, machine: Machine) -> Artwork:
    """Return a plate, all of them as layers, or the cloth as it comes out.

    Raises:
        GeometryError: where the page says of no baths, has no such plate, or has colours that cannot be dyed.
        ExportError: where the page is too large.
    """
    dyeing, made = _asked(page, spec)
    seen = shown(page)
    if spec.plate == CLOTH:
        layers, cloth = _cloth(seen, dyeing), dyeing.colour(dyeing.ground)
    else:
        chosen = made if spec.plate in ("", ALL) else [_named(spec.plate, made)]
        layers, cloth = [_layer(seen, dyeing, each) for each in chosen], dyeing.undyed
    done = Artwork(
        page.title,
        page.cell,
        tuple(layers),
        cloth,
        page.tolerance,
        page.bleed,
        replace(page.provenance, processes=(*page.provenance.processes, str(spec))),
        _borders(page, layers),
        dyeing=dyeing,
    )
    done = replace(done, facts={"wax": _facts(page, done, dyeing, spec)})
    if spec.cap is not None:
        grid = _grid(page, spec)
        if spec.cap_number is None and len(grid) > 1:
            raise GeometryError(f"cap_number = none, expected 1 to {len(grid)}: a file holds one stamp")
        done = stamp(done, grid, spec.cap_number or 1, spec.pins)
    return _mirrored(done) if spec.mirror else done


def parts(page: Page, spec: WaxProcess) -> list[tuple[str, WaxProcess]]:
    """Return the files of plates, one each, and what is added to their names; none where one file holds all.

    Raises:
        GeometryError: as :func:`apply`.
    """
    _, made = _asked(page, spec)
    stamps = len(_grid(page, spec)) if spec.cap is not None and spec.cap_number is None else 1
    if spec.plate and stamps == 1:
        return []
    found = []
    for name in [spec.plate] if spec.plate else [_slug(each.name) for each in made]:
        for number in range(1, stamps + 1):
            words = [*([] if spec.plate else [name]), *([f"cap-{number}"] if stamps > 1 else [])]
            own = replace(spec, plate=name, cap_number=number if stamps > 1 else spec.cap_number)
            found.append(("-".join(words), own))
    return found


def _grid(page: Page, spec: WaxProcess) -> Grid:
    """Return how a plate is divided over stamps.

    Raises:
        GeometryError: where it is no tile's, or there would be too many.
    """
    assert spec.cap is not None
    if not isinstance(page, Artwork) or page.bleed:
        raise GeometryError("cap, expected a tile: a cloth is stamped by what repeats")
    if spec.plate == CLOTH:
        raise GeometryError(f'plate = "{CLOTH}", expected a plate, or no cap: a stamp prints wax')
    grid = grid_of(page.cell, spec.cap)
    if len(grid) > MOST_STAMPS:
        raise GeometryError(f"cap, expected a larger one: the repeat takes {len(grid):,}, past {MOST_STAMPS}")
    return grid


def stages(page: Page, spec: WaxProcess) -> list[tuple[Step, Artwork]]:
    """Return the steps of the work, each with its picture: a plate, or the cloth after a bath.

    Raises:
        GeometryError: as :func:`apply`.
    """
    dyeing, _ = _asked(page, spec)
    seen = shown(page)
    sets = list(dict.fromkeys(seen.seen(dyeing)))
    waxed: dict[Seen, str] = {}
    done: list[str] = []
    found = []
    number = 0
    for step in planned(dyeing, sets, spec.removal):
        colours = dict[Seen, str]()
        if step.doing is Doing.BOIL:
            colours = {each: dyeing.colour(each) for each in sets}
        elif step.doing is Doing.DYE:
            done.append(step.bath)
            colours = {each: waxed.get(each) or dyeing.colour(each & set(done)) for each in sets}
        if colours:
            layers = [
                Layer(
                    Ink("+".join(dyeing.listed(each)) or "undyed", colour),
                    _in_mm(seen.region(dyeing, [each])),
                )
                for each, colour in colours.items()
            ]
            found.append((step, _picture(page, layers, colours[dyeing.ground])))
            continue
        number += 1
        layer = _layer(seen, dyeing, Plate(f"{number} {step.name}", step))
        waxed |= dict.fromkeys(step.sets, layer.ink.colour)
        if step.doing is Doing.SCRAPE:
            waxed = {each: colour for each, colour in waxed.items() if each not in step.sets}
        found.append((step, _picture(page, [layer], dyeing.undyed)))
    return found


def _picture(page: Page, layers: Sequence[Layer], cloth: str) -> Artwork:
    return Artwork(page.title, page.cell, tuple(layers), cloth, page.tolerance, page.bleed)


def _asked(page: Page, spec: WaxProcess) -> tuple[Dyeing, Sequence[Plate]]:
    """Return how a page is dyed, and its plates."""
    dyeing = dyeing_of(page)
    if dyeing is None:
        raise GeometryError(
            "expected a recipe with baths: write [[bath]] tables in their order, each with a name and a "
            "colour, and the baths of each ink"
        )
    inks = [plate.ink.name for plate in page.plates if not plate.guide]
    if unknown := [name for name in inks if name not in dyeing.inks]:
        raise GeometryError(f'ink "{unknown[0]}" is in no bath: plates are made of the design as drawn')
    colours = colours_of(dyeing, inks)
    if spec.removal is Removal.ADD_ONLY and (words := refusal(dyeing, colours)):
        raise GeometryError(f'removal = "{spec.removal}": {words}')
    return dyeing, plates(dyeing, colours.values(), spec.removal, spec.plates)


def _named(name: str, made: Sequence[Plate]) -> Plate:
    """Return a plate by its name, with its number or without."""
    found = [each for each in made if _slug(name) in (_slug(each.name), _slug(each.step.name))]
    if len(found) == 1:
        return found[0]
    names = [_slug(each.name) for each in (found or made)]
    near = None if found else nearest(_slug(name), names)
    many = f"is the name of {len(found)} plates: " if found else ""
    raise GeometryError(
        f'plate = "{name}", {many}'
        + (f'did you mean "{near}"?' if near else f"expected one of {', '.join([*names, ALL, CLOTH])}")
    )


def _slug(name: str) -> str:
    """Return a name as files have it."""
    kept = "".join(c if c.isalnum() or c in "+_." else "-" for c in name.strip())
    return "-".join(filter(None, kept.split("-"))).rstrip(".")


def _layer(seen: Shown, dyeing: Dyeing, plate: Plate) -> Layer:
    colour = SCRAPED if plate.step.doing is Doing.SCRAPE else STAYS if plate.step.stays else COMES_OFF
    return Layer(Ink(_slug(plate.name), colour), _in_mm(seen.region(dyeing, plate.step.sets)))


def _cloth(seen: Shown, dyeing: Dyeing) -> list[Layer]:
    """Return what shows of each ink, in the colour that its baths give; nothing lies under anything."""
    layers = []
    for number, name in enumerate(seen.inks):
        areas = _in_mm(seen.arrangement.region(seen.top == number))
        if len(areas):
            layers.append(Layer(Ink(name, dyeing.colour(dyeing.inks[name])), areas))
    return layers


def _in_mm(areas: Geometries) -> Geometries:
    if not len(areas):
        return areas
    return np.asarray(shapely.transform(areas, lambda xy: xy / STEPS_PER_MM), dtype=object)


def _borders(page: Page, layers: Sequence[Layer]) -> frozenset[tuple[str, int, int, int]]:
    """Return where marks end along the seam on purpose: any plate may, where an ink of the page does."""
    found = {(axis, low, high) for _, axis, low, high in getattr(page, "borders", ())}
    return frozenset((layer.ink.name, *each) for layer in layers for each in found)


def _mirrored(page: Artwork) -> Artwork:
    """Return a page as it is seen from behind: left and right change places."""
    width = page.cell.columns / STEPS_PER_MM

    def turned(areas: Geometries) -> Geometries:
        if not len(areas):
            return areas
        points = shapely.transform(areas, lambda xy: np.stack([_back(xy[:, 0], width), xy[:, 1]], axis=1))
        return np.asarray(shapely.orient_polygons(points), dtype=object)

    cell = replace(page.cell, drop=-page.cell.drop % 1 if page.cell.drop else Fraction(0))
    layers = tuple(replace(layer, areas=turned(layer.areas)) for layer in page.layers)
    return replace(page, cell=cell, layers=layers, borders=_turned(page))


def _back(x: Any, width: float) -> Any:
    """Return places mirrored, on the grid."""
    return np.rint((width - x) * STEPS_PER_MM) / STEPS_PER_MM


def _turned(page: Artwork) -> frozenset[tuple[str, int, int, int]]:
    width = page.cell.columns
    return frozenset(
        (ink, axis, low, high) if axis == 0 else (ink, axis, width - high, width - low)
        for ink, axis, low, high in page.borders
    )


def _facts(page: Page, done: Artwork, dyeing: Dyeing, spec: WaxProcess) -> dict[str, Any]:
    """Return what there is to say of plates: their areas, and the order of work."""
    layers = done.layers
    whole = page.cell.width * page.cell.height
    area = {layer.ink.name: float(shapely.area(layer.areas).sum()) for layer in layers}
    pieces = {layer.ink.name: len(layer.areas) for layer in layers}
    waxed = () if spec.plate == CLOTH else (STAYS, COMES_OFF)
    drawn = {
        layer.ink.name: drawn_by(
            done, layer.areas, spec.cantings if layer.ink.colour in waxed else {}, spec.multi_spouts
        )
        for layer in layers
    }
    inks = [plate.ink.name for plate in page.plates if not plate.guide]
    colours = colours_of(dyeing, inks)
    steps = planned(dyeing, colours.values(), spec.removal)
    return {
        "removal": str(spec.removal),
        "plates": [
            {
                "plate": name,
                "area_mm2": round(each, 3),
                "covers": round(each / whole, 6),
                "pieces": pieces[name],
                **drawn[name],
            }
            for name, each in area.items()
        ],
        "add_only": refusal(dyeing, colours) or "possible",
        "work": [{"step": each.name, "doing": str(each.doing), "bath": each.bath} for each in steps],
    }
