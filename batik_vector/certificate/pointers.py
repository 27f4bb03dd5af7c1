"""The artwork with a mark at each fault, to be looked at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Layer, Overlap, violations
from batik_vector.certificate.report import Certificate, Place
from batik_vector.geometry.regions import oriented
from batik_vector.tiling.torus.torus import (
    Window,
    clip_areas,
    clip_lines,
    lines_of,
    polygons_of,
    to_mm,
    to_step_grid,
)
from batik_vector.tiling.welding.duplicates import drawn_once
from batik_vector.tiling.welding.weld import welded

NAME = "check"
COLOUR = "#ff00c8"
"""No dye bath has it, so that nobody takes the marks for the drawing."""

RADIUS = 0.025
"""Radius of a ring, as a share of the page's smaller side."""

STROKE = 0.12
"""Breadth of the marks' lines, as a share of the ring's radius."""

SEGMENTS = 48


def pointers(artwork: Artwork, certificate: Certificate, also: Sequence[Place] = ()) -> Artwork:
    """Return the artwork with a layer "check" on top: a ring, a cross-hair and an arrow at each fault, each
    remark, and each of some other places (mm).

    What lies on an edge of the page is marked on the opposite edge too. The marks stay on the page. An
    artwork that is not in the normal form is brought to it, as exporters ask. Where nothing is wrong, no
    layer is added.
    """
    artwork = artwork if not violations(artwork) else _tidied(artwork)
    lines, breadth = pointer_lines(artwork.cell, certificate, also)
    if not len(lines):
        return artwork
    taken = {layer.ink.name for layer in artwork.layers}
    name = NAME
    while name in taken:
        name += "-"
    layer = Layer(Ink(name, COLOUR, breadth), lines=lines, line_names=(NAME,) * len(lines))
    return replace(artwork, layers=(*artwork.layers, layer))


def pointer_lines(
    cell: Cell, certificate: Certificate, also: Sequence[Place] = ()
) -> tuple[Geometries, float]:
    """Return the lines (mm) that point at all that is wrong on a page, and their breadth in mm."""
    told = [fault.where for fault in (*certificate.faults, *certificate.remarks)]
    places = sorted({place for where in (*told, *also) for place in _shown(where, cell)})
    radius = RADIUS * min(cell.width, cell.height)
    middle = cell.width / 2, cell.height / 2
    marks = [mark for place in places for mark in _mark(place, middle, radius)]
    lines = to_step_grid(np.array(marks, dtype=object))
    window = Window(0, 0, cell.columns, cell.rows)
    lines, _ = drawn_once(*clip_lines(lines, np.zeros(len(lines), np.intp), window))
    return to_mm(lines), max(round(STROKE * radius, 3), 0.001)


def _shown(where: tuple[float, float], cell: Cell) -> list[tuple[float, float]]:
    """Return a place on the page, and its twins where it lies on an edge."""
    (ax, ay), (bx, by) = (np.array(each) / 1000 for each in cell.lattice)
    found = []
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            x, y = where[0] + i * ax + j * bx, where[1] + i * ay + j * by
            if -1e-9 <= x <= cell.width + 1e-9 and -1e-9 <= y <= cell.height + 1e-9:
                found.append((round(x, 3), round(y, 3)))
    return found


def _mark(place: tuple[float, float], middle: tuple[float, float], radius: float) -> Geometries:
    """Return a ring with a cross-hair that leaves the place itself free, and an arrow from the middle."""
    at = np.array(place)
    way = np.array(middle) - at
    way = way / np.hypot(*way) if np.hypot(*way) > radius else np.array([0.6, 0.8])
    angles = np.linspace(0, 2 * np.pi, SEGMENTS + 1)
    ring = at + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    lines = [ring]
    for direction in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        lines.append(at + radius * np.outer([0.3, 0.8], direction))
    tip, side = at + 1.15 * radius * way, np.array([-way[1], way[0]])
    lines.append(np.array([tip, tip + 2.5 * radius * way]))
    lines.append(tip + radius * np.array([0.6 * way + 0.35 * side, 0 * way, 0.6 * way - 0.35 * side]))
    return np.array([shapely.LineString(line) for line in lines], dtype=object)


def _tidied(artwork: Artwork) -> Artwork:
    """Bring an artwork to the normal form: on the grid, on the page, nothing twice."""
    window = Window(0, 0, artwork.cell.columns, artwork.cell.rows)
    layers: dict[str, Layer] = {}
    for layer in artwork.layers:
        before = layers.get(layer.ink.name)
        layers[layer.ink.name] = _tidy_layer(layer, window, before)
    kept = tuple(layer for layer in layers.values() if len(layer.areas) or len(layer.lines))
    return replace(artwork, layers=kept, bleed=0.0)


def _tidy_layer(layer: Layer, window: Window, before: Layer | None) -> Layer:
    areas, lines = layer.areas, layer.lines
    area_names, line_names = layer.area_names, layer.line_names
    if before is not None:
        areas, lines = np.concatenate([before.areas, areas]), np.concatenate([before.lines, lines])
        area_names, line_names = before.area_names + area_names, before.line_names + line_names
    areas, number = polygons_of(to_step_grid(areas), np.arange(len(areas)))
    areas, number = clip_areas(areas, number, window)
    if layer.ink.overlap != Overlap.OVERLAY:
        areas, first = welded(areas)
        number = number[first]
    lines, row = lines_of(to_step_grid(lines), np.arange(len(lines)))
    lines, row = drawn_once(*clip_lines(lines, row, window))
    return Layer(
        layer.ink,
        to_mm(oriented(areas)) if len(areas) else areas,
        to_mm(lines),
        tuple(area_names[i] for i in number),
        tuple(line_names[i] for i in row),
    )
