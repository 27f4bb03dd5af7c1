"""What a recipe promises of its tile, for the certificate to hold it to."""

from __future__ import annotations

from batik_vector.certificate import Asked
from batik_vector.recipe.model import Recipe
from batik_vector.tiling.symmetry.repeats import repeat_of

MEASURING = 0.002
"""By how much more a tile may be found stretched than its recipe says."""


def asked_group(recipe: Recipe) -> Asked | None:
    """Return the symmetry group that a recipe promises of its whole tile, or nothing.

    A placement with a symmetry or an origin of its own need not keep the tile's, nor do rows of a ground.
    """
    asked = repeat_of(recipe.tiling.repeat).group
    if asked is None:
        return None
    kept = all(each.keeps(asked) for each in recipe.place)
    across, along = recipe.tiling.stretch
    apart = max(across / along, along / across) - 1
    return Asked(asked.name, exactly=False, stretch=apart + MEASURING) if kept else None
