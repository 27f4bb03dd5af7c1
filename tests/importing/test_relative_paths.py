"""Paths in relative steps, as svgo and Illustrator write them, come back to their start all but a bit."""

from __future__ import annotations

import contextlib

import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from batik_vector.certificate import certify
from batik_vector.certificate.drawing import drawing
from batik_vector.importing.svg import DrawingError, read_svg, read_tile
from tests.importing.drawings import svg
from tests.thorough import examples, long

TRIANGLE = "M17.5 37.8l2.6-9.6h-5.2l2.6 9.6z"


@st.composite
def relative_paths(draw: st.DrawFn) -> tuple[str, float]:
    """Path data in relative steps that mostly come back to their start, and about how far they reach."""
    size = draw(st.sampled_from([0.5, 3.0, 20.0, 60.0, 500.0, 2000.0]))
    decimals = draw(st.integers(0, 4))
    number = st.floats(-0.4, 0.4).map(lambda share: round(share * size, decimals))
    words = [f"M{size / 2} {size / 2}"]
    for _ in range(draw(st.integers(1, 2))):
        x = y = 0.0
        for letter in draw(st.lists(st.sampled_from("lllhvcsqt"), min_size=1, max_size=7)):
            steps = [draw(number) for _ in range({"h": 1, "v": 1, "c": 6, "s": 4, "q": 4}.get(letter, 2))]
            words.append(letter + " ".join(map(str, steps)))
            x += 0 if letter == "v" else steps[-1 if letter == "h" else -2]
            y += 0 if letter == "h" else steps[-1]
        if draw(st.booleans()):
            words.append(f"l{round(-x, decimals)} {round(-y, decimals)}")
        words.append(draw(st.sampled_from(["z", "z", ""])))
        words.append(f"m{draw(number)} {draw(number)}")
    return "".join(words), size


@long
@settings(max_examples=examples(60, 4000), derandomize=True, deadline=None)
@given(
    relative_paths(),
    st.sampled_from(["", "px", "mm", "in", "pt"]),
    st.sampled_from(["nonzero", "evenodd"]),
    st.sampled_from(["", ' stroke="red"']),
)
@example((TRIANGLE, 60.0), "px", "nonzero", "")
@example((TRIANGLE, 60.0), "mm", "evenodd", "")
def test_relative_paths_are_read_and_measured(
    path: tuple[str, float], unit: str, rule: str, stroke: str
) -> None:
    d, size = path
    head = f'width="{size}{unit}" height="{size}{unit}" viewBox="0 0 {size} {size}"'
    with contextlib.suppress(DrawingError):
        drawing(read_tile(svg(f'<path d="{d}" fill-rule="{rule}"{stroke}/>', head)))


@pytest.mark.parametrize("unit", ["px", "mm", "in"])
def test_a_triangle_in_relative_steps_is_one_triangle_and_passes(unit: str) -> None:
    reading = read_svg(
        svg(f'<path d="{TRIANGLE}"/>', f'width="60{unit}" height="60{unit}" viewBox="0 0 60 60"')
    )
    (layer,) = reading.artwork.layers
    assert [len(area.exterior.coords) for area in layer.areas] == [4]
    assert certify(reading.artwork).passed


def test_a_stroke_that_all_but_comes_back_is_closed() -> None:
    (layer,) = read_tile(svg(f'<path d="{TRIANGLE[:-1]}" fill="none" stroke="red"/>')).layers
    assert shapely.is_closed(layer.lines).all()
    assert shapely.get_num_coordinates(layer.lines).tolist() == [4]


def test_a_sliver_that_rounding_left_is_no_mark() -> None:
    (layer,) = read_tile(svg('<path d="M10 10h20v10h-20z"/><path d="M10 40h20v1e-8h-20z"/>')).layers
    assert len(layer.areas) == 1
