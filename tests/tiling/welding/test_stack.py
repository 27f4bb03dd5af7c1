"""Sheets on the torus: what is cut where, what is left out whole, and what that may cost."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Layer, Overlap
from batik_vector.compiling.compiler import compile_recipe, inspect
from batik_vector.geometry.curves import Circle, Petal, Rose
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Motif, Rosette, Treatment
from batik_vector.tiling.layouts import Ring
from batik_vector.tiling.symmetry.repeats import Cut, TileSpec
from batik_vector.tiling.welding import sheets
from batik_vector.tiling.welding.congruent import Stock
from batik_vector.tiling.welding.growth import grown_on_grid
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.tiling.welding.stack import assemble
from batik_vector.tiling.welding.wrapping import Torus
from tests.budgets import counted

INK = Ink("wax", "#f4efe2", 2.0)


def array(*shapes: shapely.Geometry) -> np.ndarray:
    return np.array(shapes, dtype=object)


def laid(*sheets: Sheet, size: tuple[int, int] = (100, 80), tolerance: float = 0.02) -> tuple[Layer, ...]:
    cell = Cell(size[0] * 1000, size[1] * 1000)
    inks = list({sheet.ink.name: sheet.ink for sheet in sheets if sheet.ink}.values())
    return assemble(sheets, inks, cell, cell.lattice, tolerance)[0]


@pytest.mark.parametrize("overlap", [Overlap.OVERLAY, Overlap.WELD])
def test_a_mark_wider_than_its_unit_is_cut_in_every_unit_of_the_tile(overlap: Overlap) -> None:
    """Half-drop as a rectangle holds two units, and the cutter bites into each of them."""

    def tile(cut: Cut) -> Artwork:
        motifs: dict[str, Motif] = {
            "big": Rosette(elements=(Element(curve=Circle(40.0), contours=2),)),
            "cut": Rosette(elements=(Element(curve=Circle(2.0), treatment=Treatment.CUT),)),
        }
        places = tuple(Placement(motif=name, scale=1.0, at=(3.0, 4.0), ink="wax") for name in motifs)
        return compile_recipe(
            Recipe(
                title="t",
                tolerance=0.1,
                motif=motifs,
                ink={"wax": InkSpec(colour="#f4efe2", overlap=overlap)},
                place=places,
                tile=TileSpec(size=(10.0, 12.0), repeat="half-drop", cut=cut),
            )
        )

    whole, unit = tile(Cut.RECTANGLE), tile(Cut.UNIT)
    assert inspect(whole)["violations"] == inspect(whole)["seam"] == []
    areas = [sum(shapely.union_all(layer.areas).area for layer in each.layers) for each in (whole, unit)]
    assert areas[0] == pytest.approx(2 * areas[1], rel=2e-3)


def test_lines_of_several_inks_that_end_on_the_seam_are_all_told() -> None:
    inks = [Ink("a", "#000000", 0.8), Ink("b", "#000000", 1.2)]
    lines = [
        Sheet(ink.name, ink, lines=array(shapely.LineString([(-20, y), (20, y)])))
        for ink, y in zip(inks, (30, 60), strict=True)
    ]
    gaps = [
        Sheet("g", None, array(shapely.box(left, y, 9, y + 20)), gap=0.0)
        for left, y in ((0.4, 20), (0.6, 50))
    ]
    cell = Cell(100_000, 80_000)
    for order in (lines, lines[::-1]):
        _, borders = assemble([*order, *gaps], inks, cell, cell.lattice, 0.02)
        assert sorted(borders) == [("a", 0, 30_000, 30_000), ("b", 0, 60_000, 60_000)]


def test_the_tip_of_a_needle_that_is_flat_on_the_seam_is_told() -> None:
    """Of its two sides one is drawn, and ends on the seam where they meet."""
    needle = shapely.LineString([(-20, 0), (80, 0.001), (90, 0), (80, -0.001), (-20, 0)])
    cell = Cell(100_000, 80_000)
    _, borders = assemble([Sheet("n", INK, lines=array(needle))], [INK], cell, cell.lattice, 0.02)
    assert (INK.name, 1, 90_000, 90_000) not in borders
    flat = shapely.LineString([(20, 9), (60, 0), (90, 0), (60, 0), (20, 9)])
    _, borders = assemble([Sheet("n", INK, lines=array(flat))], [INK], cell, cell.lattice, 0.02)
    assert (INK.name, 1, 90_000, 90_000) in borders


def test_a_line_that_leaves_another_on_the_seam_ends_there_on_purpose() -> None:
    lines = [
        shapely.LineString([(10, 5), (0, 20), (0, 60), (10, 75)]),
        shapely.LineString([(10, 15), (0, 30), (0, 50), (10, 65)]),
    ]
    cell = Cell(100_000, 80_000)
    _, borders = assemble([Sheet("n", INK, lines=array(*lines))], [INK], cell, cell.lattice, 0.02)
    assert {(INK.name, 0, y, y) for y in (30_000, 50_000)} <= borders


def test_mending_a_seam_pushes_no_area_over_its_neighbour() -> None:
    """A gap of a step that one side of the seam alone has is closed, and a point there moves over an edge."""
    left = shapely.Polygon([(29_014, 0), (36_287, 0), (36_373, 63), (32_000, 2_700)])
    right = shapely.Polygon([(36_288, 0), (43_247, 0), (43_247, 3_000), (36_946, 484)])
    beyond = shapely.box(29_014, 79_000, 43_247, 80_000)
    cell = Cell(100_000, 80_000)
    for apart in (True, False):
        torus = Torus(Stock(), cell, cell.lattice, np.zeros(2, np.int64))
        sealed = torus.sealed("wax", torus.stock.taken_up(array(left, right, beyond)), apart=apart)
        assert (sealed is None) == apart


@pytest.mark.parametrize("away", [0.004, 0.009, 0.011])
def test_a_line_runs_along_the_seam_on_it_or_well_beside_it(away: float) -> None:
    """A mark beside a mirror, and its image: two lines as near as that would be one drawn twice."""
    right = shapely.LineString([(90, 20), (100 - away, 30), (100 - away, 40), (90, 50)])
    left = shapely.LineString([(10, 20), (away, 30), (away, 40), (10, 50)])
    (layer,) = laid(Sheet("s", INK, lines=array(right, left)))
    drawn = shapely.length(layer.lines).sum()
    once = 10 if away < 0.01 else 20
    assert drawn == pytest.approx(4 * np.hypot(10, 10) + once, abs=0.05)


@pytest.mark.parametrize("away", np.linspace(0.6, 1.1, 11))
def test_an_area_left_out_takes_its_line_with_it(away: float) -> None:
    square = shapely.box(15, 15, 25, 25)
    corner = 25 + away / np.sqrt(2)
    dot = shapely.box(corner, corner, corner + 0.01, corner + 0.01)
    area = Sheet("a", INK, array(square), whole=True, margin=1.0)
    line = Sheet("a.line", INK, lines=array(square.exterior), whole=True)
    above = Sheet("dot", None, array(dot), gap=0.0)
    layers = laid(area, line, above, tolerance=0.4)
    drawn = [(len(layer.areas), len(layer.lines)) for layer in layers]
    assert drawn in ([], [(1, 1)])


def test_marks_that_all_meet_are_not_copied_for_every_meeting() -> None:
    """Every one of 40 different marks meets every other: 780 meetings."""
    marks = array(*(shapely.Point(50, 40).buffer(10 + k / 3, quad_segs=16) for k in range(40)))
    with counted() as work:
        laid(Sheet("discs", INK, marks))
    assert work.given("set_coordinates") < 12 * shapely.get_num_coordinates(marks).sum()


def test_what_is_made_in_python_may_hold_lists() -> None:
    motif = Rosette(elements=[Element(curve=Circle(1.0))])  # type: ignore[arg-type]
    place = Placement(motif="dot", scale=3.0, at=[10.0, 10.0], ink="wax")  # type: ignore[arg-type]
    recipe = Recipe(
        title="t",
        motif={"dot": motif},
        ink={"wax": InkSpec(colour="#f4efe2")},
        place=(place,),
        tile=TileSpec(size=(20.0, 20.0)),
    )
    assert len(compile_recipe(recipe).layers[0].areas) == 1


@pytest.mark.parametrize("gap", [15.0, 1000.0])
def test_a_gap_wider_than_the_repeat_grows_a_mark_no_farther_than_covers_all(
    gap: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    reached = []

    def watched(shapes: Geometries, reach: float, corners: int) -> Geometries:
        reached.append(reach)
        return grown_on_grid(shapes, reach, corners)

    monkeypatch.setattr(sheets, "grown_on_grid", watched)
    motif = Rosette(
        elements=(Element(curve=Circle(9.0), name="under"), Element(curve=Circle(0.5), name="over", gap=gap))
    )
    recipe = Recipe(
        motif={"m": motif},
        ink={"wax": InkSpec(colour="#f4efe2")},
        place=(Placement(motif="m", scale=1.0, ink="wax"),),
        tile=TileSpec(size=(20.0, 20.0)),
    )
    (area,) = compile_recipe(recipe).layers[0].areas
    assert shapely.area(area) == pytest.approx(np.pi / 4, rel=0.05)
    # Half the diagonal of the repeat reaches every place.
    assert max(reached) < 10 * 2**0.5 + 0.5


@pytest.mark.parametrize("contours", range(2, 10))
@pytest.mark.parametrize("curve", [Petal(2, 1.0), Petal(3, 1.0), Circle(1.0), Rose(3, 1, 1.0)])
def test_nested_contours_compile_whatever_they_share(curve: Circle, contours: int) -> None:
    recipe = Recipe(
        title="t",
        motif={"m": Rosette(elements=(Element(curve=curve, contours=contours),))},
        ink={"wax": InkSpec(colour="#f4efe2")},
        place=(Placement(motif="m", scale=9.0, ink="wax", layout=Ring(count=3, radius=30.0)),),
        tile=TileSpec(size=(90.0, 90.0)),
    )
    artwork = compile_recipe(recipe)
    assert inspect(artwork)["violations"] == []
    # Bands between k and k - 1 of n equal steps, every other one from the outermost.
    share = sum((k**2 - (k - 1) ** 2) / contours**2 for k in range(contours, 0, -2))
    one = replace_contours(recipe)
    full = float(shapely.area(compile_recipe(one).layers[0].areas).sum())
    assert float(shapely.area(artwork.layers[0].areas).sum()) == pytest.approx(share * full, rel=0.02)


def replace_contours(recipe: Recipe) -> Recipe:
    from dataclasses import replace

    (element,) = recipe.motif["m"].parts()
    assert isinstance(element, Element)
    return replace(recipe, motif={"m": Rosette(elements=(replace(element, contours=1),))})


def test_what_a_filled_slit_comes_to_overlap_is_welded() -> None:
    """The slit's edge runs past a mark that touched the slit's mouth in a point."""
    slit = [
        (58.429, 41.027),
        (59.096, 40.514),
        (59.057, 40.123),
        (59.206, 41.609),
        (61, 45),
        (64, 38),
        (57, 38),
    ]
    beside = [(59.096, 40.514), (59.1, 40.553), (59.103, 40.586), (59.053, 40.583), (59.011, 40.58)]
    marks = array(shapely.Polygon(slit), shapely.Polygon(beside))
    assert shapely.is_valid(marks).all()
    assert not shapely.relate_pattern(marks[0], marks[1], "T********")
    (layer,) = laid(Sheet("marks", Ink("wax", "#f4efe2", 2.0), marks))
    assert len(layer.areas) == 1
    assert layer.areas[0].area == pytest.approx(shapely.area(marks).sum(), abs=2e-3)
