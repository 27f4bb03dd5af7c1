"""Features are asked for in conditions, and make patterns alike."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector import LibraryError, read_recipe
from batik_vector.library import Library
from batik_vector.library.features import FEATURES, condition
from batik_vector.library.measuring import Measured
from tests.library.test_store import RECIPE
from tests.thorough import examples

PATTERNS: dict[str, dict[str, Any]] = {
    "a": {"width": 100.0, "height": 100.0, "inks": 1, "coverage": 20.0, "repeat": "grid", "vertices": 1000},
    "b": {
        "width": 100.0,
        "height": 50.0,
        "inks": 2,
        "coverage": 30.49,
        "repeat": "half-drop",
        "vertices": 2000,
    },
    "c": {"width": 320.5, "height": 80.0, "inks": 3, "coverage": 40.0, "repeat": "p4m", "vertices": 9000},
    "d": {"width": 10.0, "height": 80.0, "inks": 4},
}


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Library]:
    with Library(tmp_path_factory.mktemp("library") / "my.library") as opened:
        for number, (name, features) in enumerate(PATTERNS.items(), 1):
            opened.add(name, read_recipe(RECIPE.format(number=number)), measured=Measured(features))
        yield opened


def found(library: Library, where: str) -> str:
    return "".join(hit.name for hit in library.search(where=where, own=True))


@pytest.mark.parametrize(
    ("where", "names"),
    [
        ("inks = 2", "b"),
        ("inks == 2", "b"),
        ("inks 2..3", "bc"),
        ("inks = 2..3", "bc"),
        ("inks in 2 .. 3", "bc"),
        ("inks <= 3, coverage 20..40", "abc"),
        ("inks <= 3 and coverage > 20", "bc"),
        ("Inks≥3", "cd"),
        ("inks != 2", "acd"),
        ("coverage = 30", "b"),
        ("coverage = 30.5", "b"),
        ("coverage = 30.50", ""),
        ("coverage != 30", "ac"),
        ("coverage < 1e3", "abc"),
        ("width = 320.5", "c"),
        ("repeat = half-drop", "b"),
        ("repeat = 'P4M'", "c"),
        ('repeat != "grid"', "bc"),
        ("width > .5, height=5e1", "b"),
        ("", "abcd"),
        (" , ", "abcd"),
    ],
)
def test_conditions_are_met(library: Library, where: str, names: str) -> None:
    assert found(library, where) == names


@pytest.mark.parametrize(
    ("where", "words"),
    [
        ("inkz = 2", 'no feature is called "inkz": did you mean "inks"?'),
        ("zzz = 2", "expected one of width, height"),
        ("shape = wawy", 'no shape is called "wawy": did you mean "wavy"?'),
        ("shape = zigzag", "expected one of rhombus, curved, wavy"),
        ("inks = two", 'expected a number, and "two" is none'),
        ("inks = nan", "expected a number"),
        ("inks < 1e999", "expected a number"),
        ("inks 4..2", "the range is empty, expected inks 2..4"),
        ("repeat > grid", "repeat is a word: expected repeat = grid"),
        ("repeat 1..2", "repeat is a word, and has no range"),
        ("inks", 'is no condition, expected such as "'.rstrip('"')),
        ("= 3", "is no condition"),
        ("inks = 2; DROP TABLE patterns", "expected a number"),
        ("inks = 2 OR 1", "expected a number"),
        ("a) OR (1 = 1", "is no condition"),
        (", ".join(["inks = 1"] * 51), "51 conditions, expected at most 50"),
    ],
)
def test_what_is_no_condition_is_told(library: Library, where: str, words: str) -> None:
    with pytest.raises(LibraryError) as told:
        library.search(where=where)
    assert words in str(told.value)


@settings(max_examples=examples(100, 5000))
@given(st.text(alphabet="inks covrage=<>!.,0123456789e-+'\"();%", max_size=30))
def test_anything_else_is_refused_in_words_and_never_reaches_sql(text: str) -> None:
    try:
        sql, values = condition(text)
    except LibraryError:
        return
    assert sql.count("?") == len(values)
    assert not set(sql) & set("'\";()%")


def test_the_nearest_come_first(library: Library) -> None:
    hits = library.search(like="a", own=True)
    assert [hit.name for hit in hits] == ["a", "b", "c", "d"]
    assert hits[0].distance == 0
    # One ink more is 1, half the height 1 / 2, 10.49 per cent are 0.7, another repeat is 1, twice the
    # vertices 1 / 1.5; the width is the same.
    expected = ((1 + 0.5**2 + (10.49 / 15) ** 2 + 1 + (1 / 1.5) ** 2 + 0) / 6) ** 0.5
    assert hits[1].distance == pytest.approx(expected)
    assert hits[0].features["repeat"] == "grid"


def test_likeness_is_the_same_both_ways_where_both_were_measured(library: Library) -> None:
    def apart(one: str, other: str) -> float | None:
        return next(hit.distance for hit in library.search(like=one, own=True) if hit.name == other)

    assert apart("a", "c") == pytest.approx(apart("c", "a"))


def test_what_was_never_measured_is_like_nothing(library: Library) -> None:
    library.add("e", read_recipe(RECIPE.format(number=9)), measured=Measured())
    with pytest.raises(LibraryError, match="nothing of it was measured"):
        library.search(like="e")
    assert "e" in library.unmeasured()
    library.measure("e")
    assert "e" not in library.unmeasured()
    assert library.features("e")["inks"] == 1
    library.remove("e")


def test_a_recipe_that_is_saved_is_found_by_what_it_draws(library: Library) -> None:
    recipe = read_recipe(RECIPE.format(number=10))
    library.add("dot", recipe)
    # A circle 10 mm wide on 40 by 40 mm.
    assert found(library, "coverage = 4.9, width = 40, inks = 1, marks = 1, motifs = 1") == "dot"
    library.remove("dot")


def test_every_feature_says_what_it_is() -> None:
    for name, feature in FEATURES.items():
        assert name.isidentifier()
        assert feature.says
        assert feature.unit >= 0


ROW = "elements = {}, relation = rotation, symmetry = {}, layers {}, shape = {}, petals {}, pistils {}"
TABLE_2 = {
    1: ROW.format(2, 8, "= 1", "curved", "= 8", "= 1"),
    2: ROW.format(3, 8, "= 1", "wavy", "= 8", "= 2"),
    3: ROW.format(2, 8, "= 1", "rhombus", "= 8", "= 2"),
    4: ROW.format(2, 6, "= 2", "curved", "= 6", "= 2"),
    5: ROW.format(2, 8, "= 1", "curved", "= 8", ">= 3"),
    6: ROW.format(2, 1, ">= 3", "curved", ">= 10", "= 0") + ", kind = none",
}
"""The paper's rows as they are asked for: multi is three and more, of petals ten; none has no mirror."""


