"""Search by text: parts of words are found, whatever is typed."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from batik_vector import read_recipe
from batik_vector.library import Library, rows
from batik_vector.library.names import folded
from batik_vector.library.text import terms
from tests.library.test_store import NOTHING, RECIPE
from tests.thorough import examples

NOTES = [
    "Kawung picis, for Ngayogyakarta",
    'Sekawung bang; 100 % cotton, "ka-wung" of \'62',
    "Semèn Ra̋ma đại Ærø straße",
    "NEAR OR AND NOT NEAR(a, b) * ^ : {x} %_",
    "日本の藍 藍染め",
    "a b c",
    "",
]


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Library]:
    with Library(tmp_path_factory.mktemp("library") / "my.library") as opened:
        for number, note in enumerate(NOTES):
            recipe = read_recipe(RECIPE.format(number=number + 1))
            opened.add(f"n{number}", recipe, measured=NOTHING, note=note, tags=["new year"] if number else [])
        yield opened


def found(library: Library, query: str) -> set[str]:
    return {hit.name for hit in library.search(query, own=True)}


@pytest.mark.parametrize(
    ("query", "numbers"),
    [
        ("kawung", "01"),
        ("SEKAW", "1"),
        ("yogya", "0"),
        ("kawung yogya", "0"),
        ("ka", "01"),
        ("%", "13"),
        ("100 %", "1"),
        ("_", "3"),
        ("ka-wung", "1"),
        ('"picis, for"', "0"),
        ('"for picis"', ""),
        ('"picis, for', "0"),
        ("picis for", "0"),
        ("semen rama", "2"),
        ("dai aero strasse", "2"),
        ("NEAR(a,", "3"),
        ("near(a, b)", "3"),
        ("* ^ : {x}", "3"),
        ("藍", "4"),
        ("藍染", "4"),
        ("new year", "123456"),
        ('"new year"', "123456"),
        ("Dots 3", "23"),
        ("n5", "5"),
        ("", "0123456"),
        ('"" "', "0123456"),
        ("\0\n\t", "0123456"),
        ("kawung\0", "01"),
    ],
)
def test_what_is_typed_is_found(library: Library, query: str, numbers: str) -> None:
    assert found(library, query) == {f"n{number}" for number in numbers}


PARTS = st.sampled_from(
    [*"\"*()^:-+%_'\\;,.{}[]\0\n", "AND", "NEAR", "ka", "wung", "ä", "đ", "藍", " ", "x" * 60]
)
QUERIES = st.one_of(st.text(max_size=12), st.lists(PARTS, max_size=8).map("".join))


@settings(max_examples=examples(100, 3000), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(QUERIES)
def test_any_query_finds_what_holds_all_its_terms(library: Library, query: str) -> None:
    connection = library._connection
    held = {
        name: rows.words(connection, rows.pattern(connection, folded(name)))
        for name in (f"n{number}" for number in range(len(NOTES)))
    }
    asked = terms(query)
    assert found(library, query) == {
        name for name, text in held.items() if all(term in text for term in asked)
    }


def test_hits_in_names_come_first(library: Library) -> None:
    names = [hit.name for hit in library.search("ceplok")]
    assert names[:2] == ["sample/ceplok", "starter/ceplok"]
