"""Copies: which marks are one and the same, moved, turned or mirrored, and how each lies.

Marks are compared by their outlines: sampled evenly along their length, two outlines of one shape are one
sequence of complex numbers, turned and begun elsewhere, and the correlation of the two, one Fourier
transform, gives both at once (as of Fourier descriptors: Zahn and Roskies, "Fourier descriptors for plane
closed curves", 1972). Harmonics of all outlines, holes too, then give the turn to the last bits. What is
thought to be a copy is laid over the mark that it is to repeat, and measured.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.values import frozen

Index = NDArray[np.intp]
Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

SAMPLES = 128
"""Points of an outline at which it is compared."""
ALIKE = 3.0
"""How many tolerances the samples of a copy may be off, in the mean, to be measured at all."""
HARMONICS = np.arange(1, 37)
"""Harmonics ∮ r·e^(ikφ) ds of an outline that are asked for a turn: number k turns k times as fast as the
mark."""
FAINT = 1e-3
"""Share of the largest that a harmonic could have, below which it tells nothing of a turn."""
TURNS = 512
"""Turns at which harmonics are compared, all together, for a first guess."""
BLOCK = 2048
"""Marks that are compared at a time, which bounds the memory it takes."""
MOST_TRIED = 8
"""Turns that are tried where an outline alone leaves open which it is."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(3)
"""Gauss' places and weights along a straight edge."""
MOST_CLOSE = 4_000_000
"""Pairs of vertices up to which two outlines are compared point by point; larger ones by their areas."""
UPRIGHT = 15.0
"""Degrees: turns that are all but a multiple of it are taken to be one."""


@frozen(eq=False)
class Copies:
    """Marks as copies of few.

    ``kind`` is the number of the mark, itself a copy of itself, that each one repeats: ``heads[kind[i]]``.
    ``place`` is where its centre lies, in mm, shape (n, 2); ``turn`` in degrees; ``mirrored`` says whether it
    is mirrored at the x axis before it is turned.
    """

    heads: Index
    kind: Index
    place: Floats
    turn: Floats
    mirrored: Mask

    def maps(self) -> Affines:
        """Return the maps that bring the head of each, its centre in the origin, to where each lies."""
        rows = []
        for turn, mirrored, place in zip(
            self.turn.tolist(), self.mirrored.tolist(), self.place.tolist(), strict=True
        ):
            rows.append(posed(turn, mirrored, (place[0], place[1])))
        return Affines.of(rows)


def posed(turn: float, mirrored: bool, place: tuple[float, float]) -> Affine:
    """Return the map that mirrors a mark at the x axis where it is to be, turns it and moves it."""
    turned = Affine.translation(place) @ Affine.turn(turn)
    return turned @ Affine.mirror(0) if mirrored else turned


def found_copies(shapes: Geometries, ink: Index, tolerance: float) -> Copies:
    """Return marks as copies of one another.

    Args:
        shapes: valid polygons, in mm.
        ink: of each; only marks of one ink are copies.
        tolerance: mm; how far the outline of a copy may stand from that of the mark that it repeats.
    """
    marks = _Marks(shapes, tolerance)
    count = len(shapes)
    kind = np.full(count, -1, np.intp)
    turn, mirrored = np.zeros(count), np.zeros(count, bool)
    place = marks.centre.view(np.float64).reshape(-1, 2).copy()
    heads: list[int] = []
    for head in range(count):
        if kind[head] >= 0:
            continue
        kind[head] = len(heads)
        near = marks.near(head, np.flatnonzero((kind < 0) & (ink == ink[head])))
        for number, how in marks.copies(head, near).items():
            kind[number] = len(heads)
            turn[number], mirrored[number], place[number] = how
        heads.append(head)
    return Copies(np.array(heads, np.intp), kind, place, turn, mirrored)


