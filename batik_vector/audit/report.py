"""What an audit says: findings as plain values, grouped and counted, the worst first."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from typing import Any

from batik_vector.units import format_mm
from batik_vector.values import frozen

Place = tuple[float, float]

DIGITS = 4
"""Decimals of every figure that leaves as plain values: a tenth of a grid step."""


class Kind(enum.StrEnum):
    """What a machine may fail at."""

    SIZE = "size"
    """The drawing is larger than the machine."""
    OPEN = "open"
    """A path is open, and has to be closed."""
    DOUBLE = "double"
    """A stretch of path is drawn again."""
    SLIVER = "sliver"
    """A mark or a hole so thin all over that nobody meant to draw it."""
    LINE = "line"
    """A line, a mark or a neck is too narrow."""
    GAP = "gap"
    """The bare ground between two marks, or within one, is too narrow."""
    HOLE = "hole"
    """A hole is too small."""
    NODES = "nodes"
    """Nodes follow too closely on one another."""


@frozen
class Finding:
    """One thing that a machine would fail at.

    ``where`` is its place on the page in mm, y up, and ``ink`` whose it is. ``value`` is what was measured
    there and ``limit`` what the machine can do, both in mm; of nodes, in nodes to a mm. Of an open path and
    one drawn again ``value`` is its length, and ``limit`` None.
    """

    kind: Kind
    ink: str
    where: Place
    value: float
    limit: float | None
    words: str

    @property
    def share(self) -> float:
        """How much of what is needed is there, from 0 to 1: the less, the worse."""
        if self.limit is None:
            return 0.0
        low, high = sorted((self.value, self.limit))
        return low / high if high > 0 else 0.0


@frozen
class Group:
    """Findings of one kind and ink, the worst first."""

    kind: Kind
    ink: str
    findings: tuple[Finding, ...]

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.findings)

    @property
    def worst(self) -> Finding:
        """The worst of them."""
        return self.findings[0]


@frozen(kw_only=True)
class Audit:
    """What a drawing asks of a machine that it cannot do; it passed if there is nothing.

    ``findings`` are sorted, the worst first. ``measured`` names the kinds that the machine sets limits for.
    """

    machine: str
    findings: tuple[Finding, ...]
    measured: tuple[Kind, ...]

    @property
    def passed(self) -> bool:
        """Whether nothing was found."""
        return not self.findings

    @property
    def groups(self) -> tuple[Group, ...]:
        """The findings by kind and ink, the group with the worst of all first."""
        known: dict[tuple[Kind, str], list[Finding]] = {}
        for each in self.findings:
            known.setdefault((each.kind, each.ink), []).append(each)
        return tuple(Group(kind, ink, tuple(each)) for (kind, ink), each in known.items())

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain values for JSON, in a fixed order."""
        return {
            "machine": self.machine,
            "passed": self.passed,
            "measured": [str(kind) for kind in self.measured],
            "groups": [
                {"kind": str(each.kind), "ink": each.ink, "count": each.count, "worst": _plain(each.worst)}
                for each in self.groups
            ],
            "findings": [_plain(each) for each in self.findings],
        }


def _plain(finding: Finding) -> dict[str, Any]:
    return {
        "kind": str(finding.kind),
        "ink": finding.ink,
        "where_mm": [round(side, DIGITS) + 0.0 for side in finding.where],
        "value": round(finding.value, DIGITS),
        "limit": finding.limit,
        "words": finding.words,
    }


def sorted_findings(found: Sequence[Finding]) -> tuple[Finding, ...]:
    """Return findings in a fixed order, the worst first."""
    kinds = list(Kind)
    return tuple(
        sorted(found, key=lambda f: (round(f.share, 6), kinds.index(f.kind), -f.value, f.ink, f.where))
    )


def mm(value: float) -> str:
    """Return a measured length in words, to three digits or so."""
    return format_mm(round(value, 2 if value >= 1 else 3))
