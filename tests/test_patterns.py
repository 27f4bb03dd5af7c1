"""Text from strangers is read alike on every Python, and in a time that grows with its length."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.importing.page import parse_px
from batik_vector.importing.transforms import parse_transform
from batik_vector.patterns import NUMBER, numbers_in
from batik_vector.recipe.reading.lines import Lines
from tools.house import PACKAGE, modules

LATER = re.compile(r"(?<!\\)\)(?:[*+?]|\{[\d,]*\})\+|\(\?>")
"""A group that gives nothing back, which Python before 3.11.5 reads wrongly."""


@pytest.mark.parametrize("path", modules(), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_no_pattern_leans_on_what_the_first_pythons_do_wrong(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    if path.name == "patterns.py":
        text = text.rpartition('"""\n\nfrom __future__')[2]
    found = LATER.search(text)
    assert not found, f"line {text.count(chr(10), 0, found.start()) + 1}: see batik_vector/patterns.py"


@pytest.mark.parametrize("wrong", [r"(?:[eE]\d++)?+", r"(a|b)*+", r"(?:ab){2,3}+", r"(?>ab)"])
def test_a_group_that_gives_nothing_back_is_told(wrong: str) -> None:
    assert LATER.search(wrong)
    assert not LATER.search(r"\(([^()]*+)\)\s*+(?:ab)?\)*+")


@pytest.mark.parametrize(
    ("text", "number"),
    [("3em", "3"), ("3e5m", "3e5"), ("3e+", "3"), ("-.5.5", "-.5"), ("1.e-2x", "1.e-2"), ("+7..", "+7.")],
)
def test_a_number_ends_where_it_ends(text: str, number: str) -> None:
    found = re.match(NUMBER, text)
    assert found
    assert found[0] == number
    assert re.match(f"({NUMBER})(.*)", text).groups() == (number, text[len(number) :])  # type: ignore[union-attr]


def test_units_that_begin_like_an_exponent_are_units() -> None:
    assert parse_px("3em") is None
    assert parse_px("3e1px") == 30
    with pytest.raises(ValueError, match="cannot be read"):
        parse_transform("translate(3em)")


numbers = st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(st.tuples(numbers, st.sampled_from([" ", ",", " , ", "\n", "\t,"]))))
def test_numbers_are_read_as_they_were_written(written: list[tuple[float, str]]) -> None:
    text = "".join(f"{number!r}{between}" for number, between in written)
    assert numbers_in(text) == [number for number, _ in written]


@settings(max_examples=300)
@given(st.text("0123456789.eE+-, x", max_size=12))
def test_what_is_no_list_of_numbers_is_not_read(text: str) -> None:
    one = re.compile(r"[\s,]*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)")
    at, read = 0, []
    while found := one.match(text, at):
        at = found.end()
        read.append(float(found[1]))
    assert numbers_in(text) == (None if text[at:].strip(" ,") else read)


def test_lists_without_commas_are_read() -> None:
    assert numbers_in("1-2.5.5, 3") == [1, -2.5, 0.5, 3]
    assert numbers_in(" ") == []


LONG = 40_000
HOSTILE = [
    "1" * LONG, "1" * LONG + "e", "1" * LONG + "!", "." * LONG, "1." * LONG, ".1" * LONG + "!", "1e" * LONG,
    " " * LONG + "!", "1" + " " * LONG + "!", "-" * LONG, "," * LONG + "x", '"' * LONG, "'" * LONG,
    '"' + "\\" * LONG, '"""' + '" ' * LONG, "a" * LONG, "a." * LONG, "a. " * LONG, "a" + " ." * LONG,
    "#\n" * LONG, "[" * LONG, "(" * LONG, "url(" + " " * LONG, "1 " * LONG, "/" * LONG,
]  # fmt: skip
READERS = """
import contextlib
from batik_vector.fields import parse_colour
from batik_vector.importing.colours import colour_of
from batik_vector.importing.transforms import parse_transform
from batik_vector.geometry.paths.data import parse_path
from batik_vector.importing.page import parse_px
from batik_vector.importing.paint import url_of
from batik_vector.recipe.reading.limits import deep_key
from batik_vector.recipe.reading.lines import Lines
from batik_vector.recipe.reading.lines import parse_path as parse_key
from batik_vector.tiling.symmetry.repeats import parse_repeat
from batik_vector.tiling.layouts.copies import parse_rosette
from batik_vector.units import parse_length
from tests.test_patterns import HOSTILE

begun = {
    parse_colour: "#", colour_of: "rgb(", parse_transform: "translate(", parse_path: "M0 0L", parse_px: "1",
    url_of: "url(", deep_key: "a.", Lines: "a = ", parse_key: "a.", parse_repeat: "drop ", parse_rosette: "D",
    parse_length: "1",
}
for reader, beginning in begun.items():
    for text in HOSTILE:
        for whole in (text, beginning + text):
            print(reader.__module__, reader.__name__, ascii(whole[:40]), len(whole), flush=True)
            with contextlib.suppress(ValueError):
                reader(whole)
"""


def test_no_text_is_read_for_ever() -> None:
    """In a process of its own, since a regular expression that goes astray cannot be interrupted.

    All of them take some seconds; what takes the square of its length takes longer alone.
    """
    command = [sys.executable, "-c", READERS]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, cwd=PACKAGE.parent)
    assert done.returncode == 0, done.stdout[-300:] + done.stderr[-2000:]


@pytest.mark.parametrize(
    ("value", "lines"),
    [
        ('"""\nan "inner" quote\n\\"""\n""""', 4),
        ("'''\n'a' ''b''\n''''", 3),
        ('"\\\\ \\" #"', 1),
        ("'\\'", 1),
        ('""', 1),
        ("[1, # one\n  2, #two\n\n # three\n]", 5),
    ],
)
def test_keys_behind_any_text_have_their_lines(value: str, lines: int) -> None:
    assert Lines(f"a = {value}\nb = 1\n").line(("b",)) == lines + 1
