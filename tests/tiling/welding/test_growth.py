"""Growth keeps the tolerance at every corner, however it lies."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.tiling.welding.growth import grown, grown_on_grid, quad_segs
from batik_vector.units import STEPS_PER_MM


@settings(derandomize=True, max_examples=200, deadline=None)
@given(
    st.floats(5, 175),
    st.floats(0, 360),
    st.floats(0.2, 20),
    st.sampled_from([0.002, 0.02, 0.05, 0.4]),
)
def test_a_corner_of_any_angle_is_round_to_the_tolerance(
    turn: float, lie: float, reach: float, tolerance: float
) -> None:
    legs = np.radians([lie, lie + 180 - turn])
    wedge = shapely.polygons([(0, 0), *(100 * np.column_stack([np.cos(legs), np.sin(legs)])).tolist()])
    (round_,) = grown(np.array([wedge]), reach, tolerance)
    middle = np.radians(lie + (180 - turn) / 2) + np.pi
    # All round the corner, between the straight sides.
    fan = middle + np.radians(np.linspace(-turn / 2, turn / 2, 400))
    rays = shapely.linestrings(
        np.stack([np.zeros((400, 2)), 2 * reach * np.column_stack([np.cos(fan), np.sin(fan)])], 1)
    )
    reached = shapely.length(shapely.intersection(rays, round_))
    assert reached.max() <= reach + 1e-9
    assert reached.min() >= reach - tolerance - 1e-9


@pytest.mark.parametrize("lie", [0, 29, 101, 333])
def test_on_the_grid_too(lie: float) -> None:
    turned = shapely.affinity.rotate(shapely.box(0, 0, 30_000, 20_000), lie)
    reach, tolerance = 2.5, 0.05
    (round_,) = grown_on_grid(np.array([turned]), reach, quad_segs(reach, tolerance))
    true = turned.buffer(reach * STEPS_PER_MM, quad_segs=400)
    assert (
        shapely.hausdorff_distance(round_.exterior, true.exterior, densify=0.05)
        <= tolerance * STEPS_PER_MM + 2
    )
