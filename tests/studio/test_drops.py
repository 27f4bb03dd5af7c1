from __future__ import annotations

import pytest

from batik_vector.errors import RecipeError
from batik_vector.studio.asking import View
from batik_vector.studio.drafts import Draft
from batik_vector.studio.drops import MOTIF_NOW, taken_in
from batik_vector.studio.views import Looker
from tests.studio.test_drafts import FLOWER

BIRD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 40">
<path fill="{body}" d="M4 20C8 4 30 4 36 20C30 36 8 36 4 20Z"/>
<circle fill="{eye}" cx="14" cy="18" r="4"/></svg>"""


def dropped(body: str, eye: str) -> Draft:
    draft, words = taken_in(Draft(FLOWER), "My bird.svg", BIRD.format(body=body, eye=eye).encode())
    assert words == f"My bird.svg {MOTIF_NOW}"
    assert draft.faults == ()
    return draft


def test_a_drawing_of_several_colours_keeps_them_as_inks() -> None:
    draft = dropped("#cc3333", Draft(FLOWER).recipe.ink["wax"].colour)
    # The wax of the recipe has the colour of the eye; the body's is added, and may be changed.
    assert draft.tables["ink"] == {"wax": {}, "red": {"colour": "#cc3333", "drawn": "#cc3333"}}
    blue = draft.with_value("ink.red.colour", "#2b4a8b")
    for each, colour in ((draft, "#cc3333"), (blue, "#2b4a8b")):
        layers = Looker().look(each, View()).facts["layers"]
        assert [(layer["ink"], layer["colour"]) for layer in layers][1:] == [("red", colour)]


def test_a_drawing_of_one_colour_takes_the_ink_of_its_placement() -> None:
    draft = dropped("#cc3333", "#cc3333")
    assert draft.tables["motif"]["my-bird"] == {"kind": "svg", "file": "my-bird.svg"}
    assert list(draft.tables["ink"]) == ["wax"]


def test_a_drawing_that_cannot_be_read_is_told_in_its_own_words() -> None:
    with pytest.raises(RecipeError, match=r"^broken.svg:1: is no well-formed XML"):
        taken_in(Draft(FLOWER), "broken.svg", b'<svg><path d="M0 0')
