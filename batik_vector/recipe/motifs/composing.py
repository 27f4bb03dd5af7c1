"""What the kinds of plants and animals share: named tables that become elements, bottom first."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator
from dataclasses import fields, replace
from typing import Annotated, TypeAlias

import numpy as np

from batik_vector.fields import Between, Length, Says, check
from batik_vector.geometry.curves import Blade, Curve, OutlineCurve
from batik_vector.geometry.maps.affine import unit_turn
from batik_vector.geometry.paths.bands import band
from batik_vector.geometry.paths.matrix import Matrix
from batik_vector.geometry.paths.outline import Outline, bounds_of, joined
from batik_vector.geometry.paths.shapes import ellipse
from batik_vector.geometry.paths.splines import through
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.element import Element, dressed
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.values import frozen

Keyed: TypeAlias = tuple[str, Element]
"""An element, and the key of the table of the motif that it is made of."""


@frozen(kw_only=True)
class Plate(Dress):
    """A part that lies on others: it keeps a line of ground to what is beneath, as a canting leaves it."""

    gap: Annotated[
        Annotated[Length, Between(0, 1000)] | None,
        Says("ground kept bare round it by cutting what lies beneath"),
    ] = 0.8


@frozen(kw_only=True)
class Isen(Dress):
    """What fills a part (*isen*): left bare of wax, or drawn where it names an ink."""

    treatment: Annotated[
        Treatment | None,
        Says("as any element's; left out, filled where it names an ink, and cut out if not"),
    ] = None  # type: ignore[assignment]

    def settled(self) -> Dress:
        """Return its look with the treatment known; in an ink it lies in what is beneath, not over it."""
        drawn = Treatment.AREA if self.ink else Treatment.CUT
        return replace(self, treatment=self.treatment or drawn).plain()

    def plain(self) -> Dress:
        """Return it as any element's look, its treatment being known."""
        gap = 0.0 if self.gap is None and self.treatment != Treatment.CUT else self.gap
        look = {each.name: getattr(self, each.name) for each in fields(Dress)}
        return Dress(**look | {"gap": gap})


class Composed:
    """A kind of motif whose elements are worked out from its parameters: see :meth:`compose`."""

    def __post_init__(self) -> None:
        check(self)
        self.parts()

    def compose(self) -> Iterator[Keyed]:
        """Yield its elements, bottom first, each with the key of its table."""
        raise NotImplementedError

    @functools.cached_property
    def _composed(self) -> tuple[Keyed, ...]:
        return tuple(self.compose())

    def parts(self) -> tuple[Element, ...]:
        """Return the elements that are drawn, bottom first."""
        return tuple(element for _, element in self._composed)

    def keys(self) -> tuple[str, ...]:
        """Return the keys of their tables, as ``parts`` has them."""
        return tuple(key for key, _ in self._composed)


class Banded(Composed):
    """A kind that is one link of a band, from x = 0 to 1: bands lie side by side where they are fitted."""

    @property
    def across(self) -> float:
        """How broad the band is, in links."""
        raise NotImplementedError


def part(
    key: str,
    look: Dress,
    shape: Curve | Outline | Iterable[Outline],
    *,
    name: str = "",
    count: int = 1,
    turn: float = 0.0,
    radius: float = 0.0,
    arc: float = 360.0,
    spin: float = 0.0,
    mirror: bool = False,
) -> Keyed:
    """Return an element in the look of the table ``key``, called after it when it has no other ``name``."""
    if not isinstance(shape, Curve):
        shape = OutlineCurve(shape if isinstance(shape, Outline) else joined(tuple(shape)))
    settled = look.settled() if isinstance(look, Isen) else look
    element = dressed(settled, name or key, shape, count, turn=turn, radius=radius, arc=arc)
    return key, replace(element, spin=spin, mirror=mirror) if spin or mirror else element


def outline_of(curve: Curve, pieces: int = 10) -> Outline:
    """Return a closed curve from the origin to a tip (at t = ½) and back as a spline of cubics."""
    t = np.arange(2 * pieces) / (2 * pieces)
    return through(curve.at(t), True, True, (0, pieces))


def similar(turn: float, scale: float = 1.0, at: tuple[float, float] = (0.0, 0.0)) -> Matrix:
    """Return the map that turns by degrees, scales and then shifts."""
    z = unit_turn(turn) * scale
    return z.real, z.imag, -z.imag, z.real, *at


def dot(at: tuple[float, float], radius: float) -> Outline:
    """Return a dot (*cecek*)."""
    return replace(ellipse(*at, radius, radius), closed=np.array([True]))


def dots(places: Points, radius: float | Array) -> list[Outline]:
    """Return dots at places, shape (n, 2)."""
    sizes = np.broadcast_to(radius, len(places)).tolist()
    return [dot((x, y), size) for (x, y), size in zip(places.tolist(), sizes, strict=True)]


def stroke(centre: Points, begin: float, end: float, swell: float = 0.0) -> Outline:
    """Return a line with a body whose half breadth goes from one to another, ``swell`` more amidst."""
    share = np.linspace(0, 1, len(centre))
    return band(centre, begin + (end - begin) * share + 4 * swell * share * (1 - share))


def direction(blade: Blade, share: float) -> float:
    """Return the direction of a blade's midrib at a share of its length, in degrees."""
    return blade.bend * share


def on(blade: Blade, share: float | Array, side: float | Array) -> Points:
    """Return places on a blade, ``side`` half breadths left of its midrib, shape (n, 2)."""
    shares, sides = np.broadcast_arrays(np.asarray(share, float), np.asarray(side, float))
    return blade.spread(np.atleast_1d(shares), np.atleast_1d(sides))


def rib(blade: Blade, begin: float, end: float, half: float) -> Outline:
    """Return a line along a blade's midrib, slim at its ends."""
    return stroke(on(blade, np.linspace(begin, end, 7), 0.0), 0.4 * half, 0.4 * half, 0.6 * half)


def fan(
    roots: Points, angles: Array, lengths: Array, blade: Blade, ray: float, begin: float = 0.3
) -> tuple[list[Outline], list[Outline]]:
    """Return a fan of blades and a line in each of them.

    Args:
        roots: where they begin, shape (n, 2).
        angles: where they point, in degrees, shape (n,).
        lengths: how much larger than ``blade`` each of them is, shape (n,).
        blade: the shape of all.
        ray: half the breadth of their lines, as a share of theirs; 0 leaves the lines out.
        begin: where these begin, as a share of the length.
    """
    shape = outline_of(blade)
    line = rib(blade, begin, 0.82, ray * blade.width) if ray else None
    places = [
        similar(angle, scale, (x, y))
        for (x, y), angle, scale in zip(roots.tolist(), angles.tolist(), lengths.tolist(), strict=True)
    ]
    return [shape.moved(f) for f in places], [line.moved(f) for f in places] if line else []


def centred(found: Iterable[Keyed]) -> list[Keyed]:
    """Return elements, drawn once where their outlines have them, with the middle of all in the origin."""
    keyed = list(found)
    outlines = [element.curve.outline() for _, element in keyed]
    bounds = np.array([bounds_of(outline) for outline in outlines if outline is not None])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    x, y = (-(low + high) / 2).tolist()
    return [
        (key, replace(element, curve=OutlineCurve(outline.moved(similar(0.0, 1.0, (x, y))))))
        for (key, element), outline in zip(keyed, outlines, strict=True)
        if outline is not None
    ]
