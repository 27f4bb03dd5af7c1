"""Regions under iterated similarities: Hutchinson's union of images, and what is added at every level."""

from __future__ import annotations

import math
from types import MappingProxyType

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Geometries, Points
from batik_vector.values import frozen

Complex = NDArray[np.complex128]

THIRD = math.sqrt(3) / 2
GRID = 1e-10
"""Step of the grid on which images that share sides are united, as a share of the whole."""


def _corners(count: int, radius: float, turn: float = 90.0) -> tuple[complex, ...]:
    angle = np.radians(turn + 360 / count * np.arange(count))
    return tuple((radius * np.exp(1j * angle)).tolist())


@frozen
class System:
    """Similarities z ↦ factor·z + shift, and the region that they carry.

    With ``added`` the images of each level are added to those before: S ← region ∪ ⋃ F_i(S). ``meets`` says
    whether images share more than points.
    """

    region: tuple[complex, ...]
    factors: tuple[complex, ...]
    shifts: tuple[complex, ...]
    source: str
    most: int
    added: bool = False
    meets: bool = True


def _scaled(corners: tuple[complex, ...], factor: float) -> tuple[tuple[complex, ...], tuple[complex, ...]]:
    return (factor + 0j,) * len(corners), tuple(z * (1 - factor) for z in corners)


_TRIANGLE = _corners(3, 1 / math.sqrt(3))
_SQUARE = tuple(z / math.sqrt(2) for z in _corners(4, 1.0, 45))
_CARPET = tuple(complex(x, y) / 3 for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y)
_CROSS = tuple(complex(x, y) / 3 for x, y in ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)))
_HEXAGON = _corners(6, 0.5, 0)

SYSTEMS = MappingProxyType(
    {
        "sierpinski-triangle": System(
            _TRIANGLE, *_scaled(_TRIANGLE, 0.5), "Sierpiński (1915); Hutchinson (1981)", 9, meets=False
        ),
        "sierpinski-carpet": System(_SQUARE, (1 / 3 + 0j,) * 8, _CARPET, "Sierpiński (1916)", 5),
        "vicsek": System(_SQUARE, (1 / 3 + 0j,) * 5, _CROSS, "Vicsek (1983)", 6),
        "hexaflake": System(
            _HEXAGON,
            (1 / 3 + 0j,) * 7,
            (0j, *(z * 4 / 3 for z in _HEXAGON)),
            "https://en.wikipedia.org/wiki/N-flake",
            5,
        ),
        "koch": System(
            _TRIANGLE, (), (), "von Koch (1904); Barnsley (1988), condensation sets", 6, added=True
        ),
    }
)
"""Sierpinski's triangle and carpet, Vicsek's cross, the flake of hexagons, and Koch's island."""


def count_of(name: str, level: int) -> int:
    """Return of how many images of the region a level consists."""
    system = SYSTEMS[name]
    if system.added:
        return int(4**level)
    return int(len(system.factors) ** level)


def region_of(name: str, level: int) -> Geometries:
    """Return the region of a level, 1 broad about the origin."""
    system = SYSTEMS[name]
    if system.added:
        shapes = _koch(level)
    else:
        factor, shift = np.ones(1, complex), np.zeros(1, complex)
        factors, shifts = np.array(system.factors), np.array(system.shifts)
        for _ in range(level):
            factor, shift = (
                (factors[:, None] * factor[None]).ravel(),
                (factors[:, None] * shift[None] + shifts[:, None]).ravel(),
            )
        shapes = factor[:, None] * np.array(system.region) + shift[:, None]
    areas = shapely.polygons(_points(shapes))
    if system.meets and len(shapes) > 1:
        areas = polygonal(np.array([shapely.union_all(areas, grid_size=GRID)], dtype=object))
        areas = np.asarray(shapely.simplify(areas, 4 * GRID), dtype=object)
    return oriented(np.asarray(areas, dtype=object))


def _koch(level: int) -> Complex:
    """Return the outline of Koch's island: at every level a triangle more on each side."""
    begin = np.array(_TRIANGLE)
    for _ in range(level):
        third = (np.roll(begin, -1) - begin) / 3
        a, b = begin + third, begin + 2 * third
        tip = a + third * np.exp(-1j * math.pi / 3)
        begin = np.stack([begin, a, tip, b], axis=1).ravel()
    return begin[None]


def _points(shapes: Complex) -> Points:
    return np.stack([shapes.real, shapes.imag], axis=-1)
