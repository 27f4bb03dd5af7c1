"""The flower of a drawing: its rings told apart as petals, pistils and ornaments, by their geometry alone.

What a ring is goes by size and place. The petals are the ring that covers most; rings of marks nearly as large, or of
the same shape, are petals too, and rings of petals that reach equally far are one layer. Pistils are slim marks that
point to the centre, on the petals or between them. The rest are ornaments.
"""

from __future__ import annotations

import enum
import math
from collections import Counter
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.analysis.marks import Indices, Marks, Numbers, Place, alike
from batik_vector.analysis.petal_shape import PetalShape, petal_shape
from batik_vector.analysis.rings import COVER, Ring, Rosette
from batik_vector.values import frozen

AS_LARGE, AS_LONG = 0.3, 0.2
"""The least area of a petal against that of the main ones, and its length where it has their shape."""

SLIM, POINTING = 0.55, math.cos(math.radians(2 * 35))
"""The breadth of a pistil at the most, as a share of its length, and how far from the radius it may point."""

SMALL = 0.4
"""The area of a pistil at the most, as a share of a petal's."""

LEVEL = 0.08
"""How far the tips of one layer's petals may be apart, as a share of their reach."""

WITHIN = 0.75
"""The share of a ring's marks that have to lie on others' for the ring to lie on theirs."""

LOOKED_AT = 5
"""Petals of a ring whose shape is looked at; most of them decide."""

ODD_SIZE = 2.0
"""How many times larger or smaller than the others an odd mark of a ring may be."""


class Role(enum.StrEnum):
    """What a ring is in its flower."""

    PETAL = "petal"
    PISTIL = "pistil"
    ORNAMENT = "ornament"


@frozen(eq=False)
class Part:
    """A ring in its flower: its marks by number, its role, and its radii (mm, medians over the marks).

    ``on`` is the number of the part on whose marks these lie, ``inset`` says that they repeat that part's shape.
    """

    marks: Indices
    kind: int
    order: int
    role: Role
    inner: float
    outer: float
    on: int | None = None
    inset: bool = False


@frozen(eq=False)
class PetalLayer:
    """A layer of petals: how many, of which shapes, how far they reach (mm), and of which parts."""

    count: int
    shapes: tuple[PetalShape, ...]
    outer: float
    parts: tuple[int, ...]


@frozen(eq=False)
class Flower:
    """A flower about ``centre`` (mm), reaching ``reach`` mm. ``marks`` are all that belong to it, by number.

    ``layers`` go from the outermost inwards. ``pistils`` are how many a petal has, of the layers that have any.
    ``elements`` is the number of types among what is repeated.
    """

    centre: Place
    reach: float
    marks: Indices
    parts: tuple[Part, ...]
    layers: tuple[PetalLayer, ...]
    pistils: tuple[float, ...]
    elements: int


def flower_of(marks: Marks, rosette: Rosette) -> Flower | None:
    """Return the flower about a point, None where nothing there is a petal."""
    inner, outer = _radii(marks, rosette.centre)
    rings = [ring for ring in rosette.rings if np.median(inner[ring.members]) < 0.98 * rosette.reach]
    reach = max((float(np.median(outer[ring.members])) for ring in rings if ring.cover >= COVER), default=0.0)
    rings = [ring for ring in rings if np.median(outer[ring.members]) <= 1.02 * reach]
    if not rings:
        return None
    near = np.hypot(*(marks.places - rosette.centre).T)
    mine = np.flatnonzero((near < reach) & (outer <= 1.15 * reach))
    members = _with_odd_ones(marks, rings, mine, near, inner, outer)
    parts = _parts(marks, rosette.centre, rings, members, inner, outer)
    layers = _layers(marks, rosette.centre, parts, outer)
    if not layers:
        return None
    reach = max(reach, max(float(outer[part.marks].max()) for part in parts))
    return Flower(
        rosette.centre, reach, mine, tuple(parts), layers, _pistils(parts, layers), _elements(marks, parts, layers)
    )


def _radii(marks: Marks, centre: Place) -> tuple[Numbers, Numbers]:
    """Return how near marks come to a point and how far they reach, by their vertices."""
    xy, owner = shapely.get_coordinates(marks.outlines, return_index=True)
    away = np.hypot(*(xy - centre).T)
    first = np.searchsorted(owner, np.arange(len(marks)))
    return np.minimum.reduceat(away, first), np.maximum.reduceat(away, first)


def _with_odd_ones(
    marks: Marks, rings: Sequence[Ring], mine: Indices, near: Numbers, inner: Numbers, outer: Numbers
) -> list[Indices]:
    """Return the marks of each ring with those that fill its gaps: a petal of another shape is still a petal."""
    members = [ring.members for ring in rings]
    taken = np.unique(np.concatenate(members))
    for mark in np.setdiff1d(mine, taken).tolist():
        for number, ring in enumerate(rings):
            low, high = float(np.median(inner[ring.members])), float(np.median(outer[ring.members]))
            larger = float(marks.sizes[mark] ** 2 / np.median(marks.sizes[ring.members] ** 2))
            fits = 1 / ODD_SIZE <= larger <= ODD_SIZE and low < near[mark] < high
            apart = np.hypot(*(marks.places[ring.members] - marks.places[mark]).T).min()
            if fits and len(members[number]) < ring.order and apart > 0.6 * ring.spacing:
                members[number] = np.append(members[number], mark)
                break
    return members


