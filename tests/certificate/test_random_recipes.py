"""Everyday recipes of all repeats pass: no strip along a seam, no crumb of a line that hides a symmetry."""

from __future__ import annotations

import pytest

from batik_vector import compile_recipe
from batik_vector.certificate import certify
from batik_vector.errors import RecipeError
from batik_vector.making.promised import asked_group
from batik_vector.recipe.loading import read_recipe
from tests.random_recipes import recipe_text
from tests.thorough import examples, rarely, slow
from tests.tiling.test_seamless import NO_TILE, TOO_MUCH

STRIPS = (324, 844, 1182)
"""Marks cut to a region whose edge lies on the seam: a lap over it stood there as a strip of ink."""

CRUMBS = (246, 1028, 1758)
"""Lines of which a gap left a few micrometres at some images only."""

MORE = (431, 639, 1133, 1238, 1702, 768, 1025, 1206, 1405, 1654)
"""More of both kinds, line ends at sharp angles, and pages covered all over."""

BESIDE = (166, 204, 1705, 1807)
"""Lines that run beside a mirror or the seam as near as a step, or cross a mirror at a right angle."""

HOLES = (445, 1374, 125)
"""Holes that touch the outlines they lie in, and areas that begin in one point."""

ROUNDED = (1342,)
"""Gaps that missed the tolerance at some corners and not at their images, as GEOS rounds their chords."""

DOUBLED = (1210,)
"""Lines that lie on the seam and on their images beyond it, and end there at a gap."""

SPREAD = range(7, 2000, 94)


def passes(number: int) -> None:
    recipe = read_recipe(recipe_text(number))
    try:
        artwork = compile_recipe(recipe)
    except RecipeError as error:
        # Nothing may be left to draw, a toss find no room, or the work be more than a compile may do.
        if any(words in str(error) for words in (*NO_TILE, *TOO_MUCH)):
            pytest.skip(str(error))
        raise
    assert certify(artwork, asked=asked_group(recipe)).faults == ()


@pytest.mark.parametrize("number", rarely([*STRIPS, *CRUMBS], 3))
def test_strips_and_crumbs_are_no_longer_left(number: int) -> None:
    passes(number)


@slow
@pytest.mark.parametrize("number", [*MORE, *BESIDE, *HOLES, *ROUNDED, *DOUBLED, *SPREAD][: examples(1, 40)])
def test_everyday_recipes_pass(number: int) -> None:
    passes(number)
