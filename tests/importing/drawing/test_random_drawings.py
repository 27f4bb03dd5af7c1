"""Random drawings as motifs: what they draw in a colour covers what resvg paints in it."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings

from batik_vector import RecipeError
from batik_vector.importing.document import parse
from batik_vector.importing.drawing.carried import carried
from batik_vector.recipe.drawing import Svg
from tests.importing.drawings import svg
from tests.importing.random_drawings import COLOURS, drawings
from tests.importing.test_against_resvg import alone, painted
from tests.thorough import examples, long


@long
@settings(
    max_examples=examples(8, 300), derandomize=True, deadline=None, suppress_health_check=list(HealthCheck)
)
@given(drawings())
def test_a_motif_covers_what_is_painted(inner: str) -> None:
    for colour in COLOURS:
        mine = alone(inner, colour)
        document = parse(svg(mine))
        motif = Svg(file="d.svg", centre="page")
        try:
            motif = motif.read_from(document, None, carried(document, None))
        except RecipeError as error:
            words = str(error)
            assert any(each in words for each in ("is clipped", "gradient", "pattern", "nothing is drawn")), (
                words
            )
            continue
        marks = np.concatenate([areas for _, areas, _ in motif.shapes(0.01)])
        # The drawing's page is 100 mm square, its middle in the origin.
        shown = shapely.intersection(shapely.union_all(marks), shapely.box(-50, -50, 50, 50))
        expected = painted(mine)
        allowed = 1.5 + 0.03 * float(shapely.length(shown)) + 0.02 * expected
        assert float(shapely.area(shown)) == pytest.approx(expected, abs=allowed)
