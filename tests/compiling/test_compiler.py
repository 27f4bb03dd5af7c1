"""From recipe to artwork: true size, true curves after every map, the right number of flowers."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from batik_vector import read_recipe
from batik_vector.artwork import Artwork, Overlap, violations
from batik_vector.compiling import placements
from batik_vector.compiling.compiler import compile_recipe, inspect
from batik_vector.errors import RecipeError
from batik_vector.geometry import work
from batik_vector.geometry.curves import Circle, Petal, Polygon, Superellipse
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Core, Element, Flower, Rosette, Treatment
from batik_vector.tiling.cloth.field import repeated, with_bleed
from batik_vector.tiling.layouts import Julian, Lattice, Layout, Ring, Single
from batik_vector.tiling.symmetry.repeats import Cut, TileSpec
from tests.thorough import rarely

WAX = {"wax": InkSpec(colour="#f4efe2")}
ROOMY = TileSpec(size=(400.0, 400.0))


def laid_out(layout: Layout, element: Element, width: float = 300.0, tolerance: float = 0.02) -> Artwork:
    return compile_recipe(
        Recipe(
            motif={"m": Rosette(elements=(element,))},
            place=(Placement(motif="m", layout=layout, width=width),),
            tile=ROOMY,
            ink=WAX,
            tolerance=tolerance,
        )
    )


def spread(z: NDArray[np.complex128], level: int, dist: float, shift: complex) -> NDArray[np.complex128]:
    """The paper's layout of points, by its formula: move, raise r to dist/power, turn by 2πk/power."""
    images = z[None, :]
    for _ in range(level):
        moved = images + shift
        bent = np.abs(moved) ** (dist / 4) * np.exp(1j * np.angle(moved))
        images = np.concatenate([bent * 1j**k for k in range(4)])
    return images.ravel()


def chords(lines: NDArray[np.object_]) -> NDArray[np.object_]:
    """Return the stretches between the vertices of lines, each a line of its own."""
    xy, of = shapely.get_coordinates(lines, return_index=True)
    made: NDArray[np.object_] = shapely.linestrings(np.stack([xy[:-1], xy[1:]], axis=1)[of[:-1] == of[1:]])
    return made


@pytest.mark.parametrize(
    ("level", "dist", "shift"),
    rarely(list(itertools.product([1, 2, 3], [4.0, 4 * 0.618], [(4 / 3, 4 / 3), (0.3, 0.0)])), 5),
)
def test_images_stay_within_the_tolerance_of_the_true_curve(
    level: int, dist: float, shift: tuple[float, float]
) -> None:
    layout = Julian(power=4, dist=dist, level=level, shift=shift)
    artwork = laid_out(layout, Element(curve=Petal(n=2), treatment=Treatment.LINE))
    # Of the 64 images of the third level fewer points each will do.
    many = 5 if level < 3 else 1
    t = np.unique(np.concatenate([np.linspace(0, 1, 800 * many + 1), np.geomspace(1e-9, 0.01, 80 * many)]))
    xy = Petal(n=2).at(np.concatenate([t, 1 - t]))
    truth = spread(xy[:, 0] + 1j * xy[:, 1], level, dist, complex(*shift))
    scale = 300 / np.ptp(truth.real)
    points = shapely.points(200 + scale * np.column_stack([truth.real, truth.imag]))
    drawn = shapely.STRtree(chords(artwork.layers[0].lines))
    _, away = drawn.query_nearest(points, all_matches=False, return_distance=True)
    assert away.max() <= 0.0205
    assert shapely.total_bounds(artwork.layers[0].lines)[::2] == pytest.approx([50, 350], abs=0.003)


@pytest.mark.parametrize(
    ("shift", "level", "flowers"), [((4 / 3, 4 / 3), 1, 4), ((4 / 3, 4 / 3), 2, 9), ((4 / 3, 0), 1, 4)]
)
def test_flowers_that_coincide_are_drawn_once(shift: tuple[float, float], level: int, flowers: int) -> None:
    flower = Recipe(
        motif={"flower": Flower()},
        place=(Placement(motif="flower", layout=Julian(level=level, shift=shift), width=300.0),),
        tile=ROOMY,
        ink={"wax": InkSpec(overlap=Overlap.OVERLAY)},
    )
    names = compile_recipe(flower).layers[0].area_names
    assert names.count("flower.disc") == flowers
    assert names.count("flower.petal") == 8 * flowers


