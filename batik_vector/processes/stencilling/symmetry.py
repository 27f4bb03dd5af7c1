"""Symmetries of openings on the torus: isometries that bring them onto themselves, found from their shapes.

Every symmetry brings a closed piece, an opening or an island, to one of the same area. So the pieces of the
rarest area say where an isometry can lead, and the contours say whether it does.
"""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Array, Points
from batik_vector.processes.stencilling.contours import Contours, Field
from batik_vector.processes.stencilling.sheets import Sheet, Torus
from batik_vector.values import frozen

NEAR = 4.0
"""Steps by which an image may miss, besides the tolerance of the drawing."""
ALIKE = 0.01
"""Part by which the areas of pieces may differ that are images of one another."""
ASKED = 3000
"""Places on the contours that are asked, about."""
FEW = 40
MOST = 400
"""Pieces of the rarest area from which on no symmetry is looked for but the identity."""


@frozen(eq=False)
class Symmetry:
    """Isometries x → turn @ x + shift, the identity first.

    ``turns`` has shape (k, 2, 2), ``shifts`` (k, 2), in steps. Those that differ by a repeat of the tile are
    there once; translations within the tile are isometries of their own.
    """

    turns: Array
    shifts: Points

    def __len__(self) -> int:
        return len(self.turns)

    def images(self, points: Points) -> Array:
        """Return the images of places, shape (n, 2), under each: shape (k, n, 2)."""
        turned = np.einsum("kij,nj->kni", self.turns, points)
        return np.asarray(turned + self.shifts[:, None, :])

    def turned(self, ways: Points) -> Array:
        """Return the images of directions, shape (n, 2), under each: shape (k, n, 2)."""
        return np.asarray(np.einsum("kij,nj->kni", self.turns, ways))


NO_OTHER = Symmetry(np.eye(2)[None], np.zeros((1, 2)))


@frozen(eq=False)
class _Pieces:
    """Closed pieces of the torus: what kind each is, its area and its centre of area, in steps."""

    kind: Index
    area: Array
    centre: Points


def symmetry_of(sheet: Sheet, opened: Sheet, contours: Contours, field: Field, tolerance: float) -> Symmetry:
    """Return all symmetries of a sheet with openings.

    Args:
        sheet: what the openings leave.
        opened: the openings, as they hang together round the tile.
        contours: of the sheet.
        field: its contours in and around the tile.
        tolerance: how far drawn edges may stand from the true curves, in steps.
    """
    slack = NEAR + tolerance
    pieces = _pieces([sheet, opened])
    if not len(pieces.kind):
        return NO_OTHER
    alike = _alike(pieces, slack)
    rarest = alike[np.argmin(alike.sum(axis=1))]
    first, others = int(np.argmax(rarest)), np.flatnonzero(rarest)
    if len(others) > MOST:
        return NO_OTHER
    asked = _asked(contours)
    torus = sheet.torus
    tree = shapely.STRtree(np.asarray(shapely.points(pieces.centre), dtype=object))
    basis = _reduced(np.array(torus.basis, float).T)
    found = list[tuple[Array, Points]]()
    moves = _shifts(np.eye(2), first, others, pieces)
    for move in moves:
        if _holds(np.eye(2), move, torus, pieces, tree, field, asked, slack):
            found.append((np.eye(2), move))
    finer = _reduced(np.column_stack([basis, *(torus.nearest(move[None])[0][0] for _, move in found)]))
    for turn in _isometries(finer, slack):
        for move in _shifts(turn, first, others, pieces):
            if _holds(turn, move, torus, pieces, tree, field, asked, slack):
                found.append((turn, move))
    return Symmetry(np.array([turn for turn, _ in found]), np.array([move for _, move in found]))


def _pieces(kinds: list[Sheet]) -> _Pieces:
    kind, area, centre = list[int](), list[float](), list[Points]()
    for number, sheet in enumerate(kinds):
        if not len(sheet.parts):
            continue
        lies = [sheet.clusters.lies(part) for part in range(len(sheet.parts))]
        first = np.array([each for each, _ in lies])
        shift = sheet.torus.at(np.array([gain for _, gain in lies], np.int64))
        own = shapely.area(sheet.parts)
        moment = own[:, None] * (shapely.get_coordinates(shapely.centroid(sheet.parts)) + shift)
        for each in np.unique(first).tolist():
            if not sheet.clusters.span(each).rank:
                mine = first == each
                kind.append(number)
                area.append(float(own[mine].sum()))
                centre.append(moment[mine].sum(axis=0) / own[mine].sum())
    if not kind:
        return _Pieces(np.empty(0, np.intp), np.empty(0), np.empty((0, 2)))
    torus = kinds[0].torus
    return _Pieces(np.array(kind), np.array(area), torus.home(np.array(centre))[0])


def _alike(pieces: _Pieces, slack: float) -> Array:
    """Return which pieces may be images of which, shape (n, n)."""
    near = np.abs(pieces.area[:, None] - pieces.area)
    room = ALIKE * pieces.area + 4 * slack * np.sqrt(pieces.area)
    return np.asarray((near <= room) & (pieces.kind[:, None] == pieces.kind))


