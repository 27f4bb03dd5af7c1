from __future__ import annotations

import copy
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.recipe.references import Path as Way
from batik_vector.studio.text import rewriting
from batik_vector.studio.text.rewriting import (
    CannotRewriteError,
    inserted,
    member_text,
    moved,
    with_value,
    without,
)
from batik_vector.studio.text.spelling import spelled
from tests.thorough import examples, long

ROOT = Path(__file__).parents[3]
TEXTS = {
    path.stem: path.read_text(encoding="utf-8")
    for folder in ("samples", "batik_vector/starters")
    for path in sorted((ROOT / folder).glob("*.toml"))
}
_TOKEN = re.compile(r"'''.*?'''|\"\"\".*?\"\"\"|\"(?:\\.|[^\"\\\n])*\"|'[^'\n]*'|(#[^\n]*)", re.DOTALL)

SMALL = """# what it is
title = "A"  # a title
seed  = 0x10

[ink.wax]   # the first
colour = '#ffffff'

# above the second
[ink.indigo]
colour = "#112233"
width  = 1.50

[motif.a]
kind = "rosette"
elements = [
  # the first
  { curve = { kind = "circle" }, count = 3 },  # round
  { curve = { kind = "circle" } },
]

[[place]]
motif = "a"
width = "10 mm"

# the second place
[[place]]
motif = "a"
width = "20 mm"
[place.layout]
kind = "ring"
"""


def comments(text: str) -> list[str]:
    return sorted(found[1] for found in _TOKEN.finditer(text) if found[1])


def scalars(node: Any, at: Way = ()) -> list[Way]:
    if not isinstance(node, dict | list):
        return [at]
    members = node.items() if isinstance(node, dict) else enumerate(node)
    return [path for key, each in members for path in scalars(each, (*at, key))]


def lists(node: Any, at: Way = ()) -> list[Way]:
    """Return the paths of members that can be moved: of lists of tables, and motifs and inks."""
    found: list[Way] = []
    members = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, each in members:
        if isinstance(each, list) and each and all(isinstance(one, dict) for one in each):
            found += [(*at, key, number) for number in range(len(each))]
        found += lists(each, (*at, key))
    return found if at else [*found, *(("motif", name) for name in node.get("motif", {}))]


def test_the_comments_of_a_text_are_found() -> None:
    assert comments(SMALL) == sorted(
        ["# what it is", "# a title", "# the first", "# above the second", "# the first", "# round"]
        + ["# the second place"]
    )


@long
@settings(max_examples=examples(20, 60), deadline=None, derandomize=True)
@given(st.sampled_from(sorted(TEXTS)), st.data())
def test_a_value_is_set_and_all_else_stays_as_it_was_written(name: str, data: st.DataObject) -> None:
    text = TEXTS[name]
    tables = tomllib.loads(text)
    path = data.draw(st.sampled_from(scalars(tables)))
    value = data.draw(st.one_of(st.integers(-9, 999), st.floats(-5, 5), st.text(max_size=5), st.booleans()))
    written = with_value(text, path, value)
    node: Any = tables
    for part in path[:-1]:
        node = node[part]
    node[path[-1]] = value
    assert tomllib.loads(written) == tables
    assert comments(written) == comments(text)
    assert len(set(written.splitlines()) - set(text.splitlines())) <= 1


@long
@settings(max_examples=examples(20, 60), deadline=None, derandomize=True)
@given(st.sampled_from(sorted(TEXTS)), st.data())
def test_a_key_that_is_put_in_can_be_taken_out_again(name: str, data: st.DataObject) -> None:
    text = TEXTS[name]
    tables = tomllib.loads(text)
    around = data.draw(st.sampled_from([path[:-1] for path in scalars(tables)]))
    while not isinstance(at(tables, around), dict):
        around = around[:-1]
    path = (*around, data.draw(st.sampled_from(["fresh", "new key"])))
    value: Any = data.draw(st.sampled_from([3, [1, 2], {"a": 1}]))
    if isinstance(value, dict) and not around:
        value = 3
    written = with_value(text, path, value)
    assert at(tomllib.loads(written), path) == value
    assert comments(written) == comments(text)
    assert tomllib.loads(without(written, path)) == tables
    assert comments(without(written, path)) == comments(text)


def at(node: Any, path: Way) -> Any:
    for part in path:
        node = node[part]
    return node


@long
@settings(max_examples=examples(20, 60), deadline=None, derandomize=True)
@given(st.sampled_from(sorted(TEXTS)), st.data())
def test_members_are_moved_there_and_back(name: str, data: st.DataObject) -> None:
    text = TEXTS[name]
    tables = tomllib.loads(text)
    path = data.draw(st.sampled_from(lists(tables)))
    around = at(tables, path[:-1])
    to = data.draw(st.integers(0, len(around) - 1))
    written = moved(text, path, to)
    keys = list(around) if isinstance(around, dict) else list(range(len(around)))
    order = [key for key in keys if key != path[-1]]
    order.insert(to, path[-1])
    after = at(tomllib.loads(written), path[:-1])
    if isinstance(around, dict):
        assert list(after) == order
        assert after == around
        back = moved(written, path, keys.index(path[-1]))
    else:
        assert after == [around[key] for key in order]
        back = moved(written, (*path[:-1], to), int(path[-1]))
    assert tomllib.loads(back) == tables
    assert comments(written) == comments(text) == comments(back)


