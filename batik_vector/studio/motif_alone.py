"""A motif alone, as it is while its sliders move: a picture that is there at once, however large the pattern.

The motif is drawn once, about as large as it lies on the cloth, in its inks and with the ground that it keeps
bare, and nothing of the pattern around it.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Artwork
from batik_vector.errors import Fault, RecipeError
from batik_vector.recipe.figures import size_of
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.layouts import Single
from batik_vector.tiling.symmetry.repeats import TileSpec

ROOM = 3.0
"""Sides of its tile, of the motif's breadth: tall ones do not reach round it."""
EDGE = 0.06
"""Cloth left round it in the picture, of its larger side."""
SMALLEST, LARGEST = 5.0, 1000.0
"""mm that it is broad, where the pattern does not say."""
PARTS = 300.0
"""Parts of its breadth to which its edges are true: it is seen small."""
_VIEW = re.compile(r'viewBox="[^"]*"')


def alone(recipe: Recipe, name: str) -> Recipe:
    """Return the recipe of a motif alone, in the middle of a tile of bare cloth.

    Args:
        recipe: whose motif it is.
        name: of the motif.

    Raises:
        RecipeError: where there is no such motif.
    """
    if name not in recipe.motif:
        raise RecipeError([Fault(f'there is no motif "{name}"', "motif")])
    own = next((each for each in recipe.place if name in each.motifs), Placement(motif=name, width=1.0))
    width = min(max(_breadth(recipe, own, name), SMALLEST), LARGEST)
    # A scale is kept to the bit: what fills a motif has room at its own size.
    placed = Placement(
        motif=name,
        scale=own.scale,
        width=width if own.scale is None else None,
        ink=own.ink or next(iter(recipe.ink), ""),
        fill_with=own.fill_with,
    )
    side = ROOM * width
    # Its marks are not multiplied, and nothing is laid on a cloth.
    return replace(
        recipe,
        place=(placed,),
        tile=TileSpec(size=(side, side)),
        tolerance=max(recipe.tolerance, width / PARTS),
        border=(),
        yardage=None,
        output=(),
    )


def _breadth(recipe: Recipe, placement: Placement, name: str) -> float:
    """Return about how broad a motif is on the cloth, in mm."""
    if placement.scale is not None:
        return 2 * placement.scale * size_of(recipe.motif[name])
    if isinstance(placement.layout, Single) and placement.width is not None:
        return placement.width
    cell = recipe.tiling.cell()
    return min(cell.width, cell.height) / 4


def cropped(svg: str, tile: Artwork) -> str:
    """Return the picture of a tile, showing what is drawn on it and a little of the cloth round that."""
    marks = np.concatenate([np.concatenate([layer.areas, layer.lines]) for layer in tile.layers])
    left, low, right, high = shapely.total_bounds(marks)
    edge = EDGE * max(right - left, high - low)
    box = left - edge, tile.cell.height - high - edge, right - left + 2 * edge, high - low + 2 * edge
    return _VIEW.sub('viewBox="' + " ".join(f"{each:.3f}" for each in box) + '"', svg, count=1)
