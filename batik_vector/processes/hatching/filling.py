"""Areas filled: the strokes of a pen, mark by mark, the edge of each at last."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.congruence import different
from batik_vector.geometry.outlines import MM, Index, Outlines, nothing, runs, together
from batik_vector.processes.hatching.crossings import Lines
from batik_vector.processes.hatching.options import (
    ConcentricHatch,
    Hatch,
    ParallelHatch,
    SpiralHatch,
)
from batik_vector.processes.hatching.regions import Regions
from batik_vector.processes.hatching.rings import as_strokes, concentric
from batik_vector.processes.hatching.serpentines import serpentines
from batik_vector.processes.hatching.spirals import spirals
from batik_vector.processes.hatching.work import check_work, directions

APART = 8
"""Strokes end an eighth of the pen's width short of the edge, those of a second direction another eighth:
what is joined along the edge would draw it twice."""
THINNER = (2, 4, 8)
"""Parts of the inset that are tried, one after another, with areas too narrow for the whole."""

Strokes = tuple[Outlines, Index]
"""Strokes, and the mark that each lies in."""


def hatched(areas: Outlines, spec: Hatch, pen: float) -> Outlines:
    """Return the strokes that fill areas, mark by mark, in the order in which they are drawn.

    Parallel strokes lie exactly a spacing apart. None leaves its area by more than a step; where the inset is
    half the pen's width or more, no ink does, but of areas that are too narrow for it.

    Args:
        areas: closed rings, each mark filled by itself.
        spec: how.
        pen: the pen's width in mm.

    Raises:
        GeometryError: where the spacing asks for too many strokes.
    """
    areas = _sound(areas)
    if not len(areas):
        return nothing()
    width = pen * MM
    inset = width / 2 if spec.inset is None else spec.inset * MM
    spacing = width if spec.spacing is None else spec.spacing * MM
    check_work(areas, spec, spacing, width)
    if isinstance(spec, ParallelHatch):
        # Where lines cross a copy hangs on where it lies.
        strokes, _ = _strokes(areas, spec, inset, spacing, width)
        return strokes
    heads, number, corner = different(areas)
    strokes, marks = _strokes(areas.taken(heads, -corner[heads]), spec, inset, spacing, width)
    which, ends = runs(np.searchsorted(marks, np.arange(len(heads) + 1)), number)
    return strokes.taken(which, np.repeat(corner, np.diff(ends), axis=0))


def _strokes(areas: Outlines, spec: Hatch, inset: float, spacing: float, width: float) -> Strokes:
    """Return the strokes that fill areas, mark by mark; lengths are in steps."""
    whole = Regions.of(areas)
    inner = whole.drawn_in(inset).regions
    drawn = _filled(inner, spec, spacing, width)
    if spec.thin:
        drawn.append(_thin(whole, inner, inset))
    strokes = together([each for each, _ in drawn])
    marks = np.concatenate([of for _, of in drawn])
    order = np.argsort(marks, kind="stable")
    return strokes.taken(order), marks[order]


def unreached(areas: Outlines, spec: Hatch, pen: float) -> float:
    """Return how much of areas, in mm², a round pen that stays inside cannot paint: necks, ends of corners.

    Areas that are too narrow as a whole count only where their edge is not drawn either.

    Args:
        areas: closed rings.
        spec: how they are filled.
        pen: the pen's width in mm.
    """
    areas = _sound(areas)
    inset = (pen / 2 if spec.inset is None else spec.inset) * MM
    heads, number, corner = different(areas)
    whole = Regions.of(areas.taken(heads, -corner[heads]))
    times = np.bincount(number, minlength=len(heads))
    inner = whole.drawn_in(inset).regions
    asked = whole.taken(np.unique(inner.marks)) if spec.thin else whole
    reached = shapely.area(shapely.buffer(inner.polygons(), inset)) * times[inner.marks]
    return (
        max(float((shapely.area(asked.polygons()) * times[asked.marks]).sum() - reached.sum()), 0.0) / MM**2
    )


def _sound(areas: Outlines) -> Outlines:
    """Return areas without names; a ring of fewer than three points encloses nothing."""
    rings = np.diff(areas.rings) > 2
    if rings.all():
        return areas.taken(np.arange(len(areas)))
    outer = np.flatnonzero(rings[areas.marks[:-1]])
    areas = areas.taken(outer)
    rings = np.diff(areas.rings) > 2
    kept = np.repeat(rings, np.diff(areas.rings))
    counts = np.add.reduceat(rings, areas.marks[:-1], dtype=np.int64)
    return Outlines(
        areas.points[kept],
        np.concatenate([[0], np.cumsum(np.diff(areas.rings)[rings])]),
        np.concatenate([[0], np.cumsum(counts)]),
        areas.closed[rings],
    )


def _filled(inner: Regions, spec: Hatch, spacing: float, width: float) -> list[Strokes]:
    """Return the strokes of what the pen can reach, the edge's at last."""
    if isinstance(spec, ConcentricHatch):
        return [concentric(inner, spacing, width, edge_last=spec.edge)]
    if isinstance(spec, SpiralHatch):
        return [spirals(inner, spacing, width, edge_last=spec.edge)]
    assert isinstance(spec, ParallelHatch)
    drawn = list[Strokes]()
    for number, direction in enumerate(directions(spec), start=int(spec.edge)):
        within = inner.drawn_in(width / APART * number).regions
        strokes, of = serpentines(within.outlines(), Lines(direction, spacing), join=spec.join)
        drawn.append((strokes, within.marks[of]))
    return [*drawn, as_strokes(inner)] if spec.edge else drawn


def _thin(whole: Regions, inner: Regions, inset: float) -> Strokes:
    """Return the edges of areas that are too narrow for an inset, as far within as will do."""
    left = whole.taken(np.setdiff1d(whole.marks, inner.marks))
    drawn = list[Strokes]()
    for part in THINNER:
        if len(left):
            found = left.drawn_in(inset / part).regions
            drawn.append(as_strokes(found))
            left = left.taken(np.flatnonzero(~np.isin(left.marks, found.marks)))
    drawn.append(as_strokes(left))
    return together([each for each, _ in drawn]), np.concatenate([of for _, of in drawn])
