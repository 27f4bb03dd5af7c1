"""The seventeen wallpaper groups, one row each, under one function that multiplies them out.

Everything is exact: coordinates are fractions of the **rectangular translation cell**, width 1 and height
1, so that a cell of any size and any admissible stretch has the same operations. In a hexagonal cell,
whose sides are as 1 : √3, turns by 60° become rational there; a centred lattice counts the translation
by half of both sides among its generators.

Coordinate triplets and origins follow the International Tables for Crystallography, vol. A; orbifold
signatures are Conway's (Conway, Burgiel, Goodman-Strauss, "The Symmetries of Things", 2008).
"""

from __future__ import annotations

import enum
import functools
import itertools
import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from fractions import Fraction

from batik_vector.errors import UnknownNameError
from batik_vector.values import frozen

Pair = tuple[Fraction, Fraction]
"""A point or a shift in fractions of the cell's width and height."""

MOST_OPERATIONS = 10_000
"""Past this many operations, what was to be multiplied out is no group modulo its lattice."""


class Kind(enum.StrEnum):
    """What a group asks of its rectangular cell."""

    ANY = "any"
    """A rectangle of any shape."""
    SQUARE = "square"
    """As high as it is wide."""
    HEXAGONAL = "hexagonal"
    """√3 times as high as it is wide; its lattice is centred."""

    @property
    def ratio(self) -> float | None:
        """Height over width, where the group asks for one."""
        return {Kind.ANY: None, Kind.SQUARE: 1.0, Kind.HEXAGONAL: 3**0.5}[self]


@frozen
class Operation:
    """A Seitz operator (A | t): p ↦ A·p + t, with A = [[a, b], [c, d]] and t = (e, f), in fractions.

    ``one @ other`` applies ``other`` first.
    """

    a: Fraction
    b: Fraction
    c: Fraction
    d: Fraction
    e: Fraction
    f: Fraction

    @property
    def linear(self) -> tuple[Fraction, Fraction, Fraction, Fraction]:
        """The matrix A, row by row."""
        return self.a, self.b, self.c, self.d

    @property
    def shift(self) -> Pair:
        """The translation t."""
        return self.e, self.f

    def turned(self, point: Pair) -> Pair:
        """Return A·p."""
        return self.a * point[0] + self.b * point[1], self.c * point[0] + self.d * point[1]

    def at(self, point: Pair) -> Pair:
        """Return A·p + t."""
        x, y = self.turned(point)
        return x + self.e, y + self.f

    def __matmul__(self, first: Operation) -> Operation:
        """Return the operator that applies ``first`` and then this one."""
        (a, c), (b, d) = self.turned((first.a, first.c)), self.turned((first.b, first.d))
        return Operation(a, b, c, d, *self.at(first.shift))

    def inverse(self) -> Operation:
        """Return the operator that undoes this one."""
        det = self.a * self.d - self.b * self.c
        back = replace(self, a=self.d / det, b=-self.b / det, c=-self.c / det, d=self.a / det)
        x, y = back.turned(self.shift)
        return replace(back, e=-x, f=-y)

    def reduced(self, modulo: Callable[[Pair], Pair]) -> Operation:
        """Return the operator with its translation brought to one representative."""
        e, f = modulo(self.shift)
        return replace(self, e=e, f=f)

    def transposed(self) -> Operation:
        """Return the operator with the two axes exchanged."""
        return Operation(self.d, self.c, self.b, self.a, self.f, self.e)


_TERM = re.compile(r"([+-]?)(\d*)([xy]?)(?:/(\d+))?")


@functools.cache
def parse_operation(text: str) -> Operation:
    """Return the operator of a coordinate pair: ``"1/2 - x, y + 1/2"``, ``"x/2 - 3y/2, x/2 + y/2"``."""
    rows = []
    for part in text.replace(" ", "").split(","):
        row = {"x": Fraction(0), "y": Fraction(0), "": Fraction(0)}
        for sign, number, name, divisor in _TERM.findall(part):
            if number or name:
                row[name] += Fraction(int(sign + (number or "1")), int(divisor or 1))
        rows.append(row)
    (first, second) = rows
    return Operation(first["x"], first["y"], second["x"], second["y"], first[""], second[""])


IDENTITY = parse_operation("x, y")


def whole_cells(point: Pair) -> Pair:
    """Reduce modulo the rectangular lattice: both fractions in [0, 1)."""
    return point[0] % 1, point[1] % 1


