"""Dyeing: the baths that a cloth goes through, and which of them each colour on it has seen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import TypeAlias

from batik_vector.artwork.overdyeing import overdyed
from batik_vector.fields import check
from batik_vector.values import frozen

Seen: TypeAlias = frozenset[str]
"""The names of the baths that a piece of cloth has seen."""


@frozen
class Bath:
    """A dye bath, and the colour that it gives undyed cloth."""

    name: str
    colour: str

    def __post_init__(self) -> None:
        check(self)


@frozen
class Dyeing:
    """The baths in their order, and which of them bare cloth sees and the cloth under each ink.

    ``undyed`` is the cloth's colour before the first bath; ``colours`` are those that are given, and not left
    to the model, by what the cloth has seen.
    """

    baths: tuple[Bath, ...]
    undyed: str
    ground: Seen
    inks: Mapping[str, Seen]
    colours: Mapping[Seen, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        check(self)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the baths in their order."""
        return tuple(bath.name for bath in self.baths)

    def listed(self, seen: Seen) -> tuple[str, ...]:
        """Return baths in the order of dyeing."""
        return tuple(name for name in self.names if name in seen)

    def colour(self, seen: Seen) -> str:
        """Return the colour of cloth that has seen some baths: as given, or else as predicted."""
        given = self.colours.get(seen)
        return given or overdyed(self.undyed, [bath.colour for bath in self.baths if bath.name in seen])