def test_a_width_is_the_breadth_on_cloth_and_a_scale_is_mm_to_the_unit() -> None:
    wide = laid_out(Ring(count=5, radius=2.0), Element(curve=Circle(1.0)), width=123.456)
    bounds = shapely.total_bounds(wide.layers[0].areas)
    assert bounds[2] - bounds[0] == pytest.approx(123.456, abs=0.002)
    dots = laid_out(Lattice(columns=4, rows=4), Element(curve=Circle(1.0)), width=10.0)
    assert len(dots.layers[0].areas) == 16
    assert shapely.area(dots.layers[0].areas) == pytest.approx(np.pi * 25, rel=0.005)


def two_discs(**upper: object) -> Artwork:
    under = Element(curve=Circle(1.0), name="under", ink="low")
    over = Element(curve=Circle(0.5), name="over", ink="high", **upper)  # type: ignore[arg-type]
    return compile_recipe(
        Recipe(
            motif={"m": Rosette(elements=(under, over))},
            place=(Placement(motif="m", scale=100.0),),
            tile=ROOMY,
            ink={"low": InkSpec(width=2.0), "high": InkSpec(width=2.0)},
        )
    )


def areas(artwork: Artwork) -> dict[str, float]:
    return {layer.ink.name: float(shapely.area(layer.areas).sum()) for layer in artwork.layers}


def test_a_gap_leaves_bare_ground_of_its_breadth() -> None:
    disc = np.pi * 50**2
    assert areas(two_discs()) == pytest.approx({"low": 4 * disc, "high": disc}, rel=1e-3)
    cut = np.pi * 53**2
    assert areas(two_discs(gap=3.0)) == pytest.approx({"low": 4 * disc - cut, "high": disc}, rel=1e-3)
    assert areas(two_discs(treatment="cut")) == pytest.approx({"low": 3 * disc}, rel=1e-3)


def test_a_stroke_has_the_body_its_ink_draws_and_hides_what_it_encloses() -> None:
    body = 2 * np.pi * 50 * 2
    assert areas(two_discs(treatment="stroke"))["high"] == pytest.approx(body, rel=1e-3)
    hollow = areas(two_discs(treatment="stroke", gap=1.0))
    assert hollow["low"] == pytest.approx(np.pi * (100**2 - 52**2), rel=1e-3)


@pytest.mark.parametrize(("overlap", "low"), [("weld", 4.0), ("overlay", 4.0), ("knockout", 3.0)])
def test_overlap_rules(overlap: str, low: float) -> None:
    artwork = compile_recipe(
        Recipe(
            motif={
                "a": Rosette(elements=(Element(curve=Circle(1.0)),)),
                "b": Rosette(elements=(Element(curve=Circle(0.5)),)),
            },
            place=(
                Placement(motif="a", scale=50.0, ink="low"),
                Placement(motif="b", scale=50.0, ink="high"),
                Placement(motif="b", scale=50.0, ink="high", at=(210.0, 200.0)),
            ),
            tile=ROOMY,
            ink={"low": InkSpec(), "high": InkSpec(overlap=Overlap(overlap))},
        )
    )
    by_name = {layer.ink.name: layer for layer in artwork.layers}
    assert len(by_name["high"].areas) == (2 if overlap == "overlay" else 1)
    lens = shapely.Point(0, 0).buffer(25, 64).union(shapely.Point(10, 0).buffer(25, 64)).area
    left = shapely.area(by_name["low"].areas).sum()
    assert left == pytest.approx(np.pi * 2500 - (lens if low == 3.0 else 0), rel=2e-3)


