"""How many strokes a filling takes, counted before it is drawn."""

from __future__ import annotations

import math

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import MM, Outlines
from batik_vector.processes.hatching.crossings import Lines
from batik_vector.processes.hatching.directions import Direction
from batik_vector.processes.hatching.options import CrossHatch, Hatch, ParallelHatch
from batik_vector.units import format_mm

MOST_STROKES = 2_000_000
"""Strokes of a filling before they are joined, or rings of ``RING`` points: days of any plotter's time."""
RING = 100.0
OVERLAID = 20
"""How many strokes may lie over one another: more are a slip of the pen's width or of the spacing."""


def check_work(areas: Outlines, spec: Hatch, spacing: float, width: float) -> None:
    """See that areas can be filled.

    Args:
        areas: closed rings.
        spec: how they are filled.
        spacing: in steps, from stroke to stroke.
        width: of the pen, in steps.

    Raises:
        GeometryError: where strokes would lie ``OVERLAID`` times over one another, or be more than
            ``MOST_STROKES``; with the spacing that would do.
    """
    said = f"hatch.spacing = {format_mm(spacing / MM)} mm"
    if spec.spacing is None:
        said += ", the pen's width"
    if spacing * OVERLAID < width * (1 - 1e-9):
        raise GeometryError(
            f"{said}, expected a twentieth of the pen's width of {format_mm(width / MM)} mm or more: "
            f"{_rounded_up(width / MM / OVERLAID)} mm would do"
        )
    count = _rings(areas, spacing)
    if isinstance(spec, ParallelHatch):
        count = sum(_parallel(areas, Lines(direction, spacing)) for direction in directions(spec))
    if count > MOST_STROKES:
        raise GeometryError(
            f"{said}: about {count:,.0f} strokes, expected at most {MOST_STROKES:,}: "
            f"{_rounded_up(spacing / MM * count / MOST_STROKES)} mm would do"
        )


def directions(spec: ParallelHatch) -> list[Direction]:
    """Return the directions of parallel strokes."""
    angles = [spec.angle, spec.angle + spec.between] if isinstance(spec, CrossHatch) else [spec.angle]
    return [Direction.of(angle) for angle in angles]


def _parallel(areas: Outlines, lines: Lines) -> float:
    _, _, counts = lines.counts(areas)
    return float(np.abs(counts).sum()) / 2


def _rings(areas: Outlines, spacing: float) -> float:
    """Return how many rings of ``RING`` points areas hold at most; the inner ones have fewer in truth."""
    bounds = areas.bounds()
    breadth = np.minimum(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1])
    return float((breadth / 2 / spacing * np.maximum(areas.sizes() / RING, 4 / RING)).sum())


def _rounded_up(mm: float) -> str:
    """Return a length rounded up to two figures, and to whole steps."""
    unit = max(10.0 ** (math.floor(math.log10(mm)) - 1), 1 / MM)
    return format_mm(math.ceil(mm / unit * (1 - 1e-9)) * unit)
