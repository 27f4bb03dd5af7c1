"""Images of chains: refined by the image's error, then thinned to what the tolerance needs."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry import work
from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.images.chains import Angles, Chains
from batik_vector.geometry.maps.images.result import Tolerance
from batik_vector.geometry.maps.images.thinning import thin_chains
from batik_vector.geometry.sampling import REFINE_SHARE, Array, Indices, Points, refine
from batik_vector.values import frozen

__all__ = ["Traced", "trace_images"]


@frozen
class Traced:
    """Dense images of chains, in chain order, and which of their vertices the tolerance needs.

    ``image``: all vertices; chain i is ``image[offsets[i]:offsets[i + 1]]``; ``keep``: the mask.
    """

    image: Complexes
    offsets: Indices
    keep: NDArray[np.bool_]

    def chain(self, i: int) -> Complexes:
        """Return one image, as far as the tolerance needs it."""
        part = slice(self.offsets[i], self.offsets[i + 1])
        return self.image[part][self.keep[part]]

    def thinned(self) -> tuple[Complexes, Indices]:
        """Return the vertices kept, and their offsets."""
        counts = np.concatenate([[0], np.cumsum(self.keep)])
        return self.image[self.keep], counts[self.offsets]


def trace_images(
    flame: FlameMap,
    chains: Chains,
    angles: Angles | None,
    branch: int,
    tolerance: Tolerance,
    thinning: bool = True,
) -> Traced:
    """Return the images of chains under the core of a map (neither pre nor post) on one branch.

    Args:
        flame: the map.
        chains: as :func:`~batik_vector.geometry.maps.images.chains.prepare` left them.
        angles: their unwrapped angles; None where no term has a branch cut.
        branch: of the sum.
        tolerance: of the image, before post.
        thinning: False leaves the dense polyline; so does a tolerance that varies.
    """
    z = chains.z
    step = np.empty_like(z)
    step[:-1] = z[1:] - z[:-1]
    middle = None if angles is None else angles.middle

    per_point = work.PER_TOLD_POINT if callable(tolerance) else work.PER_TRACED_POINT

    def evaluate(piece: Indices, t: Array) -> Points:
        # A map of a steep power needs millions of points, near the limit of a curve again and again.
        work.spend(len(t), per_vertex=per_point)
        point = z[piece] + step[piece] * t
        angle = None
        if middle is not None:
            angle = np.angle(point)
            angle += 2 * math.pi * np.rint((middle[piece] - angle) / (2 * math.pi))
        image = flame.core(point, angle, branch)
        return np.ascontiguousarray(image, np.complex128).view(np.float64).reshape(-1, 2)

    edges = chains.edges
    fine = tolerance if callable(tolerance) else tolerance * REFINE_SHARE
    piece, t = refine(evaluate, edges, np.zeros(len(edges)), np.ones(len(edges)), fine)
    points = evaluate(piece, t)
    # Each chain's last vertex begins no piece.
    ends = evaluate(chains.last - 1, np.ones(len(chains)))
    stops = np.searchsorted(piece, chains.last)
    image = np.insert(points.view(np.complex128)[:, 0], stops, ends.view(np.complex128)[:, 0])
    offsets = np.concatenate([[0], stops + np.arange(1, len(chains) + 1)]).astype(np.intp)
    same = chains.closed & (z[chains.first] != 0)
    if angles is not None:
        # A ring that winds ends on another branch than it begins on.
        same &= np.abs(angles.end - angles.start) < math.pi
    image[offsets[1:][same] - 1] = image[offsets[:-1][same]]
    keep = np.ones(len(image), bool)
    if thinning and not callable(tolerance) and len(image):
        keep = thin_chains(image, offsets, tolerance * (1 - REFINE_SHARE), chains.closed)
    return Traced(image, offsets, keep)
