"""Border tables: what contradicts itself is refused in words."""

from __future__ import annotations

import pytest

from batik_vector.borderspec import RailSpec
from batik_vector.errors import GeometryError, RecipeError
from tests.frames import border, plain


@pytest.mark.parametrize(
    ("words", "fields"),
    [
        ('unknown corner "miter": did you mean "mitre"', {"corner": "miter"}),
        ('unknown frieze "p3m1"', {"frieze": "p3m1"}),
        ("sides is empty", {"sides": ()}),
        ('unknown side "botom": did you mean "bottom"', {"sides": ("botom",)}),
        ("the border is empty", {"place": ()}),
        ("a rail of 4 mm at 1 mm reaches beyond .* from 2 to 34 mm", {"rails": (RailSpec(at=1, width=4),)}),
        ('radius is given with corner = "mitre"', {"radius": 10}),
        ('corner_place is given with corner = "bend"', {"corner": "bend", "corner_place": (plain(),)}),
        ('symmetry = "p4m": a border repeats by its frieze', {"place": (plain(symmetry="p4m"),)}),
        ("phase and region belong to a tile", {"place": (plain(phase=(1, 0)),)}),
        ("limit = 60", {"limit": 60}),
    ],
)
def test_a_wrong_border_says_what_was_expected(words: str, fields: dict[str, object]) -> None:
    with pytest.raises((GeometryError, RecipeError), match=words):
        border(**fields)


def test_a_frieze_goes_by_all_its_names() -> None:
    assert border(frieze="spinning jump").frieze == "p2mm"
