"""Machine fit: whole repeats, the least stretch, and advice on whole pixels."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Cell
from batik_vector.errors import RecipeError
from batik_vector.tiling.symmetry.machine_fit import Fit, pixel_advice, repeats_to_fill
from batik_vector.tiling.symmetry.repeats import TileSpec

ROTARY = 641.35
"""25.25 in, the commonest rotary repeat."""


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.floats(20, 2000), st.floats(1, 2500))
def test_a_whole_number_of_repeats_fills_the_machine_or_none_would(machine: float, repeat: float) -> None:
    off = {n: abs(machine / (n * repeat) - 1) for n in range(1, int(machine / repeat) + 3)}
    if min(off.values()) > 0.01:
        with pytest.raises(RecipeError) as told:
            repeats_to_fill(machine, repeat, 1, 1.0, "width")
        assert told.value.faults[0].key == "fit.width"
        return
    count = repeats_to_fill(machine, repeat, 1, 1.0, "width")
    assert off[count] <= 0.01
    # The least stretch by its ratio, which is the least difference but for a hair.
    assert off[count] <= min(off.values()) * 1.02


def test_the_words_name_the_stretch_the_limit_and_the_sizes_that_fit() -> None:
    with pytest.raises(RecipeError) as told:
        TileSpec(size=(95.0, 90.0), fit=Fit(width=640.0))
    assert str(told.value) == (
        "fit.width: 7 repeats of 95 mm fill 640 mm when stretched by -3.76 %, past the limit of 1 %: "
        "expected a tile of width 91.429 mm or 106.667 mm, or a higher limit"
    )
    with pytest.raises(RecipeError, match=r"fit\.height: the repeat's height of 700 mm does not fit into"):
        TileSpec(size=(100.0, 350.0), repeat="brick", fit=Fit(height=640.0))


def test_a_size_that_fits_is_not_stretched() -> None:
    spec = TileSpec(size=(80.0, 60.0), fit=Fit(width=640.0, height=600.0))
    assert spec.stretch == (1.0, 1.0)
    assert spec.cell() == Cell(80_000, 60_000)


def test_each_axis_is_stretched_by_itself_and_one_left_out_stays() -> None:
    both = TileSpec(size=(79.6, 60.2), fit=Fit(width=640.0, height=600.0))
    assert both.cell() == Cell(80_000, 60_000)
    assert both.stretch == pytest.approx((80 / 79.6, 60 / 60.2))
    one = TileSpec(size=(79.6, 60.2), fit=Fit(width=640.0))
    assert one.cell() == Cell(80_000, 60_200)
    assert one.stretch[0] == pytest.approx(80 / 79.6)
    assert one.stretch[1] == 1.0


@pytest.mark.parametrize(
    ("repeat", "size", "fit", "cell"),
    [
        ("half-drop", (63.8, 60.0), Fit(width=640.0), (128.0, 60.0)),
        ("drop 1/3", (71.0, 60.0), Fit(width=640.0), (640 / 3, 60.0)),
        ("brick", (63.8, 60.0), Fit(height=ROTARY, limit=8.0), (63.8, ROTARY / 5)),
        ("mirror", (40.0, 50.0), Fit(width=640.0, height=600.0), (80.0, 100.0)),
        ("mirror-x", (39.9, 50.0), Fit(width=640.0), (80.0, 50.0)),
        # The sides of a square, and of a hexagonal cell, go together.
        ("p4m", (79.8, 79.8), Fit(width=640.0), (80.0, 80.0)),
        ("p6", (79.8, 138.2), Fit(height=ROTARY, limit=8.0), (ROTARY / 5 / 3**0.5, ROTARY / 5)),
        ("p3", (79.8, 138.2), Fit(width=640.0, height=ROTARY, limit=8.0), (80.0, ROTARY / 5)),
    ],
)
def test_the_finished_rectangle_divides_the_machine(
    repeat: str, size: tuple[float, float], fit: Fit, cell: tuple[float, float]
) -> None:
    spec = TileSpec(size=size, repeat=repeat, fit=fit)
    whole = spec.cell()
    assert (whole.width, whole.height) == pytest.approx(cell, abs=0.003)
    for machine, side in ((fit.width, whole.width), (fit.height, whole.height)):
        if machine:
            assert machine / side == pytest.approx(round(machine / side), rel=1e-4)
    across, up = spec.stretch
    asked = size[0] * whole.columns / spec.unit().columns
    assert across == pytest.approx(whole.width / asked, rel=1e-4)
    if spec.repeat in ("p4m", "p6"):
        assert up == pytest.approx(across, rel=1e-4)


def test_a_limit_of_nought_takes_what_fits_exactly() -> None:
    assert TileSpec(size=(80.0, 60.0), fit=Fit(width=640.0, limit=0.0)).stretch == (1.0, 1.0)
    with pytest.raises(RecipeError, match="past the limit of 0 %"):
        TileSpec(size=(80.1, 60.0), fit=Fit(width=640.0, limit=0.0))


@pytest.mark.parametrize(
    ("cell", "dpi", "words"),
    [
        (Cell(640_000, 25_400), 254, None),
        (Cell(641_350, 641_350), 300, None),
        (
            Cell(640_000, 25_400),
            150,
            "the width of 640 mm is 3,779.53 pixels at 150 dpi: whole at 127 or 254 dpi, "
            "or with a width of 640.08 mm (3,780 pixels)",
        ),
        (
            Cell(641_350, 641_350),
            150,
            "the width of 641.35 mm is 3,787.50 pixels and the height of 641.35 mm is 3,787.50 pixels at 150 "
            "dpi: whole at 148 or 152 dpi, or with a width of 641.096 mm (3,786 pixels) and a height of "
            "641.096 mm (3,786 pixels)",
        ),
    ],
)
def test_broken_pixels_are_told_with_the_nearest_whole_ones(
    cell: Cell, dpi: float, words: str | None
) -> None:
    assert pixel_advice(cell, dpi) == words


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.integers(1, 900_000), st.integers(1, 900_000), st.sampled_from([72, 96, 150, 300, 118.11, 254]))
def test_advice_on_pixels_comes_for_every_cell(columns: int, rows: int, dpi: float) -> None:
    words = pixel_advice(Cell(columns, rows), dpi)
    assert words is None or (f"{dpi:g} dpi" in words and "pixels)" in words)
