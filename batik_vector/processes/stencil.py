"""Stencil: each ink's areas are openings of a sheet, which bridges hold in one piece on the endless cloth.

Bridges are done to the tile, before it is set out: what repeats repeats with them. The sheet of the endless
cloth is one piece then, and so is any cut-out of it that is left in a frame.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Ink, Page
from batik_vector.artwork.page import Border
from batik_vector.errors import GeometryError
from batik_vector.geometry.sampling import Geometries
from batik_vector.machines import Machine
from batik_vector.processes.cutting.choices import Inks
from batik_vector.processes.cutting.shared import as_seen
from batik_vector.processes.options import StencilProcess
from batik_vector.processes.stencilling.choices import Backing
from batik_vector.processes.stencilling.faults import check_sheet, check_whole
from batik_vector.processes.stencilling.gaps import PLAIN
from batik_vector.processes.stencilling.islands import islands_of, without_small
from batik_vector.processes.stencilling.openings import bridged, layer_of, openings_of, with_thin, within_tile
from batik_vector.processes.stencilling.planning import Plan, bodies, ground_of, lengths, planned
from batik_vector.processes.stencilling.sheets import Sheet, Torus, hanging, sheet_of
from batik_vector.processes.stencilling.strengthening import PLENTY, strengthened
from batik_vector.processes.stencilling.structure import narrowest_member, weakest_neck
from batik_vector.units import STEPS_PER_MM

TOGETHER = "stencil"
"""What the one stencil of all inks is called."""


def apply(page: Page, spec: StencilProcess, machine: Machine) -> Artwork:
    """Return a tile of openings: what is cut out of the sheet of each stencil, a layer for each.

    Raises:
        GeometryError: where the page is no tile, or no bridges hold a sheet, with the value that would do.
    """
    if not isinstance(page, Artwork) or page.bleed:
        raise GeometryError(
            'kind = "stencil", expected a tile, and before any other process: bridges are the tile\'s, and '
            "repeat with it"
        )
    torus = Torus(page.cell)
    layers, borders, facts = [], set[Border](), list[dict[str, Any]]()
    for ink, openings in _stencils(page, torus, spec):
        held, found = _held(ink, openings, page, spec)
        layer, ends = layer_of(ink, held, page.cell)
        layers.append(layer)
        borders |= ends
        facts.append({"ink": ink.name, **found})
    told = {"bridge_mm": spec.bridge, "backing": str(spec.backing.value), "sheets": facts}
    done = replace(page.provenance, processes=(*page.provenance.processes, str(spec)))
    return replace(
        page,
        layers=tuple(layers),
        borders=frozenset(borders),
        provenance=done,
        facts={"stencil": told},
    )


def _stencils(tile: Artwork, torus: Torus, spec: StencilProcess) -> list[tuple[Ink, Geometries]]:
    """Return what is open in each stencil."""
    each = [(layer.ink, openings_of(layer, torus, spec.lines)) for layer in tile.layers]
    if spec.inks is Inks.APART or len(each) < 2:
        return each
    seen = as_seen([openings for _, openings in each])
    return [(replace(each[0][0], name=TOGETHER), within_tile(np.concatenate(seen), torus))]


def _held(
    ink: Ink, openings: Geometries, tile: Artwork, spec: StencilProcess
) -> tuple[Geometries, dict[str, Any]]:
    """Return the openings of a stencil with bridges across them, and what there is to say of it."""
    breadth = round(spec.bridge * STEPS_PER_MM)
    sheet = sheet_of(openings, tile.cell)
    islands = islands_of(sheet)
    dropped = 0
    if spec.drop and len(islands):
        openings, dropped = without_small(openings, sheet, islands, spec.drop * STEPS_PER_MM)
        islands = islands_of(sheet_of(openings, tile.cell)) if dropped else islands
    bridges = spec.backing is Backing.NONE
    holding = (
        openings if spec.neck is None else with_thin(openings, Torus(tile.cell), spec.neck * STEPS_PER_MM)
    )
    if holding is not openings:
        islands = islands_of(sheet_of(holding, tile.cell))
    ground = ground_of(holding, tile.cell, tile.tolerance * STEPS_PER_MM, bridges and spec.symmetric)
    check_sheet(ground, ink.name)
    plan = Plan(ground, made=ground.sheet.clusters)
    if bridges:
        plan = planned(ground, breadth, PLAIN if spec.large is None else PLENTY)
        check_whole(plan, ink.name, breadth, spec.symmetric)
        if spec.large is not None:
            plan = strengthened(plan, islands, breadth, spec.large * STEPS_PER_MM, spec.large_bridges)
    held = bridged(openings, bodies(plan, breadth), ground.sheet.torus)
    after = sheet_of(held, tile.cell)
    facts = {
        "openings": _pieces(held, tile),
        "pieces": ground.sheet.clusters.count,
        "islands": len(islands),
        "dropped": dropped,
        **_facts(plan, after, breadth),
        "open_mm2": round(float(shapely.area(held).sum()) / STEPS_PER_MM**2, 2),
        "closed_mm2": round(
            float(shapely.area(openings).sum() - shapely.area(held).sum()) / STEPS_PER_MM**2, 2
        ),
    }
    return held, facts


def _pieces(openings: Geometries, tile: Artwork) -> int:
    return hanging(openings, tile.cell).clusters.count if len(openings) else 0


def _facts(plan: Plan, after: Sheet, breadth: int) -> Mapping[str, Any]:
    """Return what is to be told of bridges, and of the sheet that they hold."""
    long = lengths(plan) / STEPS_PER_MM
    member, neck = narrowest_member(after, breadth), weakest_neck(plan)
    return {
        "bridges": len(long),
        "extra_bridges": sum(len(each.bridges) for each in plan.more),
        "symmetries": len(plan.ground.symmetry),
        "bridged_mm": round(float(long.sum()), 3),
        "longest_bridge_mm": round(float(long.max(initial=0.0)), 3),
        "narrowest_member": None
        if member is None
        else {"mm": round(member.breadth / STEPS_PER_MM, 3), "at_mm": _at(member.x, member.y)},
        "weakest_neck": None
        if neck is None
        else {
            "holds_mm2": round(neck.area / STEPS_PER_MM**2, 2),
            "bridges": neck.bridges,
            "mm2_per_mm": round(neck.area / STEPS_PER_MM / (neck.bridges * breadth), 2),
            "at_mm": _at(neck.x, neck.y),
        },
        "places": [_at(*each.centre) for each in plan.bridges],
    }


def _at(x: float, y: float) -> list[float]:
    return [round(x / STEPS_PER_MM, 3), round(y / STEPS_PER_MM, 3)]
