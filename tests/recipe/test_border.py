"""Border tables: what contradicts itself is refused in words."""

from __future__ import annotations

import pytest

from batik_vector.errors import GeometryError, RecipeError
from batik_vector.recipe.border import RailSpec
from tests.frames import border, plain


@pytest.mark.parametrize(
    ("words", "fields"),
    [
        ('unknown corner "miter": did you mean "mitre"', {"corner": "miter"}),
        ('unknown frieze "p3m1"', {"frieze": "p3m1"}),
        (r"sides = \[\]: expected one or more", {"sides": ()}),
        (r'sides = \["top", "top"\]: top is named twice', {"sides": ("top", "top")}),
        ('unknown side "botom": did you mean "bottom"', {"sides": ("botom",)}),
        ("the border is empty", {"place": ()}),
        (
            r"rails\[0\].at: a rail of 4 mm at 1 mm reaches beyond .* from 2 to 34 mm",
            {"rails": (RailSpec(at=1, width=4),)},
        ),
        ("a rail of 40 mm .* a width of 36 mm at most", {"rails": (RailSpec(at=1, width=40),)}),
        ('radius = 10 mm with corner = "mitre": expected none, or corner = "bend"', {"radius": 10}),
        ('corner_place: given with corner = "bend"', {"corner": "bend", "corner_place": (plain(),)}),
        ('facing = "mirror" with corner = "mitre"', {"facing": "mirror"}),
        ('facing = "mirror" with corner = "bend"', {"facing": "mirror", "corner": "bend"}),
        (r'place\[0\].symmetry: "p4m": a border repeats by its frieze', {"place": (plain(symmetry="p4m"),)}),
        (r"place\[1\].phase: belongs to a tile", {"place": (plain(), plain(phase=(1, 0)))}),
        (r"place\[0\].region: belongs to a tile", {"place": (plain(region="cut"),)}),
        ("limit = 60", {"limit": 60}),
    ],
)
def test_a_wrong_border_says_what_was_expected(words: str, fields: dict[str, object]) -> None:
    with pytest.raises((GeometryError, RecipeError), match=words):
        border(**fields)


def test_sides_that_meet_in_no_corner_may_face_each_other() -> None:
    assert border(facing="mirror", sides=("bottom", "top")).facing == "mirror"
    assert border(facing="mirror", corner="motif").facing == "mirror"


def test_a_frieze_goes_by_all_its_names() -> None:
    assert border(frieze="spinning jump").frieze == "p2mm"
