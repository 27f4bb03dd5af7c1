from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector import certify, compile_recipe, load_recipe
from batik_vector.artwork import Artwork, Cell, Ink, Layer, Overlap
from batik_vector.errors import GeometryError
from batik_vector.export.svg import render
from batik_vector.geometry.outlines import to_polylines
from batik_vector.importing.svg import read_svg
from batik_vector.machines import Machine, Motion
from batik_vector.machines import Tool as Held
from batik_vector.processes.options import PlotProcess
from batik_vector.processes.prepared import Prepared
from tests.thorough import slow

SAMPLES = Path(__file__).parents[2] / "samples"
PLAIN = Machine()


def layer(name: str, *marks: shapely.Geometry, overlap: Overlap = Overlap.WELD) -> Layer:
    areas = np.array([each for each in marks if isinstance(each, shapely.Polygon)], dtype=object)
    lines = np.array([each for each in marks if isinstance(each, shapely.LineString)], dtype=object)
    return Layer(Ink(name, "#123456", 1.5, overlap), areas, lines)


def page(*layers: Layer) -> Artwork:
    return Artwork("Squares", Cell(100_000, 100_000), layers)


def square(x: float, y: float, side: float) -> shapely.Polygon:
    return shapely.box(x, y, x + side, y + side)


def drawn_mm(prepared: Prepared) -> dict[str, float]:
    return {tool.ink.name: shapely.length(to_polylines(tool.strokes, 1000)).sum() for tool in prepared.tools}


TWO = page(layer("wax", square(10, 10, 20), square(40, 10, 20)), layer("blue", square(30, 10, 10)))


def test_a_stretch_that_inks_share_is_drawn_by_both_unless_asked_otherwise() -> None:
    once = PlotProcess().apply(TWO, PLAIN)
    assert drawn_mm(once) == {"wax": 160.0, "blue": 40.0}
    assert once.facts["plot"]["doubled"]["stretches"] == 0
    shared = PlotProcess(once="all").apply(TWO, PLAIN)  # type: ignore[arg-type]
    assert drawn_mm(shared) == {"wax": 160.0, "blue": 20.0}
    told = shared.facts["plot"]["doubled"]
    assert (told["stretches"], told["saved_mm"]) == (2, 20.0)
    assert {(tuple(each["at_mm"]), each["ink"], each["mm"]) for each in told["places"]} == {
        ((30.0, 15.0), "blue", 10.0),
        ((40.0, 15.0), "blue", 10.0),
    }


def test_places_that_are_told_are_those_of_the_longest_stretches() -> None:
    lines = [shapely.LineString([(10, 2 + k), (11 + k, 2 + k)]) for k in range(20)]
    told = PlotProcess().apply(page(layer("a", *lines, *lines)), PLAIN).facts["plot"]["doubled"]
    assert told["stretches"] == 20
    assert [each["mm"] for each in told["places"]] == [20.0 - k for k in range(10)]


def test_the_pen_that_draws_first_keeps_what_is_shared() -> None:
    swapped = PlotProcess(once="all", pens={"blue": 1}).apply(TWO, PLAIN)  # type: ignore[arg-type]
    assert drawn_mm(swapped) == {"blue": 40.0, "wax": 140.0}
    assert [(tool.ink.name, tool.pen) for tool in swapped.tools] == [("blue", 1), ("wax", 2)]


@pytest.mark.parametrize(
    ("pens", "expected"),
    [
        ({}, [("a", 1), ("b", 2), ("c", 3)]),
        ({"a": 2}, [("b", 1), ("a", 2), ("c", 3)]),
        ({"c": 1, "a": 7}, [("c", 1), ("b", 2), ("a", 7)]),
        ({"a": 3, "b": 3}, [("c", 1), ("a", 3), ("b", 3)]),
    ],
)
def test_pens_come_in_turn_and_layers_carry_their_numbers(
    pens: dict[str, int], expected: list[tuple[str, int]]
) -> None:
    artwork = page(*(layer(name, square(10, 10 + 20 * k, 5)) for k, name in enumerate("abc")))
    prepared = PlotProcess(pens=pens).apply(artwork, PLAIN)
    assert [(tool.ink.name, tool.pen) for tool in prepared.tools] == expected
    text = render(prepared).decode()
    assert [f'inkscape:label="{pen} {name}"' in text for name, pen in expected] == [True] * 3
    assert 'inkscape:label="%99 cloth"' in text


def test_a_pen_for_an_ink_that_is_not_there_is_refused() -> None:
    with pytest.raises(GeometryError, match=r'pens = unknown ink "bleu": did you mean "blue"\?'):
        PlotProcess(pens={"bleu": 1}).apply(TWO, PLAIN)


@pytest.mark.parametrize("pen", [0, 99, 1.5])
def test_pens_have_numbers_that_a_layer_can_carry(pen: float) -> None:
    with pytest.raises(GeometryError, match="pens"):
        PlotProcess(pens={"blue": pen})  # type: ignore[dict-item]


