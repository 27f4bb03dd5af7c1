"""The tile that a process is done to, taken apart into what each ink covers and put together again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Geometries, Layer, Page
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import together
from batik_vector.processes.bodies import inked
from batik_vector.processes.spec import ProcessSpec
from batik_vector.processes.trapping.joining import seam_borders
from batik_vector.units import STEPS_PER_MM


def tile_of(page: Page, spec: ProcessSpec) -> Artwork:
    """Return the page as a tile.

    Raises:
        GeometryError: where it is none.
    """
    if not isinstance(page, Artwork) or page.bleed:
        raise GeometryError(
            f'kind = "{spec.kind}", expected a tile, and before what is not done to it: it repeats with it'
        )
    return page


def covered(page: Artwork) -> list[Geometries]:
    """Return what each ink covers in and about the tile, lines by their bodies; polygons in steps."""
    return [
        inked(page, layer.ink, together(list(page.areas(k))), together(list(page.lines(k))))
        for k, layer in enumerate(page.layers)
    ]


def with_areas(
    page: Artwork, areas: Mapping[int, Geometries], spec: ProcessSpec, facts: Mapping[str, Any]
) -> Artwork:
    """Return the tile with other areas in some layers, in steps, instead of all that was drawn there."""
    layers, borders = list(page.layers), page.borders
    for number, found in areas.items():
        before = layers[number]
        names = _names(page, before, found)
        in_mm = np.asarray(shapely.transform(found, lambda xy: xy / STEPS_PER_MM), dtype=object)
        layers[number] = Layer(before.ink, in_mm, area_names=names)
        borders = frozenset(each for each in borders if each[0] != before.ink.name)
        borders |= seam_borders(before.ink.name, found, page.cell)
    done = (*page.provenance.processes, str(spec))
    return replace(
        page,
        layers=tuple(layers),
        borders=borders,
        provenance=replace(page.provenance, processes=done),
        facts={spec.kind: facts},
    )


def _names(page: Artwork, layer: Layer, areas: Geometries) -> tuple[str, ...]:
    """Return the names of the marks of a layer that areas are made of: each of the nearest one."""
    names = (*layer.area_names, *layer.line_names)
    if not names or not len(areas):
        return (layer.ink.name,) * len(areas)
    marks = np.concatenate([layer.areas, layer.lines])
    inside = shapely.get_coordinates(shapely.point_on_surface(areas)) / STEPS_PER_MM
    nearest = np.asarray(shapely.STRtree(marks).nearest(shapely.points(inside)), np.intp)
    return tuple(names[each] for each in nearest.tolist())
