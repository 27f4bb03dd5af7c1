"""The short way to a recipe: what it accepts, pydantic accepts with the same values."""

from __future__ import annotations

import copy
import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading import builder
from batik_vector.recipe.reading.builder import UnsureError, built
from batik_vector.recipe.reading.validator import validated
from tests.thorough import examples, long, rarely

FOLDER = Path(__file__).resolve().parents[3] / "samples"
SAMPLES = {path.stem: tomllib.loads(path.read_text("utf-8")) for path in sorted(FOLDER.rglob("*.toml"))}


def slots(node: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Every place in a recipe's tables."""
    inner = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [path] * bool(path) + [place for key, each in inner for place in slots(each, (*path, key))]


def changed(table: dict[str, Any], path: tuple[Any, ...], value: Any) -> dict[str, Any]:
    table = copy.deepcopy(table)
    node: Any = table
    for key in path[:-1]:
        node = node[key]
    node[path[-1]] = value
    return table


@pytest.mark.parametrize("name", rarely(list(SAMPLES), 3))
def test_every_sample_is_read_the_short_way_and_as_pydantic_reads_it(name: str) -> None:
    quick = built(Recipe, SAMPLES[name])
    slow, found = validated(SAMPLES[name], Recipe)
    assert not found
    assert quick == slow
    # Equal is not the same: 1 == 1.0 == True.
    assert repr(quick) == repr(slow)


odd_values = st.sampled_from(
    ["", "grid", "12 mm", "1e400 mm", "#fff", "area", "julian", "nan", 0, 1, -1, 3, 10**400, 0.5, 1e308]
    + [True, False, [], [1], [1, 2], [1.0, 2.0, 3.0], ["1 mm", "2 mm"], {}, {"kind": "circle"}, {"count": 2}]
    + [float("nan"), float("inf")]
)


@long
@settings(max_examples=examples(100, 400), deadline=None, derandomize=True)
@given(st.data())
def test_what_it_accepts_after_any_change_pydantic_accepts_alike(data: st.DataObject) -> None:
    table = SAMPLES[data.draw(st.sampled_from(sorted(SAMPLES)))]
    place = data.draw(st.sampled_from(slots(table)))
    table = changed(table, place, data.draw(odd_values))
    try:
        quick = built(Recipe, table)
    except UnsureError:
        return
    slow, found = validated(table, Recipe)
    assert not found
    assert repr(quick) == repr(slow)


def test_an_unknown_key_a_wrong_word_and_a_number_out_of_bounds_are_doubted() -> None:
    good = SAMPLES["four-square"]
    built(Recipe, good)
    for path, value in (
        (("titel",), "x"),
        (("tile", "repeat"), "halfdrop"),
        (("tolerance",), "9 mm"),
        (("ink", "wax", "overlap"), "welt"),
        (("place", 0, "layout", "kind"), "julia"),
        (("place", 0, "motif"), "flowr"),
        (("seed",), 1.0),
    ):
        with pytest.raises(UnsureError):
            built(Recipe, changed(good, path, value))


def test_tables_that_are_read_again_are_told_apart_by_type() -> None:
    def read(length: object) -> Recipe:
        table = copy.deepcopy(SAMPLES["kawung"])
        table["motif"]["again"] = {"kind": "rosette", "elements": [{"curve": {"kind": "circle"}}]}
        table["motif"]["again"]["elements"][0]["count"] = length
        return built(Recipe, table)

    assert read(1) == read(1)
    assert read(1).motif["again"] is read(1).motif["again"]
    for wrong in (True, 1.0, "1", 0):
        for _ in range(2):
            with pytest.raises(UnsureError):
                read(wrong)
    assert len(builder._known) <= builder.KEPT_TABLES
    for count in range(1, builder.KEPT_TABLES + 9):
        assert read(count).motif["again"].parts()[0].count == count
    assert len(builder._known) == builder.KEPT_TABLES
