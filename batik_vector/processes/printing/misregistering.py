"""Printing out of register: each ink moved as a whole, and how much cloth shows where inks met.

The tile stays a tile: what an ink loses at one edge it gains at the opposite one. Lines become areas.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Layer, Page
from batik_vector.errors import GeometryError, unknown_name
from batik_vector.geometry.arrangement import arranged
from batik_vector.geometry.outlines import together
from batik_vector.geometry.regions import oriented
from batik_vector.machines import Machine
from batik_vector.processes.bodies import inked, moved, repeated_into
from batik_vector.processes.printing.options import MisregisterProcess
from batik_vector.processes.trapping.joining import seam_borders
from batik_vector.units import STEPS_PER_MM, to_steps

Vector: TypeAlias = tuple[int, int]
"""Right and up, in steps."""


def apply(page: Page, spec: MisregisterProcess, machine: Machine) -> Artwork:
    """Return a tile whose inks are out of register.

    Raises:
        GeometryError: where the page is no tile, or there is no ink of a name, or it would move too far.
    """
    if not isinstance(page, Artwork) or page.bleed:
        raise GeometryError(
            'kind = "misregister", expected a tile, and before what is not done to it: it repeats with it'
        )
    vectors = shifts_of([layer.ink.name for layer in page.layers], spec)
    most = min(page.cell.columns, page.cell.rows)
    if any(max(map(abs, each)) >= most for each in vectors.values()):
        raise GeometryError(f"shifts, expected less than the tile: {most / STEPS_PER_MM:g} mm")
    box = 0, 0, page.cell.columns, page.cell.rows
    before, after, layers = [], [], []
    borders = frozenset[tuple[str, int, int, int]]()
    for number, layer in enumerate(page.layers):
        areas, lines = together(list(page.areas(number))), together(list(page.lines(number)))
        covers = inked(page, layer.ink, areas, lines)
        shifted = repeated_into(page.cell, moved(covers, *vectors[layer.ink.name]))
        made = arranged([shifted], box)
        found = oriented(made.region(np.asarray(made.covered[0], bool)))
        before.append(covers)
        after.append(found)
        layers.append(_layer(layer, found))
        borders |= seam_borders(layer.ink.name, found, page.cell)
    return replace(
        page,
        layers=tuple(layers),
        borders=borders,
        provenance=replace(page.provenance, processes=(*page.provenance.processes, str(spec))),
        facts={"misregister": _facts(vectors, before, after, page.cell)},
    )


def shifts_of(inks: Sequence[str], spec: MisregisterProcess) -> dict[str, Vector]:
    """Return how far each ink is off.

    Raises:
        GeometryError: where shifts name an ink that there is not.
    """
    for name in spec.shifts:
        if name not in inks:
            raise GeometryError(f"shifts.{name}: {unknown_name(name, inks, 'ink')}")
    if spec.shifts:
        return {
            name: (to_steps(x), to_steps(y)) for name in inks for x, y in [spec.shifts.get(name, (0.0, 0.0))]
        }
    found = {}
    for number, name in enumerate(inks):
        figures = hashlib.sha256(repr((spec.seed, name)).encode()).digest()
        turn = int.from_bytes(figures[:4], "big") / 2**32 * math.tau
        far = to_steps(spec.by) if number else 0
        found[name] = round(far * math.cos(turn)), round(far * math.sin(turn))
    return found


def _layer(layer: Layer, areas: Geometries) -> Layer:
    in_mm = np.asarray(shapely.transform(areas, lambda xy: xy / STEPS_PER_MM), dtype=object)
    return Layer(layer.ink, in_mm, area_names=(layer.ink.name,) * len(in_mm))


def _facts(
    vectors: Mapping[str, Vector], before: Sequence[Geometries], after: Sequence[Geometries], cell: Cell
) -> dict[str, Any]:
    """Return how far each ink is off, and how much cloth shows that was far from bare cloth before.

    Along the edges of the drawing cloth comes out too, but there it was beside bare cloth already.
    """
    box = shapely.box(0, 0, cell.columns, cell.rows)
    drawn = shapely.intersection(shapely.union_all(np.concatenate(before), grid_size=1.0), box, grid_size=1.0)
    lost = shapely.difference(drawn, shapely.union_all(np.concatenate(after), grid_size=1.0), grid_size=1.0)
    far = max(math.hypot(*each) for each in vectors.values())
    ground = np.asarray(shapely.get_parts(shapely.difference(box, drawn, grid_size=1.0)), dtype=object)
    ground = np.asarray(shapely.buffer(ground, far + 1), dtype=object)
    near = shapely.union_all(repeated_into(cell, ground))
    bare = shapely.difference(lost, near).area / STEPS_PER_MM**2
    return {
        "shifts_mm": {name: [x / STEPS_PER_MM, y / STEPS_PER_MM] for name, (x, y) in vectors.items()},
        "bare_mm2": round(bare, 3),
    }
