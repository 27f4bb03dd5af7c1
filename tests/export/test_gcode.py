"""G-code makes a tool do what the artwork says, and says nothing twice."""

from __future__ import annotations

import itertools
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Cell, Ink, Layer, Margins, Provenance
from batik_vector.errors import ExportError, UnsupportedByFormatError
from batik_vector.export import GcodeOptions, gcode
from batik_vector.export.provenance import read_provenance
from batik_vector.export.walk import Order, RecordingSurface, walk
from batik_vector.geometry.outlines import MM, of_polylines
from batik_vector.machines import Machine, Motion
from batik_vector.machines.gcode import Gcode
from tests.export import gcode_reader
from tests.export.gcode_reader import Program, along

from .drawings import InPieces, disc, empty, geometries, line, sample

SERVO = {
    "tool_down": "M3 S{s_down}\nG4 P{dwell_down}",
    "tool_up": "M5\nG4 P0.2",
    "s_down": 90,
    "dwell_down": 0.3,
}


def written(page: Any, words: dict[str, Any] | None = None, size: Any = None, **options: Any) -> bytes:
    machine = Machine(says="bench", size=size, gcode=Gcode(**(words or {})))
    return gcode.render(page, GcodeOptions(**options, machine_profile=machine))


def run(page: Any, words: dict[str, Any] | None = None, **options: Any) -> Program:
    program = gcode_reader.read(written(page, words, **options))
    assert program.ended
    return program


def wanted(page: Any, order: Order = Order.CONTOURS) -> list[list[list[float]]]:
    """The strokes of each ink in turn as the walk hands them over, in mm, closed ones to their ends."""
    surface = RecordingSurface()
    walk(page, surface, order)
    out = list[list[list[float]]]()
    for name, arguments in surface.calls:
        if name in ("areas", "lines"):
            points, rings = arguments[0].repeating()  # type: ignore[attr-defined]
            out += [(points[a:b] / 1000).tolist() for a, b in itertools.pairwise(rings)]
    return out


@pytest.mark.parametrize("words", [{}, SERVO, {"rapid": "G0 F{travel_feed}", "travel_feed": 3000}])
@pytest.mark.parametrize("bleed", [0.0, 3.0])
def test_strokes_are_the_artworks_to_the_last_digit(words: dict[str, Any], bleed: float) -> None:
    program = run(sample(bleed), words)
    assert [stroke.points.tolist() for stroke in program.strokes] == wanted(sample(bleed))
    assert program.pauses == 2


def test_areas_and_lines_come_as_given_when_they_are_not_to_be_ordered() -> None:
    program = run(sample(), order=False)
    assert [stroke.points.tolist() for stroke in program.strokes] == wanted(sample(), Order.GIVEN)


@pytest.mark.parametrize(
    ("origin", "offset", "moved"),
    [("corner", (0, 0), (0, 0)), ("corner", ("1 cm", -2.5), (10, -2.5)), ("centre", (0, 1), (-20, -14))],
)
def test_the_origin_is_where_it_is_told(origin: str, offset: Any, moved: tuple[float, float]) -> None:
    plain, other = run(sample()), run(sample(), origin=origin, offset=offset)
    for one, two in zip(plain.strokes, other.strokes, strict=True):
        assert np.allclose(two.points, one.points + moved, rtol=0, atol=1e-9)


def test_a_feed_is_said_with_the_first_cut_and_not_again() -> None:
    program = run(sample(), SERVO, feed=1234)
    assert {cut.feed for stroke in program.strokes for cut in stroke.cuts} == {1234}
    # Once for each tool, and no motion that goes on.
    assert program.count("F1234") == 3
    assert program.count("G1") == program.count("G0") == len(program.strokes)


def test_where_other_words_say_a_feed_it_is_said_again() -> None:
    program = run(sample(), feed=1234)
    assert {cut.feed for stroke in program.strokes for cut in stroke.cuts} == {1234}
    assert program.count("F1234") == len(program.strokes)


