from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.export import strokes, svg
from batik_vector.export.options import Curves, Profile, SvgOptions
from batik_vector.geometry.outlines import MM, Outlines, of_polylines

from .drawings import InPieces, area_of, disc, empty, geometries, length_of, line, sample, stacked
from .readers import SVG, svg_layers, svg_path, svg_rings

PROFILES = list(Profile)


def written(artwork: Artwork, **options: object) -> bytes:
    return svg.render(artwork, SvgOptions(**options))  # type: ignore[arg-type]


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("bleed", [0.0, 3.0])
def test_areas_and_lengths_are_the_artworks(profile: Profile, bleed: float) -> None:
    artwork = sample(bleed)
    layers = svg_layers(written(artwork, profile=profile))
    for i, label in enumerate(("1 wax", "2 soga brown", "3 Indigo/2")):
        filled, drawn = (svg_rings(layers[label], f) for f in (True, False))
        # The page is turned over, so outer rings run the other way; holes still count against them.
        assert -sum(r.area for r in filled) == pytest.approx(area_of(artwork, i), abs=1e-9)
        assert sum(r.length for r in drawn) == pytest.approx(length_of(artwork, i), abs=1e-9)
        assert all(r.closed for r in filled)


def test_closed_lines_are_closed_and_no_first_point_is_repeated() -> None:
    layers = svg_layers(written(sample()))
    drawn = svg_rings(layers["2 soga brown"], filled=False)
    assert sorted(r.closed for r in drawn) == [False, False, True]
    for ring in drawn + svg_rings(layers["1 wax"], filled=True):
        assert ring.points[0] != ring.points[-1]


def test_page_is_in_mm_and_y_runs_down() -> None:
    root = ET.fromstring(written(sample()))
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("40mm", "30mm", "0 0 40 30")
    given = svg_rings(svg_layers(written(sample(), order=False))["2 soga brown"], filled=False)
    assert given[0].points == [(1, 29), (39, 29), (39, 26.5)]


def test_bleed_grows_the_page_and_moves_the_drawing() -> None:
    root = ET.fromstring(written(sample(2.5)))
    assert (root.get("width"), root.get("viewBox")) == ("45mm", "0 0 45 35")
    stem = svg_rings(svg_layers(written(sample(2.5), order=False))["2 soga brown"], filled=False)[0]
    assert stem.points[0] == (3.5, 31.5)


def test_style_stands_on_groups_and_paths_are_plain() -> None:
    data = written(sample())
    root = ET.fromstring(data)
    assert not re.search(rb"<(use|pattern|clipPath|style|mask|rect)|transform=|class=", data)
    for path in root.iter(f"{SVG}path"):
        assert set(path.keys()) <= {"d", "id"}
    layers = svg_layers(data)
    assert layers["1 wax"].get("fill-rule") == "evenodd"
    assert layers["2 soga brown"].get("stroke-width") == "0.4"
    filled, drawn = layers["3 Indigo/2"].findall(f"{SVG}g")
    assert (filled.get("fill"), drawn.get("fill"), drawn.get("stroke")) == ("#1d2f5f", "none", "#1d2f5f")
    assert layers["3 Indigo/2"].get("fill") is None


def test_ids_are_letters_and_digits_and_unique() -> None:
    artwork = sample()
    clash = tuple(
        Layer(Ink(name, "#000000"), areas=geometries(disc(5, 5, 1)), area_names=(mark,))
        for name, mark in (
            ("petal1", "petal"),
            ("Pétal 1", "petal1"),
            ("九", ""),
            ("", "1"),
            ("cloth", "wax"),
        )
    )
    data = written(replace(artwork, layers=artwork.layers + clash))
    ids = [e.get("id", "") for e in ET.fromstring(data).iter() if e.get("id")]
    assert len(ids) == len(set(ids)) > 12
    assert all(re.fullmatch("[A-Za-z][A-Za-z0-9]*", i) for i in ids)
    assert {"wax", "flowerPetal1", "stem1", "stem2", "bar1", "bar2"} <= set(ids)


def test_compact_has_one_path_per_kind_of_mark() -> None:
    layers = svg_layers(written(sample(), profile=Profile.COMPACT))
    counts = {label: len(list(g.iter(f"{SVG}path"))) for label, g in layers.items()}
    assert counts == {"%99 cloth": 0, "1 wax": 1, "2 soga brown": 1, "3 Indigo/2": 2}


