"""The proof of a draft: the recipe is compiled, and what it draws laid over the drawing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell
from batik_vector.tiling.torus.torus import Window, clip_areas, to_mm, to_step_grid, translate, translates
from batik_vector.values import frozen


@frozen
class Proof:
    """How far a recipe's cloth is from a drawing: of each ink the area (mm²) by which they differ, and what
    is allowed: the tolerance times the length of its outline."""

    apart: tuple[float, ...]
    allowed: tuple[float, ...]

    @property
    def share(self) -> float:
        """The greatest part of what is allowed that is used up."""
        return max((a / max(b, 1e-9) for a, b in zip(self.apart, self.allowed, strict=True)), default=0.0)

    @property
    def holds(self) -> bool:
        """Whether no ink differs by more than it may."""
        return self.share <= 1.0


def compared(
    artwork: Artwork, seen: Sequence[shapely.Geometry], inks: Sequence[str], cell: Cell, tolerance: float
) -> Proof:
    """Compare what a recipe draws with a drawing.

    Args:
        artwork: the tile that was compiled of the recipe.
        seen: what the drawing's page shows of each ink, in mm.
        inks: the colours of these.
        cell: the page.
        tolerance: mm.
    """
    apart, allowed = [], []
    for colour, drawn in zip(inks, seen, strict=True):
        made = _on_page(artwork, colour, cell)
        apart.append(float(shapely.area(shapely.symmetric_difference(made, drawn))))
        allowed.append(tolerance * float(shapely.length(drawn)))
    return Proof(tuple(apart), tuple(allowed))


def _on_page(artwork: Artwork, colour: str, cell: Cell) -> shapely.Geometry:
    """Return what the field of an artwork's tiles shows of an ink on a page."""
    marks = [layer.areas for layer in artwork.layers if layer.ink.colour == colour]
    areas = to_step_grid(np.concatenate([np.empty(0, dtype=object), *marks]))
    if not len(areas):
        return shapely.Polygon()
    window = Window(0, 0, cell.columns, cell.rows)
    which, shift = translates(shapely.bounds(areas).reshape(-1, 4), artwork.cell.lattice, window)
    found, _ = clip_areas(translate(areas[which], shift), which, window)
    return shapely.union_all(to_mm(found))