def test_what_lies_under_a_higher_ink_is_drawn_unless_it_is_to_be_removed() -> None:
    line = shapely.LineString([(0, 50), (100, 50)])
    hiding = page(layer("line", line), layer("area", square(40, 40, 20)))
    assert drawn_mm(PlotProcess().apply(hiding, PLAIN))["line"] == 100
    removed = PlotProcess(hidden="remove").apply(hiding, PLAIN)  # type: ignore[arg-type]
    assert drawn_mm(removed)["line"] == pytest.approx(80, abs=0.01)
    assert removed.facts["plot"]["hidden_mm"] == pytest.approx(20, abs=0.01)
    kept = PlotProcess(hidden="remove", margin=1.0).apply(hiding, PLAIN)  # type: ignore[arg-type]
    assert drawn_mm(kept)["line"] == pytest.approx(78, abs=0.001)
    over = page(layer("line", line), layer("area", square(40, 40, 20), overlap=Overlap.OVERLAY))
    assert drawn_mm(PlotProcess(hidden="remove").apply(over, PLAIN))["line"] == 100  # type: ignore[arg-type]
    upside_down = page(layer("area", square(40, 40, 20)), layer("line", line))
    assert drawn_mm(PlotProcess(hidden="remove").apply(upside_down, PLAIN))["line"] == 100  # type: ignore[arg-type]


def test_a_margin_without_what_asks_for_it_is_refused() -> None:
    with pytest.raises(GeometryError, match='margin = 1, expected hidden = "remove" beside it'):
        PlotProcess(margin=1.0)


def test_strokes_that_meet_are_one_unless_told() -> None:
    lines = [shapely.LineString([(10, 10 * k), (10, 10 * k + 10)]) for k in range(1, 6)]
    assert len(PlotProcess().apply(page(layer("a", *lines)), PLAIN).tools[0].strokes) == 1
    assert len(PlotProcess(join=False).apply(page(layer("a", *lines)), PLAIN).tools[0].strokes) == 5


def test_a_bare_page_takes_no_time() -> None:
    for bare in (page(), page(layer("a"))):
        facts = PlotProcess(hidden="remove").apply(bare, PLAIN).facts["plot"]  # type: ignore[arg-type]
        assert (facts["strokes"], facts["seconds"], facts["doubled"]["places"]) == (0, 0.0, [])


def test_outlines_along_the_page_are_drawn_when_asked() -> None:
    cut = page(layer("a", square(0, 40, 20), square(80, 40, 20)))
    assert drawn_mm(PlotProcess().apply(cut, PLAIN)) == {"a": 120.0}
    assert drawn_mm(PlotProcess(edges=True).apply(cut, PLAIN)) == {"a": 160.0}


def test_way_and_time_are_told_for_each_pen_and_together() -> None:
    motion = Motion(draw_speed=10, travel_speed=100, acceleration=1e6, lift=0.5, tool_change=30)
    facts: Mapping[str, Any] = PlotProcess().apply(TWO, Machine(motion=motion)).facts["plot"]
    wax, blue = facts["pens"]
    assert (wax["pen"], wax["ink"], wax["strokes"], wax["drawn_mm"]) == (1, "wax", 2, 160.0)
    assert wax["travel_mm"] == 10.0
    assert wax["seconds"] == pytest.approx(16 + 0.1 + 2 * 0.5, abs=0.06)
    assert facts["seconds"] == pytest.approx(wax["seconds"] + blue["seconds"] + 30, abs=0.11)
    assert (facts["strokes"], facts["drawn_mm"], facts["pen_changes"]) == (3, 200.0, 1)


def test_lines_are_as_broad_as_the_pen() -> None:
    fine = Machine(tool=Held(width=0.4))
    assert PlotProcess().apply(TWO, PLAIN).tools[0].ink.width == 1.5
    assert PlotProcess().apply(TWO, fine).tools[0].ink.width == 0.4
    assert PlotProcess(width=0.7).apply(TWO, fine).tools[0].ink.width == 0.7


def test_what_was_plotted_once_is_plotted_again_as_it_is() -> None:
    first = PlotProcess(pens={"blue": 1, "wax": 5}).apply(TWO, PLAIN)
    again = PlotProcess().apply(first, PLAIN)
    assert [tool.pen for tool in again.tools] == [1, 5]
    assert drawn_mm(again) == drawn_mm(first)
    assert again.provenance.processes == ("plot pens={blue=1,wax=5}", "plot")


@pytest.mark.parametrize(
    ("sample", "spec"),
    [
        ("kawung", PlotProcess(once="all", hidden="remove")),  # type: ignore[arg-type]
        ("chrysanthemum-line", PlotProcess()),
        # Holes of it ran out into needles whose tips lay on the seam.
        pytest.param("five-circle", PlotProcess(), marks=slow),
    ],
)
def test_a_plotted_tile_keeps_its_certificate(sample: str, spec: PlotProcess, tmp_path: Path) -> None:
    prepared = spec.apply(compile_recipe(load_recipe(SAMPLES / f"{sample}.toml")), PLAIN)
    path = tmp_path / "plotted.svg"
    path.write_bytes(render(prepared))
    certificate = certify(read_svg(str(path), "grid").artwork)
    assert certificate.passed, certificate.faults