class _Marks:
    """Marks and what is known of each that no move, turn or mirror changes."""

    def __init__(self, shapes: Geometries, tolerance: float) -> None:
        self.shapes, self.tolerance = shapes, tolerance
        self.area, self.length = shapely.area(shapes), shapely.length(shapes)
        self.holes = shapely.get_num_interior_rings(shapes)
        centre = shapely.get_coordinates(shapely.centroid(shapes))
        self.centre: Complex = np.ascontiguousarray(centre).view(np.complex128).ravel()
        self.harmonics, self.spread, self.radius = _harmonics(shapes, self.centre)
        self.outline = _sampled(shapes, self.centre)
        self.power = (np.abs(self.outline) ** 2).sum(axis=1)

    def near(self, head: int, others: Index) -> Index:
        """Return those of some marks that might be copies of one."""
        slack = self.tolerance * self.length[head]
        size = np.abs(self.area[others] - self.area[head]) <= slack
        # The mean square of the distance from the centre, brought to a length.
        wide = np.abs(np.sqrt(self.spread[others]) - np.sqrt(self.spread[head]))
        far = np.abs(self.radius[others] - self.radius[head])
        alike = size & (wide <= 2 * self.tolerance) & (far <= 4 * self.tolerance)
        found: Index = others[alike & (self.holes[others] == self.holes[head])]
        return found

    def copies(self, head: int, others: Index) -> dict[int, tuple[float, bool, tuple[float, float]]]:
        """Return which of some marks are copies of one, and how each of these lies."""
        found: dict[int, tuple[float, bool, tuple[float, float]]] = {}
        for mirrored in (False, True):
            some = np.array([each for each in others.tolist() if each not in found], np.intp)
            if not len(some):
                break
            blocks = [some[i : i + BLOCK] for i in range(0, len(some), BLOCK)]
            off, angle = np.hstack([self._turned(head, block, mirrored) for block in blocks])
            close = off <= ALIKE * self.tolerance
            for tries in self._angles(head, some[close], angle[close], mirrored):
                left = [i for i, each in enumerate(some[close].tolist()) if each not in found]
                rows = some[close][left]
                if not len(rows):
                    break
                turn = self._tidy(head, tries[left])
                same = self._same(head, rows, turn, mirrored)
                for row, degrees in zip(rows[same].tolist(), turn[same].tolist(), strict=True):
                    centre = complex(self.centre[row])
                    found[row] = degrees, mirrored, (centre.real, centre.imag)
        return found

    def _turned(self, head: int, others: Index, mirrored: bool) -> tuple[Floats, Floats]:
        """Return by how much outlines are off that of a mark at best (mm), and turned by what angle then."""
        mine = self.outline[head]
        spectrum = np.fft.fft(np.conj(mine)[::-1] if mirrored else mine)
        product = np.conj(spectrum) * np.fft.fft(self.outline[others], axis=1)
        at = np.fft.ifft(product, axis=1)
        best = np.abs(at).argmax(axis=1).astype(np.float64)
        step = 0.5
        peak = _shifted(product, best)
        for _ in range(12):
            # Between samples, the same sum with a shift that is no whole number.
            for side in (-step, step):
                there = _shifted(product, best + side)
                better = np.abs(there) > np.abs(peak)
                best, peak = np.where(better, best + side, best), np.where(better, there, peak)
            step /= 2
        squares = self.power[head] + self.power[others] - 2 * np.abs(peak)
        return np.sqrt(np.maximum(squares, 0.0) / SAMPLES), np.angle(peak)

    def _angles(self, head: int, others: Index, angle: Floats, mirrored: bool) -> list[Floats]:
        """Return turns (radians) to try, the likeliest first, as harmonics know them to the last bits."""
        mine = np.conj(self.harmonics[head]) if mirrored else self.harmonics[head]
        strength = np.abs(mine) * HARMONICS * (np.abs(mine) > FAINT)
        best = int(np.argmax(strength))
        # Round marks lie any way: as they are is the plainest.
        plain = np.zeros(len(others))
        if not strength[best]:
            return [plain, angle]
        fold = int(HARMONICS[best])
        product = np.zeros((len(others), TURNS), np.complex128)
        product[:, HARMONICS] = np.conj(mine) * self.harmonics[others]
        # Where all of them agree best: the sum over k of e^(-ik·turn) times each product.
        guess = np.fft.fft(product, axis=1).real.argmax(axis=1) * (2 * np.pi / TURNS)
        exact = np.angle(self.harmonics[others, best] / mine[best]) / fold
        step = 2 * np.pi / fold

        def nearest(to: Floats) -> Floats:
            return np.asarray(exact + step * np.rint((to - exact) / step))

        likely = [plain, nearest(angle), nearest(np.asarray(guess, np.float64)), angle]
        return likely + [likely[1] + step * k for k in range(1, min(fold, MOST_TRIED))]

    def _tidy(self, head: int, angle: Floats) -> Floats:
        """Return angles (radians) as degrees in (−180, 180], those all but a multiple of 15 made one."""
        degrees = np.degrees(angle)
        near = np.rint(degrees / UPRIGHT) * UPRIGHT
        slack = np.degrees(self.tolerance / 8 / max(self.radius[head], 1e-9))
        degrees = np.where(np.abs(degrees - near) <= slack, near, np.round(degrees, 6))
        wrapped = -((-degrees + 180.0) % 360.0 - 180.0)
        return np.asarray(wrapped + 0.0)

    def _same(self, head: int, others: Index, degrees: Floats, mirrored: bool) -> Mask:
        """Tell which marks a mark is, when it is laid over them."""
        own = shapely.transform(
            self.shapes[head],
            lambda xy: xy - [self.centre[head].real, self.centre[head].imag],
        )
        maps = [
            posed(turn, mirrored, (float(at.real), float(at.imag)))
            for turn, at in zip(degrees.tolist(), self.centre[others].tolist(), strict=True)
        ]
        laid = Affines.of(maps).apply(np.array([own], dtype=object))
        return same(laid, self.shapes[others], self.tolerance)


