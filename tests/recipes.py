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
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.tiling.layouts import (
    Clear,
    Free,
    Julian,
    Lattice,
    Layout,
    Mirror,
    Ring,
    RosetteLayout,
    Single,
    Spot,
    Stripes,
    Toss,
)
from batik_vector.tiling.symmetry.groups import GROUPS
from batik_vector.tiling.symmetry.machine_fit import Fit
from batik_vector.tiling.symmetry.repeats import MIRRORS, Cut, TileSpec, repeat_of
from batik_vector.tiling.symmetry.spread import Spread

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
        Julian, power=st.integers(2, 4), dist=st.sampled_from([2.0, 3.0, 4.0, 5.0]), turn=st.floats(0, 90)
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
    st.builds(
        RosetteLayout,
        group=st.sampled_from(["C1", "C2", "C3", "D1", "D2"]),
        turn=st.floats(-180, 180),
        axis=st.floats(0, 90),
    ),
)

windings = st.sampled_from([(1, 0), (0, 1), (1, 1), (1, -1)])

grounds: st.SearchStrategy[Layout] = st.one_of(
    st.builds(
        Toss,
        distance=st.floats(0, 1),
        count=st.integers(1, 3),
        size=st.tuples(st.floats(0.5, 1), st.floats(1, 1.5)),
        flip=st.booleans(),
        clear=st.sampled_from([Clear.TOSSED, Clear.NONE, Clear.NONE]),
        tries=st.just(20),
        settle=st.integers(0, 2),
        seed=st.integers(0, 1000),
    ),
    st.builds(
        Stripes,
        # Lines that are flipped in turn must be even in number to close.
        count=st.just(2),
        winding=windings,
        links=st.integers(6, 9),
        flip=st.booleans(),
        creep=st.integers(-1, 1),
    ),
)

gaps = st.one_of(st.none(), st.none(), st.floats(0, 3))

figures = st.builds(
    Placement,
    motif=st.just("m"),
    layout=layouts,
    scale=st.floats(2, 15),
    at=st.tuples(st.floats(-80, 80), st.floats(-80, 80)),
    turn=st.floats(-180, 180),
    gap=gaps,
)

filled = st.builds(
    Placement, motif=st.just("m"), layout=grounds, scale=st.floats(0.5, 1.5), gap=st.sampled_from([None, 0.5])
)

placements = st.one_of(figures, figures, figures, filled)

side = st.integers(15_000, 60_000).map(lambda steps: steps / 1000)
DROPPED = ["grid", "half-drop", "brick", "drop 1/3", "drop 2/5", "brick 1/4"]
REPEATS = [*DROPPED, *MIRRORS, *GROUPS]
dropped = st.sampled_from(DROPPED)
symmetric = st.sampled_from([*GROUPS, *MIRRORS])


@st.composite
def tiles(draw: st.DrawFn, repeats: st.SearchStrategy[str]) -> TileSpec:
    """Draw a repeat, one in four of them fitted to a machine."""
    repeat = draw(repeats)
    width, height = draw(side), draw(side)
    ratio = repeat_of(repeat).kind.ratio
    if ratio:
        # A little off, so that it is stretched.
        height = round(width * ratio * draw(st.floats(0.992, 1.008)), 3)
    cut = Cut.RECTANGLE if repeat in MIRRORS else draw(st.sampled_from(list(Cut)))
    straight = TileSpec(size=(width, height), repeat=repeat)
    if draw(st.integers(0, 3)) == 0:
        stretch, limit = draw(st.integers(1, 3)) * draw(st.floats(0.96, 1.04)), 5.0
        whole = straight.cell()
        if draw(st.booleans()):
            return replace(straight, cut=cut, fit=Fit(width=whole.width * stretch, limit=limit))
        return replace(straight, cut=cut, fit=Fit(height=whole.height * stretch, limit=limit))
    return replace(straight, cut=cut)


def symmetries(tile: TileSpec) -> list[str]:
    """Return what a placement on a tile may name as its symmetry."""
    found = [""]
    for name in GROUPS:
        with contextlib.suppress(GeometryError):
            tile.orbit(name, spread=Spread.CUT)
            found.append(name)
    return found


@st.composite
def recipes(draw: st.DrawFn, repeat: str = "", grounded: bool = False) -> Recipe:
    """Draw a recipe of one motif in two inks, placed once or twice, that always compiles.

    Without a repeat given, most are without symmetries, which a placement may have all the same. Tosses and
    stripes occur where it is ``grounded``.
    """
    overlap = st.sampled_from(list(Overlap))
    repeats = st.just(repeat) if repeat else st.one_of(dropped, dropped, dropped, symmetric)
    tile = draw(tiles(repeats))
    known = st.sampled_from(symmetries(tile) if draw(st.integers(0, 2)) == 0 else [""])
    phase = draw(st.tuples(st.floats(-30, 30), st.floats(-30, 30)))

    def multiplied(placement: Placement, symmetry: str, spread: Spread | None) -> Placement:
        # As much of the cloth is covered as without symmetry: images beyond counting tell nothing more.
        images = len(tile.orbit(symmetry, phase, spread).operations)
        scale = (placement.scale or 1.0) / math.sqrt(images)
        return replace(placement, symmetry=symmetry, region=spread, phase=phase, scale=scale)

    spreads = st.sampled_from([None, *Spread])
    placed = placements if grounded else figures
    return Recipe(
        motif={"m": Rosette(elements=tuple(draw(st.lists(elements, min_size=1, max_size=3))))},
        place=tuple(draw(st.lists(st.builds(multiplied, placed, known, spreads), min_size=1, max_size=2))),
        tile=tile,
        tolerance=draw(st.sampled_from([0.2, 0.4, 0.4])),
        ink={
            "indigo": InkSpec(colour="#1d2f5f", width=draw(st.floats(0.2, 2)), overlap=draw(overlap)),
            "wax": InkSpec(colour="#f4efe2", width=draw(st.floats(0.2, 2)), overlap=draw(overlap)),
        },
    )