@long
@settings(max_examples=examples(20, 60), deadline=None, derandomize=True)
@given(st.sampled_from(sorted(TEXTS)), st.data())
def test_a_member_taken_out_is_put_in_again_as_it_was_written(name: str, data: st.DataObject) -> None:
    text = TEXTS[name]
    tables = tomllib.loads(text)
    path = data.draw(st.sampled_from([each for each in lists(tables) if isinstance(each[-1], int)]))
    value, written = at(tables, path), member_text(text, path)
    less = without(text, path)
    rest = copy.deepcopy(tables)
    del at(rest, path[:-1])[path[-1]]
    if not at(rest, path[:-1]):
        return
    assert tomllib.loads(less) == rest
    again = inserted(less, path[:-1], value, int(path[-1]), written)
    assert tomllib.loads(again) == tables
    assert member_text(again, path) == written
    # A comment beside the member goes with it; those of all else stay.
    gone = set(comments(text)) - set(comments(again))
    assert len(gone) <= 1


def test_a_comment_above_a_block_moves_with_it_and_goes_with_it() -> None:
    assert moved(SMALL, ("ink", "indigo"), 0).index("# above the second") < SMALL.index("[ink.wax]") + 5
    assert "# the second place" not in without(SMALL, ("place", 1))
    assert "# above the second" in without(SMALL, ("ink", "wax"))
    first = moved(SMALL, ("place", 1), 0)
    assert first.index("# the second place") < first.index("10 mm")
    assert tomllib.loads(first)["place"][0]["layout"] == {"kind": "ring"}


def test_what_is_put_in_looks_like_what_stands_around_it() -> None:
    assert "seed  = 0x10\ntitled = 1\n" in with_value(SMALL, ("titled",), 1)
    assert "width  = 1.50\nwide   = 2\n" in with_value(SMALL, ("ink", "indigo", "wide"), 2)
    assert '{ curve = { kind = "circle", radius = 0.5 } },' in with_value(
        SMALL, ("motif", "a", "elements", 1, "curve", "radius"), 0.5
    )
    more = inserted(SMALL, ("motif", "a", "elements"), {"count": 2}, 1)
    assert "},  # round\n  { count = 2 },\n  { curve" in more
    assert inserted(SMALL, ("motif", "a", "elements"), {"count": 2}).count("\n") == SMALL.count("\n") + 1


def test_a_table_that_is_missing_is_made() -> None:
    written = with_value(SMALL, ("place", 0, "layout", "count"), 5)
    assert "layout = { count = 5 }\n" in written
    written = with_value(SMALL, ("yardage", "width"), "1 m")
    assert written.endswith('\n\n[yardage]\nwidth = "1 m"\n')
    written = with_value(SMALL, ("ink", "a new one"), {"width": 2})
    assert '[ink."a new one"]\nwidth = 2\n\n[motif.a]' in written
    assert '[[output]]\nformat = "svg"\n' in inserted(SMALL, ("output",), {"format": "svg"})


@pytest.mark.parametrize(
    "text",
    [
        "a.b = 1\na.c = 2\n",
        "[x]\ny.z = 1\n",
        "x = { y = 1, z = [ 1, 2, ] }\n",
        "[[a]]\n[[a.b]]\n[[a.b]]\nc = 1\n",
    ],
)
def test_however_tables_are_written_what_is_meant_is_said(text: str) -> None:
    tables = tomllib.loads(text)
    for path in scalars(tables):
        assert at(tomllib.loads(with_value(text, path, 7)), path) == 7
        rest = copy.deepcopy(tables)
        del at(rest, path[:-1])[path[-1]]
        found = tomllib.loads(without(text, path))
        assert found == rest
    fresh = with_value(text, ("new", "table", "deep"), [True, {"x": 1.5}])
    assert tomllib.loads(fresh) == tables | {"new": {"table": {"deep": [True, {"x": 1.5}]}}}


def test_where_nothing_can_be_meant_nothing_is_written() -> None:
    calls: list[Callable[[], str]] = [
        lambda: without(SMALL, ("seed", "x")),
        lambda: without(SMALL, ("nothing",)),
        lambda: with_value(SMALL, ("place", 7, "x"), 1),
        lambda: with_value(SMALL, ("title", "x"), 1),
        lambda: moved(SMALL, ("place", 9), 0),
        lambda: inserted(SMALL, ("title",), 1),
    ]
    for call in calls:
        with pytest.raises(CannotRewriteError):
            call()
    for value in (None, float("nan"), object()):
        with pytest.raises(ValueError, match="expected"):
            spelled(value)


def test_the_document_is_never_written_anew_for_what_samples_say(monkeypatch: pytest.MonkeyPatch) -> None:
    """All comments would be lost."""
    import tomlkit

    monkeypatch.setattr(tomlkit, "dumps", lambda tables: pytest.fail("written anew"))
    for text in list(TEXTS.values())[::5]:
        tables = tomllib.loads(text)
        last = len(tables.get("place", ())) - 1
        if last >= 0:
            rewriting.without(text, ("place", last))
            rewriting.with_value(text, ("place", last, "turn"), 3)
            rewriting.moved(text, ("place", last), 0)
        for name in list(tables.get("motif", {}))[:1]:
            rewriting.without(text, ("motif", name))