def test_lines_end_where_their_body_meets_a_gap() -> None:
    artwork = compile_recipe(
        Recipe(
            motif={
                "m": Rosette(
                    elements=(
                        Element(
                            curve=Polygon(sides=4, radius=2.0),
                            turn=45,
                            treatment=Treatment.LINE,
                            name="frame",
                        ),
                        Element(curve=Circle(1.0), radius=np.sqrt(2.0), gap=1.0, name="dot"),
                    )
                )
            },
            place=(Placement(motif="m", scale=20.0),),
            tile=ROOMY,
            ink={"wax": InkSpec(width=2.0)},
        )
    )
    lines = shapely.union_all(artwork.layers[0].lines)
    dot = shapely.union_all(artwork.layers[0].areas)
    # The centre line stays a gap and half its own breadth away, so the body stays a gap away.
    assert shapely.distance(lines, dot) == pytest.approx(2.0, abs=0.02)


def test_the_field_is_whole_and_welded() -> None:
    recipe = Recipe(
        motif={"m": Rosette(elements=(Element(curve=Circle(1.0)),))},
        place=(Placement(motif="m", scale=10.0, at=(0.0, 0.0)),),
        tile=TileSpec(size=(50.0, 40.0), repeat="half-drop", cut=Cut.UNIT),
        ink=WAX,
    )
    tile = compile_recipe(recipe)
    # Half a disc in the middle of the right edge, two quarters on the left.
    assert len(tile.layers[0].areas) == 3
    field = repeated(tile, 4, 4)
    assert violations(field) == []
    whole = [area for area in field.layers[0].areas if shapely.area(area) > 0.99 * np.pi * 100]
    assert len(whole) >= 9
    assert shapely.area(field.layers[0].areas).sum() == pytest.approx(
        16 * shapely.area(tile.layers[0].areas).sum()
    )
    bled = with_bleed(tile, 5.0)
    assert violations(bled) == []
    assert shapely.total_bounds(bled.layers[0].areas) == pytest.approx([-5, -5, 55, 45])


def test_a_recipe_that_covers_all_it_draws_says_so() -> None:
    cover = Element(curve=Circle(1.0), treatment=Treatment.CUT)
    with pytest.raises(RecipeError, match="nothing is left to draw"):
        laid_out(Single(), cover)


def test_work_past_the_limit_is_refused_with_its_estimate() -> None:
    text = """
    limit = 5000
    [motif.flower]
    kind = "flower"
    [[place]]
    motif = "flower"
    layout = { kind = "lattice", columns = 500, rows = 500 }
    width = "1 mm"
    [tile]
    size = ["1 m", "1 m"]
    """
    with pytest.raises(RecipeError, match=r"place\[0\].*about [\d,]+ vertices, past the limit of 5,000"):
        compile_recipe(read_recipe(text))


def test_a_leaf_whose_tip_lies_on_the_seam_keeps_its_area() -> None:
    leaves = Element(curve=Superellipse(0.2, 20, 1.2, 0.3), count=4)
    covered = []
    for at in [(30.0, 30.0), (43.04230356637408, 16.578780845709165)]:
        artwork = compile_recipe(
            Recipe(
                motif={"m": Rosette(elements=(leaves,))},
                place=(Placement(motif="m", scale=20.0, at=at),),
                tile=TileSpec(size=(60.0, 60.0)),
                ink=WAX,
            )
        )
        covered.append(float(shapely.area(artwork.layers[0].areas).sum()))
    assert covered[1] == pytest.approx(covered[0], abs=1)


def test_marks_that_keep_whole_go_with_their_outline() -> None:
    dot = Element(curve=Circle(1.0), count=8, radius=4.0, name="dot", treatment=Treatment.BOTH, whole=True)
    cover = Element(curve=Circle(1.2), radius=4.0, treatment=Treatment.CUT)
    artwork = laid_out(Single(), dot, width=100.0)
    covered = compile_recipe(
        Recipe(
            motif={"m": Rosette(elements=(dot, cover))},
            place=(Placement(motif="m", scale=10.0),),
            tile=ROOMY,
            ink=WAX,
        )
    )
    assert (len(artwork.layers[0].areas), len(artwork.layers[0].lines)) == (8, 8)
    assert (len(covered.layers[0].areas), len(covered.layers[0].lines)) == (7, 7)


