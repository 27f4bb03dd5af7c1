"""Messages stay short whatever a recipe writes."""

from __future__ import annotations

import pytest

from batik_vector import read_recipe
from batik_vector.errors import RecipeError, shortened, unknown_name
from tests.recipe.test_bad_input import BASE

LONG = "w" * 5000


def test_names_up_to_the_longest_are_told_whole() -> None:
    assert shortened("n" * 80) == "n" * 80
    assert shortened("n" * 81) == "n" * 60 + "…"


@pytest.mark.parametrize("known", [["short"], [LONG], [LONG + "x"]])
def test_an_unknown_name_is_shortened_and_so_are_the_known(known: list[str]) -> None:
    assert len(unknown_name(LONG, known, "ink")) < 300


@pytest.mark.parametrize(
    "more", [f'[ink.{LONG}]\ncolour = "no"', f'[[place]]\nmotif = "m"\nink = "{LONG}"\nscale = "1 mm"']
)
def test_a_recipe_that_names_an_ink_of_5000_letters_is_refused_in_few(more: str) -> None:
    with pytest.raises(RecipeError) as caught:
        read_recipe(f"{BASE}\n{more}\n")
    assert len(str(caught.value)) < 1000
