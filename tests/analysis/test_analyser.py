"""The analyser: the paper's Table 2 from compiled drawings alone, and other rows where other things are
drawn."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import shapely
import shapely.affinity

from batik_vector import analyse
from batik_vector.artwork import Artwork, Cell, Ink, Layer, RawArtwork
from batik_vector.certificate.symmetry.rosette import found_rosette
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.importing.document import DrawingError
from batik_vector.recipe.loading import load_recipe
from tests.analysis.drawings import SAMPLES, TABLE_2, bare_svg, changed, flower
from tests.analysis.flowers import CASES, DROP, HEART, PISTIL, Case, drawn, ring
from tests.thorough import rarely

ELSEWHERE = "translate(190 24) rotate(37.3) scale(0.61)"
"""How the six flowers are moved: turned, made smaller, shifted, onto a larger page."""


@pytest.mark.parametrize("number", TABLE_2)
def test_the_papers_table_comes_out_of_the_compiled_drawing(number: int) -> None:
    assert str(analyse(bare_svg(flower(number)))) == TABLE_2[number]


@pytest.mark.parametrize("bezier", [False, True])
@pytest.mark.parametrize("number", rarely(list(TABLE_2), 3))
def test_it_does_not_matter_how_the_drawing_lies_and_what_its_curves_are(number: int, bezier: bool) -> None:
    found = analyse(bare_svg(flower(number), bezier=bezier, placed=ELSEWHERE, page=400))
    assert str(found) == TABLE_2[number]


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_other_flowers_have_other_rows(case: Case) -> None:
    found = analyse(drawn(*case.elements))
    assert (str(found), found.symmetry.kind) == (case.row, case.kind)


def test_a_changed_sample_has_a_changed_row() -> None:
    fewer = changed(1, ("count = 8, ink", "count = 7, ink"))
    assert str(analyse(bare_svg(fewer))) == "2, rotation, 1/7, single, curved, 7, 1"


def test_names_and_inks_by_other_names_tell_nothing() -> None:
    renamed = changed(3, ("petal", "pistil-of-seven"), ("[ink.soga]", "[ink.petals]"), ('"soga"', '"petals"'))
    assert str(analyse(renamed)) == TABLE_2[3]


def test_a_flower_in_one_piece_is_taken_apart() -> None:
    found = analyse(drawn(ring([(x - 0.25, y) for x, y in DROP], 8), HEART.replace("0.12", "0.3")))
    assert found.marks == 1
    assert str(found) == "1, rotation, 1/8, single, curved, 8, none"


def test_lines_are_looked_at_as_areas_are() -> None:
    lines = 'treatment = "line"'
    found = analyse(drawn(ring(DROP, 8, rest=lines), ring(PISTIL, 8, rest=lines)))
    assert str(found) == "2, rotation, 1/8, single, curved, 8, 1"
    assert found.line_widths == (1.0, 1.0)


def test_four_flowers_are_told_as_one_of_four() -> None:
    found = analyse(compile_recipe(load_recipe(SAMPLES / "four-square.toml")))
    assert found.flowers == 4
    assert [layer.petals for layer in found.layers] == [8]
    assert found.centre == pytest.approx((80, 240), abs=0.01)


def test_figures_are_those_of_the_artwork() -> None:
    artwork = drawn(ring(DROP, 8), HEART)
    found = analyse(artwork)
    areas = np.concatenate([layer.areas for layer in artwork.layers])
    assert found.coverage == pytest.approx(shapely.area(areas).sum() / 1e4, rel=1e-9)
    assert found.nodes == shapely.get_num_coordinates(areas).sum() - len(areas)
    assert found.nodes == analyse(bare_svg(artwork)).nodes - 4  # the cloth, whose layer has lost its name
    assert found.centre == pytest.approx((50, 50), abs=1e-3)
    assert found.reach == pytest.approx(40, abs=0.05)


def square(*layers: Layer) -> Artwork:
    return RawArtwork("square", Cell(100_000, 100_000), layers)


def areas(*polygons: shapely.Polygon) -> Layer:
    return Layer(Ink("ink", "#000000"), np.array(polygons, dtype=object))


LEAF = shapely.Polygon([(0, 0), (6, 2), (12, 0), (6, -2)])


def test_leaves_in_rows_are_shifted_and_no_flower() -> None:
    rows = [shapely.affinity.translate(LEAF, 5 + 16 * i, 10 + 11 * j) for i in range(5) for j in range(7)]
    found = analyse(square(areas(*rows)))
    assert not found.judged
    assert found.relation == "translation"
    assert "35 marks of 1 shape, and no three alike" in found.reason
    assert str(found) == "1, translation, 1/2, none, none, none, none"


def test_what_is_taken_apart_in_vain_is_told_of_as_it_was_drawn() -> None:
    found = analyse(compile_recipe(load_recipe(Path(__file__).with_name("tulips.toml"))))
    assert not found.judged
    assert 0 < found.elements <= found.kinds <= found.marks


def test_a_single_mark_and_an_empty_page_are_not_judged() -> None:
    disc = analyse(square(areas(shapely.Point(50, 50).buffer(20, quad_segs=64))))
    assert not disc.judged
    assert "1 mark of 1 shape" in disc.reason
    assert (disc.symmetry.word, disc.symmetry.kind) == ("rotation", "rotation by any angle")
    empty = analyse(square())
    assert not empty.judged
    assert empty.reason == "nothing is drawn"
    assert empty.dimension is None


def test_a_tracing_is_not_judged() -> None:
    random = np.random.default_rng(5)
    blots = [
        shapely.Polygon(np.column_stack([r * np.cos(t), r * np.sin(t)]) + random.uniform(10, 90, 2))
        for n in random.integers(5, 14, 700)
        for t, r in [(np.arange(n) * 2 * math.pi / n, random.uniform(0.05, 0.9, n) * random.uniform(0.1, 1))]
    ]
    found = analyse(square(*(areas(blot) for blot in blots)))
    assert not found.judged
    assert "no pattern of like marks" in found.reason


def test_what_is_no_drawing_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "empty.svg"
    path.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9"/>')
    with pytest.raises(DrawingError, match="nothing is drawn"):
        analyse(path)


def test_the_rosette_is_the_certificates() -> None:
    artwork = drawn(ring(DROP, 8), HEART)
    found = found_rosette(artwork.layers, (50, 50), artwork.tolerance)
    assert analyse(artwork).symmetry.name == found.name == "D8"


def test_plain_values_hold_all_of_it() -> None:
    facts = analyse(drawn(ring(DROP, 6))).as_dict()
    assert facts["row"]["petals"] == "6"
    assert facts["layers"] == [{"petals": 6, "shapes": ["curved"], "outer_mm": pytest.approx(40, abs=0.05)}]
    assert facts["symmetry"]["group"] == "D6"
    assert set(facts["box_dimension"]) == {"dimension", "from_mm", "to_mm", "residual", "sizes"}


def test_what_the_papers_users_made_has_their_rows() -> None:
    (mirrored, turned) = (compile_recipe(load_recipe(SAMPLES / f"figure-16{each}.toml")) for each in "ab")
    assert str(analyse(bare_svg(mirrored))) == "2, rotation, 1/8, multi, curved, 10 or more, none"
    found = analyse(bare_svg(turned))
    assert [str(each) for each in found.others] == [
        "2, rotation, 1/5, single, curved, 5, 2",
        "multi, rotation, 1/5, double, curved and wavy, 5, none",
    ]
    assert [each.flowers for each in found.others] == [4, 4]