@pytest.mark.parametrize("number", TABLE_2)
def test_the_papers_six_flowers_are_found_by_their_rows_each_alone(library: Library, number: int) -> None:
    hits = library.search(where=TABLE_2[number])
    assert [hit.name for hit in hits] == [f"sample/figure-15-{number}"]
    assert library.search(where=f'row = "{hits[0].features["row"]}"') == hits


def test_a_pattern_is_known_by_the_flower_that_it_repeats(library: Library) -> None:
    # The whirl in the middle of User B's circle has the row of flower 1; its flowers stand about that.
    row = "multi, rotation, 1/5, double, curved and wavy, 5, none"
    assert "sample/figure-16b" in {hit.name for hit in library.search(where=f'row = "{row}"')}


@pytest.mark.parametrize(
    ("where", "names"),
    [
        ("shape = wavy", "fh"),
        ("shape = curved", "gh"),
        ("shape != curved", "f"),
        ("shape = curved and wavy", "h"),
        ("kind = reflection", "g"),
        ("kind = none", "f"),
        ("petals = 8, shape = wavy, symmetry >= 6", "f"),
    ],
)
def test_a_pattern_may_have_several_words(library: Library, where: str, names: str) -> None:
    several: dict[str, dict[str, Any]] = {
        "f": {"shape": "wavy", "kind": "none", "petals": 8, "symmetry": 6},
        "g": {"shape": "curved", "kind": "rotation and reflection"},
        "h": {"shape": "curved and wavy", "kind": "rotation"},
    }
    with library.together():
        for number, (name, features) in enumerate(several.items(), 11):
            library.add(name, read_recipe(RECIPE.format(number=number)), measured=Measured(features))
        assert found(library, where) == names
        library.remove(*several, for_good=True)


def test_a_flower_is_more_like_a_flower_of_its_kind(library: Library) -> None:
    near = [hit.name for hit in library.search(like="sample/figure-15-1", limit=4)]
    assert near[0] == "sample/figure-15-1"
    assert {"sample/figure-15-2", "sample/figure-15-3", "sample/figure-15-5"} & set(near[1:])
