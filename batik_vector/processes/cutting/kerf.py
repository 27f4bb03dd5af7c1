"""Kerf: the cut is as broad as the beam, so its middle runs half of that beside what is to stay.

Corners of what stays come out sharp whatever way the beam goes round them, if it keeps its distance. Into
corners that point the other way it comes no farther than its own roundness.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.overlays import HAIR, meeting, on_grid, united

MITRE = 2.0
"""How far from a corner the way may be at most, in half kerfs: beyond it the way is cut straight across."""


def compensated(regions: Geometries, kerf: int, *, inward: bool = False) -> Geometries:
    """Return the regions about whose borders the middle of the cut runs, on the grid.

    Args:
        regions: valid polygons in steps that do not overlap; what stays, and of which outer borders grow and
            holes shrink.
        kerf: how broad the cut is, in steps.
        inward: whether what is around them stays instead: then outer borders shrink and holes grow.
    """
    if not kerf or not len(regions):
        return regions
    distance = -kerf / 2 if inward else kerf / 2
    moved = np.asarray(shapely.buffer(regions, distance, join_style="mitre", mitre_limit=MITRE), dtype=object)
    near = meeting(moved, HAIR)
    return np.concatenate([on_grid(moved[~near]), united(moved[near])]) if near.any() else on_grid(moved)
