"""What can fill an element (*isen-isen*): kinds of marks, with bounds and help. Importing it is cheap."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from batik_vector.fields import Catalogue, OneOf, named
from batik_vector.recipe.fills.base import Fill, Room
from batik_vector.recipe.fills.isen import Isen, Style
from batik_vector.recipe.fills.lines import Contours, Follow, Galaran, Hatching, Sawut, Sisik, VeinLines
from batik_vector.recipe.fills.marks import CacahGori, Cecek, Herangan, Rows, Ukel

FILLS: Catalogue[type[Fill]] = Catalogue(
    "fills",
    {
        each.kind: each
        for each in (
            Cecek,
            Sawut,
            Galaran,
            Ukel,
            Sisik,
            CacahGori,
            Herangan,
            Contours,
            VeinLines,
            Hatching,
            Isen,
        )
    },
    lambda: Fill,
    named("kind", Fill),
)
"""The catalogue of fills."""

AnyFill: TypeAlias = Annotated[Fill, OneOf(lambda: FILLS, "fill")]

__all__ = [
    "FILLS",
    "AnyFill",
    "CacahGori",
    "Cecek",
    "Contours",
    "Fill",
    "Follow",
    "Galaran",
    "Hatching",
    "Herangan",
    "Isen",
    "Room",
    "Rows",
    "Sawut",
    "Sisik",
    "Style",
    "Ukel",
    "VeinLines",
]
