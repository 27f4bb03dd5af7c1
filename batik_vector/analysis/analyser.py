"""The analyser: from a drawing to the features by which the paper judges patterns, told once."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.analysis.dimension import box_dimension
from batik_vector.analysis.figures import coverage, line_widths, nodes
from batik_vector.analysis.flower import TIPS, Flower, flower_of
from batik_vector.analysis.lobes import taken_apart
from batik_vector.analysis.marks import Indices, Marks, kinds_of, marks_of
from batik_vector.analysis.report import NONE, Analysis, Symmetry
from batik_vector.analysis.report import Layer as LayerFound
from batik_vector.analysis.rings import rosettes
from batik_vector.artwork import Artwork, Geometries
from batik_vector.artwork import Layer as InkLayer
from batik_vector.certificate.symmetry.rosette import found_rosette
from batik_vector.fields import given
from batik_vector.importing.svg import read_svg

MOST_MARKS, MOST_KINDS = 30_000, 400
"""Marks, and kinds of them, past which a drawing is a tracing and no pattern of marks."""

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
    kinds, best, why = _flower(marks)
    covered, coverages = coverage(layers, artwork.cell)
    areas = np.concatenate([layer.areas for layer in layers]) if layers else np.empty(0, dtype=object)
    lines = np.concatenate([layer.lines for layer in layers]) if layers else np.empty(0, dtype=object)
    figures = {
        "title": artwork.title,
        "marks": len(marks),
        "coverage": covered,
        "coverages": coverages,
        "line_widths": line_widths(layers),
        "nodes": count,
        "dimension": box_dimension(areas, lines),
        "notes": tuple(notes),
    }
    if best is None:
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
            **figures,  # type: ignore[arg-type]
        )
    flower, alike = best
    x, y = flower.centre.tolist()
    own = [_within(layer, (x, y), flower.reach) for layer in layers]
    found = found_rosette(own, (x, y), tolerance)
    return Analysis(
        judged=True,
        reason="",
        kinds=0 if kinds is None else int(kinds.max()) + 1,
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
        **figures,  # type: ignore[arg-type]
    )


def _flower(marks: Marks) -> tuple[Indices | None, tuple[Flower, int] | None, str]:
    """Return the kinds of marks, the largest flower and how many are like it; or why there is none."""
    if not len(marks):
        return None, None, "nothing is drawn"
    if len(marks) > MOST_MARKS:
        return None, None, f"{len(marks):,} marks are a tracing, expected at most {MOST_MARKS:,}"
    kinds = kinds_of(marks, MOST_KINDS)
    if kinds is None:
        return None, None, f"{len(marks):,} marks of more than {MOST_KINDS} shapes: no pattern of like marks"
    found = rosettes(marks, kinds)
    apart = taken_apart(marks, found)
    if apart is not marks:
        marks = apart
        kinds = kinds_of(marks, MOST_KINDS)
        if kinds is None:
            return (
                None,
                None,
                f"{len(marks):,} marks of more than {MOST_KINDS} shapes: no pattern of like marks",
            )
        found = rosettes(marks, kinds)
    for rosette in found:
        flower = flower_of(marks, rosette)
        if flower is not None:
            return kinds, (flower, sum(rosette.like(other) for other in found)), ""
    shapes = int(kinds.max()) + 1
    counts = (
        f"{len(marks):,} mark{'s' if len(marks) > 1 else ''} of {shapes:,} shape{'s' if shapes > 1 else ''}"
    )
    return kinds, None, f"{counts}, and no three alike that stand round a point as petals do"


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
