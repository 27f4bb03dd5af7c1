"""Counterchange: an ink lies where one of two figures does and the other not, to the grid and the seam."""

from __future__ import annotations

import pytest
import shapely

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, Overlap, violations
from batik_vector.compiling.compiler import inspect
from batik_vector.errors import BatikError
from batik_vector.geometry.curves import Circle, Petal, Polygon
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.tiling.layouts import Lattice, Toss
from batik_vector.tiling.symmetry.repeats import TileSpec

SQUARE = Rosette(elements=(Element(curve=Polygon(4, 10 * 2**0.5), turn=45),))
FLOWER = Rosette(
    elements=(
        Element(curve=Petal(2, 9.0), count=5),
        Element(curve=Circle(2.0), treatment=Treatment.CUT),
    )
)
CHECKS = Placement(motif="square", layout=Lattice(columns=1, rows=2, stagger=True), scale=1, ink="indigo")


def over(**more: object) -> Placement:
    told = {"motif": "flower", "scale": 1, "ink": "indigo", "counterchange": True, **more}
    return Placement(**told)  # type: ignore[arg-type]


def made(*places: Placement, repeat: str = "grid", overlap: Overlap = Overlap.WELD) -> Artwork:
    inks = {"ochre": InkSpec(colour="#a86f3a"), "indigo": InkSpec(colour="#1d2f5f", overlap=overlap)}
    return compile_recipe(
        Recipe(
            motif={"square": SQUARE, "flower": FLOWER},
            place=places,
            tile=TileSpec(size=(40, 40), repeat=repeat),
            ink=inks,
        )
    )


def ink(artwork: Artwork, name: str = "indigo") -> shapely.Geometry:
    return shapely.union_all(
        [area for each in artwork.layers if each.ink.name == name for area in each.areas]
    )


@pytest.mark.parametrize("repeat", ["grid", "half-drop", "brick 1/3", "p4g", "pmm"])
def test_the_ink_lies_where_one_figure_does_and_the_other_does_not(repeat: str) -> None:
    flower = over(at=(13.2, 7.7))
    artwork = made(CHECKS, flower, repeat=repeat)
    assert violations(artwork) == []
    assert inspect(artwork)["seam"] == []
    below = ink(made(CHECKS, repeat=repeat))
    above = ink(made(over(at=(13.2, 7.7), counterchange=False), repeat=repeat))
    wanted = shapely.symmetric_difference(below, above)
    wrong = shapely.symmetric_difference(wanted, ink(artwork))
    assert shapely.area(wrong) < 2e-3 * shapely.length(wanted)
    # What stands beside an edge is a sliver of the grid, and no shape.
    assert shapely.is_empty(shapely.buffer(wrong, -0.002))


def test_a_toss_trades_with_what_lies_there() -> None:
    artwork = made(CHECKS, over(layout=Toss(count=4, size=(0.5, 0.6))))
    assert inspect(artwork)["seam"] == []
    assert shapely.area(ink(artwork)) == pytest.approx(800, rel=0.2)
    assert len(shapely.get_parts(ink(artwork))) > 4


def test_an_ink_beneath_shows_where_the_figure_is_bare() -> None:
    ground = Placement(motif="square", scale=2, ink="ochre")
    artwork = made(ground, CHECKS, over(at=(20, 20)), overlap=Overlap.KNOCKOUT)
    indigo, ochre = ink(artwork), ink(artwork, "ochre")
    assert shapely.area(shapely.intersection(indigo, ochre)) == 0
    assert shapely.area(shapely.union(indigo, ochre)) == pytest.approx(1600, abs=1e-3)


def test_what_is_traded_twice_is_as_it_was() -> None:
    twice, never = made(CHECKS, over(), over()), made(CHECKS)
    assert shapely.area(shapely.symmetric_difference(ink(twice), ink(never))) < 0.02


@pytest.mark.parametrize(
    ("places", "overlap", "words"),
    [
        ((over(),), Overlap.WELD, r'place\[0\].*nothing beneath is drawn in "indigo" to trade with'),
        (
            (Placement(motif="square", scale=1, ink="ochre"), over()),
            Overlap.WELD,
            r'place\[1\].*nothing beneath is drawn in "indigo"',
        ),
        ((CHECKS, over()), Overlap.OVERLAY, r'place\[1\].*"indigo" has overlap = "overlay"'),
    ],
)
def test_what_cannot_be_traded_is_told(places: tuple[Placement, ...], overlap: Overlap, words: str) -> None:
    with pytest.raises(BatikError, match=words):
        made(*places, overlap=overlap)


def test_with_a_gap_it_is_no_counterchange() -> None:
    with pytest.raises(BatikError, match=r"gap = 1: in a counterchange .* expected no gap"):
        over(gap=1.0)
