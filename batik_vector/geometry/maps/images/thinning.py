"""Thinning of many rings at once, and again more finely where it broke something."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.sampling import Array, Indices, thin

SMALLEST_SHARE = 1 / 8
"""A ring is never thinned more coarsely than this share of its size: a circle then keeps six corners."""

FINER = (1.0, 0.25, 1 / 16, 1 / 64)
"""Shares of the tolerance tried in turn where thinned rings cross, before all vertices are left. Necks
narrower than the tolerance need it."""

FINER_SHARES = (1 / 8, 1 / 32, 1 / 128, 1 / 512)
"""Shares of a ring's size that go with them."""


def thin_chains(
    z: Complexes,
    offsets: Indices,
    tolerance: float,
    closed: NDArray[np.bool_],
    share: float = SMALLEST_SHARE,
) -> NDArray[np.bool_]:
    """Return a mask of the vertices of dense polylines that the tolerance needs.

    Args:
        z, offsets: the polylines, one after another; closed ones repeat their first point.
        tolerance: how far a vertex left out may stand from the chord that passes it.
        closed: which are rings; these keep three corners at least.
        share: of a ring's size, beyond which its tolerance does not go.
    """
    counts = np.diff(offsets)
    begin = np.repeat(z[offsets[:-1]], counts)
    local = z - begin
    # Enlarging a small ring is the same as lessening its tolerance.
    size = np.maximum(_extent(local.real, offsets), _extent(local.imag, offsets)) * share
    with np.errstate(divide="ignore"):
        scale = np.where(closed & (size < tolerance) & (size > 0), tolerance / size, 1.0)
    points = np.ascontiguousarray(local * np.repeat(scale, counts)).view(np.float64).reshape(-1, 2)
    keep = thin(points, offsets, tolerance)
    few = closed & (np.add.reduceat(keep, offsets[:-1], dtype=np.intp) < 4)
    return np.asarray(keep | np.repeat(few, counts))


def ever_finer(
    z: Complexes, offsets: Indices, tolerance: float, closed: NDArray[np.bool_]
) -> Iterator[NDArray[np.bool_]]:
    """Yield masks that thin less and less; the last keeps all vertices."""
    for factor, share in zip(FINER, FINER_SHARES, strict=True):
        yield thin_chains(z, offsets, tolerance * factor, closed, share)
    yield np.ones(len(z), bool)


def _extent(values: Array, offsets: Indices) -> Array:
    return np.asarray(np.maximum.reduceat(values, offsets[:-1]) - np.minimum.reduceat(values, offsets[:-1]))
