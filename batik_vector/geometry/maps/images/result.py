"""What became of marks under a map, and to what tolerance it is worked out."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.sampling import Array, Geometries, Indices, Points

Tolerance: TypeAlias = float | Callable[[Points], Array]
"""One tolerance, or a function of points in the image where it varies; the images are then left dense,
to be thinned further on."""


class Images(NamedTuple):
    """What became of an array of marks: the images, branch after branch and within one in source order.

    ``source[i]`` is the index of the mark that image i comes from, ``branch[i]`` the branch it lies on.
    A region that winds round the origin has one image on all branches together: it counts to branch 0.
    A mark that is cut (a fold, an arc that ends in the origin) has several images on one branch.
    """

    geometries: Geometries
    source: Indices
    branch: Indices


NO_IMAGES = Images(np.empty(0, dtype=object), np.empty(0, np.intp), np.empty(0, np.intp))


def core_tolerance(flame: FlameMap, tolerance: Tolerance) -> Tolerance:
    """Return the tolerance before post, for what is traced once and stands for all its turned branches."""
    if not callable(tolerance):
        return tolerance / flame.post.stretch
    given = tolerance
    spins = [1 + 0j]
    if len(flame.terms) == 1:
        spins = [flame.terms[0][1].spin(k) for k in range(flame.branches)]

    def allowed(points: Points) -> Array:
        z = np.ascontiguousarray(points).view(np.complex128)[:, 0]
        turned = [flame.post.at_complex(np.ascontiguousarray(z * spin)) for spin in spins]
        worst = np.min([given(each.view(np.float64).reshape(-1, 2)) for each in turned], axis=0)
        return np.asarray(worst / flame.post.stretch)

    return allowed


def affine_images(flame: FlameMap, marks: Geometries) -> Images | None:
    """Return the images of marks, exactly and vertex by vertex, or None where the map bends."""
    maps = flame.affine_branches()
    if maps is None:
        return None
    count = len(marks)
    return Images(
        Affines.of(maps).apply(marks),
        np.tile(np.arange(count, dtype=np.intp), len(maps)),
        np.repeat(np.arange(len(maps), dtype=np.intp), count),
    )
