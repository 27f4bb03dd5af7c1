"""The flower of a drawing: its rings told apart as petals, pistils and ornaments, by their geometry alone.

What a ring is goes by size and place. The petals are the ring that covers most; rings of marks nearly as
large, or of the same shape, are petals too, and rings of petals that reach equally far are one layer. Pistils
are slim marks that point to the centre, on the petals or between them. The rest are ornaments.
"""

from __future__ import annotations

import enum
import math
from collections import Counter
from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.analysis.marks import Indices, Marks, Numbers, Place, alike
from batik_vector.analysis.petal_shape import PetalShape, petal_shape
from batik_vector.analysis.rings import COVER, Ring, Rosette
from batik_vector.values import frozen

AS_LARGE, AS_LONG = 0.3, 0.2
"""The least area of a petal against that of the main ones, and its length where it has their shape."""

SLIM, POINTING = 0.55, math.cos(math.radians(2 * 35))
"""The breadth of a pistil at the most, as a share of its length, and how far from the radius it may point."""

FOLLOWING, PEEPING, TIPS = 1.12, 0.9, 1.005
"""Where a farther layer of petals begins at the most, and a ring of leaves, and where what lies within the
tips ends, against the reach of the petals."""

CRUMB = 0.004
"""The area of marks, as a share of a petal's, below which they are what cuts have left over."""

FIELD = 0.2
"""The area of a petal's inner field, in another ink, at the least, as a share of the petal's."""

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

    ``on`` is the number of the lowest part on whose marks these lie, ``inset`` says that they are the inner
    fields of petals: the same element in another ink.
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
    """A flower about ``centre`` (mm), reaching ``reach`` mm.

    ``layers`` go from the outermost inwards. ``pistils`` are the numbers of them that petals have, in the
    layers that have any. ``elements`` is the number of types among what is repeated.
    """

    centre: Place
    reach: float
    parts: tuple[Part, ...]
    layers: tuple[PetalLayer, ...]
    pistils: tuple[float, ...]
    elements: int


def flower_of(marks: Marks, rosette: Rosette) -> Flower | None:
    """Return the flower about a point, None where nothing there is a petal."""
    inner, outer = _radii(marks, rosette.centre)
    rings, reach = _reaching(marks, rosette, inner, outer)
    if not rings:
        return None
    near = np.hypot(*(marks.places - rosette.centre).T)
    members = _with_odd_ones(marks, rings, near, inner, outer)
    parts = _parts(marks, rosette.centre, rings, members, inner, outer)
    layers = _layers(marks, rosette.centre, parts)
    reach = max(reach, max(float(outer[parts[n].marks].max()) for layer in layers for n in layer.parts))
    elements = _elements(marks, parts, layers)
    return Flower(rosette.centre, reach, tuple(parts), layers, _pistils(marks, parts, layers), elements)


def _reaching(marks: Marks, rosette: Rosette, inner: Numbers, outer: Numbers) -> tuple[list[Ring], float]:
    """Return the rings of the flower about a point, and how far its petals reach.

    From the ring that covers most on, rings of petals belong to it that begin where it ends, or nearly, other
    closed rings that peep out from between its petals, and all that lies within their tips. What stands
    farther out is the ground's.
    """

    def area(ring: Ring) -> float:
        return float((marks.sizes[ring.members] ** 2).sum())

    closed = [ring for ring in rosette.rings if ring.cover >= COVER]
    if not closed:
        return [], 0.0
    # Marks in mirrored pairs, as wings of butterflies round a flower, are petals where there are no others.
    single = [ring for ring in closed if len(ring.members) <= ring.order]
    main = max(single or closed, key=area)
    reach = float(np.median(outer[main.members]))
    for ring in sorted(closed, key=lambda ring: float(np.median(inner[ring.members]))):
        follows = FOLLOWING if _petal_like(marks, ring.members, main.members) else PEEPING
        if np.median(inner[ring.members]) <= follows * reach:
            reach = max(reach, float(np.median(outer[ring.members])))
    crumb = CRUMB * float(np.median(marks.sizes[main.members] ** 2))
    rings = [
        ring
        for ring in rosette.rings
        if np.median(outer[ring.members]) <= TIPS * reach
        and np.median(marks.sizes[ring.members] ** 2) >= crumb
    ]
    return rings, reach


