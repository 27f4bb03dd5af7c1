"""Values set from outside: keys cut short, keys of every member of a list, and the text that is kept."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import RecipeError
from batik_vector.recipe.reading import overrides
from batik_vector.recipe.reading.lines import value_spans
from batik_vector.recipe.reading.overrides import Override, overridden, parse_override
from batik_vector.recipe.references import dotted

SAMPLES = sorted((Path(__file__).parents[3] / "samples").glob("*.toml"))
TEXT = """
title = "Two flowers"  # a title
[motif.big]
kind = "flower"
petal = { count = 8, length = 1.0 }
[motif.small]
kind = "flower"
[[place]]
motif = "big"
layout = { kind = "julian", dist = 4 }
[[place]]
motif = "small"
layout = { kind = "julian", dist = 4 }
[[place]]
motif = "small"
layout = { kind = "single" }
"""


def changed(*texts: str) -> dict[str, Any]:
    text, tables, _ = overridden(TEXT, tomllib.loads(TEXT), [parse_override(each) for each in texts])
    assert tomllib.loads(text) == tables
    return tables


def test_a_key_may_be_cut_short_where_one_place_can_be_meant() -> None:
    assert changed("petal.count=12")["motif"]["big"]["petal"]["count"] == 12
    assert changed("petal.turn=3")["motif"]["big"]["petal"]["turn"] == 3
    assert changed("small.pistil=1")["motif"]["small"]["pistil"] == 1


def test_what_begins_at_the_root_is_never_looked_for_elsewhere() -> None:
    assert changed("seed=3")["seed"] == 3
    assert changed("tile.size=3")["tile"] == {"size": 3}


def test_the_index_of_a_lone_member_may_be_left_out() -> None:
    text = TEXT.partition('[[place]]\nmotif = "small"')[0]
    _, tables, _ = overridden(text, tomllib.loads(text), [parse_override("place.width=3")])
    assert tables["place"] == [{"motif": "big", "layout": {"kind": "julian", "dist": 4}, "width": 3}]
    with pytest.raises(
        RecipeError, match=r"may be any of place\[0\]\.width.*all of them as place\[\*\]\.width"
    ):
        changed("place.width=3")


def test_where_several_can_be_meant_all_are_named() -> None:
    with pytest.raises(
        RecipeError,
        match=r"layout\.dist: may be any of place\[0\]\.layout\.dist, place\[1\].*"
        r"in full, or all of them as place\[\*\]\.layout\.dist",
    ):
        changed("layout.dist=3")


def test_every_member_that_has_the_key_is_set() -> None:
    assert [each["layout"].get("dist") for each in changed("place[*].layout.dist=3")["place"]] == [3, 3, None]
    assert [each["at"] for each in changed("place[*].at=[1, 2]")["place"]] == [[1, 2]] * 3
    with pytest.raises(RecipeError, match=r"expected lists where it has \[\*\]"):
        changed("motif[*].kind=3")


def values(tables: Any, at: tuple[str | int, ...] = ()) -> list[tuple[tuple[str | int, ...], Any]]:
    members = (
        tables.items() if isinstance(tables, dict) else enumerate(tables) if isinstance(tables, list) else ()
    )
    return [(at, tables)] * bool(at) + [
        each for name, inner in members for each in values(inner, (*at, name))
    ]


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_a_text_changed_in_place_is_the_text_that_its_document_would_be(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(SAMPLES)).read_text(encoding="utf-8")
    known = value_spans(text)
    paths = [path for path, _ in values(tomllib.loads(text)) if path in known]
    value = st.one_of(st.integers(-99, 10**6), st.floats(-1e6, 1e6), st.text(max_size=9), st.booleans())
    path, new, newer = data.draw(st.sampled_from(paths)), data.draw(value), data.draw(value)
    change = [Override(path, new, f"{dotted(path)}={new}")]
    written = overrides._in_place(text, change)
    assert written is not None
    asked, tables, _ = overridden(text, tomllib.loads(text), change)
    assert tomllib.loads(written) == tables
    assert asked == written
    # All but the value is as it was.
    start, end = known[path]
    assert written.startswith(text[:start])
    assert written.endswith(text[end:])
    # Once a place has been read back, its next value is read back alone.
    asked, tables, _ = overridden(text, tomllib.loads(text), [Override(path, newer, "")])
    assert tomllib.loads(asked) == tables


@pytest.mark.parametrize(
    "key", ["place[1].layout.dist", "place.1.layout.dist", "petal.count", "seed", "tile.size"]
)
def test_the_tables_that_are_given_stay_as_they_are(key: str) -> None:
    tables = tomllib.loads(TEXT)
    _, other, _ = overridden(TEXT, tables, [parse_override(f"{key}=7")])
    assert tables == tomllib.loads(TEXT) != other
    # What is not changed is not copied either.
    assert other["motif"]["small"] is tables["motif"]["small"]
