"""The analyser: from a drawing to the features by which the paper judges patterns, told once."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely

from batik_vector.analysis.dimension import box_dimension
from batik_vector.analysis.figures import coverage, line_widths, nodes
from batik_vector.analysis.flower import TIPS, Flower, flower_of
from batik_vector.analysis.lobes import taken_apart
from batik_vector.analysis.marks import Indices, Marks, kinds_of, marks_of
from batik_vector.analysis.report import NONE, Analysis, Features, Symmetry
from batik_vector.analysis.report import Layer as LayerFound
from batik_vector.analysis.rings import Rosette, rosettes
from batik_vector.artwork import Artwork, Geometries
from batik_vector.artwork import Layer as InkLayer
from batik_vector.certificate.symmetry.rosette import found_rosette
from batik_vector.fields import given
from batik_vector.importing.svg import read_svg
from batik_vector.values import defaults

MOST_MARKS, MOST_KINDS = 30_000, 400
"""Marks, and kinds of them, past which a drawing is a tracing and no pattern of marks."""

MOST_FLOWERS, NEARLY, CLEAR = 3, 0.5, 0.85
"""Flowers that are told of; how far another one reaches at the least, to the largest; and how far apart they
stand, to the reach of both."""

SAMPLED_MM = 0.02
"""How far (mm) the polylines of a stranger may stand from true curves: as far as ours do."""

PARALLEL = 0.98
"""The cosine of the angle between the long axes of marks that are shifted copies."""


def analyse(source: Artwork | str | os.PathLike[str] | bytes) -> Analysis:
    """Measure the features of a drawing from its geometry alone.

    Neither names of layers and elements are looked at nor a recipe that the file may carry.

    Args:
        source: an artwork, or an SVG by its path or its bytes.

    Raises:
        DrawingError: where the SVG cannot be read, or draws nothing.
    """
    given(source, Artwork | str | os.PathLike | bytes, "source")
    if isinstance(source, Artwork):
        return _analysed(source, nodes(source.layers), ())
    reading = read_svg(source)
    # Of polylines nobody knows how closely they follow the curves that they were made from.
    tolerance = max(reading.artwork.tolerance, SAMPLED_MM)
    return _analysed(reading.artwork, reading.nodes, reading.notes, tolerance)


def _analysed(artwork: Artwork, count: int, notes: Sequence[str], tolerance: float | None = None) -> Analysis:
    layers, tolerance = artwork.layers, tolerance or artwork.tolerance
    marks = marks_of(layers)
    kinds, flowers, why = _flowers(marks)
    covered, coverages = coverage(layers, artwork.cell)
    areas = np.concatenate([layer.areas for layer in layers]) if layers else np.empty(0, dtype=object)
    lines = np.concatenate([layer.lines for layer in layers]) if layers else np.empty(0, dtype=object)
    figures: dict[str, Any] = {
        "title": artwork.title,
        "marks": len(marks),
        "coverage": covered,
        "coverages": coverages,
        "line_widths": line_widths(layers),
        "nodes": count,
        "dimension": box_dimension(areas, lines),
        "notes": tuple(notes),
    }
    if not flowers:
        repeated = 0 if kinds is None else int((np.bincount(kinds, minlength=1) > 1).sum())
        return Analysis(
            judged=False,
            reason=why,
            kinds=0 if kinds is None else int(kinds.max(initial=-1)) + 1,
            elements=repeated or min(len(marks), 1),
            relation=NONE if kinds is None else _relation(marks, kinds),
            symmetry=_symmetry(layers, tolerance)
            if len(marks) and kinds is not None
            else Symmetry("C1", 1, NONE, None, 0.0),
            **figures,
        )
    largest, *others = (_features(flower, alike, layers, tolerance) for flower, alike in flowers)
    return Analysis(
        judged=True,
        reason="",
        kinds=0 if kinds is None else int(kinds.max()) + 1,
        others=tuple(others),
        **{name: getattr(largest, name) for name in defaults(largest)},
        **figures,
    )


def _features(flower: Flower, alike: int, layers: Sequence[InkLayer], tolerance: float) -> Features:
    """Return the features of a flower; its symmetry is measured on the layers."""
    x, y = flower.centre.tolist()
    own = [_within(layer, (x, y), flower.reach) for layer in layers]
    found = found_rosette(own, (x, y), tolerance)
    return Features(
        elements=flower.elements,
        relation="rotation",
        symmetry=Symmetry(found.name, found.order, found.kind, found.axis, found.deviation),
        layers=tuple(
            LayerFound(each.count, tuple(map(str, each.shapes)), each.outer) for each in flower.layers
        ),
        pistils=flower.pistils,
        flowers=alike,
        centre=(x, y),
        reach=flower.reach,
    )


def _flowers(marks: Marks) -> tuple[Indices | None, list[tuple[Flower, int]], str]:
    """Return the kinds of marks, the flowers with how many are like each, or why there is none.

    The largest comes first, then others that are no part of it and nearly as large.
    """
    if not len(marks):
        return None, [], "nothing is drawn"
    if len(marks) > MOST_MARKS:
        return None, [], f"{len(marks):,} marks are a tracing, expected at most {MOST_MARKS:,}"
    kinds = kinds_of(marks, MOST_KINDS)
    found = [] if kinds is None else rosettes(marks, kinds)
    whole, apart = kinds, taken_apart(marks, found)
    if kinds is not None and apart is not marks:
        marks = apart
        kinds = kinds_of(marks, MOST_KINDS)
        found = [] if kinds is None else rosettes(marks, kinds)
    if kinds is None:
        return None, [], f"{len(marks):,} marks of more than {MOST_KINDS} shapes: no pattern of like marks"
    flowers: list[tuple[Flower, int]] = []
    told: list[Rosette] = []
    for rosette in found:
        if len(flowers) == MOST_FLOWERS or any(rosette.like(other) for other in told):
            continue
        flower = flower_of(marks, rosette)
        if flower is not None and all(_beside(flower, other) for other, _ in flowers):
            flowers.append((flower, sum(rosette.like(other) for other in found)))
            told.append(rosette)
    if flowers:
        return kinds, flowers, ""
    shapes = int(kinds.max()) + 1
    counts = (
        f"{len(marks):,} mark{'s' if len(marks) > 1 else ''} of {shapes:,} shape{'s' if shapes > 1 else ''}"
    )
    # What was taken apart in vain is told of as it was drawn.
    return whole, [], f"{counts}, and no three alike that stand round a point as petals do"


def _beside(flower: Flower, other: Flower) -> bool:
    """Whether a flower is nearly as large as another one and stands clear of it."""
    away = float(np.hypot(*(flower.centre - other.centre)))
    return flower.reach >= NEARLY * other.reach and away >= CLEAR * (flower.reach + other.reach)


def _within(layer: InkLayer, centre: tuple[float, float], reach: float) -> InkLayer:
    """Return what of a layer belongs to a flower: what lies within its reach."""

    def kept(marks: Geometries) -> Geometries:
        marks = np.asarray(marks, dtype=object)
        if not len(marks):
            return marks
        xy, owner = shapely.get_coordinates(marks, return_index=True)
        away = np.hypot(*(xy - centre).T)
        first = np.searchsorted(owner, np.arange(len(marks)))
        return marks[np.maximum.reduceat(away, first) <= TIPS * reach]

    return InkLayer(layer.ink, kept(layer.areas), kept(layer.lines))


def _symmetry(layers: Sequence[InkLayer], tolerance: float) -> Symmetry:
    """Return the symmetry of all that is drawn, about its middle."""
    drawn = np.concatenate([np.concatenate([layer.areas, layer.lines]) for layer in layers])
    x, y = shapely.get_coordinates(shapely.centroid(shapely.geometrycollections(drawn)))[0].tolist()
    found = found_rosette(layers, (x, y), tolerance)
    return Symmetry(found.name, found.order, found.kind, found.axis, found.deviation)


def _relation(marks: Marks, kinds: Indices) -> str:
    """Return how like marks lie to one another where they stand round no point: shifted, or in no order."""
    shifted = repeated = 0
    for kind in range(int(kinds.max(initial=-1)) + 1):
        mine = np.flatnonzero(kinds == kind)
        if len(mine) > 1:
            along = np.abs(marks.ways[mine] @ marks.ways[mine[0]])
            parallel = (along >= PARALLEL) | (marks.slimness[mine] > 0.95)
            repeated += len(mine)
            shifted += int(parallel.sum())
    return "translation" if repeated and shifted >= 0.8 * repeated else NONE
