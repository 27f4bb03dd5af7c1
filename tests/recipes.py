"""Random recipes for properties that hold for every one of them."""

from __future__ import annotations

import contextlib
import math
from dataclasses import replace

from hypothesis import strategies as st

from batik_vector.artwork import Overlap
from batik_vector.errors import GeometryError
from batik_vector.geometry.curves import (
    Circle,
    Curve,
    Hypocycloid,
    Petal,
    Polygon,
    Rose,
    Spiral,
    Star,
    Superellipse,
)
from batik_vector.model import InkSpec, Placement, Recipe
from batik_vector.motif import Element, Rosette, Treatment
from batik_vector.tiling.cells import MIRRORS, Cut, TileSpec, repeat_of
from batik_vector.tiling.groups import GROUPS
from batik_vector.tiling.layouts import Free, Julian, Lattice, Layout, Mirror, Ring, Single, Spot
from batik_vector.tiling.symmetry import Spread

small = st.floats(0.2, 1.5)

curves: st.SearchStrategy[Curve] = st.one_of(
    st.builds(Circle, radius=small),
    st.builds(Superellipse, a=st.floats(0.2, 2), b=st.floats(0.5, 12), length=small, width=small),
    st.builds(Rose, n=st.integers(1, 6), d=st.integers(1, 3), length=small),
    st.builds(Petal, n=st.integers(1, 6), length=small),
    st.builds(Hypocycloid, m=st.integers(11, 18), n=st.sampled_from([1, 3, 5]), length=small),
    st.builds(Polygon, sides=st.integers(3, 8), radius=small),
    st.builds(Star, points=st.integers(3, 8), radius=small, inner=small),
    st.builds(Spiral, revolutions=st.floats(0.3, 3), radius=small),
)

elements = st.builds(
    Element,
    curve=curves,
    name=st.sampled_from(["petal", "leaf", "dot"]),
    count=st.integers(1, 5),
    radius=st.floats(0, 1.5),
    turn=st.floats(-180, 180),
    spin=st.floats(-180, 180),
    treatment=st.sampled_from(list(Treatment)),
    ink=st.sampled_from(["wax", "indigo"]),
    gap=st.one_of(st.none(), st.floats(0, 3)),
)

layouts: st.SearchStrategy[Layout] = st.one_of(
    st.builds(Single, turn=st.floats(-180, 180)),
    st.builds(
        Julian, power=st.integers(2, 5), dist=st.sampled_from([2.0, 3.0, 4.0, 5.0]), turn=st.floats(0, 90)
    ),
    st.builds(Ring, count=st.integers(2, 6), upright=st.booleans()),
    st.builds(Mirror, axis=st.floats(0, 180)),
    st.builds(Lattice, columns=st.integers(1, 3), rows=st.just(2), stagger=st.booleans()),
    st.builds(
        Free,
        spots=st.lists(
            st.builds(Spot, turn=st.floats(-180, 180), scale=st.floats(0.5, 2), mirror=st.booleans()),
            min_size=1,
            max_size=3,
        ).map(tuple),
    ),
)

placements = st.builds(
    Placement,
    motif=st.just("m"),
    layout=layouts,
    scale=st.floats(2, 15),
    at=st.tuples(st.floats(-80, 80), st.floats(-80, 80)),
    turn=st.floats(-180, 180),
    gap=st.one_of(st.none(), st.none(), st.floats(0, 3)),
)

side = st.integers(15_000, 60_000).map(lambda steps: steps / 1000)
dropped = st.sampled_from(["grid", "half-drop", "brick", "drop 1/3", "drop 2/5", "brick 1/4"])
symmetric = st.sampled_from([*GROUPS, *MIRRORS])


@st.composite
def tiles(draw: st.DrawFn) -> TileSpec:
    """Draw a repeat: most without symmetries, which a placement may have all the same."""
    repeat = draw(st.one_of(dropped, dropped, dropped, symmetric))
    width, height = draw(side), draw(side)
    ratio = repeat_of(repeat).kind.ratio
    if ratio:
        # A little off, so that it is stretched.
        height = round(width * ratio * draw(st.floats(0.992, 1.008)), 3)
    cut = Cut.RECTANGLE if repeat in MIRRORS else draw(st.sampled_from(list(Cut)))
    return TileSpec(size=(width, height), repeat=repeat, cut=cut)


def symmetries(tile: TileSpec) -> list[str]:
    """Return what a placement on a tile may name as its symmetry."""
    found = [""]
    for name in GROUPS:
        with contextlib.suppress(GeometryError):
            tile.orbit(name, spread=Spread.CUT)
            found.append(name)
    return found


@st.composite
def recipes(draw: st.DrawFn) -> Recipe:
    """Draw a recipe of one motif in two inks, placed once or twice, that always compiles."""
    overlap = st.sampled_from(list(Overlap))
    tile = draw(tiles())
    known = st.sampled_from(symmetries(tile) if draw(st.integers(0, 2)) == 0 else [""])
    phase = draw(st.tuples(st.floats(-30, 30), st.floats(-30, 30)))

    def multiplied(placement: Placement, symmetry: str, spread: Spread | None) -> Placement:
        # As much of the cloth is covered as without symmetry: images beyond counting tell nothing more.
        images = len(tile.orbit(symmetry, phase, spread).operations)
        scale = (placement.scale or 1.0) / math.sqrt(images)
        return replace(placement, symmetry=symmetry, region=spread, phase=phase, scale=scale)

    spreads = st.sampled_from([None, *Spread])
    return Recipe(
        motif={"m": Rosette(elements=tuple(draw(st.lists(elements, min_size=1, max_size=3))))},
        place=tuple(
            draw(st.lists(st.builds(multiplied, placements, known, spreads), min_size=1, max_size=2))
        ),
        tile=tile,
        tolerance=draw(st.sampled_from([0.1, 0.4])),
        ink={
            "indigo": InkSpec(colour="#1d2f5f", width=draw(st.floats(0.2, 2)), overlap=draw(overlap)),
            "wax": InkSpec(colour="#f4efe2", width=draw(st.floats(0.2, 2)), overlap=draw(overlap)),
        },
    )
