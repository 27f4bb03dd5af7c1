"""The rosette group of a figure: its turns and mirrors about one point, found from its outline alone.

Leonardo's theorem has only the groups Cn and Dn to offer (Weyl, Symmetry, 1952). Which n may hold is read off
the waves that the outline makes round the centre; whether it holds is measured as for the wallpaper groups,
along the whole outline and by the same measure (:mod:`~batik_vector.certificate.symmetry.agreement`), so that
a petal a twentieth longer than the others breaks the symmetry here as there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Layer
from batik_vector.certificate.symmetry.agreement import NEAR, Matcher, Samples, moved
from batik_vector.certificate.symmetry.lattice import Matrix
from batik_vector.certificate.symmetry.operations import Pair, Vector
from batik_vector.certificate.symmetry.outline import Edges, outline
from batik_vector.units import GRID_MM, STEPS_PER_MM
from batik_vector.values import frozen

MOST_TURNS = 128
"""The highest order looked for."""

ANGLES, RADII = 1440, 24
"""Bins round the centre, and away from it, in which the outline is counted."""

BLUR = 6.0
"""Standard deviation, in bins, of the blur that lets the centre be a little off."""

LIKELY = 0.6
"""The share of the waves that have to fit an order, or an axis, before it is measured; true ones have 0.9."""

OFF = 1e-3
"""How far off, as a share of the figure's reach, a centre has to be for another look from the true one."""

COARSE = 400
"""How many times the slack a figure is across, at the least: smaller ones would be found like everything."""

AROUND = 3.0
"""Side of the square on whose torus a figure is measured, in its diameters: no image then meets another."""

ANY = (1.0, 0.3)
"""Turns, in radians, that together keep only rings and discs: no order that is looked for has either."""

AXES = 6
"""Mirrors tried, the likeliest first."""

Numbers = NDArray[np.float64]


@frozen
class Rosette:
    """The symmetry of a figure about its ``centre`` (mm).

    ``order`` is how many turns bring it upon itself, the whole turn counted: 1 is none. ``mirrors`` says
    whether there are as many mirrors as well, and ``axis`` in which direction one of them runs, in degrees
    from 0 to 180. ``deviation`` (mm) is the most by which an image misses the figure. ``continuous`` figures
    are rings and discs about the centre alone, which any turn keeps; their order says nothing.
    """

    order: int
    mirrors: bool
    centre: Pair
    axis: float | None = None
    deviation: float = 0.0
    continuous: bool = False

    @property
    def name(self) -> str:
        """The group's name: C8, D8, or O(2) of a figure that every turn keeps."""
        return "O(2)" if self.continuous else f"{'D' if self.mirrors else 'C'}{self.order}"

    @property
    def kind(self) -> str:
        """What it consists of, in words."""
        if self.continuous:
            return "rotation by any angle"
        turned = "rotation" if self.order > 1 else ""
        return " and ".join(filter(None, (turned, "reflection" if self.mirrors else ""))) or "none"


def found_rosette(layers: Sequence[Layer], centre: Pair, tolerance: float = 0.02) -> Rosette:
    """Return the rosette group of a figure about a point near ``centre``.

    Args:
        layers: what belongs to the figure and nothing else, in mm; each ink has to be mapped onto itself.
        centre: in mm; a hundredth of the figure's size beside the true one does not matter.
        tolerance: how far (mm) a drawn edge may stand from the true curve.
    """
    drawn = [np.asarray(marks) for layer in layers for marks in (layer.areas, layer.lines) if len(marks)]
    if not drawn:
        return Rosette(1, False, centre)
    low_x, low_y, high_x, high_y = shapely.total_bounds(np.concatenate(drawn))
    reach = float(max(high_x - centre[0], centre[0] - low_x, high_y - centre[1], centre[1] - low_y, 1e-3))
    side = math.ceil(2 * AROUND * reach * STEPS_PER_MM)
    middle = np.array([side / 2, side / 2]) / STEPS_PER_MM
    shift = middle - np.array(centre)
    figure = outline([_shifted(layer, shift) for layer in layers], Cell(side, side))
    # As for tiles: pattern and image may both be out by the tolerance.
    slack = min(2 * tolerance + 4 * GRID_MM, 2 * reach / COARSE)
    found = _Search(figure.edges, middle, reach, slack, side / STEPS_PER_MM).result()
    x, y = (np.array(found.centre) - shift).tolist()
    return Rosette(found.order, found.mirrors, (x, y), found.axis, found.deviation, found.continuous)