def _parts(
    marks: Marks, centre: Place, rings: Sequence[Ring], members: Sequence[Indices], inner: Numbers, outer: Numbers
) -> list[Part]:
    """Return the rings with their roles, the largest marks first."""
    area = np.array([float(np.median(marks.sizes[each] ** 2)) for each in members])
    lies_on = _lying_on(marks, members, area)
    total = area * [len(each) for each in members] * np.array([on is None for on in lies_on])
    main = int(np.argmax(total))
    petals = [
        number == main or (lies_on[number] is None and _petal_like(marks, members[number], members[main]))
        for number in range(len(rings))
    ]
    parts = []
    for number, each in enumerate(members):
        on = lies_on[number]
        role, inset = Role.ORNAMENT, False
        if petals[number]:
            role = Role.PETAL
        elif on is not None and petals[on] and _same_shape(marks, each, members[on]):
            inset = True
        elif _pistil_like(marks, centre, each, members[main]):
            beside = any(
                petals[other]
                and np.median(inner[members[other]]) < np.median(outer[each]) <= 1.1 * np.median(outer[members[other]])
                for other in range(len(rings))
            )
            role = Role.PISTIL if on is not None and petals[on] or (on is None and beside) else role
        radii = float(np.median(inner[each])), float(np.median(outer[each]))
        parts.append(Part(each, rings[number].kind, rings[number].order, role, *radii, on, inset))
    return parts


def _lying_on(marks: Marks, members: Sequence[Indices], area: Numbers) -> list[int | None]:
    """Return for each ring on the marks of which other, larger ones its marks lie: the smallest of them."""
    every = np.concatenate(members)
    owner = np.repeat(np.arange(len(members)), [len(each) for each in members])
    # A mark may be bent round its centroid; some point within it tells where it lies.
    points = shapely.point_on_surface(marks.outlines[every])
    point, cover = shapely.STRtree(marks.outlines[every]).query(points, predicate="within")
    found: list[int | None] = []
    for number, each in enumerate(members):
        mine = owner[point] == number
        others = {
            other: len(np.unique(point[mine & (owner[cover] == other)])) / len(each)
            for other in np.unique(owner[cover[mine]]).tolist()
            if other != number and area[other] > area[number]
        }
        holding = [other for other, share in others.items() if share >= WITHIN]
        found.append(min(holding, key=lambda other: area[other], default=None))
    return found


def _same_shape(marks: Marks, one: Indices, other: Indices) -> bool:
    return bool(alike(marks, one[:1], other[:1], size=None)[0])


def _petal_like(marks: Marks, ring: Indices, main: Indices) -> bool:
    size = float(np.median(marks.sizes[ring]) / np.median(marks.sizes[main]))
    return size**2 >= AS_LARGE or (size >= AS_LONG and _same_shape(marks, ring, main))


def _pistil_like(marks: Marks, centre: Place, ring: Indices, main: Indices) -> bool:
    """Whether marks are slim, small, and point to the centre."""
    slim = float(np.median(marks.slimness[ring])) <= SLIM
    small = float(np.median(marks.sizes[ring] ** 2)) <= SMALL * float(np.median(marks.sizes[main] ** 2))
    out = marks.places[ring] - centre
    along = (marks.ways[ring] * out).sum(axis=1) ** 2 / (out * out).sum(axis=1)
    return slim and small and float(np.median(2 * along - 1)) >= POINTING


def _layers(marks: Marks, centre: Place, parts: Sequence[Part], outer: Numbers) -> tuple[PetalLayer, ...]:
    """Return the layers of petals, the outermost first."""
    petals = sorted((n for n, part in enumerate(parts) if part.role == Role.PETAL), key=lambda n: -parts[n].outer)
    layers: list[list[int]] = []
    for number in petals:
        if layers and parts[layers[-1][0]].outer - parts[number].outer <= LEVEL * parts[layers[-1][0]].outer:
            layers[-1].append(number)
        else:
            layers.append([number])
    found = []
    for layer in layers:
        shapes: list[PetalShape] = []
        for number in layer:
            mine = parts[number].marks
            some = mine[:: -(-len(mine) // LOOKED_AT)]
            (shape, _), *_ = Counter(petal_shape(each, centre) for each in marks.outlines[some]).most_common()
            if shape not in shapes:
                shapes.append(shape)
        count = sum(len(parts[number].marks) for number in layer)
        found.append(PetalLayer(count, tuple(shapes), parts[layer[0]].outer, tuple(layer)))
    return tuple(found)


def _pistils(parts: Sequence[Part], layers: Sequence[PetalLayer]) -> tuple[float, ...]:
    """Return how many pistils a petal has, for each layer that has any."""
    counts = [0] * len(layers)
    for part in parts:
        if part.role == Role.PISTIL:
            on = [n for n, layer in enumerate(layers) if part.on in layer.parts]
            # Those between petals belong to the layer that reaches as far or farther.
            reaching = [n for n, layer in enumerate(layers) if layer.outer * 1.1 >= part.outer]
            counts[(on or reaching[-1:] or [0])[0]] += len(part.marks)
    return tuple(count / layer.count for count, layer in zip(counts, layers, strict=True) if count)


def _elements(marks: Marks, parts: Sequence[Part], layers: Sequence[PetalLayer]) -> int:
    """Return how many types there are: rings of one shape and role are one, and so is a layer of petals."""
    type_of = list(range(len(parts)))

    def join(one: int, other: int) -> None:
        old, new = type_of[one], type_of[other]
        type_of[:] = [new if each == old else each for each in type_of]

    for layer in layers:
        for number in layer.parts[1:]:
            join(number, layer.parts[0])
    for number, part in enumerate(parts):
        if part.inset and part.on is not None:
            join(number, part.on)
        for other in range(number):
            if part.role == parts[other].role and _same_shape(marks, part.marks, parts[other].marks):
                join(number, other)
    return len(set(type_of))


def within(marks: Marks, flower: Flower) -> NDArray[np.bool_]:
    """Return which marks belong to a flower."""
    mine = np.zeros(len(marks), bool)
    mine[flower.marks] = True
    return mine
