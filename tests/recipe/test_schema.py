"""The schema of recipes: read here by the few rules that it uses."""

from __future__ import annotations

import itertools
import re
import tomllib
from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest

from batik_vector.command.starters import STARTERS
from batik_vector.geometry.curves import CURVES
from batik_vector.geometry.maps import VARIATIONS
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.motif import MOTIFS
from batik_vector.recipe.outputs import OUTPUTS
from batik_vector.recipe.reading.field_types import members
from batik_vector.recipe.schema import schema
from batik_vector.tiling.layouts import LAYOUTS
from tests.recipe.test_bad_input import CASES, recipe

SCHEMA = schema()
KINDS: dict[str, tuple[type, ...]] = {
    "object": (dict,),
    "array": (list,),
    "string": (str,),
    "boolean": (bool,),
    "integer": (int,),
    "number": (int, float),
}


def accepts(rules: dict[str, Any], value: Any) -> bool:
    if "$ref" in rules:
        return accepts(SCHEMA["$defs"][rules["$ref"].removeprefix("#/$defs/")], value)
    kind = rules.get("type")
    if kind and (not isinstance(value, KINDS[kind]) or (isinstance(value, bool) and kind != "boolean")):
        return False
    tests = [
        "const" not in rules or value == rules["const"],
        "enum" not in rules or value in rules["enum"],
        "minimum" not in rules or rules["minimum"] <= value <= rules["maximum"],
        "pattern" not in rules or re.search(rules["pattern"], value) is not None,
        "minItems" not in rules or rules["minItems"] <= len(value) <= rules["maxItems"],
        "oneOf" not in rules or sum(accepts(each, value) for each in rules["oneOf"]) == 1,
        "anyOf" not in rules or any(accepts(each, value) for each in rules["anyOf"]),
    ]
    return all(tests) and _accepts_inside(rules, value)


def _accepts_inside(rules: dict[str, Any], value: Any) -> bool:
    if isinstance(value, list):
        pairs = zip(value, rules.get("prefixItems", itertools.repeat(rules.get("items", {}))), strict=False)
        return all(accepts(rule, each) for each, rule in pairs)
    if not isinstance(value, dict):
        return True
    known, more = rules.get("properties", {}), rules.get("additionalProperties", {})
    return all(name in value for name in rules.get("required", ())) and all(
        accepts(known[key], each) if key in known else more is not False and accepts(more, each)
        for key, each in value.items()
    )


@pytest.mark.parametrize("path", sorted(STARTERS.glob("*.toml")), ids=lambda path: path.stem)
def test_the_schema_accepts_what_compiles(path: Path) -> None:
    assert accepts(SCHEMA, tomllib.loads(path.read_text("utf-8")))


