"""Contours of a sheet on the torus: in short chains for measuring, and in places along them for comparing."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import shapely

from batik_vector.errors import TooLargeError
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.sampling import Array, Geometries, Points
from batik_vector.processes.stencilling.sheets import Sheet, Torus
from batik_vector.values import frozen

LINK = 8
"""Edges in a chain: few enough that a chain's bounds say where it is."""
MOST = 400_000
"""Places along the contours of a tile that are compared, at most."""


@frozen(eq=False)
class Contours:
    """The contours of a sheet within its tile, the sheet on their left hand.

    ``runs`` are polylines in steps, cut at the tile's edges; ``part`` is the part of the sheet of each.
    """

    torus: Torus
    runs: Geometries
    part: Index

    @cached_property
    def chains(self) -> tuple[Geometries, Index]:
        """Short stretches of the contours, and the part of each."""
        coords, run = shapely.get_coordinates(self.runs, return_index=True)
        number = np.arange(len(coords)) - np.searchsorted(run, run)
        last = np.append(run[1:] != run[:-1], True)
        begin = np.flatnonzero((number % LINK == 0) & ~last)
        # Each chain shares its last place with the next one's first.
        end = np.minimum(begin + LINK, np.flatnonzero(last)[run[begin]])
        sizes = end - begin + 1
        which = np.repeat(np.arange(len(begin)), sizes)
        step = np.arange(len(which)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        made = shapely.linestrings(coords[begin[which] + step], indices=which) if len(begin) else []
        return np.asarray(made, dtype=object), self.part[run[begin]]


def contours_of(sheet: Sheet) -> Contours:
    """Return the contours of a sheet: its outlines but for those that the tile's edges alone make."""
    rings, owner = shapely.get_rings(sheet.parts, return_index=True)
    cell = sheet.torus.cell
    coords, ring = shapely.get_coordinates(rings, return_index=True)
    edge = np.zeros(len(coords), bool)  # whether from a place to the next one runs an edge of the tile
    for axis, size in ((0, cell.columns), (1, cell.rows)):
        for value in (0, size):
            on = coords[:, axis] == value
            edge[:-1] |= on[:-1] & on[1:]
    last = np.append(ring[1:] != ring[:-1], True)
    drawn = np.flatnonzero(~edge & ~last)
    # A ring that is drawn all round is one run; another falls into runs between the edges of the tile.
    fresh = np.append(True, (drawn[1:] != drawn[:-1] + 1) | (ring[drawn[1:]] != ring[drawn[:-1]]))[
        : len(drawn)
    ]
    number = np.cumsum(fresh) - 1
    places = np.stack([drawn, drawn + 1], axis=1)
    first = np.flatnonzero(fresh)
    sizes = np.diff(np.append(first, len(drawn))) + 1
    which = np.repeat(np.arange(len(first)), sizes)
    step = np.arange(len(which)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    taken = places[first, 0][which] + step if len(first) else np.empty(0, np.intp)
    runs = np.asarray(shapely.linestrings(coords[taken], indices=which) if len(first) else [], dtype=object)
    part = owner[ring[drawn[first]]]
    assert len(number) == len(drawn)
    more, more_part = _on_seams(sheet)
    return Contours(
        sheet.torus, np.concatenate([runs, more]), np.concatenate([part, more_part]).astype(np.intp)
    )


def _on_seams(sheet: Sheet) -> tuple[Geometries, Index]:
    """Return the contours that run along the tile's edges, and their parts."""
    lines, parts = list[shapely.Geometry](), list[int]()
    for part, axis, value, low, high in sheet.seams.tolist():
        ends = [(value, low), (value, high)] if axis == 0 else [(low, value), (high, value)]
        # Anticlockwise round the tile the sheet lies on the left.
        upward = (axis == 0) == (value != 0)
        lines.append(shapely.LineString(ends if upward else ends[::-1]))
        parts.append(part)
    return np.array(lines, dtype=object), np.array(parts, np.intp)


@frozen(eq=False)
class Places:
    """Places along contours, in and around the tile.

    Attributes:
        points: shape (n, 2), in steps.
        heading: the way of the contour there, of length 1, shape (n, 2); the sheet lies on the left.
        part: the part of the sheet.
        gain: the repeat in which each lies, shape (n, 2).
        run: the contour.
        to_end: how far it is along the contour to its nearer end, in steps; the end's place is ``end``.
        along: how far it is from its beginning; ``around`` is its whole length, 0 where it does not close.
    """

    points: Points
    heading: Points
    part: Index
    gain: Steps
    run: Index
    along: Array
    around: Array
    to_end: Array
    end: Points


def places_on(contours: Contours, spacing: float, slack: float, reach: float) -> Places:
    """Return places along contours, of those in the tile and of all that come within reach of it.

    Args:
        contours: of a sheet.
        spacing: how far apart they are at most, in steps.
        slack: how far contours may be straightened before.
        reach: in steps.

    Raises:
        TooLargeError: where there are too many.
    """
    length = float(shapely.length(contours.runs).sum())
    if length / spacing > MOST:
        raise TooLargeError(
            f"{length / 1e6:,.0f} m of contours, expected at most {MOST * spacing / 1e6:,.0f} m for bridges "
            "so narrow: take broader bridges, or a simpler tile"
        )
    runs = shapely.segmentize(shapely.simplify(contours.runs, slack), spacing)
    coords, run = shapely.get_coordinates(runs, return_index=True)
    last = np.append(run[1:] != run[:-1], True)
    way = np.roll(coords, -1, axis=0) - coords
    # Middles of edges: at a corner no one heading is the right one.
    begin = np.flatnonzero(~last)
    way, run_of = way[begin], run[begin]
    size = np.sqrt((way**2).sum(axis=1))
    middle = coords[begin] + way / 2
    total = np.concatenate([[0.0], np.cumsum(size)])
    first = np.searchsorted(run_of, run_of)
    along = total[:-1] - total[first] + size / 2
    whole = total[np.searchsorted(run_of, run_of, side="right")] - total[first]
    heads = coords[np.searchsorted(run, run_of)]
    tails = coords[np.searchsorted(run, run_of, side="right") - 1]
    closed = (heads == tails).all(axis=1)
    nearer = along < whole / 2
    found = Places(
        middle,
        way / np.maximum(size, 1e-9)[:, None],
        contours.part[run_of],
        np.zeros((len(middle), 2), np.int64),
        run_of,
        along,
        np.where(closed, whole, 0.0),
        np.where(closed, np.inf, np.where(nearer, along, whole - along)),
        np.where(nearer[:, None], heads, tails),
    )
    return _around(found, contours.torus, reach)


def _around(places: Places, torus: Torus, reach: float) -> Places:
    cell = torus.cell
    low, high = np.array([-reach, -reach]), np.array([cell.columns + reach, cell.rows + reach])
    which, gains = torus.around(np.hstack([places.points, places.points]), low, high)
    shift = torus.at(gains)
    return Places(
        places.points[which] + shift,
        places.heading[which],
        places.part[which],
        gains,
        places.run[which],
        places.along[which],
        places.around[which],
        places.to_end[which],
        places.end[which] + shift,
    )


@frozen(eq=False)
class Field:
    """The contours of the cloth about the tile as chains, to be searched by place."""

    chains: Geometries
    part: Index
    gain: Steps
    tree: shapely.STRtree


def field_of(contours: Contours, reach: float) -> Field:
    """Return the chains of contours that come within reach of the tile, in steps."""
    chains, part = contours.chains
    cell = contours.torus.cell
    low, high = np.array([-reach, -reach]), np.array([cell.columns + reach, cell.rows + reach])
    which, gains = contours.torus.around(shapely.bounds(chains), low, high)
    coords = shapely.get_coordinates(chains[which])
    counts = shapely.get_num_coordinates(chains)[which]
    coords += np.repeat(contours.torus.at(gains), counts, axis=0)
    indices = np.repeat(np.arange(len(which)), counts)
    lines = np.asarray(shapely.linestrings(coords, indices=indices) if len(which) else [], dtype=object)
    return Field(lines, part[which], gains, shapely.STRtree(lines))
