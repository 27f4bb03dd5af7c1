"""What rings leave white: corners that are sharper than the pen, and necks where no ring has room.

A ring's ink has round corners, so that a little stays white in each corner between it and the ring around it.
The ring reaches out for that by a spike, without the pen being lifted. Whatever else is left is as narrow as
the pen, and gets its centre line.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.hatching.centre_lines import centre_lines
from batik_vector.processes.hatching.regions import Regions
from batik_vector.values import frozen

BLUNT = 0.7
"""The cosine of 45°: where rings turn by less, nearly nothing is left white."""
SLACK = 1 / 64
"""A part of the pen's width that is not seen."""
LEAST = 1 / 32
"""A part of the square of the pen's width: smaller places stay white."""
SHORT = 1 / 6
"""A part of the pen's width by which a spike's ink ends before the corner: hardly anything is left there."""
FARTHEST = 2.0
"""How many widths a spike may be long; from there on lifting the pen takes less time."""


@frozen(eq=False)
class Spikes:
    """Where rings reach out: from ``corner`` to ``tip``, places in steps, shape (n, 2), in which region."""

    corner: NDArray[np.float64]
    tip: NDArray[np.float64]
    region: Index


@frozen(eq=False)
class Leftovers:
    """What fills the places that rings leave white: spikes of the rings within, and lines of their own."""

    spikes: Spikes
    lines: Outlines
    regions: Index


def leftovers(regions: Regions, within: Geometries, spacing: float, width: float) -> Leftovers:
    """Return what fills the places between rings and those within them.

    Args:
        regions: bounded by the rings.
        within: what lies a spacing within each.
        spacing: from ring to ring, in steps. Where it is greater than the width, corners stay as they are.
        width: of the pen, in steps.
    """
    broad = max(spacing, width)
    pieces, of = _white(regions, within, broad)
    spikes, kept = _spikes(regions, within, pieces, of, broad)
    lines, piece = centre_lines(pieces[~kept], broad)
    if spacing > width * (1 + 1e-9):
        none = np.empty(0, np.intp)
        spikes = Spikes(spikes.corner[none], spikes.tip[none], none)
    return Leftovers(spikes, lines, of[~kept][piece])


def _white(regions: Regions, within: Geometries, broad: float) -> tuple[Geometries, Index]:
    """Return places that neither the ring around nor those within paint, and the region of each."""
    asked = np.flatnonzero(_pointed(within))
    reach = broad * (0.5 + SLACK)
    free = regions.taken(asked).shrunk(reach)
    painted = shapely.buffer(within[asked], reach, quad_segs=8)
    pieces, of = shapely.get_parts(shapely.difference(free, painted), return_index=True)
    large = np.flatnonzero(shapely.area(pieces) > broad * broad * LEAST)
    return pieces[large], asked[of[large]]


def _pointed(within: Geometries) -> NDArray[np.bool_]:
    """Return which regions have corners, or are empty."""
    parts, part = shapely.get_parts(within, return_index=True)
    rings, of = shapely.get_rings(parts, return_index=True)
    pointed = np.asarray(shapely.is_empty(within))
    if not len(rings):
        return pointed
    points, ring = shapely.get_coordinates(rings, return_index=True)
    step = np.diff(points, axis=0)
    ends = np.flatnonzero(np.diff(ring))
    first = np.append(0, ends + 1)
    x, y = step.T
    # The step after each; that after a ring's last is its first, and what leads to the next ring is none.
    after = np.arange(1, len(step) + 1)
    after[np.append(ends, len(step)) - 1] = first
    dot = x * x[after] + y * y[after]
    long = np.sqrt((x * x + y * y) * (x[after] ** 2 + y[after] ** 2))
    sharp = dot < BLUNT * long
    sharp[ends] = False
    pointed[part[of[ring[:-1][sharp]]]] = True
    return pointed


def _spikes(
    regions: Regions, within: Geometries, pieces: Geometries, of: Index, broad: float
) -> tuple[Spikes, NDArray[np.bool_]]:
    """Return the spikes, and which pieces are painted by one or do not need it."""
    places, piece = shapely.get_coordinates(pieces, return_index=True)
    points = np.asarray(shapely.points(places), dtype=object)
    away = np.rint(shapely.distance(points, within[of[piece]]))
    away[np.isnan(away)] = np.inf
    farthest = np.lexsort((-away, piece))
    farthest = farthest[np.diff(piece[farthest], prepend=-1) > 0]
    kept = np.isfinite(away[farthest])
    some = np.flatnonzero(kept)
    ways = shapely.get_coordinates(shapely.shortest_line(points[farthest[some]], within[of[some]]))
    far, corner = ways[::2], ways[1::2]
    length = np.sqrt(((far - corner) ** 2).sum(axis=1))
    share = np.maximum(length - broad * (0.5 + SHORT), 0.0) / np.maximum(length, 1.0)
    tip = corner + (far - corner) * share[:, None]
    spikes = shapely.linestrings(np.stack([corner, tip], axis=1))
    line = np.full(len(pieces), None, dtype=object)
    line[some] = spikes
    missed = shapely.distance(points, line[piece]) > broad * (0.5 + SHORT + SLACK)
    kept[np.unique(piece[missed])] = False
    good = (
        kept[some] & (length * share <= broad * FARTHEST) & shapely.covers(regions.polygons[of[some]], spikes)
    )
    kept[some] = good
    drawn = good & (share > 0)
    return Spikes(corner[drawn], tip[drawn], of[some[drawn]]), kept
