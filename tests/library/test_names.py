"""Names of patterns are names of files on every system."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector import LibraryError
from batik_vector.library.names import checked_name, checked_tags, folded, name_from, parsed
from tests.thorough import examples


@pytest.mark.parametrize(
    "name", ["kawung", "Kawung picis (2)", "a.b", "Semèn Råma", "藍染", "1", "x" * 80, " a "]
)
def test_good_names(name: str) -> None:
    assert checked_name(name) == name.strip()


@pytest.mark.parametrize(
    "name",
    [
        "",
        " ",
        ".",
        "..",
        ".a",
        "a/b",
        "a\\b",
        "../a",
        "a:b",
        "a@1",
        "a.",
        "a\n",
        "a\0b",
        "-a",
        "x" * 81,
        "CON",
        "nul.x",
    ],
)
def test_bad_names(name: str) -> None:
    if name == "a\n":
        assert checked_name(name) == "a"
        return
    with pytest.raises(LibraryError, match="is no name of a pattern"):
        checked_name(name)


@settings(max_examples=examples(100, 3000))
@given(st.text(max_size=100))
def test_a_name_is_made_of_any_text(text: str) -> None:
    name = name_from(text)
    assert checked_name(name) == name
    assert parsed(name) == (name, None)


def test_tags_are_lower_case_and_each_once() -> None:
    assert checked_tags(["New  Year", "new year", "Ärzte"]) == ("new year", "ärzte")
    for tag in ("", " ", "a,b", "x" * 41, "a\nb"):
        with pytest.raises(LibraryError, match="is no tag"):
            checked_tags([tag])


@settings(max_examples=examples(100, 3000))
@given(st.text(max_size=20))
def test_folding_twice_is_folding_once(text: str) -> None:
    assert folded(folded(text)) == folded(text)
