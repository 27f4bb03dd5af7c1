"""Layouts: how copies of one motif are set out. The catalogue is ``LAYOUTS``.

A layout is measured in motif units and returns either the affine images of the motif, or an iterated
system of maps where it bends the motif. Those of :mod:`~batik_vector.tiling.layouts.grounds` are worked out
on the lattice of the repeat instead.
"""

from __future__ import annotations

from typing import Annotated, TypeAlias

from batik_vector.fields import Catalogue, OneOf
from batik_vector.tiling.layouts.base import Bend, Layout, Pair, Share
from batik_vector.tiling.layouts.copies import (
    Free,
    Lattice,
    Mirror,
    Places,
    Ring,
    RosetteLayout,
    Single,
    Spot,
)
from batik_vector.tiling.layouts.grounds import Clear, FreeGround, Pack, Scattered, Stripes, Toss
from batik_vector.tiling.layouts.named import (
    Circle,
    DoubleSquare,
    FiveCircle,
    FourSquare,
    Symmetric,
    ThreeCircle,
)
from batik_vector.tiling.layouts.systems import Julian, MapSpec, System, Term

LAYOUTS: Catalogue[type[Layout]] = Catalogue(
    "layouts",
    {
        "single": Single,
        "julian": Julian,
        "symmetric": Symmetric,
        "double-square": DoubleSquare,
        "four-square": FourSquare,
        "three-circle": ThreeCircle,
        "five-circle": FiveCircle,
        "circle": Circle,
        "ring": Ring,
        "mirror": Mirror,
        "rosette": RosetteLayout,
        "free": Free,
        "places": Places,
        "lattice": Lattice,
        "toss": Toss,
        "pack": Pack,
        "ground": FreeGround,
        "stripes": Stripes,
        "ifs": System,
    },
    lambda: Layout,
)

AnyLayout: TypeAlias = Annotated[Layout, OneOf(lambda: LAYOUTS, "layout")]

__all__ = [
    "LAYOUTS",
    "AnyLayout",
    "Bend",
    "Circle",
    "Clear",
    "DoubleSquare",
    "FiveCircle",
    "FourSquare",
    "Free",
    "FreeGround",
    "Julian",
    "Lattice",
    "Layout",
    "MapSpec",
    "Mirror",
    "Pack",
    "Pair",
    "Places",
    "Ring",
    "RosetteLayout",
    "Scattered",
    "Share",
    "Single",
    "Spot",
    "Stripes",
    "Symmetric",
    "System",
    "Term",
    "ThreeCircle",
    "Toss",
]
