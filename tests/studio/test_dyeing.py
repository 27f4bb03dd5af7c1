"""Colours of a palette: shown as they look, and the recipe's own once one of them is set by hand."""

from __future__ import annotations

from batik_vector.studio.changes import set_by_hand, worn
from batik_vector.studio.drafts import Draft
from batik_vector.studio.parameters import controls
from tests.studio.test_changes import SAMPLES

OWN = Draft.read(SAMPLES / "kawung.toml")
DYED = OWN.with_value("palette", "cirebon")
SOGA = "ink.soga.colour"


def test_what_a_palette_gives_is_what_fields_say() -> None:
    assert not worn(OWN)
    given = worn(DYED)
    found = controls(DYED)
    assert {found[".".join(map(str, path))].value for path in given} == {*given.values()}
    assert found[SOGA].value == DYED.recipe.ink["soga"].colour != OWN.recipe.ink["soga"].colour


def test_a_colour_set_by_hand_takes_the_others_along() -> None:
    mine = set_by_hand(DYED, SOGA, "#123456")
    assert "palette" not in mine.tables
    assert mine.recipe.ink["soga"].colour == "#123456"
    assert mine.recipe.ink["cotton"].colour == DYED.recipe.ink["cotton"].colour
    assert mine.recipe.cloth.colour == DYED.recipe.cloth.colour
    # What is no colour of the palette leaves it, and so does a reset.
    assert set_by_hand(DYED, "title", "Mine").tables["palette"] == "cirebon"
    assert set_by_hand(DYED, SOGA, None).tables["palette"] == "cirebon"
    assert set_by_hand(OWN, SOGA, "#123456") == OWN.with_value(SOGA, "#123456")