def test_the_line_of_both_leaves_the_gap_bare() -> None:
    under = Element(curve=Circle(2.0), name="under", ink="low")
    over = Element(curve=Circle(1.0), ink="high", line_ink="pen", treatment=Treatment.BOTH, gap=1.0)
    artwork = compile_recipe(
        Recipe(
            motif={"m": Rosette(elements=(under, over))},
            place=(Placement(motif="m", scale=30.0),),
            tile=ROOMY,
            ink={"low": InkSpec(), "high": InkSpec(), "pen": InkSpec(width=2.0)},
        )
    )
    by_name = {layer.ink.name: layer for layer in artwork.layers}
    bare = shapely.distance(shapely.union_all(by_name["low"].areas), shapely.union_all(by_name["pen"].lines))
    assert bare == pytest.approx(2.0, abs=0.03)


def test_copies_of_an_element_that_coincide_are_drawn_once() -> None:
    ring = laid_out(Single(), Element(curve=Circle(1.0), count=5, treatment=Treatment.LINE), width=100.0)
    assert len(ring.layers[0].lines) == 1


def test_marks_of_an_overlay_stay_apart_across_the_seam() -> None:
    discs = Rosette(
        elements=(
            Element(curve=Circle(1.0), name="x"),
            Element(curve=Circle(1.0), radius=0.8, turn=90, name="y"),
        )
    )
    tile = compile_recipe(
        Recipe(
            motif={"m": discs},
            place=(Placement(motif="m", scale=5.0, at=(0.0, 10.0)),),
            tile=TileSpec(size=(20.0, 20.0)),
            ink={"wax": InkSpec(overlap=Overlap.OVERLAY)},
        )
    )
    field = repeated(tile, 2, 1).layers[0]
    whole = [name for name, area in zip(field.area_names, field.areas, strict=True) if area.area > 78]
    assert sorted(whole) == ["m.x", "m.y"]


def test_a_border_that_lies_on_the_seam_is_no_fault() -> None:
    square = Recipe(
        motif={"m": Rosette(elements=(Element(curve=Polygon(sides=4, radius=np.sqrt(2.0)), turn=45),))},
        place=(Placement(motif="m", scale=10.0, at=(10.0, 20.0)),),
        tile=TileSpec(size=(40.0, 40.0)),
        ink=WAX,
    )
    artwork = compile_recipe(square)
    assert len(artwork.borders) == 1
    assert inspect(artwork)["seam"] == []


def test_a_field_keeps_what_is_left_of_the_drop() -> None:
    tile = compile_recipe(
        Recipe(
            motif={"m": Rosette(elements=(Element(curve=Circle(1.0)),))},
            place=(Placement(motif="m", scale=10.0, at=(0.0, 13.0)),),
            tile=TileSpec(size=(50.0, 40.0), repeat="half-drop", cut=Cut.UNIT),
            ink=WAX,
        )
    )
    for across, up in [(1, 1), (3, 1), (2, 2), (3, 2)]:
        field = repeated(tile, across, up)
        assert inspect(field)["seam"] == []


def test_marks_that_cross_too_often_are_refused_with_the_contours_that_make_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(work, "LIMIT", 1000.0)
    recipe = Recipe(
        motif={"rose garden": Flower(core=Core(contours=4))},
        place=(Placement(motif="rose garden", width=80.0),),
        tile=TileSpec(size=(100.0, 100.0)),
        ink=WAX,
    )
    with pytest.raises(RecipeError, match="contours = 4"):
        compile_recipe(recipe)


def test_a_bent_motif_of_far_too_many_vertices_is_refused_before_it_is_bent(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(placements, "_set_out", None)
    monkeypatch.setattr(work, "LIMIT", 1000.0)
    recipe = Recipe(
        motif={"m": Flower()},
        place=(Placement(motif="m", layout=Julian(dist=2.5, level=1), scale=20.0),),
        tile=TileSpec(size=(300.0, 300.0)),
        ink=WAX,
    )
    with pytest.raises(RecipeError, match=r"place\[0\].* vertices"):
        compile_recipe(recipe)
