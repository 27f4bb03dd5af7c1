"""The butterfly curve: Fay's formula, the turns that draw it once, and its mirror image."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from batik_vector.geometry.curves import Butterfly, trace
from batik_vector.geometry.curves.butterfly import REACH


@pytest.mark.parametrize("angle", [0.3, 2.0, 11.1, 40.0, 70.0])
def test_it_is_the_formula_of_the_paper(angle: float) -> None:
    radius = math.exp(math.sin(angle)) - 2 * math.cos(4 * angle) + math.sin((2 * angle - math.pi) / 24) ** 5
    x, y = Butterfly().at(np.array([(angle - math.pi / 2) / (24 * math.pi) % 1]))[0]
    assert (x, y) == (
        pytest.approx(radius * math.cos(angle) / REACH),
        pytest.approx(radius * math.sin(angle) / REACH),
    )


@pytest.mark.parametrize("curve", [Butterfly(), Butterfly(fringe=0.0, level=0.5)])
def test_it_closes_and_is_its_own_mirror_image(curve: Butterfly) -> None:
    ends = curve.at(np.array([0.0, 1.0]))
    assert ends[0] == pytest.approx(ends[1], abs=1e-9)
    line = shapely.LineString(trace(curve, 1e-4).strands[0])
    image = shapely.transform(line, lambda xy: xy * [-1, 1])
    assert shapely.hausdorff_distance(line, image) < 3e-4