def multiplied(
    generators: Iterable[Operation], modulo: Callable[[Pair], Pair] = whole_cells
) -> tuple[Operation, ...]:
    """Return the group that operations generate, one of each class modulo a lattice, the identity first.

    Args:
        generators: of the group, the lattice's own translations left out.
        modulo: brings a translation to its representative modulo the lattice.

    Raises:
        ValueError: where they generate no group that is finite modulo the lattice.
    """
    steps = list(generators)
    made = {IDENTITY: None}
    fresh = [IDENTITY]
    while fresh:
        products = [(each @ step).reduced(modulo) for each in fresh for step in steps]
        fresh = [each for each in dict.fromkeys(products) if each not in made]
        made |= dict.fromkeys(fresh)
        if len(made) > MOST_OPERATIONS:
            raise ValueError("the operations generate no group modulo the lattice")
    return tuple(made)


@frozen(eq=False)
class Group:
    """A wallpaper group in its rectangular cell.

    Attributes:
        name: the short international symbol in its customary spelling (p4m for p4mm).
        orbifold: Conway's signature.
        others: further names it goes by.
        kind: what it asks of the cell's shape.
        generators: with the lattice of whole cells they generate the group; the translation by half of
            both sides is among them where the lattice is centred.
        region: corners of a fundamental region, anticlockwise, convex: its images fill the cell once.
    """

    name: str
    orbifold: str
    others: tuple[str, ...]
    kind: Kind
    generators: tuple[Operation, ...]
    region: tuple[Pair, ...]

    @functools.cached_property
    def operations(self) -> tuple[Operation, ...]:
        """One operator of each class modulo whole cells, the identity first: as many as there are copies
        in a rectangle."""
        return multiplied(self.generators)

    @property
    def copies(self) -> int:
        """Copies of an asymmetric motif in one rectangle."""
        return len(self.operations)

    @property
    def translations(self) -> frozenset[Pair]:
        """The translations among the operations, modulo whole cells."""
        return frozenset(each.shift for each in self.operations if each.linear == IDENTITY.linear)

    @property
    def centre(self) -> Pair:
        """The centroid of the fundamental region: on no mirror and no centre of rotation."""
        origin, *rest = self.region
        area, x, y = Fraction(0), Fraction(0), Fraction(0)
        for p, q in itertools.pairwise(rest):
            twice = _cross(_minus(p, origin), _minus(q, origin))
            area += twice
            x += twice * (origin[0] + p[0] + q[0])
            y += twice * (origin[1] + p[1] + q[1])
        return x / (3 * area), y / (3 * area)

    def edges(self) -> tuple[tuple[Pair, Pair], ...]:
        """Return the edges of the region, each from its corner to the next."""
        return tuple(zip(self.region, (*self.region[1:], self.region[0]), strict=True))

    def mirrored_edges(self) -> tuple[bool, ...]:
        """Return for each edge of the region whether it lies on a mirror."""
        return tuple(self._on_mirror(p, q) for p, q in self.edges())

    def _on_mirror(self, p: Pair, q: Pair) -> bool:
        """Whether an operation other than the identity leaves both points where they are."""
        for each in self.operations:
            if each.linear == IDENTITY.linear:
                continue
            move = _minus(p, each.at(p))
            if move == whole_numbers(move) and _minus(q, each.at(q)) == move:
                return True
        return False

    def transposed(self) -> Group:
        """Return the group with the two axes exchanged."""
        return replace(
            self,
            generators=tuple(each.transposed() for each in self.generators),
            region=tuple((y, x) for x, y in reversed(self.region)),
        )


