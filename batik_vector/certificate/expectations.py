"""What symmetry is asked of a tile, and which groups contain which."""

from __future__ import annotations

import functools

from batik_vector.fields import check
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


ORDERS = {
    **dict.fromkeys(("p1",), 1),
    **dict.fromkeys(("p2", "pm", "pg", "cm"), 2),
    **dict.fromkeys(("p3",), 3),
    **dict.fromkeys(("pmm", "pmg", "pgg", "cmm", "p4"), 4),
    **dict.fromkeys(("p3m1", "p31m", "p6"), 6),
    **dict.fromkeys(("p4m", "p4g"), 8),
    **dict.fromkeys(("p6m",), 12),
}
"""Linear parts of each group."""


def has_more(found: str, asked: str) -> bool:
    """Whether a group has all the symmetry of another and more, and is not merely another one.

    Groups of one order contain each other on larger cells, as p31m does p3m1: they are different groups.
    """
    return asked in contained(found) and ORDERS[found] > ORDERS[asked]


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
        check(self)
        object.__setattr__(self, "name", group(self.name).name)

    def allows(self, found: str) -> bool:
        """Whether a group that was found will do."""
        return found == self.name or (not self.exactly and self.name in contained(found))