def test_compact_breaks_paths_that_readers_refuse(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(strokes, "PATH_POINTS", 50)
    artwork = sample()
    layers = svg_layers(written(artwork, profile=Profile.COMPACT))
    assert len(list(layers["1 wax"].iter(f"{SVG}path"))) == 2
    rings = svg_rings(layers["1 wax"], filled=True)
    assert -sum(r.area for r in rings) == pytest.approx(area_of(artwork, 0), abs=1e-9)


def test_marks_laid_over_one_another_do_not_cut_each_other_out() -> None:
    assert svg_layers(written(stacked(), profile=Profile.COMPACT))["1 w"].get("fill-rule") == "nonzero"
    assert svg_layers(written(stacked()))["1 w"].get("fill-rule") == "evenodd"


def test_cloth_is_a_layer_that_plotters_skip_and_may_be_left_out() -> None:
    cloth = svg_layers(written(sample()))["%99 cloth"]
    assert cloth.get("fill") == "#123456"
    assert abs(svg_rings(cloth, filled=True)[0].area) == 40 * 30
    assert "%99 cloth" not in svg_layers(written(sample(), cloth=False))


def line_across() -> Outlines:
    return of_polylines(geometries(line((0, 0), (1, 1))), MM)


def test_numbers_of_layers_are_apart_however_many_there_are() -> None:
    def labels(inks: int) -> list[str]:
        layers = tuple(Layer(Ink(f"ink{i}", "#000000")) for i in range(inks))
        page = InPieces(replace(empty(), layers=layers), guides=line_across())
        cloth, others = svg.layer_labels(page)
        return [cloth, *others]

    assert labels(2) == ["%99 cloth", "1 ink0", "2 ink1", "%98 marks"]
    for inks in (97, 98, 99, 100, 1200):
        numbers = [re.search(r"\d+", label) for label in labels(inks)]
        assert len({found.group() for found in numbers if found}) == inks + 2


def test_rulers_show_mm() -> None:
    assert b'inkscape:document-units="mm"' in written(sample())


@pytest.mark.parametrize("profile", PROFILES)
def test_an_empty_artwork_is_a_page(profile: Profile) -> None:
    assert list(svg_layers(written(empty(), profile=profile))) == ["%99 cloth"]
    bare = replace(empty(), layers=(Layer(Ink("w", "#000000")),))
    assert list(svg_layers(written(bare, profile=profile))) == ["%99 cloth", "1 w"]


def test_titles_and_names_are_escaped() -> None:
    artwork = replace(sample(title='<&"\x00\x1b\ud800]]>'), layers=(Layer(Ink('<"&\x01\n', "#000000")),))
    data = written(artwork)
    root = ET.fromstring(data)
    assert root.findtext(f"{SVG}title") == '<&"\ufffd\ufffd\ufffd]]>'
    assert '1 <"&\ufffd ' in svg_layers(data)


@pytest.mark.parametrize("profile", PROFILES)
def test_curves_keep_the_shape_with_fewer_nodes(profile: Profile) -> None:
    marks = geometries(shapely.Point(20, 15).buffer(10, quad_segs=64), shapely.box(1, 1, 4, 3))
    artwork = Artwork("c", Cell(40_000, 30_000), (Layer(Ink("w", "#000000"), areas=marks),))
    data = written(artwork, profile=profile, curves=Curves.BEZIER, curve_tolerance=0.01)
    round_, square = svg_rings(svg_layers(data)["1 w"], filled=True)
    assert 3 <= round_.curves <= 24
    assert -round_.area == pytest.approx(np.pi * 100, rel=2e-3)
    assert round_.closed
    assert (square.curves, len(square.points), -square.area) == (0, 4, 6)
    assert square.closed


def test_lines_and_curves_in_one_ring() -> None:
    half = shapely.Point(20, 15).buffer(10, quad_segs=64).intersection(shapely.box(20, 0, 40, 30))
    stem = shapely.union_all([half, shapely.box(12, 14, 20, 16)])
    artwork = Artwork("c", Cell(40_000, 30_000), (Layer(Ink("w", "#000000"), areas=geometries(stem)),))
    (ring,) = svg_rings(svg_layers(written(artwork, curves=Curves.BEZIER))["1 w"], filled=True)
    straight = len(ring.points) - 1 - 20 * ring.curves
    assert 2 <= ring.curves <= 12
    # Five edges, of which closing may draw one.
    assert 4 <= straight <= 5
    assert -ring.area == pytest.approx(stem.area, rel=2e-3)


def test_a_curve_ends_where_it_begins() -> None:
    marks = geometries(shapely.Point(20, 15).buffer(10, quad_segs=64))
    artwork = Artwork("c", Cell(40_000, 30_000), (Layer(Ink("w", "#000000"), areas=marks),))
    (ring,) = svg_rings(svg_layers(written(artwork, curves=Curves.BEZIER))["1 w"], filled=True)
    assert ring.points[0] == pytest.approx(ring.points[-1], abs=1e-9)


def test_text_and_bytes_are_the_same() -> None:
    assert svg.svg_text(sample()).encode() == svg.render(sample())
    assert sample()._repr_svg_() == svg.svg_text(sample())


def test_the_reader_of_these_tests_can_fail() -> None:
    with pytest.raises(AssertionError):
        svg_path("M0 0l1 1")