BEYOND = {
    *(
        "an ink in parts of one",
        "several spouts of a canting that is not there",
        "spouts closer than one is broad",
        "a colourway of an ink that is not",
        "isen too bold for the marks it may choose",
        "an unknown palette",
        "a colourway of an unknown palette",
        "a colourway of nothing",
        "a colourway called all",
        "a colourway that no file can be called after",
        "a colourway beside a colour in print",
        "a palette beside a colour in print",
        "a plate of an ink that is not",
        "a plate of too many pixels",
        "inks further out of register than the tile",
        "a crackle finer than any wax",
        "cracks whose oldest is narrower than the youngest",
        "cracks broader than what lies between them",
        "cracks along no direction",
        "a hand that draws after the knife",
        "a press of which there is no profile",
        "a press outside of the folder",
        "a day for no press",
        "pages of a size and no pages",
        "an alternate of no separation",
        "fill that touches itself",
        "fill of an unknown ink",
        "fill in the ink of what it fills",
        "fill that has no room",
        "fill far too dense",
        "border radius without bend",
        "border placement with region",
        "border placement with counterchange",
        "several motifs",
        "a place for a pack",
        "a ground without a fill",
        "a ground with a width",
        "a ground of rows with a symmetry",
        "a ground with an axis",
        "a counterchange with nothing",
        "a counterchange with a gap",
        "unknown motif of a toss",
        "sizes the wrong way round",
        "more marks than fit",
        "farther than the repeat",
        "a mark larger than the repeat",
        "marks without number",
        "weights for other motifs",
        "a place for a toss",
        "a turn of stripes",
        "a line over itself",
        "lines flipped in turn",
        "a winding and an angle",
        "a flower for a band",
        "a row of what there is not",
        "a band of nothing",
        "a grid of odd steps",
    ),
    *(
        "a point",
        "a segment",
        "m = 3",
        "P1 = 0",
        "a row too many",
        "past the limit",
        "no such machine",
        "a margin about nothing",
        "a pen of no breadth",
        "a kerf broader than a gap",
        "a blade that trails by more than a contour",
        "bridges of no breadth",
        "bridges broader than an island",
        "a stencil after a cut",
        "a trap of no breadth",
        "a trap after a cut",
        "islands of no size",
        "necks of no breadth",
        "tabs of no breadth",
        "tabs longer than a contour",
        "weed lines on one another",
        "marks of no size",
        "a sheet of no height",
        "a sheet smaller than a piece",
        "a sheet that does not hold all",
        "a number of a sheet without one",
        "drop 1/0",
        "path in a name",
    ),
    *(
        "unknown motif",
        "unknown ink",
        "unknown ink of an element",
        "width and scale",
        "neither",
        "several inks",
    ),
    *("huge tile", "open table", "broken table", "key twice", "ink twice"),
    *(
        "a group that the repeat does not admit",
        "a group that the cell does not fit",
        "an impossible stretch",
        "a tile larger than the machine",
        "a fit to an absurd size",
        "half a mirror repeat",
        "a phase beyond all bounds",
    ),
    *("path data that break off", "a path of one point", "a path that is open", "a path out of this world"),
    *("one point", "a corner beyond the points"),
    *(
        "a bath twice",
        "a bath without a name",
        "an ink in no bath",
        "an ink in no bath nor colour",
        "an unknown bath",
        "a bath twice of an ink",
        "baths of a recipe without",
        "a bath that dyes nothing",
        "a colour that baths contradict",
        "an undyed colour that contradicts",
        "colours of the same baths",
        "too many baths",
        "wax without baths",
        "no such plate",
        "no such plate at all",
        "wax that would have to come off",
        "colours on either side",
    ),
}
"""What no schema can say: how values hang together; and what is no TOML."""


@pytest.mark.parametrize(
    "case", [case for case in CASES["recipe"] if case["name"] not in BEYOND], ids=lambda case: case["name"]
)
def test_the_schema_refuses_what_is_refused(case: dict[str, Any]) -> None:
    text = recipe({int(number): line for number, line in case["lines"].items()})
    assert not accepts(SCHEMA, tomllib.loads(text))
    assert accepts(SCHEMA, tomllib.loads(recipe()))


def test_every_kind_and_every_bound_is_in_the_schema() -> None:
    for what, catalogue in (
        ("motif", MOTIFS),
        ("layout", LAYOUTS),
        ("curve", CURVES),
        ("variation", VARIATIONS),
        ("output", OUTPUTS),
    ):
        for name, cls in catalogue.items():
            table = SCHEMA["$defs"][f"{what}.{name}"]
            assert table["properties"]["format" if what == "output" else "kind"] == {"const": name}
            assert set(members(cls)) < set(table["properties"])
            assert table["description"]
    count = SCHEMA["$defs"]["Leaf"]["properties"]["count"]
    assert (count["type"], count["minimum"], count["maximum"], count["default"]) == ("integer", 0, 360, 8)
    assert "source" not in SCHEMA["properties"]


def test_every_key_of_a_recipe_has_help() -> None:
    for table in (SCHEMA, *SCHEMA["$defs"].values()):
        for name, rules in table["properties"].items():
            assert "const" in rules or rules.get("description"), name


def test_every_field_of_a_recipe_is_read_or_hidden() -> None:
    assert set(members(Recipe)) == {field.name for field in fields(Recipe)} - {"source", "plugins"}