def _shifts(turn: Array, first: int, others: Index, pieces: _Pieces) -> list[Points]:
    """Return the shifts that bring a turned piece to any that is like it; its own place is the first."""
    order = sorted(others.tolist(), key=lambda each: each != first)
    return [pieces.centre[each] - turn @ pieces.centre[first] for each in order]


def _asked(contours: Contours) -> Points:
    """Return places on all contours, by which an isometry is judged."""
    lengths = shapely.length(contours.runs)
    spacing = max(float(lengths.sum()) / ASKED, 1.0)
    counts = np.maximum(1, (lengths / spacing).astype(int))
    row = np.repeat(np.arange(len(counts)), counts)
    step = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    places = shapely.line_interpolate_point(contours.runs[row], (step + 0.5) / counts[row], normalized=True)
    return shapely.get_coordinates(places)


def _holds(
    turn: Array,
    move: Points,
    torus: Torus,
    pieces: _Pieces,
    tree: shapely.STRtree,
    field: Field,
    asked: Points,
    slack: float,
) -> bool:
    """Return whether an isometry brings pieces to pieces, and contours to contours."""
    for some in (slice(0, FEW), slice(FEW, None)):
        image = torus.home(pieces.centre[some] @ turn.T + move)[0]
        if len(image) and not _met(image, pieces, some, torus, tree, slack):
            return False
    stride = max(1, len(asked) // 100)
    for places in (asked[::stride], asked):
        image = torus.home(places @ turn.T + move)[0]
        near = field.tree.query(shapely.points(image), predicate="dwithin", distance=slack)[0]
        if len(np.unique(near)) < len(image):
            return False
    return True


def _met(
    image: Points, pieces: _Pieces, some: slice, torus: Torus, tree: shapely.STRtree, slack: float
) -> bool:
    """Return whether each image is the centre of a piece like it, in the tile or beyond its edges."""
    area, kind = pieces.area[some], pieces.kind[some]
    met = np.zeros(len(image), bool)
    for gain in product((0, -1, 1), repeat=2):
        rest = np.flatnonzero(~met)
        if not len(rest):
            break
        moved = image[rest] + torus.at(np.array([gain], np.int64))
        one, other = tree.query(shapely.points(moved), predicate="dwithin", distance=2 * slack)
        room = ALIKE * area[rest[one]] + 4 * slack * np.sqrt(area[rest[one]])
        like = (np.abs(area[rest[one]] - pieces.area[other]) <= room) & (
            kind[rest[one]] == pieces.kind[other]
        )
        met[rest[one[like]]] = True
    return bool(met.all())


def _reduced(vectors: Array) -> Array:
    """Return a shortest basis (columns) of the lattice that vectors (columns) span, by Gauss's reduction."""
    basis = vectors[:, :2].copy()
    for other in vectors[:, 2:].T:
        basis = _with(basis, other)
    return _gauss(basis)


def _with(basis: Array, vector: Points) -> Array:
    """Return a basis of what a basis and one vector more span, by Euclid's way of dividing."""
    basis = _gauss(basis)
    for _ in range(64):
        rest = vector - basis @ np.rint(np.linalg.solve(basis, vector))
        if math.hypot(*rest) < 1e-4 * math.sqrt(abs(np.linalg.det(basis))) + 4 * NEAR:
            return basis
        # The rest is shorter than the longer vector, and takes the place of the one that it can stand for.
        areas = [abs(np.linalg.det(np.column_stack([rest, basis[:, each]]))) for each in (0, 1)]
        keep = 0 if areas[0] > 1e-6 * abs(np.linalg.det(basis)) else 1
        vector, basis = basis[:, 1 - keep], _gauss(np.column_stack([basis[:, keep], rest]))
    return basis


def _gauss(basis: Array) -> Array:
    a, b = basis[:, 0], basis[:, 1]
    for _ in range(64):
        if a @ a > b @ b:
            a, b = b, a
        times = np.rint((a @ b) / (a @ a))
        if not times:
            break
        b = b - times * a
    return np.column_stack([a, b])


def _isometries(basis: Array, slack: float) -> list[Array]:
    """Return the turns and reflections that bring a lattice onto itself, but for the identity."""
    inverse, found = np.linalg.inv(basis), list[Array]()
    for p, q, r, s in product((-1, 0, 1), repeat=4):
        whole = np.array([[p, q], [r, s]], float)
        if abs(p * s - q * r) != 1 or (whole == np.eye(2)).all():
            continue
        turn = basis @ whole @ inverse
        left, _, right = np.linalg.svd(turn)
        true = left @ right
        if np.abs(true @ basis - basis @ whole).max() <= slack:
            found.append(true)
    return found


def repeats_of(symmetry: Symmetry, torus: Torus, points: Points) -> tuple[Array, Array]:
    """Return the images of places, each as near to its place as a repeat brings it, and how far it is away.

    Returns:
        The images, shape (k, n, 2), and the ways to them, of the same shape.
    """
    images = symmetry.images(points)
    ways, _ = torus.nearest((images - points).reshape(-1, 2))
    ways = ways.reshape(images.shape)
    return points + ways, ways
