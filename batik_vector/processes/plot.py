"""Plot: outlines and lines as strokes for pens, each drawn once, joined, and in a good order.

What each ink draws is made of the outlines of its areas, or what fills them, and of its lines: hidden parts
go first, then what is drawn already; what is left is joined to longest paths, and these are put in order with
short ways between. Pens come in the order of their numbers.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from batik_vector.artwork import Artwork, Ink, Overlap, Page, Plate
from batik_vector.errors import GeometryError, unknown_name
from batik_vector.geometry.outlines import Outlines, nothing, together
from batik_vector.machines import Machine, Motion
from batik_vector.processes.hatching.filling import hatched, unreached
from batik_vector.processes.options import Hidden, Once, PlotProcess
from batik_vector.processes.order import contours, ordered
from batik_vector.processes.ordering.distances import PARTS
from batik_vector.processes.plotting.edges import without_edges
from batik_vector.processes.plotting.hidden import seen
from batik_vector.processes.plotting.joining import longest
from batik_vector.processes.plotting.once import once
from batik_vector.processes.plotting.timing import Pace, taken
from batik_vector.processes.prepared import Prepared, Tool, whole_page
from batik_vector.units import STEPS_PER_MM

Layers: TypeAlias = list[tuple[Plate, Outlines, Outlines]]
"""Each layer of a page with its areas and its lines."""

PLACES = 10
"""Places at which strokes were doubled that are told of, those of the longest stretches."""


def apply(page: Page, spec: PlotProcess, machine: Machine) -> Prepared:
    """Return the strokes of each pen in the order and direction in which it draws them.

    Raises:
        GeometryError: where ``pens`` names an ink that the page has not.
    """
    layers = whole_page(page)
    tools = [
        Tool(plate.ink, _strokes(page, plate, areas, lines, spec), pen, plate.guide)
        for (plate, areas, lines), pen in zip(layers, _pens(layers, spec.pens), strict=True)
    ]
    facts: dict[str, Any] = {}
    if spec.hatch:
        facts["unreached_mm2"] = _unreached(layers, spec)
    if spec.hidden is Hidden.REMOVE:
        tools, facts["hidden_mm"] = _seen(tools, layers, round(spec.margin * STEPS_PER_MM))
    # Guides come last; inks that share a pen stay in the order of painting.
    tools.sort(key=lambda tool: (tool.guide, tool.pen))
    tools, facts["doubled"] = _once(tools, spec.once)
    tools = [_in_order(tool, spec) for tool in tools]
    facts |= _costs(tools, machine.motion)
    return Prepared(page, tuple(tools), (*page.provenance.processes, str(spec)), {"plot": facts})


def _pens(layers: Layers, chosen: Mapping[str, int]) -> list[int]:
    """Return the pen of each layer; 0 for what none draws."""
    plates = [plate for plate, _, _ in layers]
    inks = [plate.ink.name for plate in plates if not plate.guide]
    for name in chosen:
        if name not in inks:
            raise GeometryError(f"pens = {unknown_name(name, inks, 'ink')}")
    told = [0 if plate.guide else chosen.get(plate.ink.name, plate.pen) for plate in plates]
    free = (number for number in range(1, 2 * len(plates) + 1) if number not in told)
    return [pen or (0 if plate.guide else next(free)) for plate, pen in zip(plates, told, strict=True)]


def _strokes(page: Page, plate: Plate, areas: Outlines, lines: Outlines, spec: PlotProcess) -> Outlines:
    """Return the outlines of areas or what fills them, and lines, one to a mark."""
    if spec.hatch and not plate.guide:
        return together([hatched(areas, spec.hatch, _width(plate.ink, spec)), *contours([lines])])
    outlines = together(list(contours([areas])))
    if not spec.edges:
        cell, bleed = page.cell, round(page.bleed * STEPS_PER_MM)
        box = -bleed, -bleed, cell.columns + bleed, cell.rows + bleed
        repeats = isinstance(page, Artwork) and not bleed
        outlines = without_edges(outlines, box, cell.lattice if repeats else None)
    return together([outlines, *contours([lines])])


def _unreached(layers: Layers, spec: PlotProcess) -> float:
    """Return how many mm² of areas are too narrow for the pens that fill them."""
    assert spec.hatch
    return round(
        math.fsum(
            unreached(areas, spec.hatch, _width(plate.ink, spec))
            for plate, areas, _ in layers
            if not plate.guide
        ),
        1,
    )


def _seen(tools: Sequence[Tool], layers: Layers, margin: int) -> tuple[list[Tool], float]:
    """Return what of tools does not lie under areas of higher inks, and how many mm do."""
    covers, length = nothing(), 0
    left = []
    for tool, (plate, areas, _) in zip(reversed(tools), reversed(layers), strict=True):
        strokes, _, hidden = (tool.strokes, None, 0) if tool.guide else seen(tool.strokes, covers, margin)
        left.append(replace(tool, strokes=strokes))
        length += hidden
        if not plate.guide and plate.ink.overlap is not Overlap.OVERLAY:
            covers = together([covers, replace(areas, names=())])
    return left[::-1], _mm(length)


def _once(tools: Sequence[Tool], among: Once) -> tuple[list[Tool], dict[str, Any]]:
    """Return tools that draw nothing twice, and what is told of what they would have."""
    if among is Once.INK and tools:
        found = [once(tool.strokes)[::2] for tool in tools]
        left, doubled = [strokes for strokes, _ in found], [each for _, each in found]
        inks = [tool.ink.name for tool, each in zip(tools, doubled, strict=True) for _ in each.places]
    else:
        ends = np.cumsum([len(tool.strokes) for tool in tools])
        strokes, source, all_doubled = once(together([tool.strokes for tool in tools]))
        cuts = np.searchsorted(source, ends)
        left = [_some(strokes, first, stop) for first, stop in pairwise([0, *cuts.tolist()])]
        doubled = [all_doubled]
        inks = [tools[k].ink.name for k in np.searchsorted(ends, all_doubled.source, "right").tolist()]
    places = np.concatenate([each.places for each in doubled])
    lengths = np.concatenate([each.lengths for each in doubled])
    facts = {
        "stretches": len(places),
        "saved_mm": _mm(int(lengths.sum())),
        "places": [
            {
                "at_mm": [x / STEPS_PER_MM for x in places[k].tolist()],
                "ink": inks[k],
                "mm": _mm(int(lengths[k])),
            }
            for k in np.argsort(-lengths, kind="stable")[:PLACES].tolist()
        ],
    }
    return [replace(tool, strokes=strokes) for tool, strokes in zip(tools, left, strict=True)], facts


def _some(strokes: Outlines, first: int, stop: int) -> Outlines:
    """Return the strokes from ``first`` to before ``stop``."""
    return strokes.taken(np.arange(first, stop))


def _in_order(tool: Tool, spec: PlotProcess) -> Tool:
    """Return a tool with its strokes joined, in order, and as broad as the pen draws them."""
    strokes = longest(tool.strokes) if spec.join and not tool.guide else tool.strokes
    ink = tool.ink if tool.guide else replace(tool.ink, width=_width(tool.ink, spec))
    return replace(tool, ink=ink, strokes=together(list(ordered([strokes]))))


def _width(ink: Ink, spec: PlotProcess) -> float:
    """Return how broad a pen draws, in mm."""
    return spec.width or ink.width


def _costs(tools: Sequence[Tool], motion: Motion) -> dict[str, Any]:
    """Return the way and the time that drawing takes, of all pens together and of each."""
    pace = Pace.of(motion)
    drawing = [tool for tool in tools if not tool.guide]
    each = [(tool, taken(tool.strokes, pace)) for tool in drawing]
    busy = [tool.pen for tool in drawing if len(tool.strokes)]
    changes = sum(one != other for one, other in pairwise(busy))
    pens = [
        {
            "pen": tool.pen,
            "ink": tool.ink.name,
            "strokes": cost.lifts,
            "drawn_mm": round(cost.drawn, 3),
            "travel_mm": round(cost.travelled, 3),
            "seconds": round(cost.seconds, 1),
        }
        for tool, cost in each
    ]
    return {
        "strokes": sum(cost.lifts for _, cost in each),
        "drawn_mm": round(math.fsum(cost.drawn for _, cost in each), 3),
        "travel_mm": round(math.fsum(cost.travelled for _, cost in each), 3),
        "pen_changes": changes,
        "seconds": round(math.fsum(cost.seconds for _, cost in each) + changes * motion.tool_change, 1),
        "pens": pens,
    }


def _mm(parts: int) -> float:
    """Return a length given in parts of a step."""
    return round(parts / PARTS / STEPS_PER_MM, 3)