def _radii(marks: Marks, centre: Place) -> tuple[Numbers, Numbers]:
    """Return how near marks come to a point and how far they reach, by their vertices."""
    xy, owner = shapely.get_coordinates(marks.outlines, return_index=True)
    away = np.hypot(*(xy - centre).T)
    first = np.searchsorted(owner, np.arange(len(marks)))
    return np.minimum.reduceat(away, first), np.maximum.reduceat(away, first)


def _with_odd_ones(
    marks: Marks, rings: Sequence[Ring], near: Numbers, inner: Numbers, outer: Numbers
) -> list[Indices]:
    """Return the marks of each ring with those that fill its gaps: an odd petal is still a petal."""
    members = [ring.members for ring in rings]
    taken = np.unique(np.concatenate(members))
    widest = max(float(np.median(outer[ring.members])) for ring in rings)
    for mark in np.setdiff1d(np.flatnonzero(near < widest), taken).tolist():
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
    marks: Marks,
    centre: Place,
    rings: Sequence[Ring],
    members: Sequence[Indices],
    inner: Numbers,
    outer: Numbers,
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
        on = root = lies_on[number]
        while root is not None and lies_on[root] is not None:
            root = lies_on[root]
        role, inset = Role.ORNAMENT, False
        if petals[number]:
            role = Role.PETAL
        elif (
            on is not None
            and petals[on]
            and len(each) == len(members[on])
            and area[number] >= FIELD * area[on]
        ):
            inset = True
        elif _pistil_like(marks, centre, each, members[main]):
            beside = any(
                petals[other]
                and np.median(inner[members[other]])
                < np.median(outer[each])
                <= 1.1 * np.median(outer[members[other]])
                for other in range(len(rings))
            )
            role = Role.PISTIL if (beside if root is None else petals[root]) else role
        radii = float(np.median(inner[each])), float(np.median(outer[each]))
        parts.append(Part(each, rings[number].kind, rings[number].order, role, *radii, root, inset))
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


def _layers(marks: Marks, centre: Place, parts: Sequence[Part]) -> tuple[PetalLayer, ...]:
    """Return the layers of petals, the outermost first."""
    petals = sorted(
        (n for n, part in enumerate(parts) if part.role == Role.PETAL), key=lambda n: -parts[n].outer
    )
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


def _pistils(marks: Marks, parts: Sequence[Part], layers: Sequence[PetalLayer]) -> tuple[float, ...]:
    """Return how many pistils petals have: every number that occurs in a layer that has any, ascending.

    Those on petals are counted petal by petal; those between them are shared out evenly.
    """
    found: set[float] = set()
    pistils = [part for part in parts if part.role == Role.PISTIL]
    for number, layer in enumerate(layers):
        on = [part.marks for part in pistils if part.on in layer.parts]
        # Those between petals belong to the innermost layer that reaches as far.
        beside = [
            len(part.marks)
            for part in pistils
            if part.on is None
            and number
            == max((n for n, each in enumerate(layers) if each.outer * 1.1 >= part.outer), default=0)
        ]
        if on or beside:
            petals = marks.outlines[np.concatenate([parts[each].marks for each in layer.parts])]
            upon = np.concatenate([*on, np.empty(0, np.intp)])
            points = shapely.point_on_surface(marks.outlines[upon])
            at = shapely.STRtree(petals).query(points, predicate="within")[1]
            found |= set((np.bincount(at, minlength=len(petals)) + sum(beside) / len(petals)).tolist())
    return tuple(sorted(found))


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