def whole_numbers(point: Pair) -> Pair:
    """Return the point with both coordinates rounded down."""
    return Fraction(point[0] // 1), Fraction(point[1] // 1)


def _minus(p: Pair, q: Pair) -> Pair:
    return p[0] - q[0], p[1] - q[1]


def _cross(p: Pair, q: Pair) -> Fraction:
    return p[0] * q[1] - p[1] * q[0]


_fraction = functools.cache(Fraction)


def _row(name: str, orbifold: str, others: str, kind: Kind, generators: str, region: str) -> Group:
    corners = [corner.split(",") for corner in region.split()]
    return Group(
        name,
        orbifold,
        tuple(others.split()),
        kind,
        tuple(parse_operation(each) for each in generators.split(";") if each.strip()),
        tuple((_fraction(x), _fraction(y)) for x, y in corners),
    )


_HALF_TURN = "-x, -y"
_QUARTER_TURN = "-y, x"
_UPRIGHT = "-x, y"
"""The reflection in an upright mirror."""
_LEVEL = "x, -y"
_CENTRED = "x + 1/2, y + 1/2"
_THIRD_TURN = f"-x/2 - 3y/2, x/2 - y/2; {_CENTRED}"
_SIXTH_TURN = f"x/2 - 3y/2, x/2 + y/2; {_CENTRED}"

_WHOLE = "0,0 1,0 1,1 0,1"
_LEFT = "0,0 1/2,0 1/2,1 0,1"
_QUARTER = "0,0 1/2,0 1/2,1/2 0,1/2"
_KITE = "0,0 1,0 1/2,1/6"
"""From a centre of rotation to the next and to a three-fold centre between them."""

GROUPS: dict[str, Group] = {
    group.name: group
    for group in (
        _row("p1", "o", "p111", Kind.ANY, "", _WHOLE),
        _row("p2", "2222", "p211", Kind.ANY, _HALF_TURN, _LEFT),
        _row("pm", "**", "p1m1 p1m", Kind.ANY, _UPRIGHT, _LEFT),
        _row("pg", "××", "p1g1 p1g", Kind.ANY, "-x, y + 1/2", _LEFT),
        _row("cm", "*×", "c1m1 c1m", Kind.ANY, f"{_UPRIGHT}; {_CENTRED}", _QUARTER),
        _row("pmm", "*2222", "p2mm", Kind.ANY, f"{_UPRIGHT}; {_LEVEL}", _QUARTER),
        _row(
            "pmg",
            "22*",
            "p2mg",
            Kind.ANY,
            f"{_HALF_TURN}; 1/2 - x, y",
            "1/4,0 3/4,0 3/4,1/2 1/4,1/2",
        ),
        _row("pgg", "22×", "p2gg", Kind.ANY, f"{_HALF_TURN}; 1/2 - x, y + 1/2", _QUARTER),
        _row("cmm", "2*22", "c2mm", Kind.ANY, f"{_UPRIGHT}; {_LEVEL}; {_CENTRED}", "0,0 1/2,0 1/2,1/4 0,1/4"),
        _row("p4", "442", "p411", Kind.SQUARE, _QUARTER_TURN, _QUARTER),
        _row("p4m", "*442", "p4mm", Kind.SQUARE, f"{_QUARTER_TURN}; {_UPRIGHT}", "0,0 1/2,0 1/2,1/2"),
        _row("p4g", "4*2", "p4gm", Kind.SQUARE, f"{_QUARTER_TURN}; 1/2 - y, 1/2 - x", "0,0 1/2,0 0,1/2"),
        _row("p3", "333", "p311", Kind.HEXAGONAL, _THIRD_TURN, "0,0 1/2,-1/6 1,0 1/2,1/6"),
        _row("p3m1", "*333", "", Kind.HEXAGONAL, f"{_THIRD_TURN}; {_UPRIGHT}", "0,0 1/2,1/6 0,1/3"),
        _row("p31m", "3*3", "", Kind.HEXAGONAL, f"{_THIRD_TURN}; {_LEVEL}", _KITE),
        _row("p6", "632", "p611", Kind.HEXAGONAL, _SIXTH_TURN, _KITE),
        _row("p6m", "*632", "p6mm", Kind.HEXAGONAL, f"{_SIXTH_TURN}; {_UPRIGHT}", "0,0 1/2,0 1/2,1/6"),
    )
}
"""The catalogue, in the order of the International Tables."""

TRANSPOSED = {"p11m": "pm", "p11g": "pg", "c11m": "cm", "p2gm": "pmg"}
"""Settings in which mirrors and glides lie level instead of upright."""


def _spelled(name: str) -> str:
    return name.strip().lower().replace("×", "x")


@functools.cache
def _by_name() -> dict[str, Group]:
    known = {
        _spelled(name): group
        for group in GROUPS.values()
        for name in (group.name, group.orbifold, *group.others)
    }
    return known | {name: GROUPS[of].transposed() for name, of in TRANSPOSED.items()}


def group_names() -> tuple[str, ...]:
    """Return every name that :func:`group` accepts, in small letters."""
    return tuple(_by_name())


def group(name: str) -> Group:
    """Return the wallpaper group of a name, in any of its spellings: p4m, p4mm, *442.

    Names such as p11m give the group with the axes exchanged.

    Raises:
        UnknownNameError: with the nearest name.
    """
    known = _by_name()
    if _spelled(name) not in known:
        raise UnknownNameError(name, [*GROUPS, *(each for each in known if each not in GROUPS)], "group")
    return known[_spelled(name)]


def group_name(text: str) -> str:
    """Return a name of a group as it is written.

    Raises:
        UnknownNameError: for one that is none.
    """
    group(text)
    return text


GROUP_PATTERN = r"^\s*(" + "|".join(re.escape(name).replace("x", "[x×]") for name in group_names()) + r")\s*$"
"""For editors, which know small letters only; :func:`group` is what decides."""