def _shifted(layer: Layer, shift: Vector) -> Layer:
    areas, lines = (shapely.transform(marks, lambda xy: xy + shift) for marks in (layer.areas, layer.lines))
    return Layer(layer.ink, areas, lines)


class _Search:
    """The search for one figure about ``middle``; ``slack`` (mm) is what an image may miss it by."""

    def __init__(self, edges: Edges, middle: Vector, reach: float, slack: float, side: float) -> None:
        self.middle, self.slack = middle, slack
        self.matcher = Matcher(edges, np.eye(2) * side, slack, reach / 50, thin=slack / 2)
        self.edges, self.reach = edges, reach
        self.deviation = 0.0

    def result(self) -> Rosette:
        """Return the group."""
        first = self.middle
        found = self._about_middle()
        if np.hypot(*(self.middle - first)) > OFF * self.reach:
            found = self._about_middle()
        return found

    def _about_middle(self) -> Rosette:
        waves = np.fft.rfft(_rings(self.edges, self.middle, self.reach), axis=1)
        power = (np.abs(waves) ** 2)[:, 1:].sum(axis=0)
        if all(self._turns(angle) for angle in ANY):
            return Rosette(1, True, _pair(self.middle), continuous=True)
        order = next((n for n in _orders(power) if self._turns(2 * math.pi / n)), 1)
        axis = self._mirror(waves, order)
        mirrors = axis is not None
        return Rosette(order, mirrors, _pair(self.middle), axis, self.deviation)

    def _turns(self, angle: float) -> bool:
        """Whether the figure is kept by a turn (radians); if so its centre is the turn's."""
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        shift = self.matcher.placed(turn, self.middle - turn @ self.middle)
        fit = self.matcher.fit(turn, shift, self.slack)
        if fit.holds:
            self.middle = np.asarray(np.linalg.solve(np.eye(2) - turn, shift))
            self.deviation = max(self.deviation, fit.worst)
        return fit.holds

    def _mirror(self, waves: NDArray[np.complex128], order: int) -> float | None:
        """Return the direction of a mirror in degrees, or None where there is none."""
        for angle in _axes(waves, order):
            angle, shift = self._settled(angle)
            fit = self.matcher.fit(_reflection(angle), shift, self.slack)
            if fit.holds:
                self.deviation = max(self.deviation, fit.worst)
                return round(math.degrees(angle) % 180, 6)
        return None

    def _settled(self, angle: float) -> tuple[float, Vector]:
        """Return the mirror near one through the centre that brings the image nearest to the figure.

        As :meth:`Matcher.placed`, with the direction as a third unknown.
        """
        shift = self.middle - _reflection(angle) @ self.middle
        reach = self.matcher.far.reach
        for _ in range(12):
            near = self.matcher.far if reach > self.matcher.near.reach else self.matcher.near
            image: Samples = moved(self.matcher.few, _reflection(angle))
            xy = image.xy + shift
            feet = near.feet(xy, image.kind, image.heading)
            used = feet.distance <= reach
            if used.sum() < 4:
                break
            normal, away = feet.normal[used], xy[used] - self.middle
            lever = normal[:, 1] * away[:, 0] - normal[:, 0] * away[:, 1]
            rows = np.column_stack([normal, lever])
            gap = (normal * feet.offset[used]).sum(axis=1)
            square = rows.T @ rows + 1e-9 * len(gap) * np.eye(3)
            step = np.linalg.solve(square, rows.T @ gap)
            # A turn by β behind a reflection is the reflection in an axis that is turned by half of it.
            turned = angle + step[2] / 2
            here = _reflection(angle) @ self.middle + shift
            angle, shift = turned, here + step[:2] - _reflection(turned) @ self.middle
            if reach <= NEAR * self.slack and np.hypot(*step[:2]) < self.slack / 100:
                break
            reach = max(reach / 2, NEAR * self.slack)
        return angle, shift


