"""The seven frieze groups: symmetries of a band, as rows of a table beneath one orbit.

A band runs along x with period 1; its midline is y = 0. Conway, Burgiel and Goodman-Strauss, *The Symmetries
of Things* (2008), chapter 5, for the orbifold and Conway's names; Kopský and Litvin (eds.), *International
Tables for Crystallography E* (2010), part 2, for the others.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TypeAlias

from batik_vector.errors import UnknownNameError
from batik_vector.geometry.maps.affine import Affine
from batik_vector.tiling.symmetry.orbits import Orbit
from batik_vector.values import frozen

HALF = Fraction(1, 2)

Step: TypeAlias = tuple[int, int, Fraction]
"""x' = sx·x + shift, y' = sy·y as (sx, sy, shift): signs, and a shift in periods."""

GLIDE: Step = (1, -1, HALF)
MIDLINE: Step = (1, -1, Fraction(0))
UPRIGHT: Step = (-1, 1, Fraction(0))
HALF_TURN: Step = (-1, -1, Fraction(0))
IDENTITY: Step = (1, 1, Fraction(0))


@frozen
class Frieze:
    """One frieze group: its names, and the generators beside the translation by a period.

    ``others`` are Conway's name, and spellings that other books use; ``p1m1`` is Kopský and Litvin's, with
    upright mirrors, and not Grünbaum and Shephard's, who call p11m so.
    """

    name: str
    orbifold: str
    others: tuple[str, ...]
    generators: tuple[Step, ...]

    def steps(self) -> tuple[Step, ...]:
        """Return the operations modulo whole periods, the identity first."""
        found = [IDENTITY]
        for known in found:
            for generator in self.generators:
                made = composed(generator, known)
                if made not in found:
                    found.append(made)
        return tuple(found)


FRIEZES: dict[str, Frieze] = {
    row.name: row
    for row in (
        Frieze("p1", "∞∞", ("hop", "p111"), ()),
        Frieze("p11g", "∞×", ("step", "p1a1"), (GLIDE,)),
        Frieze("p11m", "∞*", ("jump", "p1m"), (MIDLINE,)),
        Frieze("p1m1", "*∞∞", ("sidle", "pm11"), (UPRIGHT,)),
        Frieze("p2", "22∞", ("spinning hop", "p112"), (HALF_TURN,)),
        Frieze("p2mg", "2*∞", ("spinning sidle", "pma2"), (HALF_TURN, GLIDE)),
        Frieze("p2mm", "*22∞", ("spinning jump", "pmm2"), (HALF_TURN, MIDLINE)),
    )
}
"""The groups. p1m1 has its mirrors at 0 and ½ of the period, p2 its half turns there; p2mg has half turns at
0 and ½, mirrors at ¼ and ¾."""

_BY_NAME = {name: row for row in FRIEZES.values() for name in (row.name, row.orbifold, *row.others)}
FRIEZE_NAMES = ", ".join(FRIEZES)


def composed(last: Step, first: Step) -> Step:
    """Return the operation that does ``first`` and then ``last``, modulo a period."""
    return last[0] * first[0], last[1] * first[1], (last[0] * first[2] + last[2]) % 1


def frieze(name: str) -> Frieze:
    """Return a frieze group by any of its names: "p1m1", "*∞∞", "sidle", "pm11".

    Raises:
        UnknownNameError: with the nearest name there is.
    """
    key = " ".join(name.lower().replace("-", " ").replace("∗", "*").split())
    if key not in _BY_NAME:
        raise UnknownNameError(name, list(_BY_NAME), "frieze")
    return _BY_NAME[key]


def orbit(name: str, period: float, depth: float) -> Orbit:
    """Return the operations of a frieze on a band from y = 0 to y = depth, and its translation, in mm."""
    operations = tuple(
        Affine(a=float(sx), d=float(sy), e=float(shift) * period, f=0.0 if sy > 0 else depth)
        for sx, sy, shift in frieze(name).steps()
    )
    return Orbit(operations, ((period, 0.0),))
