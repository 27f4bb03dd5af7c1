"""What symmetry is asked of a tile, and which groups contain which."""

from __future__ import annotations

import functools

from batik_vector.tiling.symmetry.groups import group
from batik_vector.values import frozen

_WITHIN = {
    "p1": "",
    "p2": "p1",
    "pm": "p1 pg cm",
    "pg": "p1",
    "cm": "p1 pm pg",
    "pmm": "p2 pm pmg cmm",
    "pmg": "p2 pm pg pgg",
    "pgg": "p2 pg",
    "cmm": "p2 cm pmm pmg pgg",
    "p4": "p2",
    "p4m": "p4 pmm cmm p4g",
    "p4g": "p4 cmm pgg",
    "p3": "p1",
    "p3m1": "p3 cm p31m",
    "p31m": "p3 cm p3m1",
    "p6": "p2 p3",
    "p6m": "p6 p3m1 p31m cmm",
}
"""Groups among the maximal subgroups of each. International Tables for Crystallography A1, plane groups."""


@functools.cache
def contained(name: str) -> frozenset[str]:
    """Return the groups that are subgroups of one, itself included, of this or a larger cell."""
    inner = _WITHIN[name].split()
    found = {name}
    while inner:
        each = inner.pop()
        if each not in found:
            found.add(each)
            inner += _WITHIN[each].split()
    return frozenset(found)


@frozen
class Asked:
    """A symmetry group that a tile ought to have.

    ``exactly`` asks for that group and no more; a recipe only promises that it is contained, since motifs
    may have symmetries of their own. ``stretch`` is by how much (0.02 is 2 %) the tile is known to be drawn
    out in one direction against the other.
    """

    name: str
    exactly: bool = True
    stretch: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", group(self.name).name)

    def allows(self, found: str) -> bool:
        """Whether a group that was found will do."""
        return found == self.name or (not self.exactly and self.name in contained(found))