def _pair(place: Vector) -> Pair:
    x, y = place.tolist()
    return x, y


def _reflection(angle: float) -> Matrix:
    """Return the reflection in the line through the origin that runs in a direction (radians)."""
    cos, sin = math.cos(2 * angle), math.sin(2 * angle)
    return np.array([[cos, sin], [sin, -cos]])


def _rings(edges: Edges, middle: Vector, reach: float) -> Numbers:
    """Return how much of the outline lies in each direction, by ring and kind: shape (rings, ANGLES)."""
    step = edges.end - edges.begin
    length = np.hypot(*step.T)
    pieces = np.maximum(1, np.ceil(length * (ANGLES / (4 * reach)))).astype(np.intp)
    row = np.repeat(np.arange(len(edges)), pieces)
    part = (np.arange(len(row)) - np.repeat(np.cumsum(pieces) - pieces, pieces) + 0.5) / pieces[row]
    x, y = (edges.begin[row] + part[:, None] * step[row] - middle).T
    ring = np.minimum((np.hypot(x, y) * (RADII / (1.5 * reach))).astype(np.intp), RADII - 1)
    angle = np.arctan2(y, x) * (ANGLES / (2 * math.pi))
    place = np.floor(angle).astype(np.intp)
    rest, weight = angle - place, length[row] / pieces[row]
    line = (edges.kind[row] * RADII + ring) * ANGLES
    size = (int(edges.kind.max(initial=0)) + 1) * RADII * ANGLES
    rings: Numbers = np.bincount(line + place % ANGLES, weight * (1 - rest), size).astype(np.float64)
    rings += np.bincount(line + (place + 1) % ANGLES, weight * rest, size)
    rings = rings.reshape(-1, ANGLES)
    rings = rings[rings.any(axis=1)]
    wave = np.arange(ANGLES // 2 + 1) * (2 * math.pi / ANGLES)
    smooth = np.exp(-((BLUR * wave) ** 2) / 2)
    return np.asarray(np.fft.irfft(np.fft.rfft(rings, axis=1) * smooth, ANGLES, axis=1))


def _orders(power: Numbers) -> Iterator[int]:
    """Yield the orders that the waves round the centre speak for, the highest first."""
    total = float(power.sum())
    for order in range(min(MOST_TURNS, len(power)), 1, -1):
        if float(power[order - 1 :: order].sum()) >= LIKELY * total:
            yield order


def _axes(waves: NDArray[np.complex128], order: int) -> list[float]:
    """Return the likeliest directions of mirrors (radians), the best first, of each order's worth one."""
    agreement: Numbers = np.fft.irfft((waves**2)[:, :].sum(axis=0), ANGLES)
    plain = np.abs(waves) ** 2
    best = float(np.fft.irfft(plain.sum(axis=0), ANGLES)[0])
    # f(2α − θ) meets f(θ) where the sum of both angles is 2α; axes repeat after π/n.
    ahead, behind = np.roll(agreement, -1), np.roll(agreement, 1)
    peak = (agreement >= ahead) & (agreement > behind) & (agreement >= LIKELY * best)
    at = np.flatnonzero(peak)
    at = at[np.argsort(-agreement[at], kind="stable")]
    bend = np.minimum(behind[at] - 2 * agreement[at] + ahead[at], -1e-30)
    place = at + np.clip((behind[at] - ahead[at]) / (2 * bend), -0.5, 0.5)
    angles: list[float] = []
    for angle in (place * (math.pi / ANGLES)).tolist():
        apart = [
            abs((angle - other + math.pi / order / 2) % (math.pi / order) - math.pi / order / 2)
            for other in angles
        ]
        if all(each > math.pi / ANGLES for each in apart):
            angles.append(angle)
    return angles[:AXES]
