"""Words of G-code: what is put into them, and which are refused."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.errors import BatikError, GeometryError
from batik_vector.machines import MACHINES
from batik_vector.machines.gcode import NAMES, Gcode, codes, number, plain
from batik_vector.recipe.reading.machines import read_machine

BAD: list[tuple[dict[str, Any], str]] = [
    ({"tool_down": "G1 Z{deth}"}, 'tool_down = "G1 Z{deth}", unknown name "deth": did you mean "depth"?'),
    ({"tool_down": "G1 Z{depth:>9}"}, "unknown name"),
    ({"tool_down": "G1 Z{depth.real}"}, "unknown name"),
    ({"tool_down": "G1 Z{0}"}, "unknown name"),
    ({"tool_down": "G1 Z{{depth}}"}, "expected braces in pairs"),
    ({"tool_down": "G1 Z{depth"}, "expected braces in pairs"),
    ({"tool_down": "M3 S{s_down}"}, "expected a value for s_down: set s_down as well"),
    ({"rapid": "G0 F{travel_feed}"}, "expected a value for travel_feed"),
    ({"start": "M109 S{temperature}"}, "expected a value for temperature"),
    ({"start": "M0 ({ink})"}, "expected no {ink}: no tool is in hand there"),
    ({"start": "g20"}, "expected no G20"),
    ({"start": "G20.0"}, "expected no G20"),
    ({"start": "G020"}, "expected no G20"),
    ({"tool_up": "G91\nG0 Z5"}, "expected G90 after G91"),
    ({"end": "G0 X0 Y0\nM30"}, 'stop = "M30"'),
    ({"tool_change": "m02"}, 'stop = "M2"'),
    ({"tool_down": "G1 Z0 Y5 F300"}, "expected no Y"),
    ({"tool_change": "M0 (a (b))"}, "none inside"),
    ({"tool_change": "M0 (a"}, "none inside"),
    ({"start": "M0 ü"}, "expected printable ASCII"),
    ({"start": "M0 \x1b"}, "expected printable ASCII"),
    ({"rapid": ""}, "expected words on one line"),
    ({"rapid": "G0\nG1"}, "expected words on one line"),
    ({"rapid": "G0 ; fast"}, "expected no comment"),
    ({"safe_height": -1}, "expected more than the depth of 0 mm"),
    ({"feed": 0}, "expected 1 to 100000"),
    ({"dwell_down": -1}, "expected 0 to 600"),
    ({"stop": "M99"}, 'unknown stop "M99"'),
]


@pytest.mark.parametrize(("words", "told"), BAD, ids=range(len(BAD)))
def test_bad_words_are_told(words: dict[str, Any], told: str) -> None:
    with pytest.raises(GeometryError) as caught:
        Gcode(**words)
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "words",
    [
        {"tool_up": "G91\nG0 Z5\nG90"},
        {"start": "G201 (a) ; b {feed}"},
        {"start": "(G20 is no word here)"},
        {"tool_down": "M3 S{s_down}", "s_down": 0, "safe_height": -5},
        {"start": "  \n\n G64  \n"},
    ],
)
def test_good_words_are_taken(words: dict[str, Any]) -> None:
    assert Gcode(**words)


def test_lines_are_trimmed() -> None:
    assert Gcode(start="\n  G64 P0.1  \n\n M5\n").start == "G64 P0.1\nM5"


def test_names_are_filled() -> None:
    gcode = Gcode(s_down=90, s_up=0.5, travel_feed=3000, temperature=80, dwell_up=0.125, dwell_down=1 / 3)
    told: dict[str, float | str] = {"feed": 1200.0, "tool": 2, "ink": "indigo (2); M2", "width": 0.4}
    words = " ".join(f"{name}={{{name}}}" for name in NAMES)
    assert gcode.filled(words, told).split(" ", 8)[0] == "feed=1200"
    assert gcode.filled(words, told) == (
        "feed=1200 travel_feed=3000 plunge_feed=300 safe_height=5 depth=0 s_down=90 s_up=0.5 "
        "dwell_down=0.3333 dwell_up=0.125 temperature=80 dwell_down_ms=333 dwell_up_ms=125 "
        "tool=2 ink=indigo 2 M2 width=0.4"
    )


@given(st.text(max_size=200))
def test_a_name_means_nothing_whatever_it_is(name: str) -> None:
    bare = plain(name)
    assert bare.isascii()
    assert 0 < len(bare) <= 40
    assert not set(bare) & set("()[]{}<>;%#\n\r\"'=*")


@given(st.floats(-1e6, 1e6))
def test_numbers_have_no_exponent(value: float) -> None:
    assert abs(float(number(value)) - value) <= 0.00005001
    assert not {"e", "n", "i"} & set(number(value))
    assert number(value) != "-0"


def test_codes_are_read_as_interpreters_do() -> None:
    assert codes("g01 X 5 (M30) M05 ; M2") == ["G1", "X5", "M5"]


@given(st.text(alphabet="GM0123{}()fed ;.\n", max_size=40))
def test_any_words_are_taken_or_told(text: str) -> None:
    try:
        Gcode(tool_change=text)
    except BatikError as error:
        assert "tool_change" in str(error)  # noqa: PT017


@pytest.mark.parametrize("name", MACHINES)
def test_what_comes_along_says_its_sources(name: str) -> None:
    machine = read_machine(name)
    if machine.gcode != Gcode():
        assert any(key.startswith("gcode.") for key in machine.sources)