def test_the_feed_is_the_options_the_machines_or_its_motions() -> None:
    def feed(**words: Any) -> set[float]:
        return {cut.feed for stroke in run(sample(), words).strokes for cut in stroke.cuts}

    slow = Machine(motion=Motion(draw_speed=12.5))
    data = gcode.render(sample(), GcodeOptions(machine_profile=slow))
    assert {cut.feed for stroke in gcode_reader.read(data).strokes for cut in stroke.cuts} == {750}
    assert feed(feed=777) == {777}


def test_a_stroke_that_begins_where_one_ended_goes_on() -> None:
    lines = geometries(line((1, 1), (2, 1)), line((2, 1), (2, 2)), line((3, 3), (4, 3)))
    artwork = Artwork("", Cell(10_000, 10_000), (Layer(Ink("w", "#000000"), lines=lines),))
    program = run(artwork, order=False)
    assert [len(stroke.cuts) for stroke in program.strokes] == [2, 1]
    assert program.count("G1") == 4


@pytest.mark.parametrize("arcs", [False, True])
def test_pieces_make_the_same_program(arcs: bool) -> None:
    whole = written(sample(), SERVO, arcs=arcs, order=False)
    assert written(InPieces(sample(), 1), SERVO, arcs=arcs, order=False) == whole


def test_guides_are_left_out() -> None:
    guides = of_polylines(geometries(line((-5, -5), (-5, 35))), MM)
    page = InPieces(sample(), guides=guides, own_margins=Margins(10_000, 10_000, 10_000, 10_000))
    assert [plate.guide for plate in page.plates].count(True) == 1
    assert written(page, size=(40, 30)) == written(sample(), size=(40, 30))


def test_an_empty_page_is_a_program_that_ends() -> None:
    program = run(empty())
    assert not program.strokes
    assert not program.pauses


@pytest.mark.parametrize(("stop", "last"), [("M2", "M2"), ("M30", "M30"), ("%", "%")])
def test_a_program_ends_as_interpreters_want(stop: str, last: str) -> None:
    text = written(sample(), {"stop": stop, "end": "G0 X0 Y0"}).decode()
    assert text.endswith(f"\nG0 X0 Y0\n{last}\n")
    assert text.startswith("%\n") == (stop == "%")


def test_words_are_the_machines() -> None:
    words = SERVO | {
        "start": "M104 S{temperature}\nM109 S{temperature}",
        "temperature": 80,
        "tool_change": "M0 (fit {ink} {width} mm)\nT{tool} M6",
        "first_tool": True,
        "tool_up": "M5\nG4 P{dwell_up_ms}",
        "dwell_up": 0.25,
    }
    text = written(sample(), words).decode()
    assert "\nG21 G90 G17\nM104 S80\nM109 S80\nM5\nG4 P250\n" in text
    assert "\nM0 (fit wax 1 mm)\nT1 M6\n" in text
    assert "\nM0 (fit Indigo 2 1.25 mm)\nT3 M6\nG0 X" in text
    assert re.search(r"\nG0 X[\d.]+ Y[\d.]+\nM3 S90\nG4 P0.3\nG1 F3000 X", text)


def test_first_of_all_the_tool_is_lifted() -> None:
    text = written(sample()).decode()
    assert text.index("\nG0 Z5\n") < text.index("\nG0 X")


NASTY = "a (b) ; M2 % {feed}\nG0 Z-50 (c"


@pytest.mark.parametrize("comment", [";", "()", "none"])
def test_names_do_nothing(comment: str) -> None:
    artwork = sample(title=NASTY)
    inks = [replace(layer.ink, name=NASTY + str(k)) for k, layer in enumerate(artwork.layers)]
    layers = tuple(replace(layer, ink=ink) for layer, ink in zip(artwork.layers, inks, strict=True))
    artwork = replace(artwork, layers=layers)
    words = {"comment": comment, "tool_change": "M0 (fit {ink})"}
    program = run(artwork, words)
    assert [stroke.points.tolist() for stroke in program.strokes] == wanted(artwork)
    assert program.comments.count("fit a b M2 feed G0 Z-50 c1") == 1