def same(one: Geometries, other: Geometries, tolerance: float) -> Mask:
    """Tell of each two polygons whether one draws what the other does.

    Their outlines are within twice the tolerance (mm) of one another everywhere, since both may be off by it,
    and the area by which they differ is that of a band along the outline half as broad as the tolerance.
    """
    if not len(one):
        return np.zeros(0, bool)
    near = np.ones(len(one), bool)
    few = shapely.get_num_coordinates(one) * shapely.get_num_coordinates(other) <= MOST_CLOSE
    outlines = shapely.boundary(one[few]), shapely.boundary(other[few])
    near[few] = shapely.hausdorff_distance(*outlines) <= 2 * tolerance
    apart = shapely.area(shapely.symmetric_difference(one[near], other[near]))
    near[near] = apart <= tolerance / 2 * shapely.length(one[near])
    return near


def _shifted(product: Complex, shift: Floats) -> Complex:
    """Return the correlation at shifts that need not be whole numbers of samples, one of each row."""
    frequency = np.fft.fftfreq(SAMPLES)
    return np.asarray((product * np.exp(2j * np.pi * frequency * shift[:, None])).mean(axis=1))


def _sampled(shapes: Geometries, centre: Complex) -> Complex:
    """Return the outer rings of polygons at even distances, about their centres, anticlockwise."""
    found = np.empty((len(shapes), SAMPLES), np.complex128)
    share = np.arange(SAMPLES) / SAMPLES
    for row, ring in enumerate(shapely.get_exterior_ring(shapely.orient_polygons(shapes))):
        xy = shapely.get_coordinates(ring)
        at = xy[:, 0] + 1j * xy[:, 1]
        way = np.append(0.0, np.cumsum(np.abs(np.diff(at))))
        found[row] = np.interp(share * way[-1], way, at)
    return found - centre[:, None]


def _harmonics(shapes: Geometries, centre: Complex) -> tuple[Complex, Floats, Floats]:
    """Return the harmonics of the outlines of polygons about their centres, as shares of what they could be
    at most, shape (n, k); the mean square of the distance from it, and the greatest distance (mm).
    """
    rings, owner = shapely.get_rings(shapely.orient_polygons(shapes), return_index=True)
    xy, ring = shapely.get_coordinates(rings, return_index=True)
    at = xy[:, 0] + 1j * xy[:, 1] - centre[owner[ring]]
    inner = ring[1:] == ring[:-1]
    begin, end, of = at[:-1][inner], at[1:][inner], owner[ring[:-1][inner]]
    middle, half = (begin + end) / 2, (end - begin) / 2
    z = middle[:, None] + half[:, None] * NODES
    count = len(shapes)
    radius = np.zeros(count)
    np.maximum.at(radius, of, np.abs(begin))
    # By Green's theorem ∫ z·z̄ dA = 1/(4i) ∮ z·z̄² dz.
    inertia = np.imag(((z * np.conj(z) ** 2) * WEIGHTS).sum(axis=1) * half) / 4
    spread = np.bincount(of, inertia, count) / np.maximum(shapely.area(shapes), 1e-300)
    weight = np.abs(z) * WEIGHTS * np.abs(half)[:, None]
    unit = z / np.maximum(np.abs(z), 1e-300)
    whole = np.maximum(np.bincount(of, weight.sum(axis=1), count), 1e-300)
    found = np.empty((count, len(HARMONICS)), np.complex128)
    turned = weight.astype(np.complex128)
    for column in range(len(HARMONICS)):
        turned = turned * unit
        each = turned.sum(axis=1)
        found[:, column] = np.bincount(of, each.real, count) + 1j * np.bincount(of, each.imag, count)
    return found / whole[:, None], np.maximum(spread, 0.0), radius
