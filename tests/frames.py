"""Borders to test: a wave, a cloth, and random frames."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Cell, Layer, Overlap, violations
from batik_vector.compiling.borders import Bordered
from batik_vector.geometry.curves import Circle, Curve, FunctionCurve, Petal, Superellipse
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.border import BorderSpec, ClothSide, Corner, Ends, Facing, RailSpec
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.tiling.symmetry.friezes import FRIEZES
from batik_vector.tiling.symmetry.repeats import TileSpec

many = settings(
    max_examples=24,
    deadline=None,
    derandomize=True,
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow],
)

WIDTH, HEIGHT = 280.0, 200.0
CLOTH = (0.0, 0.0, WIDTH, HEIGHT)
PERIOD, DEPTH = 40.0, 36.0
RINGS = {name: 1 if name in ("p1", "p1m1") else 2 for name in FRIEZES}
"""How many rings an upright-symmetric wave in the outer half of the band makes."""


def crest(t: Array) -> Points:
    return np.column_stack([PERIOD * t, 3 * np.cos(2 * np.pi * t)])


def recipe(*elements: Element, tolerance: float = 0.05, **inks: InkSpec) -> Recipe:
    return Recipe(
        motif={"m": Rosette(elements=elements or (WAVE,))},
        place=(Placement(motif="m", scale=1),) if not inks else (Placement(motif="m", scale=1, ink="wax"),),
        tile=TileSpec(size=(40, 40)),
        tolerance=tolerance,
        ink=inks or {"wax": InkSpec(width=2)},
    )


WAVE = Element(curve=FunctionCurve(crest, closed=False), name="wave", treatment=Treatment.STROKE)
LINE = replace(WAVE, treatment=Treatment.LINE)


def border(*placements: Placement, **fields: object) -> BorderSpec:
    known = {"size": (PERIOD, DEPTH), "place": placements or (Placement(motif="m", scale=1, at=(0, 9)),)}
    return BorderSpec(**{**known, **fields})  # type: ignore[arg-type]


def plain(**fields: object) -> Placement:
    return Placement(motif="m", scale=1, **fields)  # type: ignore[arg-type]


def artwork(done: Bordered, cloth: tuple[float, float, float, float] = CLOTH) -> Artwork:
    size = Cell(round((cloth[2] - cloth[0]) * 1000), round((cloth[3] - cloth[1]) * 1000))
    return Artwork(title="", cell=size, layers=done.layers)


def sound(done: Bordered, cloth: tuple[float, float, float, float] = CLOTH) -> Layer:
    """Return the only layer of a border without faults."""
    assert violations(artwork(done, cloth)) == []
    (layer,) = done.layers
    return layer


shapes: st.SearchStrategy[Curve] = st.one_of(
    st.builds(
        Superellipse,
        a=st.floats(0.3, 1.5),
        b=st.floats(0.5, 2),
        length=st.floats(4, 30),
        width=st.floats(2, 12),
    ),
    st.builds(Petal, n=st.integers(1, 5), length=st.floats(4, 30)),
    st.builds(Circle, radius=st.floats(1, 25)),
)


elements = st.builds(
    Element,
    curve=shapes,
    count=st.integers(1, 3),
    radius=st.floats(0, 9),
    turn=st.floats(0, 360),
    treatment=st.sampled_from(list(Treatment)),
    ink=st.sampled_from(["wax", "indigo"]),
    gap=st.none() | st.floats(0, 2),
)


@st.composite
def frames(draw: st.DrawFn) -> tuple[Recipe, list[BorderSpec], tuple[float, float, float, float]]:
    """Draw a recipe of two inks, one or two borders on any sides, and a cloth that they fit."""
    overlap = st.sampled_from(list(Overlap))
    inks = {name: InkSpec(width=draw(st.floats(0.3, 3)), overlap=draw(overlap)) for name in ("indigo", "wax")}
    motif = draw(st.lists(elements, min_size=1, max_size=3))
    made: list[BorderSpec] = []
    for _ in range(draw(st.integers(1, 2))):
        corner = draw(st.sampled_from(list(Corner))) if not made or made[0].corner != "bend" else Corner.BEND
        placements = st.lists(
            st.builds(
                Placement, motif=st.just("m"), scale=st.floats(0.3, 2), ink=st.just("wax"),
                at=st.tuples(st.floats(-30, 60), st.floats(-5, 40)), turn=st.floats(0, 360),
            ), min_size=1, max_size=2,
        )  # fmt: skip
        sides = (
            draw(st.sets(st.sampled_from(list(ClothSide)), min_size=1)) if not made else set(made[0].sides)
        )
        made.append(
            BorderSpec(
                size=(draw(st.floats(14, 60)), draw(st.floats(10, 40))),
                frieze=draw(st.sampled_from(list(FRIEZES))),
                place=tuple(draw(placements)),
                corner=corner,
                corner_place=tuple(draw(placements)) if corner == Corner.MOTIF else (),
                phase=draw(st.floats(-20, 20)),
                facing=draw(st.sampled_from(list(Facing) if corner == Corner.MOTIF else [Facing.TURN])),
                ends=draw(st.sampled_from(list(Ends))),
                sides=tuple(side for side in ClothSide if side in sides),
                rails=(RailSpec(at=1, width=1.5, ink="indigo"),),
                gap=draw(st.floats(0, 5)),
                limit=50,
            )
        )
    return (
        recipe(*motif, tolerance=0.1, **inks),
        made,
        (0.0, 0.0, draw(st.floats(330, 420)), draw(st.floats(330, 420))),
    )