@pytest.mark.parametrize("comment", [";", "()"])
@pytest.mark.parametrize("recipe", ["", "a = 1\n", "# ünïcode ) ( ; %\n" * 400])
def test_the_recipe_comes_back(tmp_path: Path, comment: str, recipe: str) -> None:
    told = Provenance(recipe, 7, "0.1.0")
    path = tmp_path / "a.gcode"
    path.write_bytes(written(sample(provenance=told), {"comment": comment}))
    assert read_provenance(path) == told
    gcode_reader.read(path.read_bytes())


def test_without_comments_it_does_not() -> None:
    assert b"BATIK" not in written(sample(), {"comment": "none"})
    assert b";" not in written(sample(), {"comment": "none"})


def test_what_reaches_beyond_the_machine_is_refused_with_numbers() -> None:
    bench = r'the machine \("bench"\) reaches'
    words = rf"x runs from 1 to 39 mm, and {bench} from 0 to 30 mm: it is 38 mm long, expected 30 mm at most"
    with pytest.raises(UnsupportedByFormatError, match=words):
        written(sample(), size=(30, 40))
    with pytest.raises(ExportError, match=rf"y runs from -9 to .* mm, and {bench} from 0 to 40 mm: "
                       r"expected an offset 9 mm larger in y"):  # fmt: skip
        written(sample(), size=(40, 40), offset=(0, -10))
    with pytest.raises(ExportError, match=rf"x runs from -19 to 19 mm, and {bench} from -16 to 16 mm"):
        written(sample(), size=(32, 40), origin="centre")
    assert written(sample(), size=(39, 40))
    assert written(sample(), size=(40, 30), origin="centre")


def test_arcs_are_counted_in_what_is_reached() -> None:
    # Without a vertex at its rightmost place.
    areas = geometries(shapely.affinity.rotate(disc(20, 20, 10).buffer(0), 2.8125, origin=(20, 20)))
    artwork = Artwork("", Cell(40_000, 40_000), (Layer(Ink("w", "#000000"), areas=areas),), tolerance=0.05)
    assert written(artwork, size=(29.99, 40))
    with pytest.raises(ExportError, match=r"x runs from 10(\.00\d)? to (30|29\.99\d) mm"):
        written(artwork, size=(29.99, 40), arcs=True)


def test_arcs_asked_of_a_machine_that_takes_none() -> None:
    words = r'arcs = true: the machine \("bench"\) takes none, expected arcs = false'
    with pytest.raises(UnsupportedByFormatError, match=words):
        written(sample(), {"arcs": False}, arcs=True)


def test_arcs_stand_for_many_moves() -> None:
    straight, curved = run(sample()), run(sample(), arcs=True)
    assert "G91.1" in " ".join(a + b for words in curved.words for a, b in words)
    assert sum(len(stroke.cuts) for stroke in curved.strokes) * 8 < sum(
        len(stroke.cuts) for stroke in straight.strokes
    )
    for one, two in zip(straight.strokes, curved.strokes, strict=True):
        there = shapely.LineString(np.concatenate(list(along(two))))
        assert shapely.hausdorff_distance(shapely.LineString(one.points), there, densify=0.02) < 0.041
        assert two.points[[0, -1]].tolist() == one.points[[0, -1]].tolist()


spots = st.tuples(st.integers(-3_000_000, 30_000_000), st.integers(-3_000_000, 30_000_000))


@given(st.lists(st.lists(spots, min_size=2, max_size=6, unique=True), min_size=1, max_size=6))
def test_every_number_comes_back(lines: list[list[tuple[int, int]]]) -> None:
    shapes = geometries(*(line(*((x / 1000, y / 1000) for x, y in each)) for each in lines))
    artwork = Artwork("", Cell(10_000, 10_000), (Layer(Ink("w", "#000000"), lines=shapes),))
    found = [stroke.points for stroke in run(artwork, order=False).strokes]
    told = [point for stroke in found for point in stroke.tolist()]
    given_points = [[x / 1000, y / 1000] for each in lines for x, y in each]
    # Where one begins at the end of the one before, that place is said once.
    kept = [p for k, p in enumerate(given_points) if k == 0 or p != given_points[k - 1]]
    assert told == kept
